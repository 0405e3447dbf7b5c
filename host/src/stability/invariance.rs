//! A scene against itself scaled, turned, moved and dimmed: what may change, and by how much.

mod scenes;

use glam::{DMat3, DVec3};
use lightbvh::{BuildParams, EmissiveTriangle, ShadingPoint, exact};
use rayon::prelude::*;

use self::scenes::{offset, turns};
use super::case::{around, validated};
use super::cases::scattered;
use super::checks::{all_pmfs, relative_variance};
use super::random::Random;
use super::row::{Check, Row};
use super::subject::Subject;
use crate::backend::{Bvh, Sampler};
use crate::error::HostError;
use crate::metrics::mean;
use crate::workload::build;

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

    fn study(&self, sampler: Sampler) -> Result<Study, HostError> {
        let lights = validated("invariance", self.lights.clone())?;
        let bvh: Bvh = build(&lights, sampler, &BuildParams::default());
        let tree = Subject::new(&bvh, &lights);
        let variances = self.points.par_iter().filter_map(|p| relative_variance(&tree, p));
        let variances: Vec<f64> = variances.collect();
        Ok(Study {
            pmfs: self.points.iter().map(|point| all_pmfs(&tree, point)).collect(),
            deviation: mean(&variances).sqrt(),
        })
    }
}

impl Study {
    fn different_bits(&self, other: &Self) -> f64 {
        let pairs = self.pmfs.iter().flatten().zip(other.pmfs.iter().flatten());
        pairs.filter(|(a, b)| a.to_bits() != b.to_bits()).count() as f64
    }

    fn worse(&self, other: &Self) -> f64 {
        let factor = self.deviation / other.deviation;
        factor.max(1.0 / factor)
    }
}

/// A scene, the same changed, and what is compared.
type Group = (&'static str, Scene, Vec<Scene>, Check);

fn groups() -> Vec<Group> {
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
    let (near, far) = offset();
    let of = || base.clone();
    vec![
        ("scaled by powers of two", of(), powers, Check::SameBits),
        ("radiance scaled by powers of two", of(), dimmed, Check::SameBits),
        ("scaled by 1e-12 to 1e12", of(), by_tens, Check::Deviation),
        (
            "radiance scaled by 1e-18 to 1e18",
            of(),
            dimmed_by_tens,
            Check::Deviation,
        ),
        ("turned", of(), turns(&base), Check::Deviation),
        ("moved by 1e7 m", near, vec![far], Check::Deviation),
    ]
}

/// All rows, on the CPU.
pub fn rows() -> Result<Vec<Row>, HostError> {
    let mut out = Vec::new();
    for (name, base, others, check) in groups() {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            let study = base.study(sampler)?;
            let mut worst = 0.0;
            for other in &others {
                let new = other.study(sampler)?;
                let value = match check {
                    Check::SameBits => study.different_bits(&new),
                    _ => study.worse(&new),
                };
                // What is not a number is beyond any bound.
                if value > worst || value.is_nan() {
                    worst = value;
                }
            }
            let bound = if check == Check::SameBits { 0.0 } else { DEVIATION };
            out.push(Row::new(name, sampler.name(), check, worst, bound));
        }
    }
    Ok(out)
}
