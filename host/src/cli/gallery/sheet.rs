//! The contact sheet of a scene: the reference above, and one part of it by every method below, all at one exposure.

use std::path::Path;

use super::measure::Shown;
use super::palette::palette;
use super::report::figure;
use crate::cli::compare::crops::choose;
use crate::error::HostError;
use crate::metrics::{Judge, Judged, Region, mean};
use crate::plot::{Canvas, text_size};
use crate::render::write_whole;

/// Most bytes of a sheet.
pub(super) const MOST_BYTES: usize = 60_000;
/// Colours of a sheet, the first of them by which it is small enough.
const COLORS: [usize; 5] = [256, 192, 128, 96, 64];
/// Columns of close-ups.
const COLUMNS: u32 = 4;
/// Least width of a close-up: a line of a method's name must fit.
const CELL: u32 = 240;
/// A close-up's share of the image's width and height, and how many pixels of the image are one in the overview, each way: the
/// first of them by which the sheet is small enough.
const SHARES: [(u32, u32); 4] = [(4, 1), (6, 2), (8, 4), (16, 8)];
const MARGIN: u32 = 10;
const TEXT: u32 = 2;
const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [32; 3];
const MARK: [u8; 3] = [255, 64, 64];

/// A close-up and the words around it.
struct Cell {
    names: Vec<String>,
    pixels: Vec<[u8; 3]>,
    below: [String; 2],
}

/// Writes the sheet; returns the region that is shown, and the MSE of each method in it.
pub(super) fn write(
    path: &Path,
    title: &str,
    judge: &Judge,
    shown: &[Shown],
) -> Result<Option<(Region, Vec<f64>)>, HostError> {
    let mut columns = Vec::new();
    for of in shown {
        columns.push((of.method, judge.judge(&of.film)?));
    }
    let mut made = None;
    for (share, step) in SHARES {
        let Some(region) = choose(judge, &columns, share, 1).first().copied() else {
            return Ok(None);
        };
        let canvas = draw(title, judge, shown, &columns, region, step);
        let bytes = small(&canvas).map_err(|error| HostError::Store {
            path: path.to_owned(),
            source: std::io::Error::other(error),
        })?;
        let fits = bytes.len() <= MOST_BYTES;
        made = Some((region, bytes));
        if fits {
            break;
        }
    }
    let Some((region, bytes)) = made else {
        return Ok(None);
    };
    let errors = columns
        .iter()
        .map(|(_, judged)| judged.region(region).map(|quality| quality.mse));
    let errors = errors.collect::<Result<Vec<f64>, _>>()?;
    write_whole(path, &bytes).map_err(|source| HostError::Store {
        path: path.to_owned(),
        source,
    })?;
    Ok(Some((region, errors)))
}

/// An image of which each pixel is the mean of `step` x `step`, and its columns; what is left over at the edges joins the last
/// ones.
fn reduced(pixels: &[[u8; 3]], width: u32, step: u32) -> (Vec<[u8; 3]>, u32) {
    let (width, step) = (width.max(1) as usize, step as usize);
    let height = pixels.len() / width;
    let (columns, rows) = ((width / step).max(1), (height / step).max(1));
    let ends =
        |at: usize, of: usize, all: usize| (at * step, if at + 1 == of { all } else { (at + 1) * step });
    let mut out = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let (top, bottom) = ends(row, rows, height);
        for column in 0..columns {
            let (left, right) = ends(column, columns, width);
            let mut sum = [0_usize; 3];
            for y in top..bottom {
                for pixel in &pixels[y * width + left..y * width + right] {
                    for (sum, &channel) in sum.iter_mut().zip(pixel) {
                        *sum += usize::from(channel);
                    }
                }
            }
            let count = (bottom - top) * (right - left);
            out.push(sum.map(|sum| ((sum + count / 2) / count) as u8));
        }
    }
    (out, columns as u32)
}

