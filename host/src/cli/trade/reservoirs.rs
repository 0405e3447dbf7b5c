//! ReSTIR (Bitterli et al. 2020) as a choice: unbiased, over consecutive frames of the animation.
//!
//! Its least image is one history of a pixel: up to six shadow rays, all passes. Where others take more rays, it takes more
//! histories that know nothing of each other, as in `lightbvh compare`. What is told of one sample of a tree is told of all
//! initial candidates of a pixel here, of which one stays.

use std::collections::{BTreeMap, VecDeque};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use lightbvh::exact::hash;
use lightbvh::{Lights, Random64, SampledLight, ShadingPoint};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::pick::{PickLight, Power};

use super::built::Built;
use super::subject::{Axis, Config, Subject};
use super::update::{Frame, Spent};
use crate::backend::{
    Backend, Combination, CpuBackend, Restir, RestirFrame, RestirOptions, Sampler, SceneArrays, Timed,
};
use crate::error::HostError;
use crate::render::power_thresholds;

/// Frames that a history runs through before the one that counts.
pub(super) const HISTORY: u32 = 8;

/// Histories up to the frame that counts, shared by seeds; that frame itself is another one by each seed.
const RUNS: u32 = 4;

/// Histories of ReSTIR over the lights of a scene.
pub(super) struct Reservoirs {
    config: Config,
    options: RestirOptions,
    /// The light BVH; by power only what the renderer is made over.
    tree: Built,
    /// The power table of the frame last advanced to; empty where candidates come from the tree.
    thresholds: Vec<u32>,
    past: VecDeque<Past>,
    /// Before the last of the `past`, by run and number.
    histories: BTreeMap<(u32, u32), Restir>,
}

/// What a frame is rendered from.
struct Past {
    backend: CpuBackend,
    arrays: Arc<SceneArrays>,
    number: u32,
    background: [f32; 3],
}

impl Reservoirs {
    /// Candidates from `source`, by power or from `tree`, at the first frame.
    pub fn new(source: Sampler, tree: Built, first: &Frame<'_>) -> Result<Self, HostError> {
        let options = RestirOptions::new(source, Combination::Unbiased);
        let mut reservoirs = Self {
            config: Config {
                axis: Axis::Integrator,
                integrator: "restir",
                levels: source,
                importance: match source {
                    Sampler::Power => "power",
                    _ => tree.config().importance,
                },
                candidates: options.candidates,
                ..tree.config()
            },
            options,
            tree,
            thresholds: Vec::new(),
            past: VecDeque::new(),
            histories: BTreeMap::new(),
        };
        if !source.needs_bvh() {
            reservoirs.thresholds = thresholds(first)?;
        }
        reservoirs.keep(first);
        Ok(reservoirs)
    }

    /// Keeps what `frame` is rendered from, and of those before only what a history takes.
    fn keep(&mut self, frame: &Frame<'_>) {
        self.histories.clear();
        if let Some(arrays) = frame.arrays {
            self.past.push_back(Past {
                backend: CpuBackend::new(self.tree.bvh().clone()),
                arrays: Arc::clone(arrays),
                number: frame.number,
                background: frame.scene.frame(frame.number).background,
            });
            while self.past.len() > HISTORY as usize + 1 {
                self.past.pop_front();
            }
        }
    }

    fn candidates_by<P: PickLight>(
        &self,
        picker: &P,
        point: &ShadingPoint,
        number: Random64,
    ) -> Vec<SampledLight> {
        let none = SampledLight {
            light: 0,
            instance: 0,
            pmf: 0.0,
        };
        let mut picked = vec![none; self.options.candidates as usize];
        picker.pick_spaced(point, number, 0, self.options.candidates, &mut picked);
        picked
    }

