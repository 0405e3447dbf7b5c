//! What a configuration is, and what it is asked for.

use std::fmt;
use std::time::Duration;

use lightbvh::{Lights, Random64, ShadingPoint};
use lightbvh_kernels::render::RenderParams;
use serde::Serialize;

use super::update::{Frame, Spent, Update};
use crate::backend::{Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::method::Builder;

/// What a user can choose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Config {
    /// What differs from the default.
    pub axis: Axis,
    /// What becomes of samples: `direct`, each counts by itself.
    pub integrator: &'static str,
    pub levels: Sampler,
    pub importance: &'static str,
    /// How nodes hold it, and their children.
    pub layout: &'static str,
    pub width: usize,
    pub builder: Builder,
    pub update: Update,
    /// Candidates of each sample.
    pub candidates: u32,
}

/// What a configuration is there to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Axis {
    /// What `LightBvh::two_level` and `render` do unless told otherwise.
    Default,
    /// What lights are chosen by.
    Importance,
    /// How the tree is built.
    Builder,
    /// One level or two.
    Levels,
    /// How the tree follows moving lights.
    Update,
    /// Candidates of a sample.
    Candidates,
    /// Operations that every processor computes alike, or its own.
    Arithmetic,
}

/// A configuration over the lights of a scene.
pub(super) trait Subject {
    fn config(&self) -> Config;

    fn bytes(&self) -> usize;

    /// Builds the tree of a frame, beside the one there is.
    fn build(&self, frame: &Frame<'_>) -> Result<Duration, HostError>;

    /// Brings the tree to the next frame.
    fn advance(&mut self, frame: &Frame<'_>) -> Result<Spent, HostError>;

    /// Samples each point once. Numbers begin with hash(`first`).
    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration;

    /// Numbers and pmfs of the candidates for a point.
    fn candidates(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>);

    /// The probability of a light.
    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32;

    fn render(
        &mut self,
        arrays: &SceneArrays,
        params: RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError>;
}

impl fmt::Display for Config {
    /// What differs from the default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let builder: &str = self.builder.name();
        match self.axis {
            Axis::Default => write!(f, "default"),
            Axis::Importance => write!(
                f,
                "{}, {} x {}, {builder}",
                self.importance, self.layout, self.width
            ),
            Axis::Builder => write!(f, "built by {builder}"),
            Axis::Levels => write!(f, "{}, {}", self.levels.name(), self.importance),
            Axis::Update => write!(f, "{}, {}", self.levels.name(), self.update.name()),
            Axis::Arithmetic => write!(f, "native operations"),
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}
