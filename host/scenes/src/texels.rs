//! Texels of an environment map by the pixels of a picture: each pixel's light goes to the texels that it lies in.
//!
//! A map that is asked at places of its own misses pixels that are smaller than a texel, as those beside the poles are, or
//! finds them too often. Here each pixel is cut into places, four or more to a texel each way, and each place counts by its
//! solid angle.

use std::f64::consts::{PI, TAU};

use lightbvh::light::infinite::{MAX_LEVELS, place_of};

/// Places of a texel, each way, at least.
const PLACES: f64 = 4.0;
/// Texels each way of a map by a picture of more than a pixel, at least: large pixels have edges.
const LEAST: u32 = 256;

/// Sums over the texels of an environment map, row by row.
pub(super) struct Texels {
    size: u32,
    /// Light times solid angle, by channel, and the solid angle of all places in a texel.
    sums: Vec<[f64; 4]>,
}

/// Texels each way for a picture: about as many texels as pixels, or more.
pub(super) fn size_for([width, height]: [u32; 2]) -> u32 {
    let side = (f64::from(width) * f64::from(height)).sqrt().ceil() as u32;
    let least = if width * height > 1 { LEAST } else { 1 };
    side.max(least).next_power_of_two().min(1 << MAX_LEVELS)
}

impl Texels {
    /// Black ones; `size` is a power of two.
    pub fn new(size: u32) -> Self {
        Self {
            size,
            sums: vec![[0.0; 4]; size as usize * size as usize],
        }
    }

    /// Angle between places, radians: the least width of a texel is about 2 / size.
    fn step(&self) -> f64 {
        2.0 / (f64::from(self.size) * PLACES)
    }

    /// Of a direction of any length.
    fn index(&self, direction: [f64; 3]) -> usize {
        let place = place_of(direction.map(|x| x as f32));
        let [column, row] = place.map(|x| {
            let at = (f64::from(x) + 1.0) * 0.5 * f64::from(self.size);
            (at as u32).min(self.size - 1)
        });
        row as usize * self.size as usize + column as usize
    }

    fn add(&mut self, direction: [f64; 3], angle: f64, [r, g, b]: [f64; 3]) {
        let index = self.index(direction);
        let own = &mut self.sums[index];
        *own = [
            own[0] + angle * r,
            own[1] + angle * g,
            own[2] + angle * b,
            own[3] + angle,
        ];
    }

    /// Adds a picture by longitude and latitude. `direction` leads to the map from a direction of the picture: its first row
    /// lies about +z, its columns go counter-clockwise from +x.
    pub fn add_longitude_latitude(
        &mut self,
        [width, height]: [u32; 2],
        pixel: impl Fn(u32, u32) -> [f64; 3],
        direction: impl Fn([f64; 3]) -> [f64; 3],
    ) {
        let rows = (PI / f64::from(height) / self.step()).ceil() as u32;
        let mut turns: Vec<[f64; 2]> = Vec::new();
        let cosine = |y: u32, part: u32| {
            let down = (f64::from(y) + f64::from(part) / f64::from(rows)) / f64::from(height);
            libm::cos(PI * down)
        };
        for (y, part) in (0..height).flat_map(|y| (0..rows).map(move |part| (y, part))) {
            let (above, below) = (cosine(y, part), cosine(y, part + 1));
            let z = 0.5 * (above + below);
            let across = (1.0 - z * z).max(0.0).sqrt();
            let columns = (across * TAU / f64::from(width) / self.step()).ceil().max(1.0) as u32;
            let all = width as usize * columns as usize;
            if turns.len() != all {
                let part = |k: usize| (k as f64 + 0.5) / all as f64;
                turns = (0..all)
                    .map(|k| {
                        let (sine, cosine) = libm::sincos(TAU * part(k));
                        [cosine, sine]
                    })
                    .collect();
            }
            let angle = (above - below) * TAU / all as f64;
            for (x, places) in (0..width).zip(turns.chunks_exact(columns as usize)) {
                let color = pixel(x, y);
                for [cosine, sine] in places {
                    self.add(direction([across * cosine, across * sine, z]), angle, color);
                }
            }
        }
    }

    /// Radiance by direction: the mean of its texel, or what `other` says where no place lies in it.
    pub fn radiance(&self, direction: [f64; 3], other: impl Fn() -> [f64; 3]) -> [f64; 3] {
        match self.sums[self.index(direction)] {
            [r, g, b, angle] if angle > 0.0 => [r, g, b].map(|sum| sum / angle),
            _ => other(),
        }
    }
}

#[cfg(test)]
mod tests;
