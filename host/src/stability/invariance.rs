//! A scene against itself scaled, turned, moved and dimmed: what may change, and by how much.

mod scenes;

use glam::{DMat3, DVec3};
use lightbvh::{BuildParams, EmissiveTriangle, Lights, ShadingPoint, exact};
use rayon::prelude::*;

use self::scenes::{offset, scene_of_zeros, turns};
use super::case::{around, validated};
use super::cases::scattered;
use super::checks::{all_pmfs, relative_deviation};
use super::random::Random;
use super::row::{Check, Row};
use super::subject::Subject;
use crate::backend::{Bvh, Sampler};
use crate::error::HostError;
use crate::workload;

/// Greatest share of samples that may go elsewhere; see [`Check::Variation`].
const VARIATION: f64 = 0.04;
/// Greatest factor on the standard deviation; see [`Check::Deviation`].
const DEVIATION: f64 = 2.0;

/// A scene and where it is looked at.
#[derive(Clone)]
struct Scene {
    lights: Vec<EmissiveTriangle>,
    points: Vec<ShadingPoint>,
}

/// What is invariant, or nearly so.
struct Study {
    /// By point, by light.
    pmfs: Vec<Vec<f32>>,
    /// Root mean square over the points of the relative standard deviation of one sample's estimate.
    deviation: f64,
}

impl Scene {
    fn new(lights: Vec<EmissiveTriangle>) -> Self {
        let points = around(&lights, 48, &mut Random::new(7));
        Self { lights, points }
    }

    /// With places, and directions, brought elsewhere.
    fn mapped(&self, place: impl Fn([f32; 3]) -> [f32; 3], direction: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let mut mapped = self.clone();
        for vertex in mapped.lights.iter_mut().flat_map(|light| light.p.iter_mut()) {
            *vertex = place(*vertex);
        }
        for point in &mut mapped.points {
            *point = ShadingPoint {
                p: place(point.p),
                n: direction(point.n),
            };
        }
        mapped
    }

    fn scaled(&self, factor: f32) -> Self {
        self.mapped(|p| p.map(|x| x * factor), |n| n)
    }

    fn turned(&self, turn: DMat3) -> Self {
        let apply = |v: [f32; 3]| {
            (turn * DVec3::from(v.map(f64::from)))
                .to_array()
                .map(|x| x as f32)
        };
        self.mapped(apply, apply)
    }

    fn dimmed(&self, factor: f32) -> Self {
        let mut dimmed = self.clone();
        for x in dimmed
            .lights
            .iter_mut()
            .flat_map(|light| light.radiance.iter_mut())
        {
            *x *= factor;
        }
        dimmed
    }

    fn tree(&self, sampler: Sampler) -> Result<(Bvh, Lights), HostError> {
        let lights = validated("invariance", self.lights.clone())?;
        Ok((workload::build(&lights, sampler, &BuildParams::default()), lights))
    }

    /// By a tree of its own; or, for [`Check::Variation`], by that of `base` refitted, since rounding may let the builder
    /// choose otherwise and then all probabilities are others.
    fn study(&self, sampler: Sampler, base: Option<&Self>) -> Result<Study, HostError> {
        let (mut bvh, mut lights) = base.unwrap_or(self).tree(sampler)?;
        if base.is_some() {
            lights = validated("invariance", self.lights.clone())?;
            bvh.follow(&lights).expect("as many lights");
        }
        let tree = Subject::new(&bvh, &lights);
        let squares: Vec<f64> = self
            .points
            .par_iter()
            .filter_map(|p| relative_deviation(&tree, p))
            .map(|d| d * d)
            .collect();
        Ok(Study {
            pmfs: self.points.iter().map(|point| all_pmfs(&tree, point)).collect(),
            deviation: (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt(),
        })
    }
}

impl Study {
    fn pairs<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (f32, f32)> + 'a {
        self.pmfs
            .iter()
            .flatten()
            .copied()
            .zip(other.pmfs.iter().flatten().copied())
    }

