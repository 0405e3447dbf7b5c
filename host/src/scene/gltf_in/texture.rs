//! Textures: a picture with its wrapping and its place on the surface, and means over triangles.

use std::cell::OnceCell;
use std::rc::Rc;

use gltf::json;
use gltf::json::texture::{Info, MagFilter, WrappingMode};
use gltf::json::validation::Checked;
use image::RgbaImage;
use serde::Deserialize;

use super::super::error::SceneError;
use super::super::paint::IN_PLACE;
use super::super::srgb::linear_from_srgb;
use super::Document;

/// A picture with its wrapping, in linear RGB.
pub(super) struct Texture {
    pixels: Rc<RgbaImage>,
    /// Where it is not black, once that is asked for.
    glowing: OnceCell<Sums>,
    wrap: [WrappingMode; 2],
    is_nearest: bool,
    to_linear: [f32; 256],
}

/// A texture and where it lies on a surface.
pub(super) struct Placed {
    pub texture: Texture,
    /// Which set of coordinates.
    pub set: u32,
    transform: Transform,
}

/// `KHR_texture_transform`: scaled, then turned, then moved.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Transform {
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
    pub tex_coord: Option<u32>,
}

impl Transform {
    /// What each coordinate adds, and where the origin goes. Against the clock as seen: the second axis points down.
    pub(super) fn columns(&self) -> [[f32; 2]; 3] {
        let (sine, cosine) = (
            libm::sin(f64::from(self.rotation)) as f32,
            libm::cos(f64::from(self.rotation)) as f32,
        );
        let [x, y] = self.scale;
        [[cosine * x, -sine * x], [sine * y, cosine * y], self.offset]
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
            tex_coord: None,
        }
    }
}

/// Which textures there are, of which extension: only their pictures' places differ.
#[derive(Deserialize)]
struct Source {
    source: u32,
}

/// Extensions that name another picture, first the one that is looked for first.
pub(super) const SOURCES: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

