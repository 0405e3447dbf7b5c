//! Pictures that textures show.

use lightbvh::exact::{abs, clamp, floor_u32};

use super::block::NONE;

/// Words of the header.
pub const HEADER_WORDS: u32 = 8;
/// Of linear numbers by their sRGB bytes.
pub const SRGB_WORDS: u32 = 256;

/// What a texture shows at a point, or a mean: linear, each in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgba {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
    /// Opacity.
    pub a: f32,
}

/// What a picture says before its texels: 10 words, then `width` times `height` of red, green, blue and opacity, a byte each from the low
/// ones up, by rows from the top.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PictureWords {
    /// Columns, at most 2^14.
    pub width: u32,
    /// Rows, at most 2^14.
    pub height: u32,
    /// [`NEAREST`](Self::NEAREST), and how the picture wraps.
    pub flags: u32,
    /// Where texture coordinates lie on the picture: columns of a map, then where it puts the origin.
    pub transform: [f32; 6],
    /// The word at which the texels begin.
    pub texels: u32,
}

const _: () = assert!(size_of::<PictureWords>() == 40);

impl PictureWords {
    /// Words of it.
    pub const COUNT: u32 = 10;
    /// Flag: the nearest texel, not a mean of four.
    pub const NEAREST: u32 = 1;
    /// Bits of the flags from which on two say how columns wrap: [`REPEAT`](Self::REPEAT) and so on.
    pub const WRAP_COLUMNS: u32 = 2;
    /// The same of rows.
    pub const WRAP_ROWS: u32 = 4;
    /// Beyond its edges the picture begins anew.
    pub const REPEAT: u32 = 0;
    /// Beyond its edges it is as at them.
    pub const CLAMP: u32 = 1;
    /// Beyond its edges it is mirrored.
    pub const MIRROR: u32 = 2;
}

/// Word `at`, or zero.
#[inline]
#[must_use]
pub fn word(words: &[u32], at: u32) -> u32 {
    let mut word = 0;
    if at < words.len() as u32 {
        word = words[at as usize];
    }
    word
}

/// A picture among the words of textures.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// All words.
    pub words: &'a [u32],
    /// Where its own begin, or [`NONE`].
    pub at: u32,
}

impl Picture<'_> {
    #[inline]
    fn number(&self, at: u32) -> f32 {
        f32::from_bits(word(self.words, self.at.wrapping_add(at)))
    }

    /// What it shows at texture coordinates of magnitude at most 2^20; ones where there is no picture.
    #[inline]
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> Rgba {
        let mut shown = Rgba {
            r: 1.0,
            g: 1.0,
            b: 1.0,
            a: 1.0,
        };
        if self.at != NONE {
            let width = word(self.words, self.at);
            let height = word(self.words, self.at.wrapping_add(1));
            let flags = word(self.words, self.at.wrapping_add(2));
            let texels = word(self.words, self.at.wrapping_add(9));
            let [u, v] = uv;
            let x = (self.number(3) * u + self.number(5) * v) + self.number(7);
            let y = (self.number(4) * u + self.number(6) * v) + self.number(8);
            let is_nearest = flags & PictureWords::NEAREST != 0;
            let x = along(x, width, (flags >> PictureWords::WRAP_COLUMNS) & 3, is_nearest);
            let y = along(y, height, (flags >> PictureWords::WRAP_ROWS) & 3, is_nearest);
            let mut sum = Rgba {
                r: 0.0,
                g: 0.0,
                b: 0.0,
                a: 0.0,
            };
            // One of four at a time: a loop is inlined once.
            for tap in 0..4 {
                let (right, down) = (tap & 1 != 0, tap & 2 != 0);
                let column = if right { x.second } else { x.first };
                let row = if down { y.second } else { y.first };
                let across = if right { x.part } else { 1.0 - x.part };
                let weight = across * if down { y.part } else { 1.0 - y.part };
                let texel = word(
                    self.words,
                    texels.wrapping_add(row.wrapping_mul(width)).wrapping_add(column),
                );
                sum.r += weight * self.color(texel);
                sum.g += weight * self.color(texel >> 8);
                sum.b += weight * self.color(texel >> 16);
                sum.a += weight * ((texel >> 24) as i32 as f32 * PER_BYTE);
            }
            shown = sum;
        }
        shown
    }

    /// The number that the lowest byte stands for (IEC 61966-2-1).
    #[inline]
    fn color(&self, texel: u32) -> f32 {
        f32::from_bits(word(self.words, HEADER_WORDS + (texel & 255)))
    }
}

/// What a byte counts. A constant: a quotient of two numbers is a division on devices.
const PER_BYTE: f32 = 1.0 / 255.0;

/// Two texels beside each other, and the part of the second.
#[derive(Clone, Copy, Debug)]
struct Pair {
    first: u32,
    second: u32,
    part: f32,
}

/// The texels that coordinate `x` lies between, of `size` along an axis. A function of its own on devices: it is called for each picture.
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline)]
fn along(x: f32, size: u32, wrap: u32, is_nearest: bool) -> Pair {
    let size = if size == 0 { 1 } else { size };
    let last = size - 1;
    let x = clamp(x, -MAX_COORDINATE, MAX_COORDINATE);
    let whole = floor_u32(abs(x));
    let beyond = abs(x) - whole as i32 as f32;
    // x - floor(x), and whether the floor is odd.
    let below = x < 0.0 && beyond > 0.0;
    let negative = x < 0.0;
    let part = if negative && beyond > 0.0 {
        1.0 - beyond
    } else {
        beyond
    };
    let odd = (whole + if below { 1 } else { 0 }) & 1 != 0;
    let inside = if wrap == PictureWords::CLAMP {
        clamp(x, 0.0, 1.0)
    } else if wrap == PictureWords::MIRROR && odd {
        1.0 - part
    } else {
        part
    };
    let scaled = inside * (size as i32 as f32);
    let cell = floor_u32(scaled);
    let rest = scaled - cell as i32 as f32;
    let repeats = wrap == PictureWords::REPEAT;
    let mut pair = Pair {
        first: bounded(cell, last, repeats),
        second: bounded(cell.wrapping_add(1), last, repeats),
        part: rest - 0.5,
    };
    if rest < 0.5 {
        let before = if repeats { last } else { 0 };
        pair.second = pair.first;
        pair.first = if cell == 0 {
            before
        } else {
            bounded(cell - 1, last, repeats)
        };
        pair.part = rest + 0.5;
    }
    if is_nearest {
        pair.first = if cell < last { cell } else { last };
        pair.second = pair.first;
        pair.part = 0.0;
    }
    pair
}

/// A texel at most one beyond the last.
#[inline]
fn bounded(cell: u32, last: u32, repeats: bool) -> u32 {
    if cell <= last {
        cell
    } else if repeats {
        0
    } else {
        last
    }
}

/// Greatest magnitude of a coordinate: 2^20. Beyond it there is no part of a texel to tell.
const MAX_COORDINATE: f32 = 1_048_576.0;
