//! Refits over and over: many words for little time, each of a frame of its own.

use indicatif::ProgressBar;
use lightbvh::Lights;
use lightbvh_kernels::bvh::{Paper, Standard, TriangleChoice, WIDTH};

use super::side::Side;
use super::tally::{Kind, Tallies};
use crate::backend::{Backend, Bvh, Sampler};
use crate::error::HostError;
use crate::method::{Importance, Target};
use crate::scene::Scene;
use crate::workload::{build, lights_at};

/// A structure on the CPU, then on each device.
fn structure<'d, C: TriangleChoice<W>, const W: usize>(
    importance: Importance,
    lights: &Lights,
    sampler: Sampler,
    targets: &[Target<'d>],
) -> Result<Vec<Box<dyn Backend + 'd>>, HostError> {
    let bvh: Bvh<C, W> = build(lights, sampler, &importance.builder().params());
    let mut backends: Vec<Box<dyn Backend + 'd>> = Vec::new();
    for target in [Target::Cpu].iter().chain(targets) {
        backends.push(target.backend::<C, W>(bvh.clone())?);
    }
    Ok(backends)
}

/// Refits `count` times per structure, to the frames after the one that the trees are built at; the CPU computes every
/// frame too.
pub(super) fn compare(
    scene: &Scene,
    importances: &[Importance],
    count: u32,
    targets: &[Target<'_>],
    tallies: &mut Tallies,
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lights = lights_at(scene, 0)?;
    let mut structures = Vec::new();
    for &importance in importances {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            let backends = match importance {
                Importance::Moments => structure::<Standard, WIDTH>(importance, &lights, sampler, targets)?,
                Importance::Eq4 => structure::<Paper, 4>(importance, &lights, sampler, targets)?,
            };
            let name = format!("{} {} {}", scene.name(), sampler.name(), importance.name());
            structures.push((name, backends));
        }
    }
    for frame in 1..=count {
        lights = lights_at(scene, frame)?;
        for (name, backends) in &mut structures {
            let mut backends = backends
                .iter_mut()
                .map(|backend| &mut **backend as &mut dyn Backend);
            let Some(cpu) = backends.next() else { continue };
            let record = cpu.node_record();
            let mut side = Side {
                cpu,
                devices: backends.collect(),
            };
            let what = format!("{name} frame {frame} refit");
            side.compare(tallies, Kind::Nodes, &what, &record, |backend| {
                Ok(backend.refit(&lights)?.value)
            })?;
        }
        progress.set_message(format!("{} refit {frame}", scene.name()));
        progress.inc(1);
    }
    Ok(())
}
