//! KTX 2.0 pictures (`KHR_texture_basisu`): the container of pictures by Basis Universal, which a crate decodes.
//!
//! Source: KTX File Format Specification 2.0, section 2. The header is read here and every length checked, as the decoder
//! takes memory for the sizes in it.

use image::RgbaImage;

use super::super::error::SceneError;
#[cfg(not(feature = "formats"))]
use super::super::error::not_compiled;
use super::super::pictures::undecoded;
use super::super::textures::MAX_SIDE;

/// How every file starts.
pub(super) const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Where the list of levels starts, and how long an entry is.
const LEVELS: (usize, usize) = (80, 24);

/// Most levels: those of a picture of [`MAX_SIDE`].
const MAX_LEVELS: u32 = 15;

/// The used part of the header.
pub(super) struct Header {
    width: u32,
    height: u32,
    /// Length of the largest level once it is unpacked.
    unpacked: u64,
}

impl Header {
    /// Reads and checks the header of one flat picture.
    pub(super) fn read(file: &[u8]) -> Result<Self, String> {
        let word = |at: usize| -> Result<u32, String> {
            let bytes = file.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
            let word = bytes.map(u32::from_le_bytes);
            word.ok_or_else(|| String::from("its KTX 2 header is cut off"))
        };
        let long = |at: usize| Ok::<u64, String>(u64::from(word(at)?) | u64::from(word(at + 4)?) << 32);
        let (width, height) = (word(20)?, word(24)?);
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(format!("it has {width} by {height} pixels"));
        }
        if word(28)? > 0 || word(32)? > 1 || word(36)? != 1 || word(40)? > MAX_LEVELS {
            return Err(String::from("it is no flat picture"));
        }
        let inside = |place: u64, length: u64| {
            let end = place.checked_add(length);
            end.is_some_and(|end| end <= file.len() as u64)
        };
        // Descriptor and key-value data have 32-bit places, the global data of the compression 64-bit ones.
        let mut sound = inside(word(48)?.into(), word(52)?.into())
            && inside(word(56)?.into(), word(60)?.into())
            && inside(long(64)?, long(72)?);
        // No level is longer than sixteen bytes a pixel, or a block of them.
        let most = 16 * u64::from(width.next_multiple_of(4)) * u64::from(height.next_multiple_of(4));
        for level in 0..word(40)?.max(1) as usize {
            let entry = LEVELS.0 + LEVELS.1 * level;
            sound &= inside(long(entry)?, long(entry + 8)?) && long(entry + 16)? <= most;
        }
        if !sound {
            return Err(String::from("its KTX 2 header claims more than the file has"));
        }
        Ok(Self {
            width,
            height,
            unpacked: long(LEVELS.0 + 16)?,
        })
    }

    /// Bytes that are taken at most: the unpacked level, blocks of one, and the pixels.
    pub(super) fn bytes(&self) -> u64 {
        self.unpacked.saturating_add(2 * self.pixels())
    }

    /// Bytes of the pixels.
    pub(super) fn pixels(&self) -> u64 {
        4 * u64::from(self.width) * u64::from(self.height)
    }

    /// Decodes the largest level.
    pub(super) fn decode(&self, name: &str, file: &[u8]) -> Result<RgbaImage, SceneError> {
        RgbaImage::from_raw(self.width, self.height, basis(name, file)?)
            .ok_or_else(|| undecoded(name, "it has fewer bytes than pixels"))
    }
}

/// Red, green, blue and alpha of each pixel.
#[cfg(feature = "formats")]
fn basis(name: &str, file: &[u8]) -> Result<Vec<u8>, SceneError> {
    use basisu::{DecodeFlags, TargetFormat, Transcoder};
    let decode = || Transcoder::new(file)?.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE);
    decode().map_err(|error| undecoded(name, format!("Basis Universal: {error:?}")))
}

#[cfg(not(feature = "formats"))]
fn basis(name: &str, _: &[u8]) -> Result<Vec<u8>, SceneError> {
    Err(not_compiled(name, "a KTX 2 picture by Basis Universal"))
}
