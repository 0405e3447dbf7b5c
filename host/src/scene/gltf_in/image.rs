//! Images, decoded within limits, and the mean of a texture over a triangle.

use std::io::Cursor;

use gltf::json;
use gltf::json::texture::WrappingMode;
use gltf::json::validation::Checked;
use image::{ImageReader, Limits, RgbImage};

use super::super::error::SceneError;
use super::{Document, container};

/// Largest width or height.
const MAX_SIDE: u32 = 16_384;

/// Most memory of one decoder.
const MAX_ALLOCATION: u64 = 1 << 30;

/// Most pixels decoded over the whole file: 2^28, 768 MiB if all were kept.
const MAX_PIXELS: u64 = 1 << 28;

/// An image with its wrapping, in linear RGB.
pub(super) struct Texture {
    pixels: RgbImage,
    wrap: [WrappingMode; 2],
    to_linear: Vec<f32>,
}

impl Document<'_> {
    /// Decodes the image of a texture.
    pub(super) fn texture(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Texture, SceneError> {
        let texture = self.get(&self.root.textures, index, "texture", element)?;
        let name = format!("textures[{}]", index.value());
        let image = self.get(&self.root.images, texture.source, "image", &name)?;
        let name = format!("images[{}]", texture.source.value());
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => container::fetch(self, uri, &name)?,
            (None, Some(view)) => self.view(view, &name)?.0.to_vec(),
            (None, None) => {
                return Err(self.malformed(
                    name,
                    "has neither a uri nor a bufferView",
                    "export the file again",
                ));
            }
        };
        let pixels = self.decode(&bytes).map_err(|problem| {
            self.malformed(
                name,
                format!("cannot be decoded: {problem}"),
                "use a PNG or JPEG of at most 16384 pixels a side",
            )
        })?;
        let mut wrap = [WrappingMode::Repeat; 2];
        if let Some(sampler) = texture.sampler {
            let sampler = self.get(&self.root.samplers, sampler, "sampler", element)?;
            for (mode, checked) in wrap.iter_mut().zip([sampler.wrap_s, sampler.wrap_t]) {
                if let Checked::Valid(valid) = checked {
                    *mode = valid;
                }
            }
        }
        let to_linear = (0..=255_u8).map(linear_from_srgb).collect();
        Ok(Texture {
            pixels,
            wrap,
            to_linear,
        })
    }

    fn decode(&self, bytes: &[u8]) -> Result<RgbImage, String> {
        let reader = || {
            ImageReader::new(Cursor::new(bytes))
                .with_guessed_format()
                .map_err(|error| error.to_string())
        };
        let (width, height) = reader()?.into_dimensions().map_err(|error| error.to_string())?;
        let pixels = self.pixels.get() + u64::from(width) * u64::from(height);
        if pixels > MAX_PIXELS {
            return Err(format!(
                "the file's images have {pixels} pixels together, more than {MAX_PIXELS}"
            ));
        }
        self.pixels.set(pixels);
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(MAX_ALLOCATION);
        let mut reader = reader()?;
        reader.limits(limits);
        Ok(reader.decode().map_err(|error| error.to_string())?.into_rgb8())
    }
}

impl Texture {
    /// Mean over the triangle with these texture coordinates.
    ///
    /// The triangle is cut into n² equal ones and the texel at the centre of each is taken; n grows with the number
    /// of texels along the longest edge, up to `max_steps`.
    pub(super) fn mean_over(&self, [a, b, c]: [[f32; 2]; 3], max_steps: u32) -> [f32; 3] {
        let size = [self.pixels.width() as f32, self.pixels.height() as f32];
        let edge = |from: [f32; 2], to: [f32; 2]| {
            ((to[0] - from[0]) * size[0])
                .abs()
                .max(((to[1] - from[1]) * size[1]).abs())
        };
        // The cast saturates, and NaN becomes 0: any coordinates give a number of steps in range.
        let steps = (2.0 * edge(a, b).max(edge(b, c)).max(edge(c, a))).ceil() as u32;
        let steps = steps.clamp(1, max_steps.max(1));
        let mut sum = [0.0_f64; 3];
        let mut take = |i: u32, j: u32, third: f32| {
            let (v, w) = (
                (i as f32 + third) / steps as f32,
                (j as f32 + third) / steps as f32,
            );
            let texel =
                self.texel([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * v + (c[axis] - a[axis]) * w));
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
        sum.map(|channel| (channel / (f64::from(steps) * f64::from(steps))) as f32)
    }

    /// Mean over the whole image.
    pub(super) fn mean(&self) -> [f32; 3] {
        let mut sum = [0.0_f64; 3];
        for pixel in self.pixels.pixels() {
            for (sum, &channel) in sum.iter_mut().zip(&pixel.0) {
                *sum += f64::from(self.to_linear[usize::from(channel)]);
            }
        }
        let count = (f64::from(self.pixels.width()) * f64::from(self.pixels.height())).max(1.0);
        sum.map(|channel| (channel / count) as f32)
    }

    fn texel(&self, uv: [f32; 2]) -> [f32; 3] {
        let x = wrapped(uv[0], self.pixels.width(), self.wrap[0]);
        let y = wrapped(uv[1], self.pixels.height(), self.wrap[1]);
        self.pixels.get_pixel_checked(x, y).map_or([0.0; 3], |pixel| {
            pixel.0.map(|channel| self.to_linear[usize::from(channel)])
        })
    }
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

/// IEC 61966-2-1, the transfer function that glTF names for colour textures.
fn linear_from_srgb(encoded: u8) -> f32 {
    let x = f64::from(encoded) / 255.0;
    let linear = if x <= 0.04045 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    };
    linear as f32
}
