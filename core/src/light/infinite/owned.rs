//! An environment map that owns its words.

use alloc::vec::Vec;

use super::counts::counts_of;
use super::environment::{EnvironmentMap, MAX_LEVELS, start_of};
use super::octahedron::direction_at;
use crate::domain::DomainError;
use crate::emission::luminance_of;
use crate::exact::{abs, max};
use crate::light::{MAX_RADIANCE, MIN_RADIANCE};

/// Places of a texel, in each direction, by whose mean it is known.
const PLACES: u32 = 4;

/// An environment map: radiance from all directions, and a quad tree that chooses among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    levels: u32,
    counts: Vec<u32>,
    radiance: Vec<[f32; 3]>,
}

impl Environment {
    /// One of `size` × `size` texels, a power of two from 1 to 2048, of the radiance (W/(m² sr), linear RGB) that `radiance`
    /// gives for unit directions, y up: asked at 16 places of each texel, whose mean it keeps. What is below [`MIN_RADIANCE`]
    /// counts as none. Probabilities go with luminance, and reach every texel that is not black.
    ///
    /// # Errors
    /// [`DomainError`]: the size, or the first radiance that is NaN, infinite, negative or above [`MAX_RADIANCE`].
    pub fn from_fn(size: u32, mut radiance: impl FnMut([f32; 3]) -> [f32; 3]) -> Result<Self, DomainError> {
        if !size.is_power_of_two() || size > 1 << MAX_LEVELS {
            let (what, expected) = (
                "the size of an environment",
                "a power of two up to 2048; take the next one",
            );
            return Err(DomainError::number(what, size as f32, expected));
        }
        let levels = size.trailing_zeros();
        let texels = 1_u32 << (2 * levels);
        let mut all = Vec::with_capacity(texels as usize);
        let mut weights = Vec::with_capacity(texels as usize);
        for texel in 0..texels {
            let [column, row] = [texel, texel >> 1].map(every_other_bit);
            let mut mean = [0.0_f64; 3];
            let mut angle = 0.0;
            for place in 0..PLACES * PLACES {
                let at = |first: u32, k: u32| {
                    let x = f64::from(first) + (f64::from(k) + 0.5) / f64::from(PLACES);
                    (x * 2.0 / f64::from(size) - 1.0) as f32
                };
                let direction = direction_at([at(column, place % PLACES), at(row, place / PLACES)]);
                let found = radiance(direction);
                if !found.iter().all(|value| (0.0..=MAX_RADIANCE).contains(value)) {
                    let expected = "0 or numbers up to 2^100 (1.3e30); repair the picture";
                    return Err(DomainError::vector(
                        "the radiance of an environment",
                        found,
                        expected,
                    ));
                }
                let share = solid_angle(direction);
                angle += share;
                for channel in 0..3 {
                    mean[channel] += share * f64::from(found[channel]);
                }
            }
            let own = mean.map(|sum| {
                let value = (sum / angle) as f32;
                if value < MIN_RADIANCE { 0.0 } else { value }
            });
            // A channel that luminance hardly sees is light all the same.
            let luminance = max(luminance_of(&own), own.iter().sum::<f32>() * 0.01);
            weights.push(f64::from(luminance) * angle);
            all.push(own);
        }
        Ok(Self {
            levels,
            counts: pyramid(levels, counts_of(&weights)),
            radiance: all,
        })
    }

    /// Its words.
    #[must_use]
    pub fn map(&self) -> EnvironmentMap<'_> {
        EnvironmentMap {
            levels: self.levels,
            counts: &self.counts,
            radiance: &self.radiance,
        }
    }

    /// Mean luminance over all directions, W/(m² sr): π times it is what a surface that sees half of it receives on average, for a
    /// [`Split`](super::Split).
    #[must_use]
    pub fn mean_luminance(&self) -> f32 {
        let size = 1_u32 << self.levels;
        let (mut sum, mut angles) = (0.0, 0.0);
        for (texel, radiance) in (0_u32..).zip(&self.radiance) {
            let [column, row] = [texel, texel >> 1].map(every_other_bit);
            let at = |first: u32| ((f64::from(first) + 0.5) * 2.0 / f64::from(size) - 1.0) as f32;
            let direction = direction_at([at(column), at(row)]);
            let angle = solid_angle(direction);
            sum += angle * f64::from(luminance_of(radiance));
            angles += angle;
        }
        (sum / angles) as f32
    }
}

/// Solid angle of a place of the map, but for a factor.
fn solid_angle(direction: [f32; 3]) -> f64 {
    let sum: f64 = direction.iter().map(|&x| f64::from(abs(x))).sum();
    sum * sum * sum
}

/// Bits 0, 2, 4 … as one number.
fn every_other_bit(x: u32) -> u32 {
    (0..16).fold(0, |found, k| found | (((x >> (2 * k)) & 1) << k))
}

/// The sums of all levels, from the root on.
fn pyramid(levels: u32, texels: Vec<u32>) -> Vec<u32> {
    let mut all = alloc::vec![0; start_of(levels) as usize + texels.len()];
    all[start_of(levels) as usize..].copy_from_slice(&texels);
    for level in (0..levels).rev() {
        let (own, below) = (start_of(level) as usize, start_of(level + 1) as usize);
        for node in 0..1_usize << (2 * level) {
            let children = &all[below + 4 * node..below + 4 * node + 4];
            all[own + node] = children.iter().sum();
        }
    }
    all
}
