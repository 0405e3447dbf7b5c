//! Exact operations against native ones, on the CPU and on each device: time of a sample, and words that differ.

use std::cell::RefCell;

use lightbvh::BuildParams;
use lightbvh::SampledLight;
use lightbvh_gpu::contractible;
use lightbvh_kernels::bvh::{Native, Node, Standard, TriangleChoice, WIDTH};
use lightbvh_kernels::query::{Query, pmf_query, sample_query};
use rayon::prelude::*;
use serde::Serialize;

use crate::backend::{Bvh, DeviceBackend, Sampler, Timed};
use crate::cli::devices::Opened;
use crate::cli::measure::interval::Interval;
use crate::cli::measure::times::in_turns;
use crate::cli::table;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{arrays_at, build, lights_at, queries};

/// Points that are asked for.
const QUERIES: u32 = 1 << 16;
/// Seed of the points and of their numbers.
const SEED: u32 = 7;

/// How a processor computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Operations {
    /// Those that Vulkan defines, in the order of the source.
    Exact,
    /// The same kernels, but the driver may contract and rearrange.
    Contractible,
    /// `NativeMath`, on the CPU alone.
    Native,
}

/// One processor, by one kind of operations.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Arithmetic {
    scene: String,
    /// `cpu`, or the device's name.
    device: String,
    operations: Operations,
    ns_per_sample: f64,
    /// Time of a sample over that of the exact operations on the same processor, turn by turn.
    sample_ratio: Interval,
    /// Samples compared, and pmfs of the lights of the exact ones.
    queries: usize,
    /// From the CPU's exact operations.
    from_exact: Different,
    /// From the CPU's native operations.
    from_native: Different,
    /// Samples whose pmf is not, to the bit, that of their light on the same processor.
    unlike_their_light: usize,
}

/// Differences.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Different {
    /// Samples of another light.
    lights: usize,
    /// Words of pmfs of the same lights at the same points.
    pmfs: usize,
    /// Of their relative differences the mean, and the greatest.
    mean_error: f64,
    greatest_error: f64,
}

/// The answers of a processor.
struct Words {
    sampled: Vec<SampledLight>,
    /// Of the lights that the CPU's exact operations choose.
    pmfs: Vec<f32>,
    unlike_their_light: usize,
}

type Answer<'a, T> = Box<dyn FnMut(&[Query]) -> Result<Timed<Vec<T>>, HostError> + 'a>;

/// A processor by one kind of operations, to be asked.
struct Side<'a> {
    device: String,
    operations: Operations,
    sample: Answer<'a, SampledLight>,
    pmf: Answer<'a, f32>,
}

/// Measures a scene's tree of two levels at `frame`.
pub(super) fn measure(
    scene: &Scene,
    frame: u32,
    opened: &[Opened],
    turns: u32,
) -> Result<Vec<Arithmetic>, HostError> {
    let lights = lights_at(scene, frame)?;
    let asked = queries(&arrays_at(scene, frame, 96, 54)?, SEED, 0, QUERIES);
    let params = BuildParams::default();
    let exact: Bvh = build(&lights, Sampler::TwoLevel, &params);
    let devices = opened
        .iter()
        .map(|o| DeviceBackend::new(&o.device, &exact).map(RefCell::new))
        .collect::<Result<Vec<_>, _>>()?;
    let mut sides = vec![
        on_cpu::<Standard>(Operations::Exact, &exact),
        on_cpu::<Native>(Operations::Native, &exact),
    ];
    for (o, backend) in opened.iter().zip(&devices) {
        for operations in [Operations::Exact, Operations::Contractible] {
            sides.push(on_device(o, backend, operations)?);
        }
    }

    let chosen = pmf_queries(&asked, &(sides[0].sample)(&asked)?.value);
    let words: Vec<Words> = sides
        .iter_mut()
        .map(|side| side.words(&asked, &chosen))
        .collect::<Result<_, _>>()?;
    let times = in_turns(sides.len(), turns, QUERIES, |at, _| {
        Ok((sides[at].sample)(&asked)?.time)
    })?;
    Ok((0..sides.len())
        .map(|at| {
            let side = &sides[at];
            let is_base =
                |other: &Side<'_>| other.device == side.device && other.operations == Operations::Exact;
            let base = sides.iter().position(is_base).unwrap_or(at);
            Arithmetic {
                scene: scene.name().to_owned(),
                device: side.device.clone(),
                operations: side.operations,
                ns_per_sample: Interval::of(times[at].clone()).median,
                sample_ratio: Interval::of_ratios(&times[at], &times[base]),
                queries: asked.len(),
                from_exact: Different::between(&words[at], &words[0]),
                from_native: Different::between(&words[at], &words[1]),
                unlike_their_light: words[at].unlike_their_light,
            }
        })
        .collect())
}

