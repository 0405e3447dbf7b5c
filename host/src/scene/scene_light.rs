//! The types of lights that scenes are rendered with: triangles alone, or any kind. What a scene lacks costs it nothing.

use lightbvh::EmissiveTriangle;
use lightbvh::light::{AnyLight, Light};
use lightbvh_kernels::shading::emitter::Emitter;

use crate::render::triangle_flux;

/// A type of lights of a scene.
pub trait SceneLight: Emitter + From<EmissiveTriangle> {
    /// A light by formula, where the type holds such.
    fn of_kind(light: AnyLight) -> Option<Self>;

    /// Vertices of the light where it is a triangle; of another, three times the place it is at.
    fn corners(&self) -> [[f32; 3]; 3];

    /// Luminous part of the flux, W; of boxes, a factor that is the same for all.
    fn flux(&self) -> f64;
}

impl SceneLight for EmissiveTriangle {
    fn of_kind(_: AnyLight) -> Option<Self> {
        None
    }

    fn corners(&self) -> [[f32; 3]; 3] {
        self.p
    }

    fn flux(&self) -> f64 {
        triangle_flux(self)
    }
}

impl SceneLight for AnyLight {
    fn of_kind(light: AnyLight) -> Option<Self> {
        Some(light)
    }

    fn corners(&self) -> [[f32; 3]; 3] {
        EmissiveTriangle::try_from(*self).map_or([self.centroid(); 3], |triangle| triangle.p)
    }

    fn flux(&self) -> f64 {
        match EmissiveTriangle::try_from(*self) {
            Ok(triangle) => triangle_flux(&triangle),
            Err(other) => f64::from(other.moments().phi),
        }
    }
}
