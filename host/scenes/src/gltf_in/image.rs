//! Pictures, decoded within limits. One that is not there, or cannot be decoded, is noted and counts as white, as what glows as
//! black.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use gltf::json;
use image::RgbaImage;

use super::super::error::SceneError;
use super::super::glow::Glows;
use super::super::paint::Picture;
use super::super::pictures::{self, undecoded};
use super::{Document, container, ktx2};

/// What has been decoded.
#[derive(Default)]
pub(super) struct Pictures {
    /// The last one: neighbours often share it.
    last: Option<(usize, Rc<RgbaImage>)>,
    /// Which could not be decoded, so that each is noted once.
    failed: HashSet<usize>,
    /// Means by picture, and whether its channels are colours.
    pub means: HashMap<(usize, bool), [f32; 4]>,
    /// Those that the scene keeps, by number in the file: their numbers in the scene.
    kept: BTreeMap<usize, (u32, Rc<RgbaImage>)>,
    /// What is known of those that glow.
    pub glows: Glows,
}

impl Pictures {
    /// Keeps a picture; returns its number in the scene.
    pub(super) fn keep(&mut self, index: usize, pixels: Rc<RgbaImage>) -> u32 {
        let next = self.kept.len() as u32;
        self.kept.entry(index).or_insert((next, pixels)).0
    }

    /// What is kept, by number in the scene.
    pub(super) fn into_kept(mut self) -> Vec<Picture> {
        (self.last, self.glows) = (None, Glows::default());
        let mut kept: Vec<_> = self.kept.into_values().collect();
        kept.sort_by_key(|&(number, _)| number);
        kept.into_iter()
            .map(|(_, pixels)| pictures::kept(pixels))
            .collect()
    }
}

impl Document<'_> {
    /// The pixels of picture `index`, which must be in the list; `None` where they cannot be had, which is noted.
    pub(super) fn picture(&self, index: usize) -> Result<Option<Rc<RgbaImage>>, SceneError> {
        {
            let pictures = self.pictures.borrow();
            if let Some((_, pixels)) = pictures.kept.get(&index) {
                return Ok(Some(Rc::clone(pixels)));
            }
            match &pictures.last {
                Some((last, pixels)) if *last == index => return Ok(Some(Rc::clone(pixels))),
                _ if pictures.failed.contains(&index) => return Ok(None),
                _ => {}
            }
        }
        let image = &self.root.images[index];
        let name = format!("images[{index}]");
        let decoded = self.encoded(image, &name);
        match decoded.and_then(|bytes| self.decode(&name, &bytes)) {
            Ok(pixels) => {
                let pixels = Rc::new(pixels);
                self.pictures.borrow_mut().last = Some((index, Rc::clone(&pixels)));
                Ok(Some(pixels))
            }
            Err(error) if error.ends_the_load() => Err(error),
            Err(error) => {
                self.pictures.borrow_mut().failed.insert(index);
                self.warn(format!(
                    "{name} counts as white, where it is what glows as black, and of normals as none: {error}"
                ));
                Ok(None)
            }
        }
    }

    fn encoded(&self, image: &json::Image, name: &str) -> Result<Vec<u8>, SceneError> {
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) => container::fetch(self, uri, name),
            (None, Some(view)) => self.view(view, name).map(|(bytes, _)| bytes.to_vec()),
            (None, None) => Err(undecoded(name, "it has neither a uri nor a bufferView")),
        }
    }

    fn decode(&self, name: &str, bytes: &[u8]) -> Result<RgbaImage, SceneError> {
        let pixels = if bytes.starts_with(&ktx2::IDENTIFIER) {
            let header = ktx2::Header::read(bytes).map_err(|problem| undecoded(name, problem))?;
            self.load.check(name, "a picture, decoded,", header.bytes())?;
            header.decode(name, bytes)?
        } else {
            pictures::decode(self.load, name, bytes, None)?.into_rgba8()
        };
        self.load.take(name, "a picture", pixels.as_raw().len() as u64)?;
        Ok(pixels)
    }
}
