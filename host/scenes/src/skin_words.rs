//! What is painted on a scene, as the kernels' buffers hold it.

use std::sync::Arc;

use bytemuck::cast_slice;
use lightbvh_kernels::shading::skin::{Corner, HAS_GLASS, PaintWords, SkinView};
use lightbvh_kernels::shading::trace::NONE;

use super::model::SceneData;
use super::paint::{Opacity, Paint, Picture, Texture};
use super::profile::OVER_DIRECTIONS;
use super::shown::{header, picture_words, words_of};
use super::srgb::linear_from_srgb;

/// Most texels of all pictures: 2^24, so that they fit the smallest storage buffers seen (128 MiB) with room to spare. Larger
/// pictures are halved until they fit.
const MAX_TEXELS: u64 = 1 << 24;

/// A frame's paint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkinArrays {
    /// [`SkinView::corners`].
    pub corners: Vec<Corner>,
    /// [`SkinView::words`].
    pub words: Arc<Vec<u32>>,
}

impl SkinArrays {
    /// As the kernels' functions take it.
    pub fn view(&self) -> SkinView<'_> {
        SkinView {
            corners: &self.corners,
            words: &self.words,
        }
    }
}

/// The words of everything that is painted; none where nothing is.
pub(super) fn words(data: &SceneData) -> Vec<u32> {
    if !data.is_painted() && data.profiles.is_empty() {
        return Vec::new();
    }
    let pictures = fitted(&data.pictures, &colors(data));
    // After the materials, the profiles.
    let count = (data.materials.len() + data.profiles.len()) as u32;
    let mut words = header(count);
    let first = words.len();
    words.resize(first + (PaintWords::COUNT * count) as usize, 0);
    let shown = pictures
        .iter()
        .chain(data.profiles.iter().map(|own| &own.picture));
    let places: Vec<([u32; 2], u32)> = shown
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
    let mut flags = 0;
    let mut paints = Vec::new();
    for material in &data.materials {
        let own = material.paint.as_ref().filter(|paint| paint.is_seen());
        let paint = own.map_or(NOTHING, |paint| {
            paint_words(paint, |texture| {
                texture.map_or(NONE, |texture| put(&texture, places[texture.picture as usize]))
            })
        });
        if paint.flags & PaintWords::CLEAR != 0 {
            flags |= HAS_GLASS;
        }
        paints.push(paint);
    }
    for &place in &places[pictures.len()..] {
        paints.push(PaintWords {
            flags: PaintWords::BY_LIGHT,
            emission_picture: put(&OVER_DIRECTIONS, place),
            ..NOTHING
        });
    }
    words[1] = flags;
    words[first..first + (PaintWords::COUNT * count) as usize].copy_from_slice(cast_slice(&paints));
    words
}

/// Of a material without paint.
const NOTHING: PaintWords = PaintWords {
    flags: 0,
    cutoff: 0.0,
    base: [1.0; 4],
    metallic: 0.0,
    roughness: 1.0,
    bump: 0.0,
    emission: [0.0; 3],
    transmission: 0.0,
    base_picture: NONE,
    rough_picture: NONE,
    bump_picture: NONE,
    emission_picture: NONE,
};

fn paint_words(paint: &Paint, mut put: impl FnMut(Option<Texture>) -> u32) -> PaintWords {
    let (opacity, cutoff) = match paint.opacity {
        Opacity::Opaque => (0, 0.0),
        Opacity::Cut(cutoff) => (PaintWords::CUT, cutoff),
        Opacity::Blended => (PaintWords::BLENDED, 0.0),
    };
    let reflects = paint.base_texture.is_some() || paint.rough_texture.is_some();
    PaintWords {
        flags: opacity
            | if reflects { PaintWords::REFLECTS } else { 0 }
            | if paint.is_clear() { PaintWords::CLEAR } else { 0 },
        cutoff,
        base: paint.base,
        metallic: paint.metallic,
        roughness: paint.roughness,
        bump: paint.bump,
        emission: paint.radiance,
        transmission: paint.transmission,
        base_picture: put(paint.base_texture),
        rough_picture: put(paint.rough_texture),
        bump_picture: put(paint.bump_texture),
        emission_picture: put(paint.glow_texture),
    }
}

