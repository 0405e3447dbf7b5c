//! A canvas of displayed pixels, for sheets of images with labels.

use std::path::Path;

use image::{ExtendedColorType, ImageFormat};

use super::font::{SIZE, glyph};
use crate::render::{FilmError, write_image};

/// Columns and rows that a line of text takes, with dots of `scale` pixels.
pub fn text_size(text: &str, scale: u32) -> (u32, u32) {
    let letters = text.chars().count() as u32;
    ((letters * (SIZE.0 + 1)).saturating_sub(1) * scale, SIZE.1 * scale)
}

/// An image of 8-bit sRGB to draw on; what reaches beyond its edges is cut off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canvas {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 3]>,
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: u32, height: u32, color: [u8; 3]) -> Self {
        Self {
            width,
            height,
            pixels: vec![color; width as usize * height as usize],
        }
    }

    /// Columns and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The pixels by rows from the upper left.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, (x, y): (u32, u32), (width, height): (u32, u32), color: [u8; 3]) {
        let columns = x.min(self.width)..x.saturating_add(width).min(self.width);
        for row in y.min(self.height)..y.saturating_add(height).min(self.height) {
            let start = row as usize * self.width as usize;
            self.pixels[start + columns.start as usize..start + columns.end as usize].fill(color);
        }
    }

    /// The outline of a rectangle, one pixel wide, inside it.
    pub fn outline(&mut self, (x, y): (u32, u32), (width, height): (u32, u32), color: [u8; 3]) {
        if width > 0 && height > 0 {
            self.fill((x, y), (width, 1), color);
            self.fill((x, y + height - 1), (width, 1), color);
            self.fill((x, y), (1, height), color);
            self.fill((x + width - 1, y), (1, height), color);
        }
    }

    /// Draws an image of `columns` columns, each pixel a square of `zoom`.
    pub fn image(&mut self, (x, y): (u32, u32), pixels: &[[u8; 3]], columns: u32, zoom: u32) {
        for (row, line) in (0..).zip(pixels.chunks(columns.max(1) as usize)) {
            for (column, &color) in (0..).zip(line) {
                self.fill((x + column * zoom, y + row * zoom), (zoom, zoom), color);
            }
        }
    }

    /// Writes a line of text from its upper left corner, with dots of `scale` pixels.
    pub fn text(&mut self, (x, y): (u32, u32), text: &str, scale: u32, color: [u8; 3]) {
        for (i, letter) in (0..).zip(text.chars()) {
            for (row, dots) in (0..).zip(glyph(letter)) {
                for column in (0..SIZE.0).filter(|c| dots >> (SIZE.0 - 1 - c) & 1 == 1) {
                    let at = (x + (i * (SIZE.0 + 1) + column) * scale, y + row * scale);
                    self.fill(at, (scale, scale), color);
                }
            }
        }
    }

    /// Writes the canvas as PNG; the file appears whole or not at all.
    ///
    /// # Errors
    /// [`FilmError`] for a canvas that the encoder refuses (an empty one), and a path that cannot be written.
    pub fn write_png(&self, path: &Path) -> Result<(), FilmError> {
        let bytes = self.pixels.as_flattened();
        let (color, format) = (ExtendedColorType::Rgb8, ImageFormat::Png);
        write_image(path, bytes, (self.width, self.height), color, format)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_enlarged_and_cut_at_the_edges() {
        let mut canvas = Canvas::new(5, 3, [0; 3]);
        canvas.image((1, 1), &[[1; 3], [2; 3], [3; 3], [4; 3]], 2, 2);
        let reds: Vec<u8> = canvas.pixels().iter().map(|p| p[0]).collect();
        assert_eq!(reds, [0, 0, 0, 0, 0, 0, 1, 1, 2, 2, 0, 1, 1, 2, 2]);
        canvas.fill((4, 2), (u32::MAX, u32::MAX), [9; 3]);
        assert_eq!(canvas.pixels()[14], [9; 3]);
        assert_eq!(canvas.pixels()[13], [2; 3]);
    }

    #[test]
    fn letters_are_told_apart() {
        let drawn = |letter: char| {
            let (width, height) = text_size("X", 1);
            let mut canvas = Canvas::new(width, height, [0; 3]);
            canvas.text((0, 0), &letter.to_string(), 1, [255; 3]);
            canvas.pixels().to_vec()
        };
        let letters: Vec<char> = "abcdefghijklmnopqrstuvwxyz0123456789-+.,:/% ?".chars().collect();
        for (i, &a) in letters.iter().enumerate() {
            assert!(letters[..i].iter().all(|&b| drawn(a) != drawn(b)), "{a}");
        }
    }
}
