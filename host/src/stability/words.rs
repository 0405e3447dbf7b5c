//! Words of a device against those of the CPU.

use bytemuck::cast_slice;
use lightbvh::{INVALID, Lights, Random64, ShadingPoint};
use lightbvh_kernels::bvh::WIDTH;
use lightbvh_kernels::query::Query;

use super::random::{ENDS, Random};
use super::row::{Check, Row};
use crate::backend::{Backend, Bvh, CpuBackend, DeviceBackend, PMF_RECORD, SAMPLED_RECORD};
use crate::error::HostError;
use crate::vulkan::Device;
use crate::words::{Record, compare_words};
use crate::workload::words_in_use;

/// Random numbers per point, next to the ends of their range.
const NUMBERS: u32 = 96;

/// Compares refit, samples and probabilities over a BVH that is refitted.
pub fn compare(
    extreme: &str,
    structure: &str,
    bvh: &Bvh,
    lights: &Lights,
    points: &[ShadingPoint],
    device: &Device,
) -> Result<Vec<Row>, HostError> {
    let mut cpu: CpuBackend = CpuBackend::new(bvh.clone());
    // It refits all that is uploaded.
    let mut other: DeviceBackend<'_> = DeviceBackend::new(device, &without_summaries(bvh))?;
    let nodes = words_in_use(bvh, &cpu.nodes()?);
    let found = words_in_use(bvh, &other.nodes()?);
    let row = |check, record: &Record, cpu: &[u32], device_words: &[u32]| -> Result<Row, HostError> {
        let comparison = compare_words(record, cpu, device_words)?;
        let place = comparison.first.map(|first| first.to_string());
        let row = Row::new(extreme, structure, check, comparison.different as f64, 0.0);
        Ok(row.on(device.name()).at(place))
    };
    let mut out = vec![row(Check::RefitWords, &cpu.node_record(), &nodes, &found)?];

    let mut queries = queries(points);
    let sampled = cpu.sample(&queries)?.value;
    let found = other.sample(&queries)?.value;
    out.push(row(
        Check::SampleWords,
        &SAMPLED_RECORD,
        cast_slice(&sampled),
        cast_slice(&found),
    )?);
    let count = lights.triangles().len() as u32;
    let live = bvh.tree().live > 0;
    let instance_of = |light: u32| {
        if live {
            lights.triangles()[light as usize].mesh
        } else {
            INVALID
        }
    };
    for (i, (query, sampled)) in (0..).zip(queries.iter_mut().zip(&sampled)) {
        let any = sampled.light == INVALID || i % 2 == 1;
        query.words = if any {
            let light = lightbvh::exact::hash(i) % count;
            [light, instance_of(light)]
        } else {
            [sampled.light, sampled.instance]
        };
    }
    let (pmfs, found) = (cpu.pmf(&queries)?.value, other.pmf(&queries)?.value);
    out.push(row(
        Check::PmfWords,
        &PMF_RECORD,
        cast_slice(&pmfs),
        cast_slice(&found),
    )?);
    Ok(out)
}

/// The same with links alone in its nodes, so that a refit has everything to compute.
fn without_summaries(bvh: &Bvh) -> Bvh {
    use lightbvh::node::Node as _;
    let mut out = bvh.clone();
    let parts = out.parts_mut();
    for node in parts.nodes.iter_mut().chain(parts.top) {
        for slot in 0..WIDTH {
            node.set_child(slot, node.kind(slot), node.link(slot));
        }
    }
    out
}

fn queries(points: &[ShadingPoint]) -> Vec<Query> {
    let random = &mut Random::new(77);
    let mut out = Vec::new();
    for &point in points {
        let numbers = (0..NUMBERS).map(|_| Random64::from(random.bits()));
        out.extend(numbers.chain(ENDS).map(|number| Query {
            point,
            words: [number.high, number.low],
        }));
    }
    out
}
