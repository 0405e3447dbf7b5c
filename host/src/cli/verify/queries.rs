//! Sampled lights and pmfs of one backend on each device against the CPU.

use bytemuck::cast_slice;
use lightbvh::exact::hash;
use lightbvh::{EmissiveTriangle, INVALID, SampledLight};
use lightbvh_kernels::query::Query;

use super::tally::{Kind, Tally};
use crate::backend::{Backend, PMF_RECORD, SAMPLED_RECORD};
use crate::error::HostError;

/// Sample, then pmf: of the light sampled for every query but each eighth, which asks for some of the `lights` in the world, of one
/// level or two. What the CPU
/// evaluates again must be what it sampled.
pub(super) fn compare_queries(
    what: &dyn Fn(&str) -> String,
    cpu: &mut dyn Backend,
    devices: &mut [&mut dyn Backend],
    mut asked: Vec<Query>,
    (lights, single): (&[EmissiveTriangle], bool),
    tallies: &mut [Tally],
    cpu_tally: &mut Tally,
) -> Result<(), HostError> {
    let sampled: Vec<SampledLight> = cpu.sample(&asked)?.value;
    for (device, tally) in devices.iter_mut().zip(tallies.iter_mut()) {
        let found = device.sample(&asked)?.value;
        let (expected, found) = (cast_slice(&sampled), cast_slice(&found));
        tally.take(Kind::Samples, &what("sample"), &SAMPLED_RECORD, expected, found)?;
    }
    for (i, (query, sampled)) in asked.iter_mut().zip(&sampled).enumerate() {
        query.words = if i % 8 == 7 && !lights.is_empty() {
            let light = hash(i as u32) % lights.len() as u32;
            let mesh = lights[light as usize].mesh;
            [light, if single { INVALID } else { mesh }]
        } else {
            [sampled.light, sampled.instance]
        };
    }
    let pmfs = cpu.pmf(&asked)?.value;
    let again: (Vec<u32>, Vec<u32>) = asked
        .iter()
        .zip(sampled.iter().zip(&pmfs))
        .filter(|(query, (sampled, _))| query.words[0] == sampled.light)
        .map(|(_, (sampled, pmf))| (sampled.pmf.to_bits(), pmf.to_bits()))
        .unzip();
    let own = what("sample against pmf");
    cpu_tally.take(Kind::Pmfs, &own, &PMF_RECORD, &again.0, &again.1)?;
    for (device, tally) in devices.iter_mut().zip(tallies) {
        let found = device.pmf(&asked)?.value;
        let (expected, found) = (cast_slice(&pmfs), cast_slice(&found));
        tally.take(Kind::Pmfs, &what("pmf"), &PMF_RECORD, expected, found)?;
    }
    Ok(())
}
