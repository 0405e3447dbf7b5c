//! Pictures that glow: their means over triangles.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use image::RgbaImage;

use super::paint::{IN_PLACE, Wrap};
use super::srgb::linear_from_srgb;

/// Texels looked at for the triangles of one primitive, about: 2^24.
const MAX_LOOKUPS: u32 = 1 << 24;
/// Finest subdivision of one triangle for the mean of a texture.
const MAX_STEPS: f64 = 2048.0;
/// Texels along an edge from which on places are as many as texels, and not four times as many.
const LONG: f32 = 256.0;

/// Of each glowing picture of a scene, by its number: where it is not black.
pub(super) type Glows = Rc<RefCell<HashMap<usize, Rc<Sums>>>>;

/// A picture of colours with its wrapping, in linear RGB, and where it lies on a surface.
#[derive(Debug)]
pub(super) struct Glow {
    picture: usize,
    pixels: Rc<RgbaImage>,
    wrap: [Wrap; 2],
    is_nearest: bool,
    /// As [`Texture::transform`](super::paint::Texture::transform).
    transform: [[f32; 2]; 3],
    to_linear: [f32; 256],
    sums: Glows,
}

impl Glow {
    /// One of the pictures of a scene, with its number.
    pub fn new(
        (picture, pixels): (usize, Rc<RgbaImage>),
        wrap: [Wrap; 2],
        is_nearest: bool,
        transform: [[f32; 2]; 3],
        glows: &Glows,
    ) -> Self {
        Self {
            picture,
            pixels,
            wrap,
            is_nearest,
            transform,
            to_linear: std::array::from_fn(|encoded| linear_from_srgb(encoded as u8)),
            sums: Rc::clone(glows),
        }
    }

    /// `factor` times the mean over each triangle, whose vertices have these coordinates.
    pub fn radiance(
        &self,
        triangles: &[[u32; 3]],
        coordinates: &[[f32; 2]],
        factor: [f32; 3],
    ) -> Vec<[f32; 3]> {
        let each = f64::from(MAX_LOOKUPS) / triangles.len().max(1) as f64;
        let steps = each.sqrt().min(MAX_STEPS) as u32;
        let own = |triangle: &[u32; 3]| {
            let mean = self.mean_over(triangle.map(|vertex| coordinates[vertex as usize]), steps);
            [0, 1, 2].map(|k| mean[k] * factor[k])
        };
        triangles.iter().map(own).collect()
    }

    /// Mean over the triangle with these texture coordinates.
    fn mean_over(&self, corners: [[f32; 2]; 3], max_steps: u32) -> [f32; 3] {
        let [x, y, origin] = self.transform;
        let moved = match self.transform == IN_PLACE {
            true => corners,
            false => corners.map(|[u, v]| [0, 1].map(|k| x[k] * u + y[k] * v + origin[k])),
        };
        self.mean_over_placed(moved, max_steps)
    }

