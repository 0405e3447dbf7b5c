//! The best configuration within a budget, measured on the caller's own points.
//!
//! Importance, layout, width and levels are types and calls of the caller's: each light BVH that is [added](Tuning::add) is one
//! configuration with its number of candidates. [`BuildParams::within`](crate::BuildParams::within) tries the presets of the
//! builder for the defaults.
//!
//! ```
//! use lightbvh::build::tune::{Budget, Diffuse, Tuning};
//! use lightbvh::{BuildParams, EmissiveTriangle, LeanMomentNode, LightBvh, Lights, Moments, ShadingPoint};
//! # let lamp = |k: u8| EmissiveTriangle {
//! #     p: [[0.0, 3.0, 0.0], [0.1, 3.0, 0.0], [0.0, 3.0, 0.1]].map(|p| [p[0] + f32::from(k), p[1], p[2]]),
//! #     radiance: [9.0; 3],
//! #     mesh: 0,
//! #     flags: 0,
//! # };
//! # let lights = Lights::new((0..20).map(lamp).collect())?;
//! # let start = std::time::Instant::now();
//! let points = [1.0, 7.0, 15.0].map(|x| ShadingPoint { p: [x, 0.0, 0.0], n: [0.0, 1.0, 0.0] });
//! let usual = LightBvh::single_level(&lights, &BuildParams::BALANCED);
//! let lean = lightbvh::Bvh::<LeanMomentNode<8>, Moments, 8>::single_level(&lights, &BuildParams::BALANCED);
//! let mut tuning = Tuning::new(&points, &Diffuse, 700.0)?;   // a shadow ray takes 700 ns
//! tuning.add("usual", &usual, 1)?.add("1 of 8", &usual, 8)?.add("lean", &lean, 1)?;
//! let measured = tuning.measure(|| start.elapsed())?;
//! let pick = Budget::Error { relative: 0.2 }.pick(&measured)?;
//! println!("{}: {} samples", measured[pick.index].name, pick.samples);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod lighting;
mod measure;
mod pick;
#[cfg(test)]
mod tests;
mod within;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::time::Duration;

pub use error::TuneError;
pub use lighting::{Diffuse, Lighting};
pub use pick::{Budget, Pick};
pub use within::Within;

use self::measure::{Configuration, Sampling, variances};
use crate::bvh::Bvh;
use crate::importance::ImportanceModel;
use crate::node::LightNode;
use crate::point::ShadingPoint;

/// Most candidates of a sample.
pub const MAX_CANDIDATES: u32 = 64;

/// Rounds of timing, each over all configurations; the least time counts, so that what interrupts one round does not.
const ROUNDS: u32 = 5;
/// Samples of each configuration in a round, at least: some milliseconds.
const SAMPLES: usize = 4096;

/// Configurations to choose among, and where they are measured.
pub struct Tuning<'a> {
    points: &'a [ShadingPoint],
    lighting: &'a dyn Lighting,
    shadow_ray_ns: f64,
    choices: Vec<(String, Box<dyn Configuration + 'a>)>,
}

/// What was measured of a configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// As it was added.
    pub name: String,
    /// Candidates of each sample.
    pub candidates: u32,
    /// Time of a sample, all its candidates, ns; without its shadow ray.
    pub sample_ns: f64,
    /// The same with its shadow ray.
    pub time_ns: f64,
    /// Relative variance of a sample's estimate with its shadow ray: the mean over the points of variance / (m² + a²), where m
    /// is the point's light, and a that of the points on average, so that points in the dark do not decide.
    pub variance: f64,
}

impl<'a> Tuning<'a> {
    /// Before any configuration: `points` as an image has them, some dozens or hundreds; the light that counts; the time of a
    /// shadow ray in the caller's renderer, ns.
    ///
    /// # Errors
    /// [`TuneError`] for no points, a point outside the domain of [`ShadingPoint::checked`], a time that is negative or not finite.
    pub fn new(
        points: &'a [ShadingPoint],
        lighting: &'a dyn Lighting,
        shadow_ray_ns: f64,
    ) -> Result<Self, TuneError> {
        if points.is_empty() {
            return Err(TuneError::NoPoints);
        }
        if !(shadow_ray_ns.is_finite() && shadow_ray_ns >= 0.0) {
            return Err(TuneError::ShadowRay { ns: shadow_ray_ns });
        }
        for (index, point) in points.iter().enumerate() {
            point
                .checked()
                .map_err(|source| TuneError::Point { index, source })?;
        }
        Ok(Self {
            points,
            lighting,
            shadow_ray_ns,
            choices: Vec::new(),
        })
    }

    /// Adds a light BVH, each sample one of `candidates` that [`sample_spaced`](Bvh::sample_spaced) chooses, in proportion to its
    /// light over its probability.
    ///
    /// # Errors
    /// [`TuneError::Candidates`] for none or more than [`MAX_CANDIDATES`].
    pub fn add<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        &mut self,
        name: impl Into<String>,
        bvh: &'a Bvh<N, I, W>,
        candidates: u32,
    ) -> Result<&mut Self, TuneError> {
        if !(1..=MAX_CANDIDATES).contains(&candidates) {
            return Err(TuneError::Candidates { candidates });
        }
        let sampling = Sampling { bvh, candidates };
        self.choices.push((name.into(), Box::new(sampling)));
        Ok(self)
    }

    /// Measures all of them, in the order in which they were added. `clock` gives the time since any moment that stays the same.
    ///
    /// One candidate has its variance by the probabilities of all lights, where lights times points are at most 2^20; several,
    /// or more lights, by trials of fixed numbers, so that everything but times is the same in every run. Trials alone miss
    /// light that is rarely found.
    ///
    /// # Errors
    /// [`TuneError::NoConfigurations`]; [`TuneError::Dark`] where no light arrives at any point; [`TuneError::Clock`] for a clock
    /// that stands still.
    pub fn measure(&self, mut clock: impl FnMut() -> Duration) -> Result<Vec<Measured>, TuneError> {
        if self.choices.is_empty() {
            return Err(TuneError::NoConfigurations);
        }
        let passes = SAMPLES.div_ceil(self.points.len());
        let mut least = alloc::vec![Duration::MAX; self.choices.len()];
        for round in 0..ROUNDS {
            for ((_, choice), least) in self.choices.iter().zip(&mut least) {
                let start = clock();
                choice.run(self.points, passes as u32, round);
                *least = clock().saturating_sub(start).min(*least);
            }
        }
        if least.contains(&Duration::ZERO) {
            return Err(TuneError::Clock);
        }
        let mut measured = Vec::new();
        for ((name, choice), least) in self.choices.iter().zip(least) {
            let sample_ns = least.as_nanos() as f64 / (passes * self.points.len()) as f64;
            measured.push(Measured {
                name: name.clone(),
                candidates: choice.candidates(),
                sample_ns,
                time_ns: sample_ns + self.shadow_ray_ns,
                variance: variances(&**choice, self.points, self.lighting).ok_or(TuneError::Dark)?,
            });
        }
        Ok(measured)
    }
}