impl Document<'_> {
    /// The texture that `info` names; `None` where its picture cannot be had, which is noted.
    pub(super) fn placed(&self, info: &Info, element: &str) -> Result<Option<Placed>, SceneError> {
        let Some((_, pixels)) = self.pixels_of(info.index, element)? else {
            return Ok(None);
        };
        let texture = self.get(&self.root.textures, info.index, "texture", element)?;
        let (mut wrap, mut is_nearest) = ([WrappingMode::Repeat; 2], false);
        if let Some(sampler) = texture.sampler {
            let sampler = self.get(&self.root.samplers, sampler, "sampler", element)?;
            is_nearest = sampler.mag_filter == Some(Checked::Valid(MagFilter::Nearest));
            for (mode, checked) in wrap.iter_mut().zip([sampler.wrap_s, sampler.wrap_t]) {
                if let Checked::Valid(valid) = checked {
                    *mode = valid;
                }
            }
        }
        let transform: Option<Transform> = match &info.extensions {
            Some(extensions) => self.extension(&extensions.others, "KHR_texture_transform", element)?,
            None => None,
        };
        let transform = transform.unwrap_or_default();
        Ok(Some(Placed {
            texture: Texture {
                pixels,
                glowing: OnceCell::new(),
                wrap,
                is_nearest,
                to_linear: std::array::from_fn(|encoded| linear_from_srgb(encoded as u8)),
            },
            set: transform.tex_coord.unwrap_or(info.tex_coord),
            transform,
        }))
    }

    /// The mean of a colour texture, linear red, green, blue, and alpha; `None` as for [`placed`](Self::placed).
    pub(super) fn mean_color(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Option<[f32; 4]>, SceneError> {
        self.mean(index, element, true)
    }

    /// The mean of a texture that holds numbers, each channel as it is.
    pub(super) fn mean_values(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Option<[f32; 4]>, SceneError> {
        self.mean(index, element, false)
    }

    fn mean(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
        color: bool,
    ) -> Result<Option<[f32; 4]>, SceneError> {
        // Many materials share a picture; it is decoded and summed once.
        for picture in self.pictures_of(index, element)? {
            if let Some(&mean) = self.pictures.borrow().means.get(&(picture, color)) {
                return Ok(Some(mean));
            }
        }
        let Some((picture, pixels)) = self.pixels_of(index, element)? else {
            return Ok(None);
        };
        let mean = mean(&pixels, color);
        self.pictures.borrow_mut().means.insert((picture, color), mean);
        Ok(Some(mean))
    }

    /// Where among the scene's pictures the one of a texture is, which is kept; `None` as for [`placed`](Self::placed).
    pub(super) fn kept(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Option<u32>, SceneError> {
        let Some((picture, pixels)) = self.pixels_of(index, element)? else {
            return Ok(None);
        };
        Ok(Some(self.pictures.borrow_mut().keep(picture, pixels)))
    }

    /// The pictures that a texture names, best first.
    fn pictures_of(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Vec<usize>, SceneError> {
        let texture = self.get(&self.root.textures, index, "texture", element)?;
        let name = format!("textures[{}]", index.value());
        let mut pictures = Vec::new();
        for extension in SOURCES {
            if let Some(extensions) = &texture.extensions {
                let source: Option<Source> = self.extension(&extensions.others, extension, &name)?;
                pictures.extend(source.map(|source| source.source as usize));
            }
        }
        // The number that stands for none.
        if texture.source.value() != u32::MAX as usize {
            pictures.push(texture.source.value());
        }
        for &picture in &pictures {
            self.get(
                &self.root.images,
                json::Index::new(picture as u32),
                "image",
                &name,
            )?;
        }
        Ok(pictures)
    }

    /// The first picture of a texture that can be decoded, with its number.
    fn pixels_of(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Option<(usize, Rc<RgbaImage>)>, SceneError> {
        let pictures = self.pictures_of(index, element)?;
        for &picture in &pictures {
            if let Some(pixels) = self.picture(picture) {
                return Ok(Some((picture, pixels)));
            }
        }
        if pictures.is_empty() {
            self.warn(format!(
                "textures[{}] (used by {element}) names no picture that is read, and counts as white",
                index.value()
            ));
        }
        Ok(None)
    }
}

impl Placed {
    /// Mean over the triangle with these texture coordinates; see [`Texture::mean_over`].
    pub(super) fn mean_over(&self, corners: [[f32; 2]; 3], max_steps: u32) -> [f32; 3] {
        let columns = self.transform.columns();
        if columns == IN_PLACE {
            return self.texture.mean_over(corners, max_steps);
        }
        let [x, y, origin] = columns;
        let moved = corners.map(|[u, v]| [0, 1].map(|k| x[k] * u + y[k] * v + origin[k]));
        self.texture.mean_over(moved, max_steps)
    }
}

impl Texture {
    /// Mean over the triangle with these texture coordinates.
    ///
    /// The triangle is cut into n² equal ones and what shows at the centre of each is taken; n grows with the number
    /// of texels along the longest edge, up to `max_steps`.
    fn mean_over(&self, [a, b, c]: [[f32; 2]; 3], max_steps: u32) -> [f32; 3] {
        let size = [self.pixels.width() as f32, self.pixels.height() as f32];
        let edge = |from: [f32; 2], to: [f32; 2]| {
            ((to[0] - from[0]) * size[0])
                .abs()
                .max(((to[1] - from[1]) * size[1]).abs())
        };
        // The cast saturates, and NaN becomes 0: any coordinates give a number of steps in range.
        let steps = (4.0 * edge(a, b).max(edge(b, c)).max(edge(c, a))).ceil() as u32;
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

    /// A mean, and where a channel of it is zero while any texel at the triangle is not black, a trace: what glows anywhere is a light.
    fn with_traces(&self, corners: [[f32; 2]; 3], mean: [f32; 3]) -> [f32; 3] {
        if mean.iter().all(|&channel| channel > 0.0) || !self.glows_within(corners) {
            return mean;
        }
        mean.map(|channel| if channel > 0.0 { channel } else { TRACE })
    }

    /// Whether any texel that shows on the triangle or beside it may be other than black.
    fn glows_within(&self, corners: [[f32; 2]; 3]) -> bool {
        let sums = self.glowing.get_or_init(|| Sums::of(&self.pixels));
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
struct Sums {
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

/// Mean of each channel of a picture, colours made linear.
fn mean(pixels: &RgbaImage, color: bool) -> [f32; 4] {
    let linear: [f64; 256] = std::array::from_fn(|encoded| match color {
        true => f64::from(linear_from_srgb(encoded as u8)),
        false => encoded as f64 / 255.0,
    });
    let mut sum = [0.0_f64; 4];
    for pixel in pixels.pixels() {
        let [r, g, b, alpha] = pixel.0;
        for (sum, channel) in sum.iter_mut().zip([r, g, b]) {
            *sum += linear[usize::from(channel)];
        }
        sum[3] += f64::from(alpha) / 255.0;
    }
    let count = (f64::from(pixels.width()) * f64::from(pixels.height())).max(1.0);
    sum.map(|channel| (channel / count) as f32)
}

/// The texel of a coordinate along one axis.
fn wrapped(coordinate: f32, size: u32, mode: WrappingMode) -> u32 {
    let inside = match mode {
        WrappingMode::ClampToEdge => coordinate,
        WrappingMode::Repeat => coordinate - coordinate.floor(),
        WrappingMode::MirroredRepeat => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
    };
    // The cast saturates at zero.
    ((inside * size as f32) as u32).min(size.saturating_sub(1))
}
