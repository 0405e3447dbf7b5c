//! Refits over and over: many words for little time, each of a frame of its own.

use indicatif::ProgressBar;
use lightbvh::Lights;
use lightbvh_kernels::bvh::Choice;

use super::side::Side;
use super::tally::{Kind, Tallies};
use crate::backend::{Backend, Bvh, Sampler};
use crate::error::HostError;
use crate::method::{Importance, Target};
use crate::scene::{Scene, SceneLight};
use crate::workload::{build, lights_of};

/// A structure over lights `L` on the CPU, then on each device.
pub(super) type Made<'d, L> = Result<Vec<Box<dyn Backend<L> + 'd>>, HostError>;

/// Makes that of a choice.
pub(super) fn structure<'d, C: Choice<W, Light: SceneLight>, const W: usize>(
    importance: Importance,
    lights: &Lights<C::Light>,
    sampler: Sampler,
    targets: &[Target<'d>],
) -> Made<'d, C::Light> {
    let bvh: Bvh<C, W> = build(lights, sampler, &importance.builder().params());
    let mut backends: Vec<Box<dyn Backend<C::Light> + 'd>> = Vec::new();
    for target in [Target::Cpu].iter().chain(targets) {
        backends.push(target.backend::<C, W>(bvh.clone())?);
    }
    Ok(backends)
}

/// Refits `count` times per structure, to the frames after the one that the trees are built at; the CPU computes every
/// frame too.
pub(super) fn compare<'d, L: SceneLight>(
    scene: &Scene,
    importances: &[Importance],
    made: impl Fn(Importance, &Lights<L>, Sampler) -> Made<'d, L>,
    count: u32,
    tallies: &mut Tallies,
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lights = lights_of(scene, 0)?;
    let mut structures = Vec::new();
    for &importance in importances {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            let backends = made(importance, &lights, sampler)?;
            let name = format!("{} {} {}", scene.name(), sampler.name(), importance.name());
            structures.push((name, backends));
        }
    }
    for frame in 1..=count {
        lights = lights_of(scene, frame)?;
        for (name, backends) in &mut structures {
            let mut backends = backends
                .iter_mut()
                .map(|backend| &mut **backend as &mut dyn Backend<L>);
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
