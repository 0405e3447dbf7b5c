//! Where a frame is seen from.

use glam::{DAffine3, DVec3};

use super::model::{Camera, Node, SceneData};
use super::transform::{Transform, unit_or};
use crate::vector::{cross, sub};

/// Where an image is seen from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Position, metres.
    pub eye: [f32; 3],
    /// Unit vector to the right of the image.
    pub right: [f32; 3],
    /// Unit vector to the top of the image.
    pub up: [f32; 3],
    /// Unit vector into the image.
    pub forward: [f32; 3],
    /// Vertical field of view, radians, above 0 and below pi.
    pub yfov: f32,
}

/// The camera of a node: looks along -Z, +Y up; the node's scale does not matter.
pub(super) fn view_of_node(world: &DAffine3, yfov: f32) -> View {
    let [_, up, back, eye] = world.to_cols_array_2d();
    looking(eye, unit_or(back.map(|x| -x), [0.0, 0.0, -1.0]), up, yfov)
}

/// A view from one place to another, +Y up; along -Z where both are one.
pub(super) fn towards(eye: [f64; 3], target: [f64; 3], yfov: f32) -> View {
    let forward = unit_or(sub(target, eye), [0.0, 0.0, -1.0]);
    looking(eye, forward, [0.0, 1.0, 0.0], yfov)
}

/// Vertical field of view of scenes without a camera: 50 degrees, a natural view on a screen.
const YFOV: f32 = 0.872_664_6;

/// The view of a scene without a camera: from the front, so that the sphere around the box of its vertices touches the image's
/// upper and lower edge.
pub(super) fn around([low, high]: [DVec3; 2]) -> View {
    // Without a vertex there is no box.
    let (low, high) = if low.x <= high.x {
        (low, high)
    } else {
        Default::default()
    };
    let radius = (0.5 * low.distance(high)).max(1e-3);
    let (middle, front) = (0.5 * (low + high), DVec3::new(0.35, 0.3, 1.0).normalize());
    towards((middle + 2.37 * radius * front).into(), middle.into(), YFOV)
}

impl SceneData {
    /// Appends a camera on a node of its own.
    pub(super) fn look(&mut self, view: &View) {
        self.cameras.push(Camera {
            node: self.nodes.len() as u32,
            yfov: view.yfov,
        });
        self.nodes.push(Node {
            name: String::from("camera"),
            transform: Transform::Matrix([view.right, view.up, view.forward.map(|x| -x), view.eye]),
            ..Node::default()
        });
    }
}

/// `forward` is a unit vector; `up` is made orthogonal to it.
pub(super) fn looking(eye: [f64; 3], forward: [f64; 3], up: [f64; 3], yfov: f32) -> View {
    // A camera that looks straight up or down takes -Z as its up direction.
    let beside = unit_or(cross(forward, [0.0, 0.0, -1.0]), [1.0, 0.0, 0.0]);
    let up = unit_or(up, [0.0, 1.0, 0.0]);
    let right = cross(forward, up);
    let right = if right.iter().all(|x| x.abs() < 1e-9) {
        beside
    } else {
        unit_or(right, beside)
    };
    let up = cross(right, forward);
    let narrow = |v: [f64; 3]| v.map(|x| x as f32);
    View {
        eye: narrow(eye),
        right: narrow(right),
        up: narrow(up),
        forward: narrow(forward),
        yfov,
    }
}
