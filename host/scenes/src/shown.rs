//! Pictures as the kernels' buffers hold them, and what they show.

use bytemuck::bytes_of;
use lightbvh_kernels::shading::picture::{self, HEADER_WORDS, PictureWords, Rgba, SRGB_WORDS};

use super::srgb::linear_from_srgb;
use super::textures::{Texture, Wrap};

/// The first words of textures: the number of materials, and the number that each encoded byte stands for.
pub(super) fn header(materials: u32) -> Vec<u32> {
    let mut words = vec![0; HEADER_WORDS as usize];
    words[0] = materials;
    words.extend((0..SRGB_WORDS).map(|byte| linear_from_srgb(byte as u8).to_bits()));
    words
}

/// The words of these bytes.
pub(super) fn words_of(bytes: &[u8]) -> impl Iterator<Item = u32> + '_ {
    let words = bytes.as_chunks::<4>().0;
    words.iter().map(|&word| u32::from_le_bytes(word))
}

/// The words of a texture on a picture of this size, whose texels begin at word `texels`.
pub(super) fn picture_words(texture: &Texture, [width, height]: [u32; 2], texels: u32) -> PictureWords {
    let wrap = |wrap| match wrap {
        Wrap::Repeat => PictureWords::REPEAT,
        Wrap::Clamp => PictureWords::CLAMP,
        Wrap::Mirror => PictureWords::MIRROR,
    };
    let [columns, rows] = texture.wrap.map(wrap);
    let nearest = if texture.is_nearest {
        PictureWords::NEAREST
    } else {
        0
    };
    let [x, y, origin] = texture.transform;
    PictureWords {
        width,
        height,
        flags: nearest | (columns << PictureWords::WRAP_COLUMNS) | (rows << PictureWords::WRAP_ROWS),
        transform: [x[0], x[1], y[0], y[1], origin[0], origin[1]],
        texels,
    }
}

/// A picture that is read by the kernels' function: means are of what images show.
#[derive(Debug)]
pub(super) struct Shown {
    words: Vec<u32>,
    size: [u32; 2],
}

impl Shown {
    /// The word at which the texture begins.
    const AT: u32 = HEADER_WORDS + SRGB_WORDS;

    /// Four bytes for each texel.
    pub fn new(size: [u32; 2], texels: &[u8], texture: &Texture) -> Self {
        let mut words = header(0);
        words.resize((Self::AT + PictureWords::COUNT) as usize, 0);
        words.extend(words_of(texels));
        let mut shown = Self { words, size };
        shown.set(texture);
        shown
    }

    /// Shows the picture by another texture.
    pub fn set(&mut self, texture: &Texture) {
        let own = picture_words(texture, self.size, Self::AT + PictureWords::COUNT);
        let place = self.words.iter_mut().skip(Self::AT as usize);
        place
            .zip(words_of(bytes_of(&own)))
            .for_each(|(to, word)| *to = word);
    }

    /// What is shown at texture coordinates.
    pub fn at(&self, uv: [f32; 2]) -> Rgba {
        let (words, at) = (&self.words[..], Self::AT);
        picture::Picture { words, at }.at(uv)
    }
}
