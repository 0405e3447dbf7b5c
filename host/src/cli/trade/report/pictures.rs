//! Images and error maps as data URLs, within what a page may weigh.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::{ExtendedColorType, ImageFormat};
use serde::Serialize;

use crate::cli::trade::front::Point;
use crate::error::HostError;
use crate::metrics::{Judge, relative_squared_error};
use crate::render::FilmError;

/// Characters of all pictures of a page.
const MOST: usize = 11 << 20;
/// The relative error that maps show as black, and the one that they show as white; logarithmic between them.
const RELATIVE_RANGE: [f64; 2] = [1e-4, 1e2];

/// The pictures of a scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pictures {
    pub width: u32,
    pub height: u32,
    pub reference: String,
    pub relative_range: [f64; 2],
    /// By point; nothing where the page would have become too large.
    pub choices: Vec<Option<Picture>>,
}

/// An image of the default's time beside the reference.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Picture {
    pub image: String,
    /// FLIP, 0 to 1, as grey.
    pub flip: String,
    /// Relative squared error as grey, see [`Pictures::relative_range`].
    pub relative: String,
    pub mean_flip: f64,
    pub mean_relative: f64,
    pub mse: f64,
    /// Shadow rays of a pixel.
    pub rays: u32,
}

/// The default first, then the front, then the others, each as far as there is room on a page of so many scenes.
pub(super) fn pictures(points: &[Point], judge: &Judge, scenes: usize) -> Result<Pictures, HostError> {
    let (width, height) = judge.size();
    let reference = png_url(judge.shown(), (width, height), ExtendedColorType::Rgb8)?;
    let mut room = (MOST / scenes.max(1)).saturating_sub(reference.len());
    let mut choices = vec![None; points.len()];
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&at| (!points[at].default, !points[at].pareto));
    for at in order {
        let picture = picture(&points[at], judge)?;
        let characters = picture.image.len() + picture.flip.len() + picture.relative.len();
        if characters <= room {
            room -= characters;
            choices[at] = Some(picture);
        }
    }
    Ok(Pictures {
        width,
        height,
        reference,
        relative_range: RELATIVE_RANGE,
        choices,
    })
}

fn picture(point: &Point, judge: &Judge) -> Result<Picture, HostError> {
    let (film, rays) = &point.images.shown;
    let size = judge.size();
    let judged = judge.judge(film)?;
    let quality = judged.quality;
    let flip: Vec<u8> = judged
        .flip
        .iter()
        .map(|&flip| (flip * 255.0).round() as u8)
        .collect();
    let [least, most] = RELATIVE_RANGE.map(f64::ln);
    let pairs = film.pixels().iter().zip(judge.reference().pixels());
    let relative: Vec<u8> = pairs
        .map(|(&pixel, &reference)| {
            let error = relative_squared_error(pixel, reference, judge.exposure());
            // The conversion takes what lies beyond the ends to them.
            (255.0 * (error.ln() - least) / (most - least)).round() as u8
        })
        .collect();
    Ok(Picture {
        image: png_url(&judged.shown, size, ExtendedColorType::Rgb8)?,
        flip: png_url(&flip, size, ExtendedColorType::L8)?,
        relative: png_url(&relative, size, ExtendedColorType::L8)?,
        mean_flip: quality.flip,
        mean_relative: quality.relative_mse,
        mse: quality.mse,
        rays: *rays,
    })
}

/// `data:image/png;base64,…` of 8-bit pixels by rows.
fn png_url(bytes: &[u8], (width, height): (u32, u32), color: ExtendedColorType) -> Result<String, FilmError> {
    let mut file = Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut file, bytes, width, height, color, ImageFormat::Png).map_err(
        |source| FilmError::Encode {
            path: "a picture of the report".into(),
            source,
        },
    )?;
    Ok(format!(
        "data:image/png;base64,{}",
        STANDARD.encode(file.get_ref())
    ))
}
