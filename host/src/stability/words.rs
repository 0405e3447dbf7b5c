//! Words of a device against those of the CPU.

use lightbvh::{EmissiveTriangle, Lights, Random64, ShadingPoint};
use lightbvh_kernels::bvh::WIDTH;
use lightbvh_kernels::query::Query;

use super::random::{ENDS, Random};
use super::row::{Check, Row};
use crate::backend::{Bvh, CpuBackend, DeviceBackend, Follow};
use crate::error::HostError;
use crate::tally::{Kind, Side, Tallies, Tally};
use crate::vulkan::Device;

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
    let mut tallies = Tallies {
        devices: vec![Tally::default()],
        ..Tallies::default()
    };
    let mut side: Side<'_, dyn Follow> = Side {
        cpu: &mut cpu,
        devices: vec![&mut other],
    };
    compare_bvh(&mut side, &mut tallies, "", (bvh, lights.all()), points)?;
    let tally = &tallies.devices[0];
    let row = |(check, kinds): (_, &[Kind])| {
        let different: u64 = kinds.iter().map(|kind| tally.words[kind].different).sum();
        let row = Row::new(extreme, structure, check, different as f64, 0.0);
        row.on(device.name()).at(tally.first_difference.clone())
    };
    let rows = [
        (Check::RefitWords, &[Kind::Nodes, Kind::Uploads][..]),
        (Check::SampleWords, &[Kind::Samples]),
        (Check::PmfWords, &[Kind::Pmfs]),
    ];
    Ok(rows.map(row).into())
}

/// Compares the words in use of a BVH over these lights of the world, and samples and probabilities at points.
pub(crate) fn compare_bvh(
    side: &mut Side<'_, dyn Follow + '_>,
    tallies: &mut Tallies,
    place: &str,
    (bvh, lights): (&Bvh, &[EmissiveTriangle]),
    points: &[ShadingPoint],
) -> Result<(), HostError> {
    let what = |kernel: &str| format!("{place} {kernel}").trim_start().to_owned();
    side.compare_held(tallies, &what("refit"), |backend| Ok(backend.held(bvh)?))?;
    side.compare_queries(
        tallies,
        &what,
        queries(points),
        (lights, bvh.view().is_single_level()),
    )
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