    fn picked(&self, point: &ShadingPoint, number: Random64) -> Vec<SampledLight> {
        match self.options.source.needs_bvh() {
            true => self.candidates_by(&self.tree.bvh().tree(), point, number),
            false => self.candidates_by(
                &Power {
                    thresholds: &self.thresholds,
                },
                point,
                number,
            ),
        }
    }
}

/// The power table of a frame.
fn thresholds(frame: &Frame<'_>) -> Result<Vec<u32>, HostError> {
    power_thresholds(frame.lights.triangles()).map_err(|_| HostError::Sampler {
        scene: frame.scene.name().to_owned(),
        sampler: Sampler::Power.name(),
        lights: frame.lights.triangles().len(),
    })
}

impl Past {
    /// The next frame of `history`.
    fn render(
        &mut self,
        history: &mut Restir,
        params: &RenderParams,
        seed: u32,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let frame = RestirFrame {
            scene: &self.arrays,
            width: params.width,
            height: params.height,
            seed: seed.wrapping_add(self.number),
            jitter: params.jitter,
            background: self.background,
            remap: None,
        };
        Ok(self.backend.restir(history, &frame)?)
    }
}

impl Subject for Reservoirs {
    fn config(&self) -> Config {
        self.config
    }

    fn bytes(&self) -> usize {
        match self.options.source.needs_bvh() {
            true => self.tree.bytes(),
            false => size_of_val(&self.thresholds[..]),
        }
    }

    fn build(&self, frame: &Frame<'_>) -> Result<Duration, HostError> {
        match self.options.source.needs_bvh() {
            true => self.tree.build(frame),
            false => Ok(Timed::of(|| black_box(thresholds(frame)).is_ok()).time),
        }
    }

    fn advance(&mut self, frame: &Frame<'_>) -> Result<Spent, HostError> {
        let spent = if self.options.source.needs_bvh() {
            self.tree.advance(frame)?
        } else {
            let made = Timed::of(|| thresholds(frame));
            self.thresholds = made.value?;
            Spent {
                refit: None,
                rebuild: Some(made.time),
                beside: None,
            }
        };
        self.keep(frame);
        Ok(spent)
    }

    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration {
        let sampled = Timed::of(|| {
            for (point, number) in points.iter().zip(first..) {
                black_box(self.picked(point, Random64::from(hash(number))));
            }
        });
        sampled.time
    }

    fn candidates(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>) {
        found.clear();
        let picked = self.picked(point, number);
        found.extend(picked.into_iter().map(|sampled| (sampled.light, sampled.pmf)));
    }

    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        match self.options.source.needs_bvh() {
            true => self.tree.pmf(lights, point, light),
            false => {
                let thresholds = &self.thresholds;
                Power { thresholds }.pmf(point, light, 0)
            }
        }
    }

    fn least_rays(&self) -> u32 {
        self.options.most_shadow_rays()
    }

    /// Of the frame last advanced to, whose arrays came with it.
    fn render(
        &mut self,
        _arrays: &SceneArrays,
        params: RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let pixels = params.width as usize * params.height as usize;
        let mut image = Timed {
            value: vec![[0.0; 3]; pixels],
            time: Duration::ZERO,
        };
        let run = params.seed % RUNS;
        let count = (params.samples / self.least_rays()).max(1);
        for number in 0..count {
            let seed = |seed: u32| hash(hash(seed).wrapping_add(number));
            let Some((last, before)) = self.past.make_contiguous().split_last_mut() else {
                continue;
            };
            if !self.histories.contains_key(&(run, number)) {
                let mut history = Restir::new(self.options);
                for past in before {
                    past.render(&mut history, &params, seed(run))?;
                }
                self.histories.insert((run, number), history);
            }
            let mut history = self.histories[&(run, number)].clone();
            let part = last.render(&mut history, &params, seed(params.seed))?;
            image.time += part.time;
            for (sum, part) in image.value.iter_mut().flatten().zip(part.value.iter().flatten()) {
                *sum += part / count as f32;
            }
        }
        Ok(image)
    }
}
