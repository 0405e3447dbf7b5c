//! Pictures, decoded within limits. One that is not there, or cannot be decoded, is noted and counts as white, as what glows as
//! black.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::io::Cursor;
use std::rc::Rc;
use std::sync::Arc;

use gltf::json;
use image::{ImageReader, Limits, RgbaImage};

use super::super::glow::Glows;
use super::super::paint::Picture;
use super::{Document, container, ktx2};

/// Largest width or height.
pub(super) const MAX_SIDE: u32 = 16_384;

/// Most memory of one decoder.
const MAX_ALLOCATION: u64 = 1 << 30;

/// Most pixels decoded over the whole file: 2^28.
const MAX_PIXELS: u64 = 1 << 28;

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
    /// Pixels decoded so far.
    pixels: u64,
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
        let pictures = kept.into_iter().map(|(_, pixels)| {
            let (width, height) = pixels.dimensions();
            let pixels = Rc::try_unwrap(pixels).unwrap_or_else(|shared| (*shared).clone());
            Picture {
                width,
                height,
                texels: Arc::new(pixels.into_raw()),
            }
        });
        pictures.collect()
    }
}

impl Document<'_> {
    /// The pixels of picture `index`, which must be in the list.
    pub(super) fn picture(&self, index: usize) -> Option<Rc<RgbaImage>> {
        {
            let pictures = self.pictures.borrow();
            if let Some((_, pixels)) = pictures.kept.get(&index) {
                return Some(Rc::clone(pixels));
            }
            match &pictures.last {
                Some((last, pixels)) if *last == index => return Some(Rc::clone(pixels)),
                _ if pictures.failed.contains(&index) => return None,
                _ => {}
            }
        }
        let image = self.root.images.get(index)?;
        let decoded = self
            .encoded(image, &format!("images[{index}]"))
            .and_then(|bytes| self.decode(&bytes));
        match decoded {
            Ok(pixels) => {
                let pixels = Rc::new(pixels);
                self.pictures.borrow_mut().last = Some((index, Rc::clone(&pixels)));
                Some(pixels)
            }
            Err(problem) => {
                self.pictures.borrow_mut().failed.insert(index);
                self.warn(format!(
                    "images[{index}] counts as white, where it is what glows as black, and of normals as none: {problem}; use PNG, JPEG, WebP or KTX 2 of at most {MAX_SIDE} \
                     pixels a side"
                ));
                None
            }
        }
    }

    fn encoded(&self, image: &json::Image, name: &str) -> Result<Vec<u8>, String> {
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => container::fetch(self, uri, name),
            (None, Some(view)) => self.view(view, name).map(|(bytes, _)| bytes.to_vec()),
            (None, None) => return Err(String::from("it has neither a uri nor a bufferView")),
        };
        bytes.map_err(|error| error.to_string())
    }

    fn decode(&self, bytes: &[u8]) -> Result<RgbaImage, String> {
        if bytes.starts_with(&ktx2::IDENTIFIER) {
            let header = ktx2::Header::read(bytes)?;
            self.count([header.width, header.height])?;
            return header.decode(bytes);
        }
        let reader = || {
            ImageReader::new(Cursor::new(bytes))
                .with_guessed_format()
                .map_err(|error| error.to_string())
        };
        let (width, height) = reader()?.into_dimensions().map_err(|error| error.to_string())?;
        self.count([width, height])?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(MAX_ALLOCATION);
        let mut reader = reader()?;
        reader.limits(limits);
        Ok(reader.decode().map_err(|error| error.to_string())?.into_rgba8())
    }

    /// Keeps the file within its budget, before memory is taken.
    fn count(&self, [width, height]: [u32; 2]) -> Result<(), String> {
        let mut pictures = self.pictures.borrow_mut();
        let pixels = pictures.pixels + u64::from(width) * u64::from(height);
        if pixels > MAX_PIXELS {
            return Err(format!(
                "the file's pictures have {pixels} pixels together, more than {MAX_PIXELS}"
            ));
        }
        pictures.pixels = pixels;
        Ok(())
    }
}
