//! What is compared: a structure over a scene.

use lightbvh::BuildParams;

use crate::backend::Sampler;
use crate::scene::Scene;

/// A structure over a scene.
pub(super) struct Subject<'a> {
    pub scene: &'a Scene,
    pub sampler: Sampler,
    /// What lights are chosen by, for messages.
    pub importance: &'static str,
    pub params: BuildParams,
    /// Whether images and reservoirs without a tree are compared too: once per scene.
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
