//! The checks of one tree on the CPU.

use lightbvh::{EmissiveTriangle, INVALID, LightBounds, Lights, Moments, Random64, ShadingPoint};
use rayon::prelude::*;

use super::random::{ENDS, Random};
use super::row::{Check, Row};
use crate::backend::Bvh;
use crate::workload::instance_of;

/// |Σ pmf − 1|: a tree's probabilities are shares of one range of numbers; each is rounded where the uniform share is added.
const SUM: f64 = 1.0 / 4_194_304.0;

/// The worst so far, and where.
#[derive(Default)]
struct Worst {
    value: f64,
    at: Option<String>,
}

impl Worst {
    /// Takes the greater; what is not a number is the greatest.
    fn most(&mut self, value: f64, at: impl FnOnce() -> String) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        if value > self.value {
            self.value = value;
            self.at = Some(at());
        }
    }

    fn count(&mut self, more: usize, at: impl FnOnce() -> String) {
        if more > 0 && self.at.is_none() {
            self.at = Some(at());
        }
        self.value += more as f64;
    }
}

/// Runs every check of a tree over `lights` at `points`, with `samples` samples at each.
pub fn check(
    extreme: &str,
    structure: &str,
    (bvh, lights): (&Bvh, &Lights),
    points: &[ShadingPoint],
    samples: u32,
) -> Vec<Row> {
    let (tree, all) = (bvh.tree(), lights);
    let lights = all.all();
    // Without a uniform share.
    let weights = tree.by::<Moments>();
    // Without any flux a uniform share may still choose lights, and the other samples none.
    let lit = lights.par_iter().any(has_flux);
    let mut seed = Random::new(lights.len() as u32 ^ 0x1f3d_5b79);
    let [mut finite, mut sum, mut equal, mut starved]: [Worst; 4] = Default::default();
    for point in points {
        let place = |more: &str| format!("{more} at {:?}, normal {:?}", point.p, point.n);
        let pmfs = all_pmfs(bvh, all, point);
        let total: f64 = pmfs.par_iter().map(|&p| f64::from(p)).sum();
        let bad = |p: &f32| !(0.0..=1.0 + 1e-5).contains(p);
        finite.count(pmfs.par_iter().filter(|p| bad(p)).count(), || place("pmf"));
        if lit && pmfs.par_iter().any(|&p| p > 0.0) {
            sum.most((total - 1.0).abs(), || place(&format!("sum {total}")));
        }
        let lost = |i: &usize| {
            let light = &lights[*i];
            has_flux(light) && weights.pmf(point, *i as u32, instance_of(bvh, all, *i as u32)) == 0.0
        };
        let lost: Vec<usize> = (0..lights.len()).into_par_iter().filter(lost).collect();
        starved.count(lost.len(), || {
            let i = lost[0];
            place(&format!("light {i}, {:?} of {}", lights[i], lights.len()))
        });

        let random = (0..samples).map(|_| Random64::from(seed.bits()));
        let numbers: Vec<Random64> = random.chain(ENDS).collect();
        let drawn = numbers
            .par_iter()
            .map(|&random| (random, tree.sample(point, random)));
        let wrong = drawn.filter(|(_, sampled)| match pmfs.get(sampled.light as usize) {
            Some(pmf) => sampled.pmf.to_bits() != pmf.to_bits() || sampled.pmf <= 0.0,
            None => lit || sampled.light != INVALID || sampled.pmf != 0.0,
        });
        let wrong: Vec<_> = wrong.collect();
        equal.count(wrong.len(), || {
            place(&format!("random number {:?} gives {:?}", wrong[0].0, wrong[0].1))
        });
    }
    let row =
        |check, worst: Worst, bound| Row::new(extreme, structure, check, worst.value, bound).at(worst.at);
    vec![
        row(Check::Finite, finite, 0.0),
        row(Check::Sum, sum, SUM),
        row(Check::Equal, equal, 0.0),
        row(Check::Starved, starved, 0.0),
    ]
}

/// Probabilities of all lights at a point.
pub fn all_pmfs(bvh: &Bvh, lights: &Lights, point: &ShadingPoint) -> Vec<f32> {
    let (tree, count) = (bvh.tree(), lights.all().len() as u32);
    (0..count)
        .into_par_iter()
        .with_min_len(64)
        .map(|light| tree.pmf(point, light, instance_of(bvh, lights, light)))
        .collect()
}

fn has_flux(light: &EmissiveTriangle) -> bool {
    LightBounds::of_triangle(light).phi > 0.0
}
