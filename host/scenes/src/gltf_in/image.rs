//! Pictures, decoded within limits. One that is not there, or cannot be decoded, is noted and counts as white, as what glows as
//! black.

use std::collections::HashMap;

use image::RgbaImage;

use super::super::error::SceneError;
use super::super::glow::Glows;
use super::super::pictures::{self, undecoded};
use super::super::textures::Picture;
use super::{Document, container, ktx2};

/// A picture and its [mean](pictures::mean_of).
pub(super) type Decoded = (Picture, [f32; 4]);

/// What has been decoded.
#[derive(Default)]
pub(super) struct Pictures {
    /// By number in the file; `None` where it cannot be had.
    decoded: HashMap<usize, Option<Decoded>>,
    /// Those that the scene keeps: their numbers in the file.
    kept: Vec<u32>,
    /// What is known of those that glow.
    pub glows: Glows,
}

impl Pictures {
    /// Keeps a picture; returns its number in the scene.
    pub(super) fn keep(&mut self, index: u32) -> u32 {
        let known = self.kept.iter().position(|&kept| kept == index);
        let number = known.unwrap_or_else(|| {
            self.kept.push(index);
            self.kept.len() - 1
        });
        number as u32
    }

    /// What is kept, by number in the scene.
    pub(super) fn into_kept(mut self) -> Vec<Picture> {
        let kept = self.kept.iter();
        kept.filter_map(|&index| Some(self.decoded.remove(&(index as usize))??.0))
            .collect()
    }
}

impl Document<'_> {
    /// Picture `index`, which must be in the list; `None` where it cannot be had, which is noted.
    pub(super) fn picture(&self, index: usize) -> Result<Option<Decoded>, SceneError> {
        if let Some(known) = self.pictures.borrow().decoded.get(&index) {
            return Ok(known.clone());
        }
        let (image, name) = (&self.root.images[index], format!("images[{index}]"));
        let encoded = container::uri_or_view(self, image.uri.as_deref(), image.buffer_view, &name);
        let picture = match encoded.and_then(|bytes| self.decode(&name, &bytes)) {
            Ok(pixels) => {
                let picture = Picture::from(pixels);
                let mean = pictures::mean_of(&picture);
                Some((picture, mean))
            }
            Err(error) if error.ends_the_load() => return Err(error),
            Err(error) => {
                let what = format!("counts as white, where it is what glows as black: {error}");
                self.note(&name, what);
                None
            }
        };
        self.pictures.borrow_mut().decoded.insert(index, picture.clone());
        Ok(picture)
    }

    fn decode(&self, name: &str, bytes: &[u8]) -> Result<RgbaImage, SceneError> {
        self.load
            .take(name, "the file of a picture", bytes.len() as u64)?;
        if !bytes.starts_with(&ktx2::IDENTIFIER) {
            return pictures::decode(self.load, name, bytes);
        }
        let header = ktx2::Header::read(bytes).map_err(|problem| undecoded(name, problem))?;
        self.load.check(name, "a picture, decoded,", header.bytes())?;
        self.load.take(name, "a picture", header.pixels())?;
        header.decode(name, bytes)
    }
}
