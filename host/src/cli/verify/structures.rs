//! Both structures over a scene: refits, queries by the hundred thousand, images.

use indicatif::ProgressBar;
use lightbvh::exact::hash;
use lightbvh::{BuildParams, Lights};
use lightbvh_kernels::bvh::Choice;
use lightbvh_kernels::render::RenderParams;
use serde::Serialize;

use super::tally::{Kind, Side, Tallies};
use crate::backend::{
    Backend, BackendError, Bvh, CpuBackend, DeviceBackend, Follow, Integrator, PIXEL_RECORD, Sampler,
    SceneArrays, node_words,
};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::scene::{Scene, SceneLight};
use crate::workload::{arrays_lit_by, build, lights_of, queries, render_params, words_in_use};

/// Queries answered at a time.
const BATCH: u32 = 1 << 19;
/// Frame at which the trees are built, and the frames that they are refitted to.
const BUILD_FRAME: u32 = 0;
const REFIT_FRAMES: [u32; 2] = [40, 110];
/// Columns and rows of images.
const SIZE: (u32, u32) = (96, 54);
/// Most reflections of the paths that are compared: enough for some to end by chance.
const BOUNCES: u32 = 5;

/// A structure over a scene.
pub(super) struct Subject<'a> {
    pub scene: &'a Scene,
    pub sampler: Sampler,
    /// The importance, for messages.
    pub importance: &'static str,
    pub params: BuildParams,
    /// Whether images without a tree are compared too: once per scene.
    pub treeless: bool,
}

impl Subject<'_> {
    /// Where words come from.
    fn says(&self, kernel: &str) -> String {
        let (scene, sampler) = (self.scene.name(), self.sampler.name());
        format!("{scene} {sampler} {} {kernel}", self.importance)
    }
}

/// A tree in one frame, and whether every invariant of it holds. It is over the lights as they stand in the world: two levels
/// have a tree for each instance, which `inspect` and `trade` share.
#[derive(Debug, Serialize)]
pub(super) struct Tree {
    pub scene: String,
    pub importance: &'static str,
    pub structure: Sampler,
    pub frame: u32,
    pub valid: bool,
    pub said: String,
    pub lights: usize,
    pub mesh_lights: usize,
    pub nodes: usize,
    pub depth: u32,
    pub bytes_per_light: f64,
}

impl Tree {
    fn of<C: Choice<W>, const W: usize>(
        subject: &Subject<'_>,
        frame: u32,
        bvh: &Bvh<C, W>,
        lights: &Lights<C::Light>,
    ) -> Self {
        let violation = bvh.validate().err().map(|violation| violation.to_string());
        Self {
            scene: subject.scene.name().to_owned(),
            importance: subject.importance,
            structure: subject.sampler,
            frame,
            valid: violation.is_none(),
            said: violation.unwrap_or_else(|| "hold".to_owned()),
            lights: lights.triangles().len(),
            mesh_lights: lights.mesh_count(),
            nodes: bvh.nodes().len() + bvh.top_nodes().len(),
            depth: bvh.depth(),
            bytes_per_light: bvh.bytes() as f64 / lights.triangles().len().max(1) as f64,
        }
    }
}

/// A structure on the CPU and on each device.
struct Made<'d, C: Choice<W>, const W: usize> {
    cpu: CpuBackend<C, W>,
    devices: Vec<DeviceBackend<'d, C, W>>,
}

impl<'d, C: Choice<W, Light: SceneLight>, const W: usize> Made<'d, C, W> {
    fn new(
        lights: &Lights<C::Light>,
        sampler: Sampler,
        params: &BuildParams,
        opened: &'d [Opened],
    ) -> Result<Self, HostError> {
        let cpu = CpuBackend::new(build(lights, sampler, params));
        let devices = opened.iter().map(|o| DeviceBackend::new(&o.device, cpu.bvh()));
        let devices = devices.collect::<Result<_, _>>()?;
        Ok(Self { cpu, devices })
    }

    /// Brings all to `lights`, and compares their nodes.
    fn refit(
        &mut self,
        lights: &Lights<C::Light>,
        what: &str,
        tallies: &mut Tallies,
    ) -> Result<(), HostError> {
        let record = self.cpu.node_record();
        self.cpu.bvh_mut().follow(lights).map_err(BackendError::from)?;
        let bvh = self.cpu.bvh();
        let expected = words_in_use(bvh, &node_words(bvh));
        for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
            device.follow(bvh)?;
            let found = words_in_use(bvh, &device.nodes()?);
            tally.take(Kind::Nodes, what, &record, &expected, &found)?;
        }
        Ok(())
    }
}

/// Compares everything about one structure over one scene.
pub(super) fn compare<C: Choice<W, Light: SceneLight>, const W: usize>(
    subject: &Subject<'_>,
    opened: &[Opened],
    (count, seed): (u64, u32),
    tallies: &mut Tallies,
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let scene = subject.scene;
    let what = |kernel: &str| subject.says(kernel);
    let lights = lights_of::<C::Light>(scene, BUILD_FRAME)?;
    let mut made = Made::<C, W>::new(&lights, subject.sampler, &subject.params, opened)?;
    let mut trees = vec![Tree::of::<C, W>(subject, BUILD_FRAME, made.cpu.bvh(), &lights)];
    for frame in REFIT_FRAMES {
        let lights = lights_of::<C::Light>(scene, frame)?;
        made.refit(&lights, &what(&format!("frame {frame} refit")), tallies)?;
        trees.push(Tree::of::<C, W>(subject, frame, made.cpu.bvh(), &lights));
    }
    tallies.trees.extend(trees);
    let is_single_level = made.cpu.bvh().is_single_level();
    let mut side = Side {
        cpu: &mut made.cpu,
        devices: made.devices.iter_mut().map(|device| device as _).collect(),
    };

    let frame = REFIT_FRAMES[REFIT_FRAMES.len() - 1];
    let params = render_params(SIZE, 2, seed, scene.frame(frame).background);
    let arrays = arrays_lit_by::<C::Light>(scene, frame, SIZE.0, SIZE.1)?;
    let lights = (arrays.lights.triangles(), is_single_level);
    let mut first = 0;
    while first < count {
        let batch = u64::min(count - first, BATCH.into()) as u32;
        let asked = queries(&arrays, hash(seed), first as u32, batch);
        side.compare_queries(tallies, &what, asked, lights)?;
        progress.inc(batch.into());
        first += u64::from(batch);
    }
    images(subject, &arrays, &params, &mut side, tallies)
}

/// Small images, of light reflected once and of paths; those of the samplers without a tree once per scene only.
fn images<L: SceneLight>(
    subject: &Subject<'_>,
    arrays: &SceneArrays<L>,
    params: &RenderParams,
    side: &mut Side<'_, L>,
    tallies: &mut Tallies,
) -> Result<(), HostError> {
    let scene = subject.scene;
    let others = [Sampler::Uniform, Sampler::Power]
        .into_iter()
        .filter(|&s| subject.treeless && (s != Sampler::Power || !arrays.thresholds.is_empty()));
    for sampler in others.chain([subject.sampler]) {
        let path = Integrator::Path { bounces: BOUNCES };
        for (kernel, integrator) in [("render", Integrator::Direct), ("path", path)] {
            let what = match sampler.needs_bvh() {
                true => subject.says(kernel),
                false => format!("{} {} {kernel}", scene.name(), sampler.name()),
            };
            side.compare(tallies, Kind::Pixels, &what, &PIXEL_RECORD, |backend| {
                Ok(backend.render(arrays, params, sampler, integrator)?.value)
            })?;
        }
    }
    Ok(())
}
