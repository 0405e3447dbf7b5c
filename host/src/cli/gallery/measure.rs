//! The images of every method over one scene, in turns, and what they took.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::fit::{Trial, samples_in};
use super::job::Job;
use super::plan::{Equal, MAX_SAMPLES};
use super::reference::Reference;
use super::subject::Subject;
use crate::backend::{Sampler, Timed};
use crate::cli::times::ms;
use crate::error::HostError;
use crate::method::{Method, MethodLight, Runner, SequenceId, UpdateTimes};
use crate::metrics::Quality;
use crate::render::Film;
use crate::workload::RenderSettings;

/// Seed of images that are rendered for their time.
const TRIAL_SEED: u32 = (1 << 31) - 1;
/// All images are of one sequence.
const SEQUENCE: SequenceId = 0;
/// Most histories of ReSTIR: each takes about 80 bytes per pixel.
const MAX_HISTORIES: u32 = 64;
/// Samples of the first trials: one image for what is made once, then two of each.
const TRIED: [u32; 5] = [1, 1, 4, 1, 4];

/// One image.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Image {
    pub seed: u32,
    /// Time of the image.
    pub ms: f64,
    /// What the frame stood still for beside it: refits, and rebuilds that do not run beside it. Of a scene that stands still too.
    pub update_ms: f64,
    #[serde(flatten)]
    pub quality: Quality,
}

/// How many samples a method has, and why.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Chosen {
    /// Shadow rays per pixel at most, as in `compare`.
    pub samples: u32,
    /// In units of the method's least samples; empty where samples are equal.
    pub trials: Vec<Trial>,
}

/// What came out for one method.
pub(super) struct Shown {
    pub method: Method,
    pub chosen: Chosen,
    pub images: Vec<Image>,
    /// The first image.
    pub film: Film,
}

/// A method that the scene refuses.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Skipped {
    pub method: Method,
    pub why: String,
}

/// All methods over a scene.
#[derive(Default)]
pub(super) struct Results {
    pub shown: Vec<Shown>,
    pub skipped: Vec<Skipped>,
    /// Images and choices of samples that this run computed, and those that it found.
    pub computed: u64,
    pub reused: u64,
}

/// A method at work.
struct Lane<'d, L: MethodLight> {
    method: Method,
    /// Shadow rays of its least image.
    unit: u32,
    /// At the frame that counts; of methods that look at no earlier images.
    runner: Option<(Box<dyn Runner<L> + 'd>, UpdateTimes)>,
    chosen: Chosen,
    images: BTreeMap<u32, Image>,
    film: Option<Film>,
}

/// Measures every method that the scene takes.
pub(super) fn measure<L: MethodLight>(
    job: &Job<'_>,
    subject: &Subject<'_, L>,
    reference: &Reference,
) -> Result<Results, HostError> {
    let mut results = Results::default();
    let mut lanes = Vec::new();
    for &method in &job.plan.methods {
        match Lane::begin(job, subject, method, &mut results) {
            Ok(lane) => lanes.push(lane),
            Err(error @ (HostError::Usage { .. } | HostError::Sampler { .. })) => {
                results.skipped.push(Skipped {
                    method,
                    why: error.to_string(),
                });
                job.progress.inc(1 + u64::from(job.plan.seeds));
            }
            Err(error) => return Err(error),
        }
    }
    // In turns, so that what else the machine does meets all alike.
    for seed in 0..job.plan.seeds {
        for k in 0..lanes.len() {
            let at = (k + seed as usize) % lanes.len();
            lanes[at].image(job, subject, reference, seed, &mut results)?;
        }
    }
    for lane in lanes {
        let Some(film) = lane.film else { continue };
        results.shown.push(Shown {
            method: lane.method,
            chosen: lane.chosen,
            images: lane.images.into_values().collect(),
            film,
        });
    }
    Ok(results)
}

impl<'d, L: MethodLight> Lane<'d, L> {
    /// Chooses the samples of a method.
    fn begin(
        job: &Job<'d>,
        subject: &Subject<'_, L>,
        method: Method,
        results: &mut Results,
    ) -> Result<Self, HostError> {
        let restir = method.recipe().restir();
        let mut lane = Self {
            method,
            unit: restir.map_or(1, |options| options.most_shadow_rays()),
            runner: None,
            chosen: Chosen {
                samples: 1,
                trials: Vec::new(),
            },
            images: BTreeMap::new(),
            film: None,
        };
        // A scene that refuses the method does so here, or where it has no table of power.
        drop(method.recipe().runner(&subject.step(subject.first), job.target)?);
        match job.plan.equal {
            Equal::Samples(samples) => {
                lane.chosen.samples = (samples / lane.unit).max(1) * lane.unit;
                if method.recipe().lights == Sampler::Power {
                    lane.render(job, subject, 1, TRIAL_SEED)?;
                }
            }
            Equal::Time(budget) => lane.choose(job, subject, budget, results)?,
        }
        job.progress.inc(1);
        Ok(lane)
    }

