//! The methods that are compared: each a way to choose lights, and what it does from frame to frame to keep choosing well.
//!
//! A method is one file with one [`Runner`]; [`runner`] makes each as the comparison has it.

mod moving;
mod no_tree;
mod restir;
mod single_level;
mod two_level;

pub use no_tree::NoTree;
pub use restir::{Count, Reservoirs};
pub use single_level::SingleLevel;
pub use two_level::TwoLevel;

use std::sync::Arc;
use std::time::Duration;

use lightbvh::{BuildParams, Heuristic, Lights};
use lightbvh_kernels::bvh::{Choice, Paper, Standard, WIDTH};
use lightbvh_kernels::shading::restir::PixelReservoir;
use lightbvh_kernels::shading::restir::surface::Surface;
use serde::{Deserialize, Serialize};

use crate::backend::{
    Backend, BackendError, Bvh, CandidateSource, Combination, CpuBackend, DeviceBackend, RestirOptions,
    SceneArrays, Timed,
};
use crate::error::HostError;
use crate::scene::Scene;
use crate::vulkan::Device;
use crate::workload::Shot;

/// A method of the paper's comparison, or a baseline.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, clap::ValueEnum, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Every light alike.
    Uniform,
    /// In proportion to flux.
    Power,
    /// One tree over all triangles by the paper's importance, built at the first frame and refitted ever after.
    SingleLevelRefit,
    /// The same, built anew every frame.
    SingleLevelRebuilt,
    /// One tree over all triangles by the default importance, built anew every frame.
    SingleLevelMomentsRebuilt,
    /// The paper's two levels and importance, split by the surface area heuristic.
    TwoLevelSah,
    /// The paper's two levels and importance, split by the surface area orientation heuristic.
    TwoLevelSaoh,
    /// Two levels by the default importance, built by the default criterion.
    TwoLevelMoments,
    /// Spatiotemporal reservoirs (Bitterli et al. 2020).
    Restir,
    /// The same with candidates from the paper's two-level light BVH.
    TwoLevelRestir,
    /// The same with candidates from the default two-level light BVH.
    TwoLevelMomentsRestir,
}

impl Method {
    /// All methods, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::Uniform,
        Self::Power,
        Self::SingleLevelRefit,
        Self::SingleLevelRebuilt,
        Self::SingleLevelMomentsRebuilt,
        Self::TwoLevelSah,
        Self::TwoLevelSaoh,
        Self::TwoLevelMoments,
        Self::Restir,
        Self::TwoLevelRestir,
        Self::TwoLevelMomentsRestir,
    ];

    /// As on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Power => "power",
            Self::SingleLevelRefit => "single-level-refit",
            Self::SingleLevelRebuilt => "single-level-rebuilt",
            Self::SingleLevelMomentsRebuilt => "single-level-moments-rebuilt",
            Self::TwoLevelSah => "two-level-sah",
            Self::TwoLevelSaoh => "two-level-saoh",
            Self::TwoLevelMoments => "two-level-moments",
            Self::Restir => "restir",
            Self::TwoLevelRestir => "two-level-restir",
            Self::TwoLevelMomentsRestir => "two-level-moments-restir",
        }
    }

    /// Whether it walks a light BVH and nothing else.
    #[must_use]
    pub fn is_light_bvh(self) -> bool {
        self.importance().is_some() && !matches!(self, Self::TwoLevelRestir | Self::TwoLevelMomentsRestir)
    }

    /// Whether it walks a light BVH of a single level.
    #[must_use]
    pub fn is_single_level(self) -> bool {
        matches!(
            self,
            Self::SingleLevelRefit | Self::SingleLevelRebuilt | Self::SingleLevelMomentsRebuilt
        )
    }

    /// Whether its light BVH is built anew by every frame that waits for it.
    #[must_use]
    pub fn is_rebuilt(self) -> bool {
        matches!(self, Self::SingleLevelRebuilt | Self::SingleLevelMomentsRebuilt)
    }

    /// Name of the importance of the light BVH that it walks, if any: [`Choice::NAME`].
    #[must_use]
    pub fn importance(self) -> Option<&'static str> {
        match self {
            Self::Uniform | Self::Power | Self::Restir => None,
            Self::SingleLevelRefit
            | Self::SingleLevelRebuilt
            | Self::TwoLevelSah
            | Self::TwoLevelSaoh
            | Self::TwoLevelRestir => Some(Paper::NAME),
            Self::SingleLevelMomentsRebuilt | Self::TwoLevelMoments | Self::TwoLevelMomentsRestir => {
                Some(Standard::NAME)
            }
        }
    }
}

/// A frame of an animation, as a method learns of it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Number of the frame.
    pub frame: u32,
    /// Its lights.
    pub lights: &'a Lights,
}

/// What bringing a method's structures to a frame took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UpdateTimes {
    /// New bounds in the structures there are.
    pub refit: Duration,
    /// Building structures anew, wherever and whenever it ran.
    pub rebuild: Duration,
    /// How long the frame stood still for a rebuild: all of it where it does not run beside the frame.
    pub wait: Duration,
}

/// Names a sequence of images of consecutive frames.
pub type Chain = u64;