    fn different_bits(&self, other: &Self) -> f64 {
        self.pairs(other)
            .filter(|(a, b)| a.to_bits() != b.to_bits())
            .count() as f64
    }

    /// The mean over points of the total variation distance.
    fn variation(&self, other: &Self) -> f64 {
        let sum: f64 = self
            .pairs(other)
            .map(|(a, b)| (f64::from(a) - f64::from(b)).abs())
            .sum();
        0.5 * sum / self.pmfs.len().max(1) as f64
    }

    fn worse(&self, other: &Self) -> f64 {
        let factor = self.deviation / other.deviation;
        factor.max(1.0 / factor)
    }
}

/// A scene, the same changed, and what is compared.
type Group = (&'static str, Scene, Vec<Scene>, &'static [Check]);

fn groups() -> Vec<Group> {
    const EQUAL: &[Check] = &[Check::SameBits];
    const NEARLY: &[Check] = &[Check::Variation, Check::Deviation];
    const DEVIATION: &[Check] = &[Check::Deviation];
    let base = Scene::new(scattered(400, 5));
    let tens = |most: i32| (-most..=most).filter(|&e| e != 0).map(|e| 10f32.powi(e));
    // Below 2^-32 the nearest points come nearer to a light than the 2^-50 m that importance tells apart.
    let powers = (-32..=39).map(|e| base.scaled(exact::pow2(e))).collect();
    let dimmed = (-60..=60)
        .step_by(3)
        .map(|e| base.dimmed(exact::pow2(e)))
        .collect();
    let by_tens = tens(12).map(|factor| base.scaled(factor)).collect();
    let dimmed_by_tens = tens(18).map(|factor| base.dimmed(factor)).collect();
    let right = [DVec3::X, DVec3::Y, DVec3::Z]
        .map(|axis| base.turned(DMat3::from_axis_angle(axis, std::f64::consts::FRAC_PI_2)));
    let (near, far) = offset();
    let zeros = [0x8000_0000, 1, 0x8000_0001, 0x007f_ffff].map(|bits| scene_of_zeros(f32::from_bits(bits)));
    let of = || base.clone();
    vec![
        ("scaled by powers of two", of(), powers, EQUAL),
        ("radiance scaled by powers of two", of(), dimmed, EQUAL),
        ("scaled by 1e-12 to 1e12", of(), by_tens, NEARLY),
        ("radiance scaled by 1e-18 to 1e18", of(), dimmed_by_tens, NEARLY),
        ("turned by right angles", of(), right.into(), DEVIATION),
        ("turned", of(), turns(&base), DEVIATION),
        ("moved by 1e7 m", near, vec![far], NEARLY),
        (
            "minus zero and subnormals for zeros",
            scene_of_zeros(0.0),
            zeros.into(),
            EQUAL,
        ),
    ]
}

/// All rows, on the CPU.
pub fn rows() -> Result<Vec<Row>, HostError> {
    let mut out = Vec::new();
    for (name, base, others, checks) in groups() {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            let study = base.study(sampler, None)?;
            let mut worst = vec![0f64; checks.len()];
            for other in &others {
                let new = other.study(sampler, None)?;
                for (worst, check) in worst.iter_mut().zip(checks) {
                    let value = match check {
                        Check::SameBits => study.different_bits(&new),
                        Check::Variation => study.variation(&other.study(sampler, Some(&base))?),
                        _ => study.worse(&new),
                    };
                    // What is not a number is beyond any bound.
                    if value > *worst || value.is_nan() {
                        *worst = value;
                    }
                }
            }
            for (&worst, &check) in worst.iter().zip(checks) {
                let bound = match check {
                    Check::SameBits => 0.0,
                    Check::Variation => VARIATION,
                    _ => DEVIATION,
                };
                out.push(Row::new(name, sampler.name(), check, worst, bound));
            }
        }
    }
    Ok(out)
}