    fn choose(
        &mut self,
        job: &Job<'d>,
        subject: &Subject<'_, L>,
        budget: f64,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let (name, key) = self.entry(job, "samples", Value::Null);
        if let Some(chosen) = job.store.load(&name, &key) {
            self.chosen = chosen;
            results.reused += 1;
            return Ok(());
        }
        job.says(&format!("{}, how many samples fit", self.method.name()));
        let most = match self.method.recipe().restir() {
            Some(_) => MAX_HISTORIES,
            None => MAX_SAMPLES,
        };
        let mut trials: Vec<Trial> = Vec::new();
        for (k, &samples) in TRIED.iter().enumerate() {
            let ms = ms(self.render(job, subject, samples, TRIAL_SEED)?.time);
            // The first image finds nothing in caches.
            if k > 0 {
                trials.push(Trial { samples, ms });
            }
            if ms > budget && k > 0 {
                break;
            }
        }
        // Once more where the line leads, as it may bend.
        let led = samples_in(budget, &trials, most);
        if trials.iter().all(|trial| trial.samples < led) {
            for _ in 0..2 {
                let ms = ms(self.render(job, subject, led, TRIAL_SEED)?.time);
                trials.push(Trial { samples: led, ms });
            }
        }
        self.chosen = Chosen {
            samples: samples_in(budget, &trials, most) * self.unit,
            trials,
        };
        job.store.save(&name, &key, &self.chosen)?;
        results.computed += 1;
        Ok(())
    }

    /// The image of a seed, rendered and measured unless it is known.
    fn image(
        &mut self,
        job: &Job<'d>,
        subject: &Subject<'_, L>,
        reference: &Reference,
        seed: u32,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let (name, mut key) = self.entry(job, &format!("s{seed:02}"), self.chosen.samples.into());
        key["seed"] = seed.into();
        key["reference_samples"] = job.plan.reference_samples.into();
        let size = (job.plan.width, job.plan.height);
        let known: Option<Image> = job.store.load(&name, &key);
        let film = match seed {
            0 => job.store.load_image(&name, &key, size),
            _ => None,
        };
        job.progress.inc(1);
        if let (Some(image), true) = (known, seed > 0 || film.is_some()) {
            self.images.insert(seed, image);
            self.film = self.film.take().or(film);
            results.reused += 1;
            return Ok(());
        }
        job.says(&format!("{}, image {}", self.method.name(), seed + 1));
        let rendered = self.render(job, subject, self.chosen.samples / self.unit, seed)?;
        let film = Film::new(size.0, size.1, rendered.value.pixels)?;
        let update = rendered.value.update;
        let image = Image {
            seed,
            ms: ms(rendered.time),
            update_ms: ms(update.refit) + ms(update.wait),
            quality: reference.judge.quality(&film)?,
        };
        if seed == 0 {
            // The picture first: a result whose picture is missing is computed again.
            job.store.save_image(&name, &key, &film)?;
            self.film = Some(film);
        }
        job.store.save(&name, &key, &image)?;
        self.images.insert(seed, image);
        results.computed += 1;
        Ok(())
    }

    /// Renders the frame that counts by `units` of the method's least samples.
    fn render(
        &mut self,
        job: &Job<'d>,
        subject: &Subject<'_, L>,
        units: u32,
        seed: u32,
    ) -> Result<Timed<Rendered>, HostError> {
        let samples = units * self.unit;
        let settings = |frame| RenderSettings {
            samples,
            ..job.settings(frame, seed)
        };
        let mut kept = match self.runner.take() {
            Some(kept) => kept,
            None => {
                let recipe = self.method.recipe();
                let mut runner = recipe.runner(&subject.step(subject.first), job.target)?;
                let mut update = UpdateTimes::default();
                for frame in subject.first..subject.frame {
                    if runner.history() > 0 {
                        runner.image(
                            &subject.step(frame),
                            subject.arrays(frame),
                            &settings(frame),
                            SEQUENCE,
                        )?;
                    }
                    update = runner.advance(&subject.step(frame + 1))?;
                }
                (runner, update)
            }
        };
        let (runner, update) = &mut kept;
        let step = subject.step(subject.frame);
        let image = runner.image(
            &step,
            subject.arrays(subject.frame),
            &settings(subject.frame),
            SEQUENCE,
        )?;
        let rendered = Timed {
            value: Rendered {
                pixels: image.value,
                update: *update,
            },
            time: image.time,
        };
        // What looks at earlier images begins anew.
        if runner.history() == 0 {
            self.runner = Some(kept);
        }
        Ok(rendered)
    }

    fn entry(&self, job: &Job<'_>, rest: &str, samples: Value) -> (String, Value) {
        let mut key = job.key();
        let backend = job.target.name();
        key["method"] = self.method.name().into();
        key["backend"] = backend.into();
        key["threads"] = rayon::current_num_threads().into();
        match (samples, job.plan.equal) {
            (Value::Null, Equal::Time(ms)) => key["time_ms"] = ms.into(),
            (samples, _) => key["samples"] = samples,
        }
        (job.name(&format!("{}-{rest}", self.method.name())), key)
    }
}

/// An image and the update before it.
struct Rendered {
    pixels: Vec<[f32; 3]>,
    update: UpdateTimes,
}
