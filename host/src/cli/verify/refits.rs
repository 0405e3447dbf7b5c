//! Refits over and over: many words for little time, each of a frame of its own.

use indicatif::ProgressBar;
use lightbvh::{BuildParams, Lights};
use lightbvh_kernels::bvh::{Choice, Paper, Standard, WIDTH};

use super::tally::{Kind, Tally};
use crate::backend::{Backend, Bvh, Sampler};
use crate::cli::render::{HeuristicName, ImportanceName};
use crate::error::HostError;
use crate::method::Target;
use crate::scene::Scene;
use crate::workload::{build, lights_at};

/// A structure on the CPU and on each device.
struct Side<'d> {
    name: String,
    cpu: Box<dyn Backend + 'd>,
    devices: Vec<Box<dyn Backend + 'd>>,
}

impl<'d> Side<'d> {
    fn new<C: Choice<W>, const W: usize>(
        lights: &Lights,
        sampler: Sampler,
        params: &BuildParams,
        targets: &[Target<'d>],
    ) -> Result<Self, HostError> {
        let bvh: Bvh<C, W> = build(lights, sampler, params);
        let on = |target: &Target<'d>| target.backend::<C, W>(bvh.clone());
        Ok(Self {
            name: format!("{} {}", sampler.name(), C::NAME),
            cpu: on(&Target::Cpu)?,
            devices: targets.iter().map(on).collect::<Result<_, _>>()?,
        })
    }
}

/// Refits `count` times per structure, to the frames after the one that the trees are built at; the CPU computes every
/// frame too.
pub(super) fn compare(
    scene: &Scene,
    importances: &[ImportanceName],
    count: u32,
    targets: &[Target<'_>],
    tallies: &mut [Tally],
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lights = lights_at(scene, 0)?;
    let mut sides = Vec::new();
    for &importance in importances {
        let params = HeuristicName::params(None, importance);
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            sides.push(match importance {
                ImportanceName::Moments => Side::new::<Standard, WIDTH>(&lights, sampler, &params, targets)?,
                ImportanceName::Eq4 => Side::new::<Paper, 4>(&lights, sampler, &params, targets)?,
            });
        }
    }
    for frame in 1..=count {
        lights = lights_at(scene, frame)?;
        for side in &mut sides {
            let expected = side.cpu.refit(&lights)?.value;
            let record = side.cpu.node_record();
            for (device, tally) in side.devices.iter_mut().zip(tallies.iter_mut()) {
                let found = device.refit(&lights)?.value;
                let what = format!("{} {} frame {frame} refit", scene.name(), side.name);
                tally.take(Kind::Nodes, &what, &record, &expected, &found)?;
            }
        }
        progress.set_message(format!("{} refit {frame}", scene.name()));
        progress.inc(1);
    }
    Ok(())
}
