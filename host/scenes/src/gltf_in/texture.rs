//! Textures: a picture with its wrapping and its place on the surface, and means over triangles.

use std::rc::Rc;

use gltf::json;
use gltf::json::texture::{Info, MagFilter, WrappingMode};
use gltf::json::validation::Checked::Valid;
use image::RgbaImage;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::super::check::MAX_TEXTURE_COORDINATE;
use super::super::error::SceneError;
use super::super::glow::Glow;
use super::super::paint::Wrap;
use super::super::srgb::linear_from_srgb;
use super::Document;

/// A texture that glows, and where it lies.
pub(super) struct Placed {
    pub glow: Glow,
    /// Which set of coordinates.
    pub set: u32,
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
    /// With numbers that a scene takes: scale and offset within 2^20, what is no number as none. Whether that changed any.
    fn bounded(self) -> (Self, bool) {
        let offset = self.offset.map(|x| within(x, 0.0));
        let scale = self.scale.map(|x| within(x, 1.0));
        let rotation = if self.rotation.is_finite() {
            self.rotation
        } else {
            0.0
        };
        let changed = offset != self.offset || scale != self.scale || rotation != self.rotation;
        let bounded = Self {
            offset,
            rotation,
            scale,
            ..self
        };
        (bounded, changed)
    }

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

/// In ±2^20; `none` for what is no number.
fn within(x: f32, none: f32) -> f32 {
    if x.is_nan() {
        none
    } else {
        x.clamp(-MAX_TEXTURE_COORDINATE, MAX_TEXTURE_COORDINATE)
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
        let (wrap, is_nearest) = self.sampler(info.index, element)?;
        let others = info.extensions.as_ref().map(|extensions| &extensions.others);
        let transform = self.transform(others, element)?;
        Ok(Some(Placed {
            glow: Glow::new(
                pixels,
                wrap,
                is_nearest,
                transform.columns(),
                &self.pictures.borrow().glows,
            ),
            set: transform.tex_coord.unwrap_or(info.tex_coord),
        }))
    }

    /// Where a texture lies on the coordinates. Numbers that a scene does not take are bounded, with a note.
    pub(super) fn transform(
        &self,
        others: Option<&Map<String, Value>>,
        element: &str,
    ) -> Result<Transform, SceneError> {
        let given: Option<Transform> = match others {
            Some(others) => self.extension(others, "KHR_texture_transform", element)?,
            None => None,
        };
        let (transform, is_changed) = given.unwrap_or_default().bounded();
        if is_changed {
            self.warn(format!(
                "{element}: scales and offsets of its KHR_texture_transform beyond 2^20 count as 2^20, a rotation that is no number as none"
            ));
        }
        Ok(transform)
    }

    /// How a texture goes on beyond its edges, and whether the nearest texel shows.
    pub(super) fn sampler(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<([Wrap; 2], bool), SceneError> {
        let texture = self.get(&self.root.textures, index, "texture", element)?;
        let (mut wrap, mut is_nearest) = ([Wrap::Repeat; 2], false);
        if let Some(sampler) = texture.sampler {
            let sampler = self.get(&self.root.samplers, sampler, "sampler", element)?;
            is_nearest = sampler.mag_filter == Some(Valid(MagFilter::Nearest));
            for (wrap, checked) in wrap.iter_mut().zip([sampler.wrap_s, sampler.wrap_t]) {
                *wrap = match checked {
                    Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
                    Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
                    _ => Wrap::Repeat,
                };
            }
        }
        Ok((wrap, is_nearest))
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
            if let Some(pixels) = self.picture(picture)? {
                return Ok(Some((picture, pixels)));
            }
        }
        if pictures.is_empty() {
            self.warn(format!(
                "textures[{}] (used by {element}) names no picture that is read, and counts as white, of normals as none",
                index.value()
            ));
        }
        Ok(None)
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