/// What a history of ReSTIR keeps from frame to frame: its G-buffer and reservoirs.
pub type History = (Vec<Surface>, Vec<PixelReservoir>);

/// A method over one scene on one backend.
pub trait Runner {
    /// Brings the structures to the next frame. Frames come in ascending order; only methods that say so in
    /// [`may_skip`](Self::may_skip) see them with gaps.
    ///
    /// # Errors
    /// [`HostError`] from a device, or for lights that the method cannot take.
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError>;

    /// Renders the frame last advanced to, which `arrays` are of, and `shot` too. Images of one `chain` follow each other
    /// over consecutive frames, so that what one leaves behind (reservoirs) may serve the next; a chain that is not known
    /// yet begins.
    ///
    /// # Errors
    /// [`HostError`] from a device, or for a scene that the method cannot take.
    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        chain: Chain,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError>;

    /// Drops what a chain left behind.
    fn end(&mut self, _chain: Chain) {}

    /// What renders single images, where one does: of the frame last advanced to.
    fn backend(&mut self) -> Option<&mut dyn Backend> {
        None
    }

    /// What the last image of a chain left behind, history by history; nothing but of ReSTIR.
    ///
    /// # Errors
    /// [`HostError`] from a device.
    fn histories(&self, _chain: Chain) -> Result<Vec<History>, HostError> {
        Ok(Vec::new())
    }

    /// Shadow rays that the last image of a chain traced, where they are counted.
    fn shadow_rays(&self, _chain: Chain) -> Option<u64> {
        None
    }

    /// Whether a frame depends on the first frame and itself alone, so that those between may be left out.
    fn may_skip(&self) -> bool {
        false
    }

    /// How many images of its chain must come before the one that counts.
    fn history(&self) -> u32 {
        0
    }
}

/// Where a method renders and refits.
#[derive(Clone, Copy)]
pub enum Target<'d> {
    /// All cores of the current rayon pool.
    Cpu,
    /// A Vulkan device.
    Device(&'d Device),
}

impl<'d> Target<'d> {
    /// As in tables.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Device(device) => device.name(),
        }
    }

    /// A backend over `bvh`.
    pub(crate) fn backend<C: Choice<W>, const W: usize>(
        &self,
        bvh: Bvh<C, W>,
    ) -> Result<Box<dyn Backend + 'd>, BackendError> {
        Ok(match *self {
            Self::Cpu => Box::new(CpuBackend::<C, W>::new(bvh)),
            Self::Device(device) => Box::new(DeviceBackend::<C, W>::new(device, &bvh)?),
        })
    }
}

/// Builds what `method` needs at its first frame.
///
/// # Errors
/// [`HostError`] from a device, or for a scene that the method cannot take.
pub fn runner<'d>(
    method: Method,
    first: &Step<'_>,
    target: Target<'d>,
) -> Result<Box<dyn Runner + 'd>, HostError> {
    let sah = BuildParams::paper(Heuristic::Sah);
    let saoh = BuildParams::paper(Heuristic::Saoh);
    let usual = BuildParams::default();
    let options = |source| RestirOptions::new(source, Combination::Unbiased);
    let (power, bvh) = (
        options(CandidateSource::Power),
        options(CandidateSource::LightBvh),
    );
    let count = Count::ShadowRays;
    Ok(match method {
        Method::Uniform => Box::new(NoTree::uniform(first, target)?),
        Method::Power => Box::new(NoTree::power(first, target)?),
        Method::SingleLevelRefit => Box::new(SingleLevel::<Paper, 4>::refitted(first, target, saoh)?),
        Method::SingleLevelRebuilt => Box::new(SingleLevel::<Paper, 4>::rebuilt(first, target, saoh)?),
        Method::SingleLevelMomentsRebuilt => {
            Box::new(SingleLevel::<Standard, WIDTH>::rebuilt(first, target, usual)?)
        }
        Method::TwoLevelSah => Box::new(TwoLevel::<Paper, 4>::new(first, target, sah)?),
        Method::TwoLevelSaoh => Box::new(TwoLevel::<Paper, 4>::new(first, target, saoh)?),
        Method::TwoLevelMoments => Box::new(TwoLevel::<Standard, WIDTH>::new(first, target, usual)?),
        Method::Restir => Box::new(Reservoirs::<Standard, WIDTH>::new(
            first, target, power, usual, count,
        )?),
        Method::TwoLevelRestir => Box::new(Reservoirs::<Paper, 4>::new(first, target, bvh, saoh, count)?),
        Method::TwoLevelMomentsRestir => Box::new(Reservoirs::<Standard, WIDTH>::new(
            first, target, bvh, usual, count,
        )?),
    })
}

/// Renders through a backend.
fn render(
    backend: &mut dyn Backend,
    step: &Step<'_>,
    arrays: &SceneArrays,
    shot: &Shot,
    sampler: crate::backend::Sampler,
) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
    let params = shot.params(step.scene.data().background);
    Ok(backend.render(arrays, &params, sampler)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_command_line_and_of_results() {
        for method in Method::ALL {
            let parsed = <Method as clap::ValueEnum>::from_str(method.name(), false);
            assert_eq!(parsed, Ok(method));
            assert_eq!(serde_json::to_value(method).expect("a name"), method.name());
        }
    }
}
