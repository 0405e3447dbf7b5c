//! The checks of one tree on the CPU.

use std::fmt::Write as _;

use lightbvh::{EmissiveTriangle, INVALID, LightBounds, Random64, ShadingPoint};
use rayon::prelude::*;

use super::geometry::{contribution, may_lose_its_area};
use super::random::{ENDS, Random};
use super::row::{Check, Row};
use super::statistics::{chi_squared, chi_squared_quantile};
use super::subject::Subject;

/// |Σ pmf − 1|: a tree's probabilities are shares of one range of numbers; each is rounded where the uniform share is added.
const SUM: f64 = 1.0 / 4_194_304.0;
/// Chance that right frequencies exceed their threshold, for one tree under one extreme.
const FREQUENCY_TAIL: f64 = 1e-6;
/// Chance that a right estimate exceeds its bound, for one point.
const BIAS_TAIL: f64 = 1e-9;
/// Share of the sum that the estimate may be off beside that, for rounding of pmfs.
const BIAS_ROUNDING: f64 = 1e-5;
/// Least count that is expected of a cell of the χ² test; fewer are put together with their neighbours.
const LEAST_EXPECTED: f64 = 8.0;

/// What is known of one point.
struct Seen {
    pmfs: Vec<f32>,
    /// Variance and greatest value of contribution over probability.
    sum: f64,
    variance: f64,
    greatest: f64,
}

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

/// Runs every check of `subject` at `points`, with `samples` samples at each.
pub fn check(
    extreme: &str,
    structure: &str,
    subject: &Subject<'_>,
    points: &[ShadingPoint],
    samples: u32,
) -> Vec<Row> {
    let lights = subject.lights;
    // Without any flux a uniform share may still choose lights, and the other samples none.
    let lit = lights
        .par_iter()
        .any(|light| LightBounds::of_triangle(light).phi > 0.0);
    let mut seed = Random::new(lights.len() as u32 ^ 0x1f3d_5b79);
    let [mut finite, mut sum, mut equal, mut starved, mut bias]: [Worst; 5] = Default::default();
    let (mut statistic, mut degrees) = (0.0, 0);
    for point in points {
        let place = |more: &str| format!("{more} at {:?}, normal {:?}", point.p, point.n);
        let seen = look(subject, lights, point);
        let total: f64 = seen.pmfs.par_iter().map(|&p| f64::from(p)).sum();
        let reachable = seen.pmfs.par_iter().any(|&p| p > 0.0);
        let bad = |p: &f32| !(0.0..=1.0 + 1e-5).contains(p);
        finite.count(seen.pmfs.par_iter().filter(|p| bad(p)).count(), || place("pmf"));
        if reachable && lit {
            sum.most((total - 1.0).abs(), || place(&format!("sum {total}")));
        }
        let lost = |i: &usize| {
            let light = &lights[*i];
            light.luminance() > 0.0 && shines(light) && (subject.pmf_by_weights)(point, *i as u32) == 0.0
        };
        let lost: Vec<usize> = (0..lights.len()).into_par_iter().filter(lost).collect();
        starved.count(lost.len(), || {
            let i = lost[0];
            place(&format!("light {i}, {:?} of {}", lights[i], lights.len()))
        });

        let random = (0..samples).map(|_| Random64::from(seed.bits()));
        let numbers: Vec<Random64> = random.chain(ENDS).collect();
        let drawn: Vec<_> = numbers
            .par_iter()
            .map(|&random| (random, (subject.sample)(point, random)))
            .collect();
        let wrong = drawn
            .iter()
            .filter(|(_, sampled)| match seen.pmfs.get(sampled.light as usize) {
                Some(pmf) => sampled.pmf.to_bits() != pmf.to_bits() || sampled.pmf <= 0.0,
                None => lit || sampled.light != INVALID || sampled.pmf != 0.0,
            });
        let wrong: Vec<_> = wrong.collect();
        equal.count(wrong.len(), || {
            place(&format!("random number {:?} gives {:?}", wrong[0].0, wrong[0].1))
        });
        if reachable {
            let lights_drawn = drawn[..samples as usize].iter().map(|(_, sampled)| sampled.light);
            let (more, cells) = frequencies(&seen.pmfs, lights_drawn.clone(), f64::from(samples) / total);
            statistic += more;
            degrees += cells;
            let off = estimate_error(&seen, lights, point, lights_drawn);
            bias.most(off, || place(&format!("estimate of {:e}", seen.sum)));
        }
    }
    let frequencies = if degrees > 0 {
        statistic / chi_squared_quantile(degrees, FREQUENCY_TAIL)
    } else {
        0.0
    };
    let mut detail = String::new();
    let _ = write!(detail, "chi-square {statistic} of {degrees} degrees");
    let row =
        |check, worst: Worst, bound| Row::new(extreme, structure, check, worst.value, bound).at(worst.at);
    vec![
        row(Check::Finite, finite, 0.0),
        row(Check::Sum, sum, SUM),
        row(Check::Equal, equal, 0.0),
        row(Check::Starved, starved, 0.0),
        Row::new(extreme, structure, Check::Frequencies, frequencies, 1.0).at(Some(detail)),
        row(Check::Bias, bias, 1.0),
    ]
}