fn draw(
    title: &str,
    judge: &Judge,
    shown: &[Shown],
    columns: &[(crate::method::Method, Judged<'_>)],
    region: Region,
    step: u32,
) -> Canvas {
    let width = judge.size().0;
    let cut = |bytes: &[u8]| region.cut(bytes.as_chunks::<3>().0, width);
    let mut cells = vec![Cell {
        names: vec![String::from("reference")],
        pixels: cut(judge.shown()),
        below: [String::from("the marked part"), String::new()],
    }];
    for (of, (method, judged)) in shown.iter().zip(columns) {
        let times: Vec<f64> = of.images.iter().map(|image| image.ms).collect();
        let errors: Vec<f64> = of.images.iter().map(|image| image.quality.mse).collect();
        cells.push(Cell {
            names: wrapped(method.name(), CELL),
            pixels: cut(judged.shown()),
            below: [
                format!("MSE {}", figure(mean(&errors))),
                format!("rays {}, {:.0} ms", of.chosen.samples, mean(&times)),
            ],
        });
    }
    let line = text_size("", TEXT).1 + 6;
    let zoom = (CELL / region.width).max(1);
    let cell = (CELL.max(region.width * zoom), region.height * zoom);
    let (small, small_width) = reduced(judge.shown().as_chunks::<3>().0, width, step);
    let small_height = small.len() as u32 / small_width;
    let inside = (COLUMNS * (cell.0 + MARGIN) - MARGIN).max(small_width);
    let overview = (inside / small_width).max(1);
    let top = MARGIN + line + 4;
    let cells_top = top + small_height * overview + MARGIN;
    let cell_height = 4 * line + cell.1 + MARGIN;
    let rows = (cells.len() as u32).div_ceil(COLUMNS);
    let mut canvas = Canvas::new(inside + 2 * MARGIN, cells_top + rows * cell_height, PAPER);

    canvas.text((MARGIN, MARGIN), &fitting(title, inside), TEXT, INK);
    let left = MARGIN + (inside - small_width * overview) / 2;
    canvas.image((left, top), &small, small_width, overview);
    let scaled = |pixels: u32| pixels * overview / step;
    let corner = (left + scaled(region.x), top + scaled(region.y));
    let size = (scaled(region.width), scaled(region.height));
    canvas.outline(corner, size, MARK);
    if size.0 > 2 && size.1 > 2 {
        canvas.outline((corner.0 + 1, corner.1 + 1), (size.0 - 2, size.1 - 2), MARK);
    }
    for (at, of) in (0..).zip(&cells) {
        let x = MARGIN + at % COLUMNS * (cell.0 + MARGIN);
        let y = cells_top + at / COLUMNS * cell_height;
        // Names of one line stand next to their pictures.
        let free = 2 - (of.names.len() as u32).min(2);
        for (k, name) in (free..).zip(&of.names) {
            canvas.text((x, y + k * line), name, TEXT, INK);
        }
        let picture = y + 2 * line;
        canvas.image((x, picture), &of.pixels, region.width, zoom);
        for (k, words) in (0..).zip(&of.below) {
            canvas.text(
                (x, picture + cell.1 + 5 + k * line),
                &fitting(words, cell.0),
                TEXT,
                INK,
            );
        }
    }
    canvas
}

/// A name in lines that fit, broken after hyphens.
fn wrapped(name: &str, width: u32) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in name.split_inclusive('-') {
        let last = lines.len() - 1;
        let longer = format!("{}{part}", lines[last]);
        if text_size(&longer, TEXT).0 <= width || lines[last].is_empty() {
            lines[last] = longer;
        } else {
            lines.push(part.to_owned());
        }
    }
    lines
}

/// As much of a text as fits, in letters that can be drawn: others are left out.
fn fitting(text: &str, width: u32) -> String {
    let drawn = |c: &char| c.is_ascii_alphanumeric() || " -+.,:/%".contains(*c);
    let mut out: String = text.chars().filter(drawn).collect();
    while text_size(&out, TEXT).0 > width {
        out.pop();
    }
    out
}

/// The canvas as PNG of [`MOST_BYTES`] at most if few colours allow it. All pictures share them.
fn small(canvas: &Canvas) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    for colors in COLORS {
        bytes = encoded(canvas, colors)?;
        if bytes.len() <= MOST_BYTES {
            break;
        }
    }
    Ok(bytes)
}

