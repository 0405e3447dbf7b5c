//! Both structures over a scene: refits, queries by the hundred thousand, images, ReSTIR.

use bytemuck::cast_slice;
use indicatif::ProgressBar;
use lightbvh::BuildParams;
use lightbvh::exact::hash;

use super::queries::compare_queries;
use super::tally::{Kind, Tally};
use crate::backend::{
    Backend, Bvh, CpuBackend, DeviceBackend, NODE_RECORD, PIXEL_RECORD, Sampler, SceneArrays,
};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{Shot, arrays_at, build, lights_at, queries};

/// Queries answered at a time.
const BATCH: u32 = 1 << 19;
/// Frame at which the trees are built, and the frames that they are refitted to.
const BUILD_FRAME: u32 = 0;
const REFIT_FRAMES: [u32; 2] = [40, 110];
/// Most reflections of the paths that are compared: enough for some to end by chance.
const BOUNCES: u32 = 5;

/// The comparison so far.
pub(super) struct Structures {
    /// By device.
    pub tallies: Vec<Tally>,
    /// The CPU's pmfs against its samples.
    pub cpu: Tally,
    pub progress: ProgressBar,
}

impl Structures {
    /// The refits again, with one dispatch for all levels; to the last frame at the end, as before.
    fn single_dispatch(
        &mut self,
        scene: &Scene,
        what: &impl Fn(&str) -> String,
        cpu: &mut CpuBackend,
        devices: &mut [DeviceBackend<'_>],
    ) -> Result<(), HostError> {
        for frame in REFIT_FRAMES {
            let what = what(&format!("frame {frame} refit with one dispatch"));
            let lights = lights_at(scene, frame)?;
            // From the nodes of another frame, as on the devices: none is as it should be already.
            let climbed = cpu.refit_once(&lights)?.value;
            let expected = cpu.refit(&lights)?.value;
            let (expected, climbed) = (cast_slice(&expected), cast_slice(&climbed));
            self.cpu
                .take(Kind::Nodes, &what, &NODE_RECORD, expected, climbed)?;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.refit_once(&lights)?.value;
                tally.take(Kind::Nodes, &what, &NODE_RECORD, expected, cast_slice(&found))?;
            }
        }
        Ok(())
    }

    /// Everything about one structure over one scene.
    pub fn structure(
        &mut self,
        scene: &Scene,
        sampler: Sampler,
        opened: &[Opened],
        count: u64,
        seed: u32,
    ) -> Result<(), HostError> {
        let what = |kernel: &str| format!("{} {} {kernel}", scene.name(), sampler.name());
        let lights = lights_at(scene, BUILD_FRAME)?;
        let bvh: Bvh = build(&lights, sampler, &BuildParams::default());
        let mut cpu = CpuBackend::new(bvh.clone(), lights.clone());
        let mut devices = opened
            .iter()
            .map(|o| DeviceBackend::new(&o.device, &bvh, &lights))
            .collect::<Result<Vec<_>, _>>()?;

        for frame in REFIT_FRAMES {
            let lights = lights_at(scene, frame)?;
            let expected = cpu.refit(&lights)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.refit(&lights)?.value;
                tally.take(
                    Kind::Nodes,
                    &what(&format!("frame {frame} refit")),
                    &NODE_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
        }

        self.single_dispatch(scene, &what, &mut cpu, &mut devices)?;

        let shot = Shot {
            frame: REFIT_FRAMES[REFIT_FRAMES.len() - 1],
            width: 96,
            height: 54,
            samples: 2,
            seed,
        };
        let arrays = arrays_at(scene, shot.frame, shot.width, shot.height)?;
        let mut first = 0;
        while first < count {
            let batch = u64::min(count - first, BATCH.into()) as u32;
            let asked = queries(&arrays, hash(seed), first as u32, batch);
            let mut devices: Vec<&mut dyn Backend> = devices.iter_mut().map(|d| d as _).collect();
            let lights = arrays.lights.triangles().len() as u32;
            let (tallies, own) = (&mut self.tallies, &mut self.cpu);
            compare_queries(&what, &mut cpu, &mut devices, asked, lights, tallies, own)?;
            self.progress.inc(batch.into());
            first += u64::from(batch);
        }
        self.images(scene, sampler, &arrays, &shot, &mut cpu, &mut devices)?;
        super::restir::compare(scene, sampler, &shot, opened, &mut self.tallies)
    }

    /// Small images, of light reflected once and of paths; those of the samplers without a tree once per scene only.
    fn images(
        &mut self,
        scene: &Scene,
        structure: Sampler,
        arrays: &SceneArrays,
        shot: &Shot,
        cpu: &mut CpuBackend,
        devices: &mut [DeviceBackend<'_>],
    ) -> Result<(), HostError> {
        let params = shot.params(scene.frame(shot.frame).background);
        let others = [Sampler::Uniform, Sampler::Power].into_iter().filter(|&s| {
            structure == Sampler::SingleLevel && (s != Sampler::Power || !arrays.thresholds.is_empty())
        });
        for sampler in others.chain([structure]) {
            let expected = cpu.render(arrays, &params, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render(arrays, &params, sampler)?.value;
                let what = format!("{} render {}", scene.name(), sampler.name());
                tally.take(
                    Kind::Pixels,
                    &what,
                    &PIXEL_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
            let expected = cpu.render_path(arrays, &params, BOUNCES, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render_path(arrays, &params, BOUNCES, sampler)?.value;
                let what = format!("{} path {}", scene.name(), sampler.name());
                tally.take(
                    Kind::Pixels,
                    &what,
                    &PIXEL_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
        }
        Ok(())
    }
}
