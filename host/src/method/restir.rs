//! ReSTIR (Bitterli et al. 2020): candidates by power, as in its paper, or from the two-level light BVH.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};

use super::moving::Moving;
use super::{Chain, History, Runner, Step, Target, UpdateTimes};
use crate::backend::{
    CandidateSource, CpuRestir, DeviceRestir, Restir, RestirFrame, RestirOptions, SceneArrays, Timed,
};
use crate::error::HostError;
use crate::render::power_thresholds;
use crate::workload::Shot;

/// Frames that a history runs through before the image that counts.
const HISTORY: u32 = 8;

/// What [`Shot::samples`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Shadow rays per pixel, so that methods can be compared at equal cost: as many histories as cost no more, but one at
    /// least. All look at the same points in the pixels, as the images of other methods do.
    ShadowRays,
    /// Histories per pixel, each with points of its own in the pixels, the same in every frame: edges become smooth.
    Histories,
}

/// ReSTIR with one history per pixel or several that know nothing of each other.
pub struct Reservoirs<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    options: RestirOptions,
    count: Count,
    target: Target<'d>,
    moving: Moving<C, W>,
    chains: BTreeMap<Chain, Vec<Box<dyn Restir<C, W> + 'd>>>,
}

impl<'d, C: Choice<W>, const W: usize> Reservoirs<'d, C, W> {
    /// Before the first image; a light BVH is built as `params` say.
    ///
    /// # Errors
    /// [`HostError`] for lights outside the domain.
    pub fn new(
        first: &Step<'_>,
        target: Target<'d>,
        options: RestirOptions,
        params: BuildParams,
        count: Count,
    ) -> Result<Self, HostError> {
        Ok(Self {
            options,
            count,
            target,
            moving: Moving::new(first, params)?,
            chains: BTreeMap::new(),
        })
    }
}

impl<C: Choice<W>, const W: usize> Runner for Reservoirs<'_, C, W> {
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
        let (options, count, target) = (self.options, self.count, self.target);
        if options.source == CandidateSource::Power && arrays.thresholds.is_empty() {
            return Err(HostError::Sampler {
                scene: step.scene.name().to_owned(),
                sampler: "restir",
                lights: arrays.lights.triangles().len(),
            });
        }
        let histories = self.chains.entry(chain).or_insert_with(|| {
            (0..count.histories(&options, shot.samples))
                .map(|_| -> Box<dyn Restir<C, W>> {
                    match target {
                        Target::Cpu => Box::new(CpuRestir::<C, W>::new(options)),
                        Target::Device(device) => Box::new(DeviceRestir::<C, W>::new(device, options)),
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
                bvh: self.moving.scene().tree(),
                width: shot.width,
                height: shot.height,
                seed: hash(hash(shot.seed).wrapping_add(number)).wrapping_add(step.frame),
                jitter: match count {
                    Count::ShadowRays => 0,
                    Count::Histories => number,
                },
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

    fn histories(&self, chain: Chain) -> Result<Vec<History>, HostError> {
        let histories = self.chains.get(&chain).into_iter().flatten();
        Ok(histories
            .map(|history| history.state())
            .collect::<Result<_, _>>()?)
    }

    fn shadow_rays(&self, chain: Chain) -> Option<u64> {
        let histories = self.chains.get(&chain)?;
        Some(histories.iter().map(|history| history.shadow_rays()).sum())
    }

    fn may_skip(&self) -> bool {
        self.options.source == CandidateSource::Power
    }

    fn history(&self) -> u32 {
        HISTORY
    }
}

impl Count {
    fn histories(self, options: &RestirOptions, samples: u32) -> u32 {
        match self {
            Self::ShadowRays => (samples / options.most_shadow_rays()).max(1),
            Self::Histories => samples,
        }
    }
}
