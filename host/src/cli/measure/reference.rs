//! The image that others are measured against, and how far it is from the truth.

use crate::error::HostError;
use crate::metrics::{Judge, mean_squared_error};
use crate::render::Film;

/// An image of many samples.
pub(in crate::cli) struct Reference {
    pub judge: Judge,
    /// The squared error that its own noise adds to the squared error of every image that is measured against it, of displayed bytes: the variance
    /// of the mean of two halves is a quarter of their mean squared difference.
    pub noise: f64,
    /// The same of radiance.
    pub linear_noise: f64,
}

impl Reference {
    /// The mean of two halves of `size` with random numbers of their own, displayed at `exposure`, or at one chosen for it.
    pub fn new(
        (width, height): (u32, u32),
        halves: [Vec<[f32; 3]>; 2],
        exposure: Option<f32>,
    ) -> Result<Self, HostError> {
        let pairs = halves[0].iter().zip(&halves[1]);
        let mean = pairs.map(|(a, b)| std::array::from_fn(|k| (a[k] + b[k]) * 0.5));
        let whole = Film::new(width, height, mean.collect())?;
        let exposure = exposure.unwrap_or_else(|| whole.auto_exposure());
        let linear_noise = mean_squared_error(&halves[0], &halves[1]) / 4.0;
        let mut shown = Vec::new();
        for half in halves {
            shown.push(Film::new(width, height, half)?.shown(exposure));
        }
        let [a, b] = [0, 1].map(|half: usize| shown[half].as_chunks::<3>().0);
        Ok(Self {
            judge: Judge::new(whole, exposure)?,
            noise: mean_squared_error(a, b) / 4.0,
            linear_noise,
        })
    }
}