    /// The triangle is cut into n² equal ones and what shows at the centre of each is taken; n is four times the number
    /// of texels along the longest edge, from 256 texels on that number itself, up to `max_steps`.
    fn mean_over_placed(&self, [a, b, c]: [[f32; 2]; 3], max_steps: u32) -> [f32; 3] {
        let size = [self.pixels.width() as f32, self.pixels.height() as f32];
        let edge = |from: [f32; 2], to: [f32; 2]| {
            ((to[0] - from[0]) * size[0])
                .abs()
                .max(((to[1] - from[1]) * size[1]).abs())
        };
        // The cast saturates, and NaN becomes 0: any coordinates give a number of steps in range.
        let longest = edge(a, b).max(edge(b, c)).max(edge(c, a));
        let steps = (4.0 * longest).min(longest.max(LONG)).ceil() as u32;
        let steps = steps.max(MIN_STEPS).clamp(1, max_steps.max(1));
        let mut sum = [0.0_f64; 3];
        let mut take = |i: u32, j: u32, third: f32| {
            let (v, w) = (
                (i as f32 + third) / steps as f32,
                (j as f32 + third) / steps as f32,
            );
            let texel =
                self.shown([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * v + (c[axis] - a[axis]) * w));
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += f64::from(channel);
            }
        };
        for i in 0..steps {
            for j in 0..steps - i {
                take(i, j, 1.0 / 3.0);
                // Between two upright triangles of a row lies an inverted one.
                if i + j + 1 < steps {
                    take(i, j, 2.0 / 3.0);
                }
            }
        }
        let mean = sum.map(|channel| (channel / (f64::from(steps) * f64::from(steps))) as f32);
        self.with_traces([a, b, c], mean)
    }

    /// A mean, and where a channel of it is zero while any texel at the triangle is not black, a trace: what glows anywhere is
    /// a light.
    fn with_traces(&self, corners: [[f32; 2]; 3], mean: [f32; 3]) -> [f32; 3] {
        if mean.iter().all(|&channel| channel > 0.0) || !self.glows_within(corners) {
            return mean;
        }
        mean.map(|channel| if channel > 0.0 { channel } else { TRACE })
    }

    /// Whether any texel that shows on the triangle or beside it may be other than black.
    fn glows_within(&self, corners: [[f32; 2]; 3]) -> bool {
        let sums = {
            let mut known = self.sums.borrow_mut();
            let own = known.entry(self.picture);
            Rc::clone(own.or_insert_with(|| Rc::new(Sums::of(&self.pixels))))
        };
        let size = [self.pixels.width(), self.pixels.height()];
        // Half a texel more where means of four are shown; all of them where it goes beyond the picture.
        let beyond = if self.is_nearest { 0.0 } else { 0.5 };
        let range = |axis: usize| {
            let along = corners.map(|corner| f64::from(corner[axis]) * f64::from(size[axis]));
            let low = along.iter().fold(f64::MAX, |a, &b| a.min(b)) - beyond;
            let high = along.iter().fold(f64::MIN, |a, &b| a.max(b)) + beyond;
            let (low, high) = (low.floor(), high.ceil());
            match low >= 0.0 && high <= f64::from(size[axis]) {
                true => (low as u32, high as u32),
                false => (0, size[axis]),
            }
        };
        sums.count(range(0), range(1)) > 0
    }

    /// What the renderer shows there: the nearest texel, or a mean of four.
    fn shown(&self, uv: [f32; 2]) -> [f32; 3] {
        if self.is_nearest {
            return self.texel(uv);
        }
        let size = [self.pixels.width() as f32, self.pixels.height() as f32];
        let at = [0, 1].map(|axis| uv[axis] * size[axis] - 0.5);
        let first = at.map(f32::floor);
        let part = [0, 1].map(|axis| at[axis] - first[axis]);
        let mut shown = [0.0; 3];
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weight = |second: u8, part: f32| if second == 0 { 1.0 - part } else { part };
            let weight = weight(x, part[0]) * weight(y, part[1]);
            let center = [
                (first[0] + f32::from(x) + 0.5) / size[0],
                (first[1] + f32::from(y) + 0.5) / size[1],
            ];
            for (shown, channel) in shown.iter_mut().zip(self.texel(center)) {
                *shown += weight * channel;
            }
        }
        shown
    }

    fn texel(&self, uv: [f32; 2]) -> [f32; 3] {
        let x = wrapped(uv[0], self.pixels.width(), self.wrap[0]);
        let y = wrapped(uv[1], self.pixels.height(), self.wrap[1]);
        self.pixels.get_pixel_checked(x, y).map_or([0.0; 3], |pixel| {
            let [r, g, b, _] = pixel.0;
            [r, g, b].map(|channel| self.to_linear[usize::from(channel)])
        })
    }
}

/// Least subdivision of a triangle: within a texel what shows is not even.
const MIN_STEPS: u32 = 16;

/// What a channel of a mean counts as at least where something glows: half of the least that a texel can be.
const TRACE: f32 = 0.5 / (255.0 * 12.92);

/// How many texels are not black, from the upper left to each (F. Crow, "Summed-area tables for texture mapping", 1984).
#[derive(Debug)]
pub(super) struct Sums {
    columns: usize,
    sums: Vec<u32>,
}

impl Sums {
    fn of(pixels: &RgbaImage) -> Self {
        let columns = pixels.width() as usize + 1;
        let mut sums = vec![0; columns * (pixels.height() as usize + 1)];
        for (y, row) in pixels.rows().enumerate() {
            let mut sum = 0;
            for (x, pixel) in row.enumerate() {
                let [r, g, b, _] = pixel.0;
                sum += u32::from(r | g | b != 0);
                sums[(y + 1) * columns + x + 1] = sums[y * columns + x + 1] + sum;
            }
        }
        Self { columns, sums }
    }

    /// Among columns and rows from one to before another.
    fn count(&self, (left, right): (u32, u32), (top, bottom): (u32, u32)) -> u32 {
        let upto = |x: u32, y: u32| self.sums[y as usize * self.columns + x as usize];
        upto(right, bottom) + upto(left, top) - upto(left, bottom) - upto(right, top)
    }
}

/// The texel of a coordinate along one axis.
fn wrapped(coordinate: f32, size: u32, mode: Wrap) -> u32 {
    let inside = match mode {
        Wrap::Clamp => coordinate,
        Wrap::Repeat => coordinate - coordinate.floor(),
        Wrap::Mirror => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
    };
    // The cast saturates at zero.
    ((inside * size as f32) as u32).min(size.saturating_sub(1))
}