/// The default's nodes, by the importance of `C`.
fn on_cpu<'a, C>(operations: Operations, bvh: &'a Bvh) -> Side<'a>
where
    C: TriangleChoice<WIDTH, Node = Node>,
{
    let tree = move || bvh.tree().by::<C::Importance>();
    Side {
        device: "cpu".to_owned(),
        operations,
        sample: Box::new(move |asked| Ok(answers(asked, |query| sample_query::<C, WIDTH>(&tree(), query)))),
        pmf: Box::new(move |asked| Ok(answers(asked, |query| pmf_query::<C, WIDTH>(&tree(), query)))),
    }
}

fn answers<T: Send>(asked: &[Query], answer: impl Fn(&Query) -> T + Sync + Send) -> Timed<Vec<T>> {
    Timed::of(|| asked.par_iter().with_min_len(256).map(answer).collect())
}

fn on_device<'a>(
    opened: &'a Opened,
    backend: &'a RefCell<DeviceBackend<'_>>,
    operations: Operations,
) -> Result<Side<'a>, HostError> {
    let device = &opened.device;
    let kernel = |name: &str| match operations {
        Operations::Exact | Operations::Native => device.kernel(name),
        Operations::Contractible => {
            let known = lightbvh_gpu::Kernel::named(name).map_or_else(Vec::new, |known| known.words());
            let words = contractible(&known).unwrap_or(known);
            device.kernel_from_words(&format!("{name}, contractible"), &words)
        }
    };
    let (sample, pmf) = (kernel("sample")?, kernel("pmf")?);
    Ok(Side {
        device: device.name().to_owned(),
        operations,
        sample: Box::new(move |asked| Ok(backend.borrow_mut().query_by(&sample, asked)?)),
        pmf: Box::new(move |asked| Ok(backend.borrow_mut().query_by(&pmf, asked)?)),
    })
}

/// The queries for the pmfs of what was sampled.
fn pmf_queries(asked: &[Query], sampled: &[SampledLight]) -> Vec<Query> {
    let of = |(query, sampled): (&Query, &SampledLight)| Query {
        words: [sampled.light, sampled.instance],
        ..*query
    };
    asked.iter().zip(sampled).map(of).collect()
}

impl Side<'_> {
    fn words(&mut self, asked: &[Query], chosen: &[Query]) -> Result<Words, HostError> {
        let sampled = (self.sample)(asked)?.value;
        let own = (self.pmf)(&pmf_queries(asked, &sampled))?.value;
        let unlike =
            (sampled.iter().zip(&own)).filter(|(sampled, own)| sampled.pmf.to_bits() != own.to_bits());
        Ok(Words {
            unlike_their_light: unlike.count(),
            pmfs: (self.pmf)(chosen)?.value,
            sampled,
        })
    }
}

impl Different {
    fn between(found: &Words, expected: &Words) -> Self {
        let lights = found.sampled.iter().zip(&expected.sampled);
        let pmfs = found.pmfs.iter().zip(&expected.pmfs);
        let errors = pmfs.clone().filter(|(_, expected)| **expected > 0.0);
        let errors: Vec<f64> = errors
            .map(|(&found, &expected)| (f64::from(found) / f64::from(expected) - 1.0).abs())
            .collect();
        Self {
            lights: lights
                .filter(|(a, b)| (a.light, a.instance) != (b.light, b.instance))
                .count(),
            pmfs: pmfs.filter(|(a, b)| a.to_bits() != b.to_bits()).count(),
            mean_error: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            greatest_error: errors.into_iter().fold(0.0, f64::max),
        }
    }
}

pub(super) fn print(rows: &[Arithmetic]) -> Result<(), HostError> {
    if rows.is_empty() {
        return Ok(());
    }
    Ok(table::print(
        rows,
        &[
            ("scene", |row| row.scene.clone()),
            ("processor", |row| row.device.clone()),
            ("operations", |row| match row.operations {
                Operations::Exact => "exact".to_owned(),
                Operations::Contractible => "exact, contractible".to_owned(),
                Operations::Native => "native".to_owned(),
            }),
            ("sample ns", |row| format!("{:.0}", row.ns_per_sample)),
            ("to exact", |row| row.sample_ratio.to_string()),
            ("samples", |row| row.queries.to_string()),
            ("other lights", |row| row.from_exact.lights.to_string()),
            ("other pmfs", |row| row.from_exact.pmfs.to_string()),
            ("mean error", |row| format!("{:.1e}", row.from_exact.mean_error)),
            ("greatest", |row| format!("{:.1e}", row.from_exact.greatest_error)),
            ("pmfs unlike native cpu", |row| row.from_native.pmfs.to_string()),
            ("pmf unlike own", |row| row.unlike_their_light.to_string()),
        ],
    )?)
}
