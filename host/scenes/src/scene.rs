//! A checked scene, and where it is seen from.

use std::sync::{Arc, OnceLock};

use super::camera::towards;
use super::error::SceneError;
use super::model::SceneData;
use super::texture_words;

/// A scene that passed every check of [`Scene::new`]: finite, in range, references whole.
#[derive(Clone, Debug)]
pub struct Scene {
    pub(super) data: SceneData,
    /// Words of its textures, made at the first request.
    textures: OnceLock<Arc<Vec<u32>>>,
    pub(super) counts: Counts,
}

/// Sizes of every frame of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub triangles: usize,
    pub emissive: usize,
    pub mesh_lights: usize,
    pub analytic: usize,
}

impl Scene {
    /// Wraps data that [`Scene::new`] found sound.
    pub(super) fn from_checked(data: SceneData, counts: Counts) -> Self {
        Self {
            data,
            textures: OnceLock::new(),
            counts,
        }
    }

    /// Built-in name or path of the file.
    pub fn name(&self) -> &str {
        &self.data.name
    }

    /// What the scene is made of.
    pub fn data(&self) -> &SceneData {
        &self.data
    }

    /// Gives the parts back, for changes; [`Scene::new`] checks them again.
    pub fn into_data(self) -> SceneData {
        self.data
    }

    /// What the loader left out, one sentence each.
    pub fn warnings(&self) -> &[String] {
        &self.data.warnings
    }

    /// The scene with means in place of its textures.
    pub fn without_textures(mut self) -> Self {
        for material in &mut self.data.materials {
            material.textures = None;
        }
        self.data.pictures.clear();
        self.textures = OnceLock::new();
        self
    }

    /// The words of [`TextureArrays`](super::TextureArrays).
    pub(super) fn texture_words(&self) -> Arc<Vec<u32>> {
        Arc::clone(
            self.textures
                .get_or_init(|| Arc::new(texture_words::words(&self.data))),
        )
    }

    /// The scene as a camera at `eye` sees it that looks at `target`, both metres, with a vertical field of view of `yfov`
    /// radians; +Y is up. Its own cameras are gone. Where both are one place it looks along −Z.
    ///
    /// # Errors
    /// As [`Scene::new`]: places beyond 2^40 m, fields of view that are none.
    pub fn seen_from(self, eye: [f32; 3], target: [f32; 3], yfov: f32) -> Result<Self, SceneError> {
        let mut data = self.into_data();
        data.cameras.clear();
        data.look(&towards(eye.map(f64::from), target.map(f64::from), yfov));
        Self::new(data)
    }
}
