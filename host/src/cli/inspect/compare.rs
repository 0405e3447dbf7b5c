//! Two models over the same lights: their probabilities, or where there are none their samples.

use lightbvh::exact::hash;
use lightbvh::{EmissiveTriangle, ShadingPoint};
use rayon::prelude::*;

use super::subject::Subject;
use crate::cli::measure::{irradiance::irradiance, variance};

/// Samples of a point that are compared where no probability of a given light can be asked for.
const SAMPLES: u32 = 64;

/// What the lights of a scene send to its points.
pub(super) struct Light<'a> {
    lights: &'a [EmissiveTriangle],
    /// By point and light.
    sent: Vec<Vec<f64>>,
}

impl<'a> Light<'a> {
    pub fn of(lights: &'a [EmissiveTriangle], points: &[ShadingPoint]) -> Self {
        let sent = points.par_iter();
        let sent = sent.map(|point| lights.iter().map(|t| irradiance(t, point)).collect());
        Self {
            lights,
            sent: sent.collect(),
        }
    }

    /// Every probability, point by point; `None` where none can be asked for.
    pub fn pmfs(&self, subject: &dyn Subject, points: &[ShadingPoint]) -> Option<Vec<f32>> {
        let of = |point: &ShadingPoint| -> Option<Vec<f32>> {
            let each = (0..).zip(self.lights);
            each.map(|(light, triangle)| subject.probability(point, light, triangle.mesh))
                .collect()
        };
        let all: Option<Vec<Vec<f32>>> = points.par_iter().map(of).collect();
        Some(all?.concat())
    }

    /// Relative variances of one sample by these probabilities, at the points that any light reaches.
    pub fn variances(&self, pmfs: &[f32]) -> Vec<f64> {
        // Without lights, nothing is sent and no chunk taken.
        let lights = self.lights.len().max(1);
        let points = self.sent.iter().zip(pmfs.chunks(lights));
        let lit = points.filter_map(|(sent, pmfs)| {
            variance(sent.iter().zip(pmfs).map(|(&sent, &pmf)| (sent, f64::from(pmf))))
        });
        lit.collect()
    }
}

/// Words of two models.
pub(super) struct Compared {
    pub count: u64,
    pub different: u64,
    /// Greatest difference of two probabilities.
    pub most: f64,
}

impl Compared {
    pub fn of(before: &[f32], after: &[f32]) -> Self {
        let mut own = Self {
            // What is missing differs.
            different: before.len().abs_diff(after.len()) as u64,
            count: before.len() as u64,
            most: 0.0,
        };
        for (a, b) in before.iter().zip(after) {
            own.different += u64::from(a.to_bits() != b.to_bits());
            own.most = own.most.max((f64::from(*a) - f64::from(*b)).abs());
        }
        own
    }

    pub fn of_samples(old: &dyn Subject, new: &dyn Subject, points: &[ShadingPoint]) -> Self {
        let mut own = Self {
            count: 0,
            different: 0,
            most: 0.0,
        };
        for (point, index) in points.iter().zip(0_u32..) {
            for k in 0..SAMPLES {
                let number = hash(index * SAMPLES + k);
                let (a, b) = (old.choose(point, number), new.choose(point, number));
                own.count += 1;
                own.different += u64::from(a.light != b.light || a.pmf.to_bits() != b.pmf.to_bits());
                own.most = own.most.max((f64::from(a.pmf) - f64::from(b.pmf)).abs());
            }
        }
        own
    }
}
