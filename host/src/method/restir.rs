//! ReSTIR (Bitterli et al. 2020) without bias: candidates by power, as in its paper, or from the two-level light BVH.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_kernels::bvh::BvhPicker;

use super::moving::Moving;
use super::{Chain, Runner, Step, Target, UpdateTimes};
use crate::backend::{
    CandidateSource, Combination, CpuRestir, DeviceRestir, Restir, RestirFrame, RestirOptions, SceneArrays,
    Timed,
};
use crate::error::HostError;
use crate::render::power_thresholds;
use crate::workload::Shot;

/// Frames that a history runs through before the image that counts.
const HISTORY: u32 = 8;

/// ReSTIR with as many histories per pixel as the shadow rays asked for allow.
pub(super) struct Reservoirs<'d> {
    options: RestirOptions,
    target: Target<'d>,
    moving: Moving,
    chains: BTreeMap<Chain, Vec<Box<dyn Restir + 'd>>>,
}

impl<'d> Reservoirs<'d> {
    pub(super) fn new(
        first: &Step<'_>,
        target: Target<'d>,
        source: CandidateSource,
    ) -> Result<Self, HostError> {
        Ok(Self {
            options: RestirOptions::new(source, Combination::Unbiased),
            target,
            moving: Moving::new(first, BuildParams::default())?,
            chains: BTreeMap::new(),
        })
    }
}

impl Runner for Reservoirs<'_> {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        match self.options.source {
            CandidateSource::LightBvh => self.moving.advance(step, None),
            CandidateSource::Power => {
                // The table comes with the frame's arrays; here it is made once more, for its time.
                let start = Instant::now();
                let _ = black_box(power_thresholds(step.lights.triangles()));
                let rebuild = start.elapsed();
                Ok(UpdateTimes {
                    rebuild,
                    wait: rebuild,
                    ..UpdateTimes::default()
                })
            }
        }
    }

    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        chain: Chain,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let (options, target) = (self.options, self.target);
        if options.source == CandidateSource::Power && arrays.thresholds.is_empty() {
            return Err(HostError::Sampler {
                scene: step.scene.name().to_owned(),
                sampler: "restir",
                lights: arrays.lights.triangles().len(),
            });
        }
        let histories = self.chains.entry(chain).or_insert_with(|| {
            (0..histories(&options, shot.samples))
                .map(|_| -> Box<dyn Restir> {
                    match target {
                        Target::Cpu => Box::new(CpuRestir::new(options)),
                        Target::Device(device) => Box::new(DeviceRestir::new(device, options)),
                    }
                })
                .collect()
        });
        let share = histories.len() as f32;
        let mut sum = Timed {
            value: vec![[0.0f32; 3]; shot.width as usize * shot.height as usize],
            time: Duration::ZERO,
        };
        for (number, history) in (0..).zip(histories) {
            let part = history.frame(&RestirFrame {
                scene: arrays,
                bvh: BvhPicker {
                    tree: self.moving.scene().tree(),
                    two_level: true,
                },
                width: shot.width,
                height: shot.height,
                seed: hash(hash(shot.seed).wrapping_add(number)).wrapping_add(step.frame),
                jitter: 0,
                background: step.scene.data().background,
                remap: None,
            })?;
            sum.time += part.time;
            for (sum, part) in sum.value.iter_mut().zip(&part.value) {
                for k in 0..3 {
                    sum[k] += part[k] / share;
                }
            }
        }
        Ok(sum)
    }

    fn end(&mut self, chain: Chain) {
        self.chains.remove(&chain);
    }

    fn may_skip(&self) -> bool {
        self.options.source == CandidateSource::Power
    }

    fn history(&self) -> u32 {
        HISTORY
    }
}

/// As many as cost no more than `shadow_rays` per pixel, but one at least.
fn histories(options: &RestirOptions, shadow_rays: u32) -> u32 {
    (shadow_rays / options.most_shadow_rays()).max(1)
}
