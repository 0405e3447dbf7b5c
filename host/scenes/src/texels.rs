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
    /// Texels each way, a power of two.
    pub size: u32,
    /// Light times solid angle, by channel, and the solid angle of all places in a texel.
    sums: Vec<[f64; 4]>,
}

impl Texels {
    /// Of a picture by longitude and latitude, about as many texels as pixels, or more: its first row lies about +y, its columns
    /// go from +z to −x.
    pub fn of([width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> [f64; 3]) -> Self {
        let side = (f64::from(width) * f64::from(height)).sqrt().ceil() as u32;
        let least = if side > 1 { LEAST } else { 1 };
        let size = side.max(least).next_power_of_two().min(1 << MAX_LEVELS);
        let mut texels = Self {
            size,
            sums: vec![[0.0; 4]; size as usize * size as usize],
        };
        // Angle between places, radians: the least width of a texel is about 2 / size.
        let step = 2.0 / (f64::from(size) * PLACES);
        let rows = (PI / f64::from(height) / step).ceil() as u32;
        let mut turns: Vec<[f64; 2]> = Vec::new();
        let cosine = |y: u32, part: u32| {
            let down = (f64::from(y) + f64::from(part) / f64::from(rows)) / f64::from(height);
            libm::cos(PI * down)
        };
        for (y, part) in (0..height).flat_map(|y| (0..rows).map(move |part| (y, part))) {
            let (above, below) = (cosine(y, part), cosine(y, part + 1));
            let up = 0.5 * (above + below);
            let across = (1.0 - up * up).max(0.0).sqrt();
            let columns = (across * TAU / f64::from(width) / step).ceil().max(1.0) as u32;
            let all = width as usize * columns as usize;
            if turns.len() != all {
                let turn = |k: usize| libm::sincos(TAU * ((k as f64 + 0.5) / all as f64));
                turns = (0..all).map(turn).map(|(sine, cosine)| [cosine, sine]).collect();
            }
            let angle = (above - below) * TAU / all as f64;
            for (x, places) in (0..width).zip(turns.chunks_exact(columns as usize)) {
                let [r, g, b] = pixel(x, y);
                for [cosine, sine] in places {
                    let index = texels.index([-across * sine, up, across * cosine]);
                    let own = &mut texels.sums[index];
                    let light = [angle * r, angle * g, angle * b, angle];
                    *own = [0, 1, 2, 3].map(|k| own[k] + light[k]);
                }
            }
        }
        texels
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

    /// Radiance by direction: the mean of its texel, in which some place lies.
    pub fn radiance(&self, direction: [f64; 3]) -> [f64; 3] {
        let [r, g, b, angle] = self.sums[self.index(direction)];
        [r, g, b].map(|sum| sum / angle.max(f64::MIN_POSITIVE))
    }
}

#[cfg(test)]
mod tests {
    use lightbvh::light::infinite::direction_at;

    use super::*;

    /// Mean over all directions of what `weight` makes of each and its radiance.
    fn mean(texels: &Texels, weight: impl Fn([f64; 3]) -> f64) -> f64 {
        let size = 2 * texels.size;
        let (mut sum, mut all) = (0.0, 0.0);
        for (column, row) in (0..size).flat_map(|row| (0..size).map(move |column| (column, row))) {
            let at = |x: u32| ((f64::from(x) + 0.5) * 2.0 / f64::from(size) - 1.0) as f32;
            let direction = direction_at([at(column), at(row)]).map(f64::from);
            let angle = direction.iter().map(|x| x.abs()).sum::<f64>().powi(3);
            sum += angle * weight(direction) * texels.radiance(direction)[0];
            all += angle;
        }
        sum / all
    }

    /// What of a picture's single pixel is in the texels, over what it has.
    fn kept([width, height]: [u32; 2], at: [u32; 2]) -> f64 {
        let texels = Texels::of([width, height], |x, y| [f64::from(u8::from([x, y] == at)); 3]);
        let cosine = |y: u32| libm::cos(PI * f64::from(y) / f64::from(height));
        let share = (cosine(at[1]) - cosine(at[1] + 1)) / 2.0 / f64::from(width);
        mean(&texels, |_| 1.0) / share
    }

    /// Asked at places of its own a map has none of a small one, or many times as much. Texels hold more places or fewer than
    /// their share of the sphere, so it is not all.
    #[test]
    fn a_single_pixel_keeps_its_light_wherever_it_lies() {
        for size @ [width, height] in [
            [3, 3],
            [64, 32],
            [200, 100],
            [513, 257],
            [16, 400],
            [700, 1],
            [1, 900],
        ] {
            for at in [
                [0, 0],
                [width - 1, 0],
                [width / 2, height / 2],
                [width / 3, height / 5],
                [width / 7, height - 1],
            ] {
                let ratio = kept(size, at);
                assert!((ratio - 1.0).abs() < 0.2, "{size:?} {at:?}: {ratio}");
            }
        }
        // Nearly all within a twenty-fifth: as many at random.
        let random = |k: u32, count: u32| lightbvh::exact::hash(k) % count;
        let all = (0..60).map(|k| kept([200, 100], [random(2 * k, 200), random(2 * k + 1, 100)]));
        let beyond = all.filter(|ratio| (ratio - 1.0).abs() > 0.04).count();
        assert!(beyond <= 2, "{beyond} of 60");
    }

    #[test]
    fn a_horizon_is_where_it_is() {
        for size in [[1, 2], [4, 2], [8, 4], [16, 8], [1, 64], [256, 2]] {
            let texels = Texels::of(size, |_, y| [f64::from(u8::from(2 * y < size[1])); 3]);
            let up = 4.0 * mean(&texels, |[_, y, _]| y.max(0.0));
            let down = 4.0 * mean(&texels, |[_, y, _]| (-y).max(0.0));
            assert!((up - 1.0).abs() < 1e-3 && down < 1e-3, "{size:?}: {up} {down}");
        }
    }
}
