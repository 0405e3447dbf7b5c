//! Pictures in files, decoded within the memory of a load.

use std::fmt::Display;
use std::io::Cursor;
use std::sync::Arc;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, RgbaImage};

use super::error::{SceneError, malformed, not_compiled};
use super::files::Load;
use super::srgb::linear_from_srgb;
use super::textures::{MAX_SIDE, Picture};

/// What cannot be decoded.
pub(super) fn undecoded(name: &str, problem: impl Display) -> SceneError {
    let advice = "use PNG, JPEG, WebP or KTX 2 of at most 16384 pixels a side";
    malformed(name, format!("cannot be decoded: {problem}"), advice)
}

/// Decodes the picture of a surface. Its size is read from its header, and its memory taken before it is known to be sound: the
/// memory of a load bounds its work.
pub(super) fn decode(load: &Load, name: &str, bytes: &[u8]) -> Result<RgbaImage, SceneError> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| undecoded(name, error))?;
    if reader.format() == Some(ImageFormat::WebP) && !ImageFormat::WebP.reading_enabled() {
        return Err(not_compiled(name, "the picture format WebP"));
    }
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(load.left());
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder().map_err(|error| undecoded(name, error))?;
    let (width, height) = decoder.dimensions();
    // What is decoded, what the decoder works with, and the copy of eight bits a channel.
    let pixels = 4 * u64::from(width) * u64::from(height);
    load.check(
        name,
        "a picture, decoded,",
        (2 * decoder.total_bytes()).saturating_add(pixels),
    )?;
    load.take(name, "a picture", pixels)?;
    let decoded = decoder
        .set_limits(limits)
        .and_then(|()| DynamicImage::from_decoder(decoder))
        .map_err(|error| undecoded(name, error))?;
    match decoded {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            Err(undecoded(name, "it holds light, not colours"))
        }
        picture => Ok(picture.into_rgba8()),
    }
}

impl From<RgbaImage> for Picture {
    fn from(pixels: RgbaImage) -> Self {
        Self {
            width: pixels.width(),
            height: pixels.height(),
            texels: Arc::new(pixels.into_raw()),
        }
    }
}

/// Mean of each channel of a picture, colours made linear.
pub(super) fn mean_of(picture: &Picture) -> [f32; 4] {
    let linear: [f64; 256] = std::array::from_fn(|encoded| f64::from(linear_from_srgb(encoded as u8)));
    let mut sum = [0.0_f64; 4];
    for &[r, g, b, alpha] in picture.texels.as_chunks::<4>().0 {
        let [r, g, b] = [r, g, b].map(|channel| linear[usize::from(channel)]);
        let own = [r, g, b, f64::from(alpha) / 255.0];
        sum = [0, 1, 2, 3].map(|k| sum[k] + own[k]);
    }
    let count = (picture.texels.len() / 4).max(1) as f64;
    sum.map(|channel| (channel / count) as f32)
}
