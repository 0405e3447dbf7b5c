//! The kernels' camera from a pose and a field of view.

use lightbvh_kernels::shading::camera::Camera;
use lightbvh_scenes::View;

/// The camera of an image of `width` by `height` square pixels.
pub fn camera(view: &View, width: u32, height: u32) -> Camera {
    let half_height = (f64::from(view.yfov) * 0.5).tan();
    let half_width = half_height * f64::from(width) / f64::from(height.max(1));
    Camera {
        origin: view.eye,
        right: view.right.map(|c| (f64::from(c) * half_width) as f32),
        up: view.up.map(|c| (f64::from(c) * half_height) as f32),
        forward: view.forward,
    }
}
