//! What the children of a node cost a device: an invocation keeps the weights of all of them, where a CPU has vectors.

use lightbvh::{BuildParams, SampledLight};
use lightbvh_kernels::bvh::{Narrow, Standard, TriangleChoice, WIDTH, Wide};
use lightbvh_kernels::query::Query;
use serde::Serialize;

use super::Point;
use super::choices::Axis;
use super::quantile::Interval;
use super::turns::in_turns;
use crate::backend::{Backend, Bvh, CpuBackend, DeviceBackend, Sampler, Timed};
use crate::cli::devices::Opened;
use crate::cli::table;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{arrays_at, build, lights_at, queries};

/// Points that are asked for.
const QUERIES: u32 = 1 << 16;
/// Seed of the points and of their numbers.
const SEED: u32 = 8;

/// A width on a device.
#[derive(Clone, Debug, Serialize)]
pub(super) struct OnDevice {
    pub device: String,
    pub ns_per_sample: f64,
    /// Time of a sample over that of the default's width on the same device, turn by turn.
    pub sample_ratio: Interval,
    /// Samples whose light, instance or pmf is not, to the bit, the CPU's.
    pub different: usize,
}

type Answer<'a> = Box<dyn FnMut(&[Query]) -> Result<Timed<Vec<SampledLight>>, HostError> + 'a>;

struct Side<'a> {
    width: usize,
    device: &'a str,
    sample: Answer<'a>,
    expected: Vec<SampledLight>,
}

/// Adds what the default and its other widths take on each device to the points of a scene's tree at `frame`.
pub(super) fn measure(
    points: &mut [Point],
    name: &str,
    frame: u32,
    opened: &[Opened],
    turns: u32,
) -> Result<(), HostError> {
    let scene = Scene::open(name)?;
    let lights = lights_at(&scene, frame)?;
    let asked = queries(&arrays_at(&scene, frame, 96, 54)?, SEED, 0, QUERIES);
    let params = BuildParams::default();
    let mut sides = Vec::new();
    for o in opened {
        sides.push(side::<Standard, WIDTH>(
            o,
            &build(&lights, Sampler::TwoLevel, &params),
            &asked,
        )?);
        sides.push(side::<Narrow, 4>(
            o,
            &build(&lights, Sampler::TwoLevel, &params),
            &asked,
        )?);
        sides.push(side::<Wide, 16>(
            o,
            &build(&lights, Sampler::TwoLevel, &params),
            &asked,
        )?);
    }
    let mut different = vec![0; sides.len()];
    for (side, different) in sides.iter_mut().zip(&mut different) {
        let words = |sampled: &SampledLight| (sampled.light, sampled.instance, sampled.pmf.to_bits());
        let found = (side.sample)(&asked)?.value;
        let pairs = found.iter().zip(&side.expected);
        *different = pairs.filter(|(a, b)| words(a) != words(b)).count();
    }
    let times = in_turns(sides.len(), turns, QUERIES, |at| {
        Ok((sides[at].sample)(&asked)?.time)
    })?;
    for (at, side) in sides.iter().enumerate() {
        let is_base = |other: &Side<'_>| other.device == side.device && other.width == WIDTH;
        let base = sides.iter().position(is_base).unwrap_or(at);
        let measured = OnDevice {
            device: side.device.to_owned(),
            ns_per_sample: Interval::of(times[at].clone()).median,
            sample_ratio: Interval::of_ratios(&times[at], &times[base]),
            different: different[at],
        };
        let of = |point: &&mut Point| {
            (point.default || point.config.axis == Axis::Width) && point.config.width == side.width
        };
        for point in points.iter_mut().filter(of) {
            point.on_devices.push(measured.clone());
        }
    }
    Ok(())
}

fn side<'a, C: TriangleChoice<W>, const W: usize>(
    opened: &'a Opened,
    bvh: &Bvh<C, W>,
    asked: &[Query],
) -> Result<Side<'a>, HostError> {
    let mut backend = DeviceBackend::<C, W>::as_built(&opened.device, bvh)?;
    let expected = CpuBackend::<C, W>::new(bvh.clone()).sample(asked)?.value;
    Ok(Side {
        width: W,
        device: opened.device.name(),
        sample: Box::new(move |asked| Ok(backend.sample(asked)?)),
        expected,
    })
}

/// Prints what was measured.
pub(super) fn print(points: &[Point]) -> Result<(), HostError> {
    let rows: Vec<(&Point, &OnDevice)> = points
        .iter()
        .flat_map(|point| point.on_devices.iter().map(move |on| (point, on)))
        .collect();
    if rows.is_empty() {
        return Ok(());
    }
    Ok(table::print(
        &rows,
        &[
            ("scene", |(point, _)| point.scene.clone()),
            ("device", |(_, on)| on.device.clone()),
            ("children", |(point, _)| point.config.width.to_string()),
            ("sample ns", |(_, on)| format!("{:.0}", on.ns_per_sample)),
            ("to default", |(_, on)| super::ratio(&on.sample_ratio)),
            ("samples unlike the cpu's", |(_, on)| on.different.to_string()),
        ],
    )?)
}
