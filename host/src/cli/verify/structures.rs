//! Both structures over a scene: refits, queries by the hundred thousand, images, ReSTIR.

use bytemuck::cast_slice;
use indicatif::ProgressBar;
use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;

use super::queries::compare_queries;
use super::tally::{Kind, Tally};
use crate::backend::{Backend, Bvh, CpuBackend, DeviceBackend, PIXEL_RECORD, Sampler, SceneArrays};
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

/// A structure over a scene.
pub(super) struct Subject<'a> {
    pub scene: &'a Scene,
    pub sampler: Sampler,
    /// What lights are chosen by, for messages.
    pub importance: &'static str,
    pub params: BuildParams,
    /// Whether images and reservoirs without a tree are compared too: once per scene.
    pub treeless: bool,
}

impl Subject<'_> {
    /// Where words come from.
    pub fn says(&self, kernel: &str) -> String {
        format!(
            "{} {} {} {kernel}",
            self.scene.name(),
            self.sampler.name(),
            self.importance
        )
    }
}

impl Structures {
    /// Everything about one structure over one scene.
    pub fn compare<C: Choice<W>, const W: usize>(
        &mut self,
        subject: &Subject<'_>,
        opened: &[Opened],
        count: u64,
        seed: u32,
    ) -> Result<(), HostError> {
        let scene = subject.scene;
        let what = |kernel: &str| subject.says(kernel);
        let lights = lights_at(scene, BUILD_FRAME)?;
        let bvh: Bvh<C, W> = build(&lights, subject.sampler, &subject.params);
        let mut cpu = CpuBackend::<C, W>::new(bvh.clone());
        let mut devices = opened
            .iter()
            .map(|o| DeviceBackend::<C, W>::new(&o.device, &bvh))
            .collect::<Result<Vec<_>, _>>()?;

        for frame in REFIT_FRAMES {
            let lights = lights_at(scene, frame)?;
            let expected = cpu.refit(&lights)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.refit(&lights)?.value;
                let what = what(&format!("frame {frame} refit"));
                tally.take(Kind::Nodes, &what, &cpu.node_record(), &expected, &found)?;
            }
        }

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
            let lights = (arrays.lights.triangles(), bvh.is_single_level());
            let (tallies, own) = (&mut self.tallies, &mut self.cpu);
            compare_queries(&what, &mut cpu, &mut devices, asked, lights, tallies, own)?;
            self.progress.inc(batch.into());
            first += u64::from(batch);
        }
        let mut devices: Vec<&mut dyn Backend> = devices.iter_mut().map(|d| d as _).collect();
        self.images(subject, &arrays, &shot, &mut cpu, &mut devices)?;
        super::restir::compare::<C, W>(subject, &shot, opened, &mut self.tallies)
    }

    /// Small images, of light reflected once and of paths; those of the samplers without a tree once per scene only.
    fn images(
        &mut self,
        subject: &Subject<'_>,
        arrays: &SceneArrays,
        shot: &Shot,
        cpu: &mut dyn Backend,
        devices: &mut [&mut dyn Backend],
    ) -> Result<(), HostError> {
        let (scene, structure) = (subject.scene, subject.sampler);
        let params = shot.params(scene.frame(shot.frame).background);
        let others = [Sampler::Uniform, Sampler::Power]
            .into_iter()
            .filter(|&s| subject.treeless && (s != Sampler::Power || !arrays.thresholds.is_empty()));
        for sampler in others.chain([structure]) {
            let what = |kernel: &str| match sampler.needs_bvh() {
                true => subject.says(kernel),
                false => format!("{} {} {kernel}", scene.name(), sampler.name()),
            };
            let expected = cpu.render(arrays, &params, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render(arrays, &params, sampler)?.value;
                tally.take(
                    Kind::Pixels,
                    &what("render"),
                    &PIXEL_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
            let expected = cpu.render_path(arrays, &params, BOUNCES, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render_path(arrays, &params, BOUNCES, sampler)?.value;
                tally.take(
                    Kind::Pixels,
                    &what("path"),
                    &PIXEL_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
        }
        Ok(())
    }
}
