//! The error of the real renderer's images, at equal samples and at equal time.

#[cfg(test)]
mod tests;

use lightbvh_kernels::render::RenderParams;
use serde::Serialize;

use crate::backend::Timed;
use crate::cli::measure::times::ms;
use crate::cli::measure::{interval::Interval, reference::Reference};
use crate::error::HostError;
use crate::metrics::{Estimate, Judge, Quality, mean, mean_squared_error};
use crate::render::Film;
use crate::workload::render_params;

/// Seeds from here on belong to the reference.
const REFERENCE_SEED: u32 = 1 << 31;

/// Least images that count as fitting into a frame even where nothing does.
const LEAST_SAMPLES: f64 = 0.05;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub turns: u32,
    /// Times each point is sampled in a turn.
    pub passes: u32,
    pub points: u32,
    pub width: u32,
    pub height: u32,
    /// Shadow rays of a pixel where all have as many; the default's time by so many is the time that all have.
    pub samples: u32,
    /// Frames whose images are measured, evenly up to the last: a tree may be lucky in one of them.
    pub frames: u32,
    /// Images of each configuration in each of them, each with its own random numbers.
    pub seeds: u32,
    /// Shadow rays of a pixel of the reference.
    pub reference: u32,
}

impl Budget {
    pub const FULL: Self = Self {
        turns: 21,
        passes: 20,
        points: 200,
        width: 320,
        height: 180,
        samples: 12,
        frames: 3,
        seeds: 3,
        reference: 512,
    };
    pub const QUICK: Self = Self {
        turns: 5,
        passes: 10,
        points: 60,
        width: 96,
        height: 54,
        samples: 12,
        frames: 3,
        seeds: 2,
        reference: 320,
    };

    /// The numbers of the frames whose images are measured, up to `last`.
    pub fn measured_frames(&self, last: u32) -> Vec<u32> {
        let mut numbers: Vec<u32> = (1..=u64::from(self.frames))
            .map(|k| (u64::from(last) * k / u64::from(self.frames)) as u32)
            .collect();
        numbers.dedup();
        numbers
    }
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Images {
    /// Time of an image by the same shadow rays.
    pub image_ms: f64,
    /// Time of an image by the same shadow rays over the default's, seed by seed.
    pub time_ratio: Interval,
    /// The same of a frame: an update and an image.
    pub frame_ratio: Interval,
    /// Mean squared error of such images as displayed, in squared steps of a byte, without the reference's own.
    pub error: f64,
    /// The error over the default's, seed by seed.
    pub error_ratio: Interval,
    /// The error by as many shadow rays as fit into the default's frame next to the update: that of the nearest whole number, by
    /// its ratio to them.
    pub error_equal_time: f64,
    /// The same over the default's, seed by seed.
    pub equal_time_ratio: Interval,
    /// How many those are.
    pub samples_equal_time: f64,
    /// The mean of all pixels over the reference's, less 1: of images by equal rays, each a measurement.
    pub bias: Option<Estimate>,
    /// Every measure of images by equal rays, means over the seeds.
    pub quality: Quality,
    /// An image of the default's time, as nearly as whole rays allow, and its shadow rays of a pixel.
    #[serde(skip)]
    pub shown: (Film, u32),
    /// Time of an image by the same shadow rays, image by image, ms.
    #[serde(skip)]
    pub times: Vec<f64>,
    /// Errors by equal rays, image by image.
    #[serde(skip)]
    pub errors: Vec<f64>,
}

/// Images of all configurations, frame after frame.
#[derive(Default)]
pub(super) struct Measured {
    of_each: Vec<OfOne>,
    judge: Option<Judge>,
}

/// The measurements of one configuration, image by image over all frames.
#[derive(Default)]
struct OfOne {
    times: Vec<f64>,
    /// Time of a frame: an update and an image.
    frames: Vec<f64>,
    errors: Vec<f64>,
    biases: Vec<f64>,
    qualities: Vec<Quality>,
    equal_time: Vec<f64>,
    /// How many shadow rays fit, frame by frame.
    fits: Vec<f64>,
    shown: Option<(Film, u32)>,
}

impl Measured {
    /// Measures the images of a frame by configurations whose updates take `updates_ms`, the default first. `render` gets the
    /// number of one.
    pub fn add(
        &mut self,
        updates_ms: &[f64],
        background: [f32; 3],
        budget: &Budget,
        render: impl Fn(usize, RenderParams) -> Timed<Vec<[f32; 3]>>,
    ) -> Result<(), HostError> {
        let count = updates_ms.len();
        let size = (budget.width, budget.height);
        let image = |at, samples, seed| render(at, render_params(size, samples, seed, background));
        let half = |half| image(0, budget.reference / 2, REFERENCE_SEED + half).value;
        let reference = Reference::new(size, [half(0), half(1)], None)?;
        let reference_mean = mean_of(reference.judge.reference().pixels());
        self.of_each.resize_with(count, OfOne::default);
        let begin = self.of_each[0].times.len();
        for seed in 0..budget.seeds {
            let mut least = vec![f64::INFINITY; count];
            // An interruption of one image does not interrupt the same one in the other turn.
            for k in 0..count {
                let at = (k + 3 * seed as usize) % count;
                least[at] = ms(image(at, budget.samples, seed).time);
            }
            for k in 0..count {
                let at = (k + seed as usize) % count;
                let image = image(at, budget.samples, seed);
                let (of, time) = (&mut self.of_each[at], least[at].min(ms(image.time)));
                of.times.push(time);
                of.frames.push(time + updates_ms[at]);
                of.biases.push(mean_of(&image.value) / reference_mean - 1.0);
                let film = Film::new(size.0, size.1, image.value)?;
                let quality = reference.judge.judge(&film)?.quality;
                of.errors.push(quality.mse - reference.noise);
                of.qualities.push(quality);
            }
        }
        let default = self.of_each[0].frames[begin..].to_vec();
        for (at, (of, &update)) in self.of_each.iter_mut().zip(updates_ms).enumerate() {
            let left: Vec<f64> = default.iter().map(|frame| frame - update).collect();
            let fits = (f64::from(budget.samples) * Interval::of_ratios(&left, &of.times[begin..]).median)
                .max(LEAST_SAMPLES);
            // Errors fall by the inverse of the rays.
            let rays = (fits.round() as u32).max(1);
            of.shown = None;
            for seed in budget.seeds..budget.seeds + budget.seeds.div_ceil(2) {
                let film = Film::new(size.0, size.1, image(at, rays, seed).value)?;
                let error = error_of(&reference, &film).max(1e-9);
                of.equal_time.push(error * f64::from(rays) / fits);
                of.shown.get_or_insert((film, rays));
            }
            of.fits.push(fits);
        }
        self.judge = Some(reference.judge);
        Ok(())
    }

