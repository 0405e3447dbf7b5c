//! Pictures that glow: their means over triangles.

use std::cell::RefCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

use super::error::SceneError;
use super::files::Load;
use super::shown::Shown;
use super::textures::{Picture, Texture};

/// Texels looked at for all triangles of a file, about.
const MAX_LOOKUPS: u32 = 1 << 26;
/// Least and most subdivisions of a triangle for the mean of a texture: within a texel it is not even.
const STEPS: (u32, f64) = (16, 2048.0);
/// Texels along an edge from which on places are as many as texels, and not four times as many.
const LONG: f32 = 256.0;

/// Least value of a channel of a mean where any texel glows: half of the least that a texel can be.
const TRACE: f32 = 0.5 / (255.0 * 12.92);

/// The glowing pictures of a file by number.
pub(super) type Glows = RefCell<HashMap<u32, Rc<Glowing>>>;

/// A picture that glows.
#[derive(Debug)]
pub(super) struct Glowing {
    shown: RefCell<Shown>,
    size: [u32; 2],
    /// How many texels above and to the left of each corner of a texel are not black (F. Crow, "Summed-area tables for texture
    /// mapping", 1984).
    sums: Vec<u32>,
}

/// A texture that glows.
#[derive(Debug)]
pub(super) struct Glow {
    texture: Texture,
    picture: Rc<Glowing>,
}

impl Glow {
    /// Of a texture of colours, and its picture.
    ///
    /// # Errors
    /// [`SceneError::Memory`].
    pub fn new(load: &Load, glows: &Glows, texture: Texture, picture: &Picture) -> Result<Self, SceneError> {
        let number = texture.picture;
        let picture = match glows.borrow_mut().entry(number) {
            Entry::Occupied(known) => Rc::clone(known.get()),
            Entry::Vacant(place) => {
                let bytes = 2 * picture.texels.len() as u64;
                load.take(&format!("picture {number}"), "the light of a picture", bytes)?;
                let size = [picture.width, picture.height];
                Rc::clone(place.insert(Rc::new(Glowing {
                    shown: RefCell::new(Shown::new(size, &picture.texels, &texture)),
                    size,
                    sums: sums(picture),
                })))
            }
        };
        Ok(Self { texture, picture })
    }

    /// `factor` times the mean over each triangle, whose vertices have these coordinates; `count` triangles of the file share the
    /// lookups.
    pub fn radiance(
        &self,
        triangles: &[[u32; 3]],
        coordinates: &[[f32; 2]],
        factor: [f32; 3],
        count: usize,
    ) -> Vec<[f32; 3]> {
        let shown = &mut self.picture.shown.borrow_mut();
        shown.set(&self.texture);
        let each = f64::from(MAX_LOOKUPS) / count.max(1) as f64;
        let most = each.sqrt().clamp(1.0, STEPS.1) as u32;
        let own = |triangle: &[u32; 3]| {
            let mean = self.mean_over(shown, triangle.map(|vertex| coordinates[vertex as usize]), most);
            [0, 1, 2].map(|k| mean[k] * factor[k])
        };
        triangles.iter().map(own).collect()
    }

    /// The triangle is cut into n² equal ones, and the centre of each is read; n is four times the number of texels along the
    /// longest edge, from 256 texels on that number itself, up to `most`. A channel that is zero while any texel at the
    /// triangle is not black gets a trace: each triangle that glows is a light.
    fn mean_over(&self, shown: &Shown, [a, b, c]: [[f32; 2]; 3], most: u32) -> [f32; 3] {
        let [x, y, origin] = self.texture.transform;
        let size = self.picture.size.map(|size| size as f32);
        let texels = [a, b, c].map(|[u, v]| [0, 1].map(|k| (x[k] * u + y[k] * v + origin[k]) * size[k]));
        let edge = |k: usize| {
            let (from, to) = (texels[k], texels[(k + 1) % 3]);
            (to[0] - from[0]).abs().max((to[1] - from[1]).abs())
        };
        // The cast saturates, and NaN becomes 0: any coordinates give a number of steps in range.
        let longest = edge(0).max(edge(1)).max(edge(2));
        let steps = (4.0 * longest).min(longest.max(LONG)).ceil() as u32;
        let steps = steps.max(STEPS.0).min(most);
        let mut sum = [0.0_f64; 3];
        let mut take = |i: u32, j: u32, third: f32| {
            let [v, w] = [i, j].map(|k| (k as f32 + third) / steps as f32);
            let own =
                shown.at([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * v + (c[axis] - a[axis]) * w));
            for (sum, channel) in sum.iter_mut().zip([own.r, own.g, own.b]) {
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
        if mean.iter().all(|&channel| channel > 0.0) || !self.glows_within(texels) {
            return mean;
        }
        mean.map(|channel| if channel > 0.0 { channel } else { TRACE })
    }

    /// Whether any texel that shows on the triangle or next to it may be other than black.
    fn glows_within(&self, corners: [[f32; 2]; 3]) -> bool {
        let Glowing { size, sums, .. } = &*self.picture;
        // Half a texel more where means of four are shown; all of them where it goes beyond the picture.
        let beyond = if self.texture.is_nearest { 0.0 } else { 0.5 };
        let [[left, right], [top, bottom]] = [0, 1].map(|axis| {
            let along = corners.map(|corner| corner[axis]);
            let low = (along.iter().fold(f32::MAX, |a, &b| a.min(b)) - beyond).floor();
            let high = (along.iter().fold(f32::MIN, |a, &b| a.max(b)) + beyond).ceil();
            match low >= 0.0 && high <= size[axis] as f32 {
                true => [low as usize, high as usize],
                false => [0, size[axis] as usize],
            }
        });
        let upto = |x: usize, y: usize| sums[y * (size[0] as usize + 1) + x];
        upto(right, bottom) + upto(left, top) > upto(left, bottom) + upto(right, top)
    }
}

/// [`Glowing::sums`].
fn sums(picture: &Picture) -> Vec<u32> {
    let columns = picture.width as usize + 1;
    let mut sums = vec![0; columns * (picture.height as usize + 1)];
    for (k, &[r, g, b, _]) in picture.texels.as_chunks::<4>().0.iter().enumerate() {
        let (x, y) = (k % (columns - 1), k / (columns - 1));
        let at = (y + 1) * columns + x + 1;
        let own = u32::from(r | g | b != 0);
        sums[at] = (sums[at - 1] + sums[at - columns] + own) - sums[at - columns - 1];
    }
    sums
}
