//! ReSTIR on every device against the CPU: pixels, G-buffers and reservoirs of a few frames in a row.

use std::sync::Arc;

use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;

use super::subject::Subject;
use super::tally::Tallies;
use crate::backend::{
    Backend, Bvh, Combination, CpuBackend, DeviceBackend, Restir, RestirFrame, RestirOptions, Sampler,
};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::workload::{RenderSettings, arrays_lit_by, build};

/// Frames in a row: the first has no history, the second a short one, the third one that was merged itself.
const FRAMES: u32 = 3;

/// Compares both combinations, with candidates from the light BVH or, once per scene, by power.
pub(super) fn compare<C: Choice<W, Light: SceneLight>, const W: usize>(
    subject: &Subject<'_>,
    settings: &RenderSettings,
    opened: &[Opened],
    tallies: &mut Tallies,
) -> Result<(), HostError> {
    let scene = subject.scene;
    let frames = (settings.frame..settings.frame + FRAMES)
        .map(|n| {
            let arrays = arrays_lit_by::<C::Light>(scene, n, settings.width, settings.height)?;
            let bvh: Bvh<C, W> = build(&arrays.lights, subject.sampler, &subject.params);
            Ok((Arc::new(arrays), bvh))
        })
        .collect::<Result<Vec<_>, HostError>>()?;
    let background = scene.frame(settings.frame).background;
    let power = subject.treeless && !frames[0].0.thresholds.is_empty();
    let sources = [Sampler::Power, subject.sampler];
    for source in sources.into_iter().filter(|source| source.needs_bvh() || power) {
        for combination in [Combination::Unbiased, Combination::Biased] {
            let options = RestirOptions::new(source, combination);
            let mut cpu = Restir::new(options);
            let mut devices: Vec<_> = opened.iter().map(|_| Restir::new(options)).collect();
            for (number, (arrays, bvh)) in (0..).zip(&frames) {
                let frame = RestirFrame {
                    scene: arrays,
                    width: settings.width,
                    height: settings.height,
                    seed: hash(settings.seed).wrapping_add(number),
                    jitter: 0,
                    background,
                    remap: None,
                };
                let expected = CpuBackend::<C, W>::new(bvh.clone())
                    .restir(&mut cpu, &frame)?
                    .value;
                let history = cpu.state()?;
                let what = subject.says(&format!("restir {} frame {number}", combination.name()));
                let devices = opened.iter().zip(&mut devices).zip(&mut tallies.devices);
                for ((opened, restir), tally) in devices {
                    let mut device = DeviceBackend::<C, W>::new(&opened.device, bvh)?;
                    tally.take_pixels(&what, &expected, &device.restir(restir, &frame)?.value)?;
                    tally.take_history([&what, &what], &history, &restir.state()?)?;
                }
            }
        }
    }
    Ok(())
}
