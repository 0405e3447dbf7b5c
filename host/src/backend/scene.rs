//! A frame of a scene as the render pass reads it.

use lightbvh::{EmissiveTriangle, Instance, Lights};
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pixel::Scene as SceneView;
use lightbvh_kernels::shading::trace::Surfaces;

use crate::render::{RayBvh, power_thresholds};
use crate::scene::{SceneLight, TextureArrays};

/// How the renderer chooses lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, strum::IntoStaticStr, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Sampler {
    /// Every light alike.
    Uniform,
    /// In proportion to flux.
    Power,
    /// A light BVH over all triangles.
    SingleLevel,
    /// A light BVH over instances over one over the triangles of each mesh.
    TwoLevel,
}

impl Sampler {
    /// All samplers.
    pub const ALL: [Self; 4] = [Self::Uniform, Self::Power, Self::SingleLevel, Self::TwoLevel];

    /// Whether it walks a light BVH.
    pub fn needs_bvh(self) -> bool {
        matches!(self, Self::SingleLevel | Self::TwoLevel)
    }

    /// As on the command line.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A frame's arrays.
#[derive(Clone, Debug)]
pub struct SceneArrays<L = EmissiveTriangle> {
    /// The surfaces that rays meet.
    pub rays: RayBvh,
    /// How it reflects.
    pub materials: Vec<Material>,
    /// The lights in the world.
    pub lights: Lights<L>,
    /// The one instance that all lights are of where they are read from here.
    identity: [Instance; 1],
    /// Table of the power sampler; empty when there are more lights than it can tell apart, or none has flux.
    pub thresholds: Vec<u32>,
    /// Who looks.
    pub camera: Camera,
    /// The surfaces' textures.
    pub textures: TextureArrays,
}

impl<L: SceneLight> SceneArrays<L> {
    /// Gathers a frame; the power table is made here.
    pub fn new(rays: RayBvh, materials: Vec<Material>, lights: Lights<L>, camera: Camera) -> Self {
        let thresholds = power_thresholds(lights.all()).unwrap_or_default();
        let identity = listed(lights.all().len() as u32);
        Self {
            rays,
            materials,
            lights,
            identity,
            thresholds,
            camera,
            textures: TextureArrays::default(),
        }
    }

    /// With textures on the surfaces.
    #[must_use]
    pub fn textured(self, textures: TextureArrays) -> Self {
        Self { textures, ..self }
    }

    /// The arrays as the kernels' functions take them, the lights as they are listed here.
    pub fn view(&self) -> SceneView<'_, L> {
        self.lit_by(self.emitters())
    }

    /// The arrays as the kernels' functions take them, with lights from elsewhere: those of a light BVH.
    pub fn lit_by<'a>(&'a self, emitters: Emitters<'a, L>) -> SceneView<'a, L> {
        SceneView {
            surfaces: self.surfaces(),
            materials: &self.materials,
            emitters,
        }
    }

    /// The surfaces that rays meet, and their textures.
    pub fn surfaces(&self) -> Surfaces<'_, L::Textures<'_>> {
        let Surfaces { nodes, blocks, .. } = self.rays.surfaces();
        let textures = L::textures(&self.textures);
        Surfaces {
            nodes,
            blocks,
            textures,
        }
    }

    /// The lights as they are listed here.
    pub fn emitters(&self) -> Emitters<'_, L> {
        Emitters {
            lights: self.lights.all(),
            instances: &self.identity,
        }
    }
}
