//! Refits over and over: many words for little time, each of a frame of its own.

use bytemuck::cast_slice;
use indicatif::ProgressBar;
use lightbvh::BuildParams;

use super::tally::{Kind, Tally};
use crate::backend::{Backend, CpuBackend, DeviceBackend, NODE_RECORD, Sampler};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{build, lights_at};

/// Refits `count` times per structure, to the frames after the one that the trees are built at; the CPU computes every
/// frame too.
pub(super) fn compare(
    scene: &Scene,
    count: u32,
    opened: &[Opened],
    tallies: &mut [Tally],
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lights = lights_at(scene, 0)?;
    let mut sides = Vec::new();
    for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
        let bvh = build(&lights, sampler, &BuildParams::default());
        let devices = opened
            .iter()
            .map(|o| DeviceBackend::new(&o.device, &bvh, &lights))
            .collect::<Result<Vec<_>, _>>()?;
        sides.push((sampler, CpuBackend::new(bvh, lights.clone()), devices));
    }
    for frame in 1..=count {
        lights = lights_at(scene, frame)?;
        for (sampler, cpu, devices) in &mut sides {
            let expected = cpu.refit(&lights)?.value;
            for (device, tally) in devices.iter_mut().zip(tallies.iter_mut()) {
                let found = device.refit(&lights)?.value;
                let what = format!("{} {} frame {frame} refit", scene.name(), sampler.name());
                let (expected, found) = (cast_slice(&expected), cast_slice(&found));
                tally.take(Kind::Nodes, &what, &NODE_RECORD, expected, found)?;
            }
        }
        progress.set_message(format!("{} refit {frame}", scene.name()));
        progress.inc(1);
    }
    Ok(())
}
