//! What is compared: a structure over a scene, and its tree in a frame.

use lightbvh::{BuildParams, Lights};
use lightbvh_kernels::bvh::Choice;
use serde::Serialize;

use crate::backend::{Bvh, Sampler};
use crate::scene::Scene;

/// A structure over a scene.
pub(super) struct Subject<'a> {
    pub scene: &'a Scene,
    pub sampler: Sampler,
    /// What lights are chosen by, for messages.
    pub importance: &'static str,
    pub params: BuildParams,
    /// Whether images without a tree are compared too: once per scene.
    pub treeless: bool,
}

impl Subject<'_> {
    /// Where words come from.
    pub fn says(&self, kernel: &str) -> String {
        format!(
            "{} {} {} {kernel}",
            self.scene.name(),
            self.sampler.name(),
            self.importance
        )
    }
}

/// A tree in one frame, and whether every invariant of it holds. It is over the lights as they stand in the world: two levels
/// have a tree for each instance, which `inspect` and `trade` share.
#[derive(Debug, Serialize)]
pub(super) struct Tree {
    pub scene: String,
    pub importance: &'static str,
    pub structure: Sampler,
    pub frame: u32,
    pub valid: bool,
    pub said: String,
    pub lights: usize,
    pub mesh_lights: usize,
    pub nodes: usize,
    pub depth: u32,
    pub bytes_per_light: f64,
}

impl Tree {
    pub fn of<C: Choice<W>, const W: usize>(
        subject: &Subject<'_>,
        frame: u32,
        bvh: &Bvh<C, W>,
        lights: &Lights<C::Light>,
    ) -> Self {
        let violation = bvh.validate().err().map(|violation| violation.to_string());
        Self {
            scene: subject.scene.name().to_owned(),
            importance: subject.importance,
            structure: subject.sampler,
            frame,
            valid: violation.is_none(),
            said: violation.unwrap_or_else(|| "hold".to_owned()),
            lights: lights.triangles().len(),
            mesh_lights: lights.mesh_count(),
            nodes: bvh.nodes().len() + bvh.top_nodes().len(),
            depth: bvh.depth(),
            bytes_per_light: bvh.bytes() as f64 / lights.triangles().len().max(1) as f64,
        }
    }
}
