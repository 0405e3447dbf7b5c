//! ReSTIR on every device against the CPU: pixels, G-buffers and reservoirs of a few frames in a row.

use std::sync::Arc;

use bytemuck::cast_slice;
use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;

use super::structures::Subject;
use super::tally::{Kind, Tally};
use crate::backend::{
    Bvh, CandidateSource, Combination, CpuRestir, DeviceRestir, PIXEL_RECORD, RESERVOIR_RECORD, Restir,
    RestirFrame, RestirOptions, SURFACE_RECORD,
};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::workload::{Shot, arrays_at, build};

/// Frames in a row: the first has no history, the second a short one, the third one that was merged itself.
const FRAMES: u32 = 3;

/// Compares both combinations, with candidates from the light BVH or, once per scene, by power.
pub(super) fn compare<C: Choice<W>, const W: usize>(
    subject: &Subject<'_>,
    shot: &Shot,
    opened: &[Opened],
    tallies: &mut [Tally],
) -> Result<(), HostError> {
    let scene = subject.scene;
    let frames = (shot.frame..shot.frame + FRAMES)
        .map(|n| {
            let arrays = arrays_at(scene, n, shot.width, shot.height)?;
            let bvh: Bvh<C, W> = build(&arrays.lights, subject.sampler, &subject.params);
            Ok((Arc::new(arrays), bvh))
        })
        .collect::<Result<Vec<_>, HostError>>()?;
    let background = scene.frame(shot.frame).background;
    let power = subject.treeless && !frames[0].0.thresholds.is_empty();
    for source in [CandidateSource::Power, CandidateSource::LightBvh] {
        if source == CandidateSource::Power && !power {
            continue;
        }
        for combination in [Combination::Unbiased, Combination::Biased] {
            let options = RestirOptions::new(source, combination);
            let mut cpu = CpuRestir::<C, W>::new(options);
            let mut devices: Vec<_> = opened
                .iter()
                .map(|o| DeviceRestir::<C, W>::new(&o.device, options))
                .collect();
            for (number, (arrays, bvh)) in (0..).zip(&frames) {
                let frame = RestirFrame {
                    scene: arrays,
                    bvh: bvh.tree(),
                    width: shot.width,
                    height: shot.height,
                    seed: hash(shot.seed).wrapping_add(number),
                    jitter: 0,
                    background,
                    remap: None,
                };
                let expected = cpu.frame(&frame)?.value;
                let (surfaces, reservoirs) = cpu.state()?;
                let what = subject.says(&format!("restir {} frame {number}", combination.name()));
                for (device, tally) in devices.iter_mut().zip(tallies.iter_mut()) {
                    let found = device.frame(&frame)?.value;
                    let state = device.state()?;
                    for (kind, record, cpu, device) in [
                        (
                            Kind::Pixels,
                            &PIXEL_RECORD,
                            cast_slice(&expected),
                            cast_slice(&found),
                        ),
                        (
                            Kind::Surfaces,
                            &SURFACE_RECORD,
                            cast_slice(&surfaces),
                            cast_slice(&state.0),
                        ),
                        (
                            Kind::Reservoirs,
                            &RESERVOIR_RECORD,
                            cast_slice(&reservoirs),
                            cast_slice(&state.1),
                        ),
                    ] {
                        tally.take(kind, &what, record, cpu, device)?;
                    }
                }
            }
        }
    }
    Ok(())
}
