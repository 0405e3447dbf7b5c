//! Frames of an animation: every method brought from frame to frame on the CPU and on each device, rebuilds included, and
//! everything that it computes compared in each frame.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::cast_slice;
use indicatif::ProgressBar;
use lightbvh::exact::hash;
use lightbvh_kernels::query::Query;

use super::queries::compare_queries;
use super::tally::{Kind, Tally};
use crate::backend::{Backend, PIXEL_RECORD, RESERVOIR_RECORD, SURFACE_RECORD, SceneArrays};
use crate::cli::render::ImportanceName;
use crate::error::HostError;
use crate::method::{Chain, Method, Runner, Step, Target, runner};
use crate::scene::Scene;
use crate::workload::{Shot, arrays_at, queries};

/// Images are small: an animation has thousands of them, and SwiftShader takes a millisecond for a pixel of some.
const SIZE: (u32, u32) = (16, 9);
/// All images of a method are of one animation.
const CHAIN: Chain = 0;

/// What is compared in each frame.
pub(super) struct Plan {
    pub frames: Range<u32>,
    /// Lights sampled and pmfs evaluated per frame and method.
    pub queries: u32,
    pub seed: u32,
    /// Only methods by these, and those without a light BVH.
    pub importances: &'static [ImportanceName],
}

/// A method on the CPU and on each device.
struct Lane<'d> {
    method: Method,
    cpu: Box<dyn Runner + 'd>,
    devices: Vec<Box<dyn Runner + 'd>>,
}

/// Compares all methods over the frames of `scene` with `targets`, which `tallies` are of.
pub(super) fn compare(
    scene: &Scene,
    plan: &Plan,
    targets: &[Target<'_>],
    tallies: &mut [Tally],
    cpu_tally: &mut Tally,
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lanes = Vec::new();
    for frame in plan.frames.clone() {
        let arrays = Arc::new(arrays_at(scene, frame, SIZE.0, SIZE.1)?);
        let step = Step {
            scene,
            frame,
            lights: &arrays.lights,
        };
        let asked = queries(&arrays, hash(plan.seed.wrapping_add(frame)), 0, plan.queries);
        if lanes.is_empty() {
            lanes = start(plan, &step, &arrays, targets)?;
        } else {
            for lane in &mut lanes {
                lane.advance(&step)?;
            }
        }
        for lane in &mut lanes {
            progress.set_message(format!("{} frame {frame}: {}", scene.name(), lane.method.name()));
            lane.compare(&step, &arrays, &asked, plan.seed, tallies, cpu_tally)?;
        }
        progress.inc(1);
    }
    Ok(())
}

/// All methods at the first frame; those that choose by power only where there is a table for it.
fn start<'d>(
    plan: &Plan,
    step: &Step<'_>,
    arrays: &SceneArrays,
    targets: &[Target<'d>],
) -> Result<Vec<Lane<'d>>, HostError> {
    let mut lanes = Vec::new();
    let wanted = |name: &str| {
        plan.importances
            .iter()
            .any(|importance| importance.name() == name)
    };
    for method in Method::ALL {
        if !method.importance().is_none_or(wanted) {
            continue;
        }
        if matches!(method, Method::Power | Method::Restir) && arrays.thresholds.is_empty() {
            continue;
        }
        lanes.push(Lane {
            method,
            cpu: runner(method, step, Target::Cpu)?,
            devices: targets
                .iter()
                .map(|&target| runner(method, step, target))
                .collect::<Result<_, _>>()?,
        });
    }
    Ok(lanes)
}

impl Lane<'_> {
    fn advance(&mut self, step: &Step<'_>) -> Result<(), HostError> {
        self.cpu.advance(step)?;
        for device in &mut self.devices {
            device.advance(step)?;
        }
        Ok(())
    }

    /// Everything that the method has at the frame last advanced to.
    fn compare(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        asked: &[Query],
        seed: u32,
        tallies: &mut [Tally],
        cpu_tally: &mut Tally,
    ) -> Result<(), HostError> {
        let method = self.method;
        let what = |kernel: &str| {
            format!(
                "{} {} frame {} {kernel}",
                step.scene.name(),
                method.name(),
                step.frame
            )
        };
        if method.is_light_bvh()
            && let Some(cpu) = self.cpu.backend()
        {
            let mut devices: Vec<&mut dyn Backend> = self
                .devices
                .iter_mut()
                .filter_map(|device| device.backend())
                .collect();
            // A tree that was built anew came to the device complete; there it is refitted, so that its words are the
            // device's own.
            let refits = method.is_rebuilt();
            let nodes = |backend: &mut dyn Backend| match refits {
                true => backend.refit(step.lights).map(|refitted| refitted.value),
                false => backend.nodes(),
            };
            let (expected, record) = (nodes(cpu)?, cpu.node_record());
            for (device, tally) in devices.iter_mut().zip(tallies.iter_mut()) {
                let found = nodes(&mut **device)?;
                tally.take(Kind::Nodes, &what("refit"), &record, &expected, &found)?;
            }
            let lights = (arrays.lights.triangles(), method.is_single_level());
            compare_queries(
                &what,
                cpu,
                &mut devices,
                asked.to_vec(),
                lights,
                tallies,
                cpu_tally,
            )?;
        }

        let shot = Shot {
            frame: step.frame,
            width: SIZE.0,
            height: SIZE.1,
            samples: 1,
            seed: seed.wrapping_add(step.frame),
        };
        let expected = self.cpu.image(step, arrays, &shot, CHAIN)?.value;
        let histories = self.cpu.histories(CHAIN)?;
        for (device, tally) in self.devices.iter_mut().zip(tallies) {
            let found = device.image(step, arrays, &shot, CHAIN)?.value;
            let (expected, found) = (cast_slice(&expected), cast_slice(&found));
            tally.take(Kind::Pixels, &what("render"), &PIXEL_RECORD, expected, found)?;
            for (cpu, device) in histories.iter().zip(&device.histories(CHAIN)?) {
                let (expected, found) = (cast_slice(&cpu.0), cast_slice(&device.0));
                tally.take(
                    Kind::Surfaces,
                    &what("restir_initial"),
                    &SURFACE_RECORD,
                    expected,
                    found,
                )?;
                let (expected, found) = (cast_slice(&cpu.1), cast_slice(&device.1));
                tally.take(
                    Kind::Reservoirs,
                    &what("restir"),
                    &RESERVOIR_RECORD,
                    expected,
                    found,
                )?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
