//! The types of lights that scenes are rendered with: triangles alone, or any kind. What a scene lacks costs it nothing.

use lightbvh::EmissiveTriangle;
use lightbvh::light::{AnyLight, Light};
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::textures::{NoTextures, TextureView};

use super::texture_words::TextureArrays;
use crate::vector::{dot, normal};

/// A type of lights of a scene.
pub trait SceneLight: Emitter + From<EmissiveTriangle> {
    /// Whether it holds lights of any kind.
    const IS_ANY: bool;

    /// A light by formula, where the type holds such.
    fn of_kind(light: AnyLight) -> Option<Self>;

    /// Textures of surfaces, where such scenes know of them.
    fn textures(textures: &TextureArrays) -> Self::Textures<'_>;

    /// Vertices of the light where it is a triangle; of another, three times the place it is at.
    fn corners(&self) -> [[f32; 3]; 3];

    /// Luminous part of the flux, W.
    fn flux(&self) -> f64;
}

impl SceneLight for EmissiveTriangle {
    const IS_ANY: bool = false;

    fn of_kind(_: AnyLight) -> Option<Self> {
        None
    }

    fn textures(_: &TextureArrays) -> NoTextures {
        NoTextures
    }

    fn corners(&self) -> [[f32; 3]; 3] {
        self.p
    }

    fn flux(&self) -> f64 {
        // Pi times area times luminance, doubled where both sides emit.
        let normal = normal(self.p);
        let area = 0.5 * dot(normal, normal).sqrt();
        let sides = if self.is_two_sided() { 2.0 } else { 1.0 };
        std::f64::consts::PI * area * f64::from(self.luminance()) * sides
    }
}

impl SceneLight for AnyLight {
    const IS_ANY: bool = true;

    fn of_kind(light: AnyLight) -> Option<Self> {
        Some(light)
    }

    fn textures(textures: &TextureArrays) -> TextureView<'_> {
        textures.view()
    }

    fn corners(&self) -> [[f32; 3]; 3] {
        EmissiveTriangle::try_from(*self).map_or([self.centroid(); 3], |triangle| triangle.p)
    }

    fn flux(&self) -> f64 {
        match EmissiveTriangle::try_from(*self) {
            Ok(triangle) => SceneLight::flux(&triangle),
            Err(other) => f64::from(other.moments().phi),
        }
    }
}