    /// The results, one for each configuration, and the judge of the last frame.
    pub fn finish(self) -> (Vec<Images>, Judge) {
        let default = &self.of_each[0];
        let images = |of: &OfOne| Images {
            time_ratio: Interval::of_ratios(&of.times, &default.times),
            frame_ratio: Interval::of_ratios(&of.frames, &default.frames),
            image_ms: Interval::of(of.times.clone()).median,
            error: mean(&of.errors),
            error_ratio: Interval::of_ratios(&of.errors, &default.errors),
            error_equal_time: mean(&of.equal_time),
            equal_time_ratio: Interval::of_ratios(&of.equal_time, &default.equal_time),
            samples_equal_time: mean(&of.fits),
            bias: Estimate::of(&of.biases).filter(|bias| bias.mean.is_finite()),
            quality: mean_quality(&of.qualities),
            shown: of.shown.clone().expect("an image of each frame"),
            times: of.times.clone(),
            errors: of.errors.clone(),
        };
        let all = self.of_each.iter().map(images).collect();
        (all, self.judge.expect("a frame is measured"))
    }
}

fn mean_quality(of: &[Quality]) -> Quality {
    let mean = |measure: fn(&Quality) -> f64| mean(&of.iter().map(measure).collect::<Vec<f64>>());
    Quality {
        mse: mean(|q| q.mse),
        ssim: mean(|q| q.ssim),
        flip: mean(|q| q.flip),
        linear_mse: mean(|q| q.linear_mse),
        relative_mse: mean(|q| q.relative_mse),
    }
}

/// Mean squared, as displayed, in squared steps of a byte, without the reference's own.
fn error_of(reference: &Reference, image: &Film) -> f64 {
    let shown = image.shown(reference.judge.exposure());
    let bytes = [&shown, reference.judge.shown()].map(|bytes| bytes.as_chunks::<3>().0);
    mean_squared_error(bytes[0], bytes[1]) - reference.noise
}

/// Of all channels of all pixels.
fn mean_of(image: &[[f32; 3]]) -> f64 {
    let sum: f64 = image.iter().flatten().map(|&c| f64::from(c)).sum();
    sum / (3.0 * image.len() as f64)
}
