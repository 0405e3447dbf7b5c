//! Textures of a scene in the kernels' buffers.

use std::sync::Arc;

use bytemuck::cast_slice;
use image::RgbaImage;
use image::imageops::thumbnail;
use lightbvh_kernels::shading::textures::{Corner, MaterialWords, TextureView};
use lightbvh_kernels::shading::trace::NONE;

use super::model::SceneData;
use super::shown::{header, picture_words, words_of};
use super::textures::{MaterialTextures, Picture, Texture};

/// Most texels of all pictures: 2^24, so that they fit the smallest storage buffers seen (128 MiB) with room to spare. Larger
/// pictures are halved until they fit.
const MAX_TEXELS: u64 = 1 << 24;

/// A frame's textures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureArrays {
    /// [`TextureView::corners`].
    pub corners: Vec<Corner>,
    /// [`TextureView::words`].
    pub words: Arc<Vec<u32>>,
}

impl TextureArrays {
    /// As the kernels' functions take it.
    pub fn view(&self) -> TextureView<'_> {
        TextureView {
            corners: &self.corners,
            words: &self.words,
        }
    }
}

/// The words of all textures; none without textures.
pub(super) fn words(data: &SceneData) -> Vec<u32> {
    if !data.has_textures() {
        return Vec::new();
    }
    let pictures = fitted(&data.pictures);
    let count = data.materials.len() as u32;
    let mut words = header(count);
    let first = words.len();
    words.resize(first + (MaterialWords::COUNT * count) as usize, 0);
    let places: Vec<([u32; 2], u32)> = pictures
        .iter()
        .map(|picture| {
            let at = words.len() as u32;
            words.extend(words_of(&picture.texels));
            ([picture.width, picture.height], at)
        })
        .collect();
    let mut put = |texture: &Texture, (size, texels): ([u32; 2], u32)| {
        let at = words.len() as u32;
        words.extend_from_slice(cast_slice(&[picture_words(texture, size, texels)]));
        at
    };
    let mut all = Vec::new();
    for material in &data.materials {
        let own = material.textures.as_ref().filter(|textures| textures.is_seen());
        all.push(own.map_or(NOTHING, |textures| {
            material_words(textures, |texture| {
                texture.map_or(NONE, |texture| put(&texture, places[texture.picture as usize]))
            })
        }));
    }
    words[first..first + (MaterialWords::COUNT * count) as usize].copy_from_slice(cast_slice(&all));
    words
}

/// Of a material without textures.
const NOTHING: MaterialWords = MaterialWords {
    cutoff: 0.0,
    base: [1.0; 4],
    emission: [0.0; 3],
    base_picture: NONE,
    emission_picture: NONE,
};

fn material_words(textures: &MaterialTextures, mut put: impl FnMut(Option<Texture>) -> u32) -> MaterialWords {
    MaterialWords {
        cutoff: textures.cutoff,
        base: textures.base,
        emission: textures.radiance,
        base_picture: put(textures.base_texture),
        emission_picture: put(textures.glow_texture),
    }
}

/// The pictures, the largest halved until all fit.
fn fitted(pictures: &[Picture]) -> Vec<Picture> {
    let mut fitted = pictures.to_vec();
    let texels = |picture: &Picture| u64::from(picture.width) * u64::from(picture.height);
    while fitted.iter().map(texels).sum::<u64>() > MAX_TEXELS {
        let most = fitted.iter().map(texels).max().unwrap_or(0);
        if most <= 1 {
            break;
        }
        let largest = fitted.iter_mut().filter(|picture| texels(picture) * 2 > most);
        largest.for_each(|picture| *picture = halved(picture));
    }
    fitted
}

/// Half as wide and high: means of the bytes of four texels.
fn halved(picture: &Picture) -> Picture {
    let texels = picture.texels.to_vec();
    let pixels = RgbaImage::from_raw(picture.width, picture.height, texels).expect("four bytes a texel");
    let [width, height] = [picture.width, picture.height].map(|size| size.div_ceil(2));
    thumbnail(&pixels, width, height).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> Picture {
        Picture {
            width,
            height,
            texels: Arc::new((0..width * height * 4).map(|k| k as u8).collect()),
        }
    }

    #[test]
    fn only_as_many_are_halved_as_must_be() {
        let side = 4096;
        let pictures = [picture(side, side / 2), picture(8, 8), picture(side / 2, side)];
        let fits = fitted(&pictures);
        let widths = [fits[0].width, fits[1].width, fits[2].width];
        assert_eq!(widths, [side / 2, 8, side / 4], "2^24 and 64 are too many");
    }
}
