//! Textures: a picture with its wrapping and its place on the surface, and means.

use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::texture::{Info, MagFilter, WrappingMode};
use gltf::json::validation::Checked::Valid;
use serde::Deserialize;

use super::super::error::SceneError;
use super::super::glow::Glow;
use super::super::textures::{IN_PLACE, Picture, Texture, Wrap};
use super::Document;
use super::image::Decoded;

/// A texture with its picture, and which set of coordinates it lies by.
pub(super) struct Placed {
    /// With the number of its picture in the file.
    texture: Texture,
    picture: Picture,
    pub set: u32,
}

impl Placed {
    /// As the renderer shows it; the scene keeps its picture.
    pub(super) fn shown(&self, document: &Document<'_>) -> Texture {
        Texture {
            picture: document.pictures.borrow_mut().keep(self.texture.picture),
            ..self.texture
        }
    }

    pub(super) fn glow(&self, document: &Document<'_>) -> Result<Glow, SceneError> {
        let glows = &document.pictures.borrow().glows;
        Glow::new(document.load, glows, self.texture, &self.picture)
    }
}

/// `KHR_texture_transform`: scaled, then turned, then moved. A rotation is against the clock as seen: the second axis points
/// down.
fn columns(given: &TextureTransform) -> [[f32; 2]; 3] {
    let angle = f64::from(given.rotation.0);
    let (sine, cosine, [x, y]) = (libm::sin(angle) as f32, libm::cos(angle) as f32, given.scale.0);
    [[cosine * x, -sine * x], [sine * y, cosine * y], given.offset.0]
}

/// Another picture of a texture.
#[derive(Deserialize)]
struct Source {
    source: u32,
}

/// Extensions that name another picture, first the one that is looked for first.
const SOURCES: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

impl Document<'_> {
    /// The texture that a material names; `None` where its picture cannot be had, which is noted.
    pub(super) fn placed(&self, info: &Info, element: &str) -> Result<Option<Placed>, SceneError> {
        let Some((number, (picture, _))) = self.picture_of(info.index, element)? else {
            return Ok(None);
        };
        let texture = self.get(&self.root.textures, info.index, "texture", element)?;
        let (mut wrap, mut is_nearest) = ([Wrap::Repeat; 2], false);
        if let Some(sampler) = texture.sampler {
            let sampler = self.get(&self.root.samplers, sampler, "sampler", element)?;
            is_nearest = sampler.mag_filter == Some(Valid(MagFilter::Nearest));
            wrap = [sampler.wrap_s, sampler.wrap_t].map(|checked| match checked {
                Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
                Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
                _ => Wrap::Repeat,
            });
        }
        let transform = info
            .extensions
            .as_ref()
            .and_then(|own| own.texture_transform.as_ref());
        Ok(Some(Placed {
            texture: Texture {
                picture: number as u32,
                is_nearest,
                wrap,
                transform: transform.map_or(IN_PLACE, columns),
            },
            picture,
            set: transform.and_then(|own| own.tex_coord).unwrap_or(info.tex_coord),
        }))
    }

    /// The mean of a texture, linear red, green, blue, and alpha; `None` as for [`placed`](Self::placed).
    pub(super) fn mean(&self, info: &Info, element: &str) -> Result<Option<[f32; 4]>, SceneError> {
        let found = self.picture_of(info.index, element)?;
        Ok(found.map(|(_, (_, mean))| mean))
    }

    /// The first picture of a texture that can be decoded, with its number.
    fn picture_of(
        &self,
        index: json::Index<json::Texture>,
        element: &str,
    ) -> Result<Option<(usize, Decoded)>, SceneError> {
        let texture = self.get(&self.root.textures, index, "texture", element)?;
        let name = format!("textures[{}]", index.value());
        let mut pictures = Vec::new();
        for extension in SOURCES {
            if let Some(extensions) = &texture.extensions {
                let source: Option<Source> = self.extension(&extensions.others, extension, &name)?;
                pictures.extend(source.map(|source| source.source));
            }
        }
        // The number that stands for none.
        let own = texture.source.value() as u32;
        pictures.extend(Some(own).filter(|&own| own != u32::MAX));
        for &picture in &pictures {
            self.get(&self.root.images, json::Index::new(picture), "image", &name)?;
        }
        for &number in &pictures {
            if let Some(picture) = self.picture(number as usize)? {
                return Ok(Some((number as usize, picture)));
            }
        }
        if pictures.is_empty() {
            self.note(
                element,
                format!("{name} names no picture that is read, and counts as white"),
            );
        }
        Ok(None)
    }
}