fn encoded(canvas: &Canvas, colors: usize) -> Result<Vec<u8>, png::EncodingError> {
    let (palette, indices) = palette(canvas.pixels(), colors);
    let (width, height) = canvas.size();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.as_flattened());
    encoder.set_compression(png::Compression::High);
    // Neighbouring indices have nothing in common.
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Method;

    #[test]
    fn every_method_fits_in_two_lines() {
        for method in Method::ALL {
            let lines = wrapped(method.name(), CELL);
            assert_eq!(lines.concat(), method.name());
            assert!(lines.len() <= 2, "{lines:?}");
            assert!(
                lines.iter().all(|line| text_size(line, TEXT).0 <= CELL),
                "{lines:?}"
            );
        }
    }

    #[test]
    fn texts_are_cut_where_they_do_not_fit() {
        assert_eq!(fitting("Lämp (a)", 1000), "Lmp a");
        // Two letters take 2 x (2 x 6) - 2 = 22 columns.
        assert_eq!(fitting("abc", 22), "ab");
        assert_eq!(fitting("abc", 21), "a");
    }

    #[test]
    fn a_reduced_image_has_the_means_of_its_pixels() {
        let pixels: Vec<[u8; 3]> = (0..15).map(|i| [10 * i, 0, 255]).collect();
        // Three rows of five: the third row and the fifth column join those before them.
        let (small, columns) = reduced(&pixels, 5, 2);
        assert_eq!(columns, 2);
        let mean = |of: &[u32]| (of.iter().sum::<u32>() as f64 * 10.0 / of.len() as f64).round() as u8;
        let left = mean(&[0, 1, 5, 6, 10, 11]);
        let right = mean(&[2, 3, 4, 7, 8, 9, 12, 13, 14]);
        assert_eq!(small, [[left, 0, 255], [right, 0, 255]]);
        assert_eq!(reduced(&pixels, 5, 1), (pixels, 5));
        assert_eq!(reduced(&[[9; 3]; 2], 2, 8), (vec![[9; 3]], 1));
    }

    #[test]
    fn noise_has_fewer_colours_and_a_flat_sheet_keeps_its_own() {
        // Numbers without a pattern: a multiplicative generator (Lehmer) of 31 bits, its upper byte.
        let mut state = 1_u64;
        let mut canvas = Canvas::new(240, 240, [255; 3]);
        for i in 0..240 * 200 {
            let mut byte = || {
                state = state * 48_271 % 0x7fff_ffff;
                (state >> 23) as u8
            };
            canvas.fill((i % 240, i / 240), (1, 1), [byte(), byte(), byte()]);
        }
        let bytes = small(&canvas).expect("a picture");
        // 48000 pixels of 8 bits fit; they would not of 24.
        assert!(
            bytes.len() <= MOST_BYTES && bytes.len() > 30_000,
            "{}",
            bytes.len()
        );
        let image = image::load_from_memory(&bytes).expect("a picture").into_rgb8();
        assert_eq!(image.dimensions(), (240, 240));
        assert_eq!(image.get_pixel(120, 220).0, [255; 3]);

        let mut canvas = Canvas::new(100, 20, [255; 3]);
        canvas.text((2, 2), "MSE 1.5", 2, INK);
        let bytes = small(&canvas).expect("a picture");
        let image = image::load_from_memory(&bytes).expect("a picture").into_rgb8();
        assert!(
            image
                .pixels()
                .zip(canvas.pixels())
                .all(|(shown, drawn)| shown.0 == *drawn)
        );
    }
}