/// Which pictures hold colours, which are encoded.
fn colors(data: &SceneData) -> Vec<bool> {
    let mut colors = vec![false; data.pictures.len()];
    let paints = data
        .materials
        .iter()
        .filter_map(|material| material.paint.as_ref());
    for (_, texture) in paints.flat_map(Paint::textures) {
        colors[texture.picture as usize] |= texture.is_color;
    }
    colors
}

/// The pictures, the largest halved until all fit.
fn fitted(pictures: &[Picture], colors: &[bool]) -> Vec<Picture> {
    let mut fitted = pictures.to_vec();
    let texels = |picture: &Picture| u64::from(picture.width) * u64::from(picture.height);
    while fitted.iter().map(texels).sum::<u64>() > MAX_TEXELS {
        let most = fitted.iter().map(texels).max().unwrap_or(0);
        if most <= 1 {
            break;
        }
        for (picture, &is_color) in fitted.iter_mut().zip(colors) {
            if texels(picture) * 2 > most {
                *picture = halved(picture, is_color);
            }
        }
    }
    fitted
}

/// Half as wide and high: means of four texels, those of colours of what they stand for.
fn halved(picture: &Picture, is_color: bool) -> Picture {
    let linear: Vec<f32> = (0..=255).map(linear_from_srgb).collect();
    // The nearest byte: as many as have the middle to the next one below the mean.
    let middles: Vec<f32> = linear.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
    let encoded = |mean: f32| middles.partition_point(|&middle| middle <= mean);
    let [width, height] = [picture.width, picture.height].map(|size| size.div_ceil(2));
    let texel = |x: u32, y: u32, channel: usize| {
        let (x, y) = (x.min(picture.width - 1), y.min(picture.height - 1));
        u32::from(picture.texels[(y as usize * picture.width as usize + x as usize) * 4 + channel])
    };
    let mut texels = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..4 {
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
                    .map(|(right, down)| texel(2 * x + right, 2 * y + down, channel));
                texels.push(match is_color && channel < 3 {
                    true => encoded(four.iter().map(|&byte| linear[byte as usize]).sum::<f32>() / 4.0) as u8,
                    false => ((four.iter().sum::<u32>() + 2) / 4) as u8,
                });
            }
        }
    }
    Picture {
        width,
        height,
        texels: Arc::new(texels),
    }
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

    /// Black and white are half as bright together, not half as great a byte; opacities are numbers.
    #[test]
    fn halves_are_means_of_four() {
        let half = halved(&picture(4, 2), false);
        assert_eq!((half.width, half.height), (2, 1));
        // Red of texels 0, 1, 4 and 5: 0, 4, 16, 20.
        assert_eq!(half.texels[..8], [10, 11, 12, 13, 18, 19, 20, 21]);
        let odd = halved(&picture(3, 1), false);
        let last = (odd.width, odd.height, odd.texels[4]);
        assert_eq!(last, (2, 1, 8), "the last one counts twice");
        for (rows, expected) in [
            // 0.5 linear is 187.5 encoded.
            ([[[0; 4], [255; 4]], [[255; 4], [0; 4]]], [188, 188, 188, 128]),
            ([[[7, 130, 255, 9]; 2]; 2], [7, 130, 255, 9]),
        ] {
            let mut squares = picture(2, 2);
            squares.texels = Arc::new(rows.as_flattened().as_flattened().to_vec());
            assert_eq!(*halved(&squares, true).texels, expected);
        }
    }

    #[test]
    fn only_as_many_are_halved_as_must_be() {
        let side = 4096;
        let pictures = [picture(side, side / 2), picture(8, 8), picture(side / 2, side)];
        let fits = fitted(&pictures, &[false; 3]);
        let widths = [fits[0].width, fits[1].width, fits[2].width];
        assert_eq!(widths, [side / 2, 8, side / 4], "2^24 and 64 are too many");
    }
}
