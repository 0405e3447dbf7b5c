//! A budget as an option of the builder.

use alloc::format;
use alloc::vec::Vec;
use core::time::Duration;

use super::{Budget, Lighting, Measured, Pick, TuneError, Tuning};
use crate::build::BuildParams;
use crate::bvh::LightBvh;
use crate::lights::Lights;
use crate::point::ShadingPoint;

/// How to build, and how many candidates to take.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    /// Parameters of the build.
    pub params: BuildParams,
    /// Candidates of each sample.
    pub candidates: u32,
    /// What they achieve.
    pub pick: Pick,
    /// All that was tried.
    pub measured: Vec<Measured>,
}

const CANDIDATES: [u32; 5] = [1, 2, 4, 8, 16];

impl BuildParams {
    /// The best of [`FAST`](Self::FAST), [`BALANCED`](Self::BALANCED) and [`BEST`](Self::BEST) for [`LightBvh::two_level`] over
    /// `lights`, with 1 to 16 candidates to a sample, within a budget for a point; points, light, shadow ray and clock as for
    /// [`Tuning`]. The time of the build is not part of it.
    ///
    /// # Errors
    /// [`TuneError`], as of [`Tuning::new`], [`Tuning::measure`] and [`Budget::pick`].
    pub fn within(
        budget: Budget,
        lights: &Lights,
        points: &[ShadingPoint],
        lighting: &dyn Lighting,
        shadow_ray_ns: f64,
        clock: impl FnMut() -> Duration,
    ) -> Result<Within, TuneError> {
        let presets = [
            ("balanced", Self::BALANCED),
            ("fast", Self::FAST),
            ("best", Self::BEST),
        ];
        let trees = presets.map(|(name, params)| (name, params, LightBvh::two_level(lights, &params)));
        let mut tuning = Tuning::new(points, lighting, shadow_ray_ns)?;
        let mut tried = Vec::new();
        for (name, params, tree) in &trees {
            for candidates in CANDIDATES {
                tuning.add(format!("{name}, 1 of {candidates}"), tree, candidates)?;
                tried.push(*params);
            }
        }
        let measured = tuning.measure(clock)?;
        let pick = budget.pick(&measured)?;
        Ok(Within {
            params: tried[pick.index],
            candidates: measured[pick.index].candidates,
            pick,
            measured,
        })
    }
}
