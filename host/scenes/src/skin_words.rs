//! What is painted on a scene, as the kernels' buffers hold it.

use std::sync::Arc;

use bytemuck::cast_slice;
use lightbvh_kernels::shading::skin::{Corner, PaintWords, SkinView};
use lightbvh_kernels::shading::trace::NONE;

use super::model::SceneData;
use super::paint::{Paint, Picture, Texture};
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
    if !data.is_painted() {
        return Vec::new();
    }
    let pictures = fitted(&data.pictures);
    let count = data.materials.len() as u32;
    let mut words = header(count);
    let first = words.len();
    words.resize(first + (PaintWords::COUNT * count) as usize, 0);
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
    let mut paints = Vec::new();
    for material in &data.materials {
        let own = material.paint.as_ref().filter(|paint| paint.is_seen());
        paints.push(own.map_or(NOTHING, |paint| {
            paint_words(paint, |texture| {
                texture.map_or(NONE, |texture| put(&texture, places[texture.picture as usize]))
            })
        }));
    }
    words[first..first + (PaintWords::COUNT * count) as usize].copy_from_slice(cast_slice(&paints));
    words
}

/// Of a material without paint.
const NOTHING: PaintWords = PaintWords {
    cutoff: 0.0,
    base: [1.0; 4],
    emission: [0.0; 3],
    base_picture: NONE,
    emission_picture: NONE,
};

fn paint_words(paint: &Paint, mut put: impl FnMut(Option<Texture>) -> u32) -> PaintWords {
    PaintWords {
        cutoff: paint.cutoff,
        base: paint.base,
        emission: paint.radiance,
        base_picture: put(paint.base_texture),
        emission_picture: put(paint.glow_texture),
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

/// Half as wide and high: means of four texels, of colours of what their bytes stand for.
fn halved(picture: &Picture) -> Picture {
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
                texels.push(match channel < 3 {
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
        let half = halved(&picture(4, 2));
        assert_eq!((half.width, half.height), (2, 1));
        // Opacity of texels 0, 1, 4 and 5: 3, 7, 19, 23.
        assert_eq!([half.texels[3], half.texels[7]], [13, 21]);
        let odd = halved(&picture(3, 1));
        let last = (odd.width, odd.height, odd.texels[7]);
        assert_eq!(last, (2, 1, 11), "the last one counts twice");
        for (rows, expected) in [
            // 0.5 linear is 187.5 encoded.
            ([[[0; 4], [255; 4]], [[255; 4], [0; 4]]], [188, 188, 188, 128]),
            ([[[7, 130, 255, 9]; 2]; 2], [7, 130, 255, 9]),
        ] {
            let mut squares = picture(2, 2);
            squares.texels = Arc::new(rows.as_flattened().as_flattened().to_vec());
            assert_eq!(*halved(&squares).texels, expected);
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