/// Probabilities of all lights at a point.
pub fn all_pmfs(subject: &Subject<'_>, point: &ShadingPoint) -> Vec<f32> {
    let count = subject.lights.len() as u32;
    (0..count)
        .into_par_iter()
        .with_min_len(64)
        .map(|light| (subject.pmf)(point, light))
        .collect()
}

/// Standard deviation of the estimate of direct light at `point` from one sample, as a share of that light; `None` where
/// there is none.
pub fn relative_deviation(subject: &Subject<'_>, point: &ShadingPoint) -> Option<f64> {
    let seen = look(subject, subject.lights, point);
    (seen.sum > 0.0).then(|| seen.variance.max(0.0).sqrt() / seen.sum)
}

/// Whether the light counts as one: rounding left something of its area, or should have.
fn shines(light: &EmissiveTriangle) -> bool {
    LightBounds::of_triangle(light).phi > 0.0 || !may_lose_its_area(light)
}

fn shine(light: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    if shines(light) {
        contribution(light, point)
    } else {
        0.0
    }
}

fn look(subject: &Subject<'_>, lights: &[EmissiveTriangle], point: &ShadingPoint) -> Seen {
    let pmfs = all_pmfs(subject, point);
    let value = |(light, &pmf): (&EmissiveTriangle, &f32)| (shine(light, point), f64::from(pmf));
    let values = || lights.par_iter().zip(&pmfs).with_min_len(256).map(value);
    let sum: f64 = values().map(|(f, _)| f).sum();
    let of_drawn = || values().filter(|&(_, p)| p > 0.0);
    let greatest = of_drawn()
        .map(|(f, p)| (f / p - sum).abs())
        .reduce(|| 0.0, f64::max);
    let variance = of_drawn().map(|(f, p)| p * (f / p - sum) * (f / p - sum)).sum();
    Seen {
        pmfs,
        sum,
        variance,
        greatest,
    }
}

/// The error of the mean of contribution over probability, over what it may be (Bernstein's inequality).
fn estimate_error(
    seen: &Seen,
    lights: &[EmissiveTriangle],
    point: &ShadingPoint,
    drawn: impl Iterator<Item = u32>,
) -> f64 {
    if seen.sum == 0.0 {
        return 0.0;
    }
    let (mut count, mut total) = (0.0, 0.0);
    for light in drawn {
        count += 1.0;
        if let (Some(light), Some(&pmf)) = (lights.get(light as usize), seen.pmfs.get(light as usize)) {
            total += shine(light, point) / f64::from(pmf);
        }
    }
    let log = (2.0 / BIAS_TAIL).ln();
    let random = (2.0 * seen.variance * log / count).sqrt() + 2.0 * seen.greatest * log / (3.0 * count);
    (total / count - seen.sum).abs() / (random + BIAS_ROUNDING * seen.sum)
}

/// χ² and its degrees of freedom; neighbouring lights share a cell until enough is expected of it. `samples` are those that
/// a probability of one stands for.
fn frequencies(pmfs: &[f32], drawn: impl Iterator<Item = u32>, samples: f64) -> (f64, usize) {
    let mut counts = vec![0_u64; pmfs.len()];
    for light in drawn {
        if let Some(count) = counts.get_mut(light as usize) {
            *count += 1;
        }
    }
    let (mut observed, mut expected) = (Vec::new(), Vec::new());
    let (mut o, mut e) = (0, 0.0);
    for (&count, &pmf) in counts.iter().zip(pmfs) {
        o += count;
        e += f64::from(pmf) * samples;
        if e >= LEAST_EXPECTED {
            observed.push(o);
            expected.push(e);
            (o, e) = (0, 0.0);
        }
    }
    if let (Some(last), Some(least)) = (observed.last_mut(), expected.last_mut()) {
        *last += o;
        *least += e;
    }
    let total: f64 = expected.iter().sum();
    if observed.len() < 2 {
        return (0.0, 0);
    }
    chi_squared(&observed, &expected.iter().map(|e| e / total).collect::<Vec<_>>())
}
