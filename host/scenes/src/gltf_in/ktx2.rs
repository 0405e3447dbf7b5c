//! KTX 2.0 pictures (`KHR_texture_basisu`): the container of pictures by Basis Universal, both read by crates.

use image::RgbaImage;

use super::super::error::SceneError;
use super::super::files::Load;

/// How every file starts.
pub(super) const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Decodes the largest level of a flat picture. The decoder takes memory for the sizes in the header, so they are checked before.
#[cfg(feature = "formats")]
pub(super) fn decode(load: &Load, name: &str, file: &[u8]) -> Result<RgbaImage, SceneError> {
    use super::super::paint::MAX_SIDE;
    use super::super::pictures::undecoded;
    use basisu::{DecodeFlags, TargetFormat, Transcoder};
    let reader = ktx2::Reader::new(file).map_err(|error| undecoded(name, error))?;
    let header = reader.header();
    let [width, height] = [header.pixel_width, header.pixel_height];
    if ![width, height].iter().all(|side| (1..=MAX_SIDE).contains(side)) {
        return Err(undecoded(name, format!("it has {width} by {height} pixels")));
    }
    if header.pixel_depth > 0 || header.layer_count > 1 || header.face_count != 1 {
        return Err(undecoded(name, "it is no flat picture"));
    }
    // No level is longer than sixteen bytes a pixel, or a block of them.
    let most = 16 * u64::from(width.next_multiple_of(4)) * u64::from(height.next_multiple_of(4));
    let unpacked = reader.levels().map(|level| level.uncompressed_byte_length).max();
    let unpacked = unpacked.filter(|&unpacked| unpacked <= most);
    let unpacked = unpacked.ok_or_else(|| undecoded(name, "its header claims more than a picture has"))?;
    // The unpacked level, blocks of one, and the pixels.
    let bytes = unpacked + 8 * u64::from(width) * u64::from(height);
    load.check(name, "a picture, decoded,", bytes)?;
    let decode = || Transcoder::new(file)?.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE);
    let pixels = decode().map_err(|error| undecoded(name, format!("Basis Universal: {error:?}")))?;
    RgbaImage::from_raw(width, height, pixels)
        .ok_or_else(|| undecoded(name, "it has fewer bytes than pixels"))
}

#[cfg(not(feature = "formats"))]
pub(super) fn decode(_: &Load, name: &str, _: &[u8]) -> Result<RgbaImage, SceneError> {
    let what = "a KTX 2 picture by Basis Universal";
    Err(super::super::error::not_compiled(name, what))
}
