//! KTX 2.0 pictures (`KHR_texture_basisu`): the container, and pictures of eight bits a channel. What is compressed by
//! Basis Universal a crate decodes, Zstandard another one.
//!
//! Source: KTX File Format Specification 2.0, section 2. The header is read here and every length checked, as the decoders
//! take memory for what it says.

use image::RgbaImage;

use super::super::error::SceneError;
#[cfg(not(feature = "ktx2"))]
use super::super::error::not_compiled;
use super::super::paint::MAX_SIDE;
use super::super::pictures::undecoded;

/// How every file starts.
pub(super) const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Where the list of levels starts, and how long an entry is.
const LEVELS: (usize, usize) = (80, 24);

/// Most levels: those of a picture of [`MAX_SIDE`].
const MAX_LEVELS: u32 = 15;

/// What is used of the header.
pub(super) struct Header {
    format: u32,
    width: u32,
    height: u32,
    scheme: u32,
    /// Place and length of the largest level, and its length once it is unpacked.
    base: [usize; 3],
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
            format: word(12)?,
            width,
            height,
            scheme: word(44)?,
            base: [long(LEVELS.0)?, long(LEVELS.0 + 8)?, long(LEVELS.0 + 16)?].map(|x| x as usize),
        })
    }

    /// Bytes that are taken at most: the unpacked level, blocks of one, and the pixels.
    pub(super) fn bytes(&self) -> u64 {
        (self.base[2] as u64).saturating_add(8 * u64::from(self.width) * u64::from(self.height))
    }

    /// Decodes the largest level.
    pub(super) fn decode(&self, name: &str, file: &[u8]) -> Result<RgbaImage, SceneError> {
        let format = self.format;
        let texels = match layout(format) {
            Some((bytes, channels)) => {
                let of = |texel: &[u8], channel| match channel {
                    4 => 0,
                    5 => 255,
                    channel => texel[channel],
                };
                let level = self.level(name, file)?;
                let texels = level.chunks_exact(bytes);
                texels
                    .flat_map(|texel| channels.map(|channel| of(texel, channel)))
                    .collect()
            }
            // VK_FORMAT_UNDEFINED, and UASTC as ASTC: what Basis Universal makes.
            None if format == 0 => basis(name, file)?,
            None => {
                let problem = format!("its format, number {format} of Vulkan, is for devices only");
                return Err(undecoded(name, problem));
            }
        };
        RgbaImage::from_raw(self.width, self.height, texels)
            .ok_or_else(|| undecoded(name, "it has fewer bytes than pixels"))
    }

    /// The bytes of the largest level, unpacked.
    fn level(&self, name: &str, file: &[u8]) -> Result<Vec<u8>, SceneError> {
        let [place, length, unpacked] = self.base;
        let stored = &file[place..place + length];
        match self.scheme {
            0 => Ok(stored.to_vec()),
            2 => zstandard(name, stored, unpacked as u64),
            scheme => {
                let problem = format!("its supercompression, scheme {scheme}, is not read");
                Err(undecoded(name, problem))
            }
        }
    }
}

/// Bytes of a texel of eight bits a channel, and the places of red, green, blue and alpha in it, 4 for 0, 5 for 255: `VkFormat`
/// in the Vulkan specification, linear or sRGB, which the texture's use decides.
fn layout(format: u32) -> Option<(usize, [usize; 4])> {
    match format {
        9 | 15 => Some((1, [0, 4, 4, 5])),
        16 | 22 => Some((2, [0, 1, 4, 5])),
        23 | 29 => Some((3, [0, 1, 2, 5])),
        30 | 36 => Some((3, [2, 1, 0, 5])),
        37 | 43 => Some((4, [0, 1, 2, 3])),
        44 | 50 => Some((4, [2, 1, 0, 3])),
        _ => None,
    }
}

/// At most so many bytes of a Zstandard stream.
#[cfg(feature = "ktx2")]
fn zstandard(name: &str, stored: &[u8], unpacked: u64) -> Result<Vec<u8>, SceneError> {
    use std::io::Read;
    let mut bytes = Vec::new();
    let stream = ruzstd::StreamingDecoder::new(stored).map_err(|error| undecoded(name, error))?;
    let read = stream.take(unpacked).read_to_end(&mut bytes);
    read.map_err(|error| undecoded(name, error))?;
    Ok(bytes)
}

/// What Basis Universal made, as red, green, blue and alpha.
#[cfg(feature = "ktx2")]
fn basis(name: &str, file: &[u8]) -> Result<Vec<u8>, SceneError> {
    use basisu::{DecodeFlags, TargetFormat, Transcoder};
    let decode = || Transcoder::new(file)?.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE);
    decode().map_err(|error| undecoded(name, format!("Basis Universal: {error:?}")))
}

#[cfg(not(feature = "ktx2"))]
fn zstandard(name: &str, _: &[u8], _: u64) -> Result<Vec<u8>, SceneError> {
    Err(not_compiled(name, "a KTX 2 picture by Zstandard", "ktx2"))
}

#[cfg(not(feature = "ktx2"))]
fn basis(name: &str, _: &[u8]) -> Result<Vec<u8>, SceneError> {
    Err(not_compiled(name, "a KTX 2 picture by Basis Universal", "ktx2"))
}
