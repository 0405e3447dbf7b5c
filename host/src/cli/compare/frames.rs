//! Frames of a scene, each made once for all who ask.

use std::collections::BTreeMap;

use lightbvh::Lights;

use crate::backend::SceneArrays;
use crate::error::HostError;
use crate::method::Step;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at};

/// The frames of a scene that are at hand.
pub(super) struct Frames<'a> {
    scene: &'a Scene,
    size: (u32, u32),
    lights: BTreeMap<u32, Lights>,
    arrays: BTreeMap<u32, SceneArrays>,
}

impl<'a> Frames<'a> {
    pub fn new(scene: &'a Scene, size: (u32, u32)) -> Self {
        Self {
            scene,
            size,
            lights: BTreeMap::new(),
            arrays: BTreeMap::new(),
        }
    }

    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Makes the lights of a frame, and its arrays if they are `to_render`.
    pub fn prepare(&mut self, frame: u32, to_render: bool) -> Result<(), HostError> {
        if !self.lights.contains_key(&frame) {
            self.lights.insert(frame, lights_at(self.scene, frame)?);
        }
        if to_render && !self.arrays.contains_key(&frame) {
            let arrays = arrays_at(self.scene, frame, self.size.0, self.size.1)?;
            self.arrays.insert(frame, arrays);
        }
        Ok(())
    }

    /// A frame as methods learn of it, once prepared.
    pub fn step(&self, frame: u32) -> Step<'_> {
        Step {
            scene: self.scene,
            frame,
            lights: &self.lights[&frame],
        }
    }

    /// The arrays of a frame, once prepared to render.
    pub fn arrays(&self, frame: u32) -> &SceneArrays {
        &self.arrays[&frame]
    }

    /// Lets all frames go.
    pub fn clear(&mut self) {
        self.lights.clear();
        self.arrays.clear();
    }
}
