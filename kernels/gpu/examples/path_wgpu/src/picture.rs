//! The picture, with the lamps that the camera sees.

use std::path::Path;

use crate::Result;
use crate::scene::{LAMPS, colour, place};
use crate::tracer::{Image, SIZE};

// As in `path.wgsl`.
const EYE: [f32; 3] = [50.3, 8.6, 1.0];
const FORWARD: [f32; 3] = [0.36, -0.29, 0.85];

/// The lamps that the camera sees, as diamonds: radiance, and how much of a pixel they cover.
fn drawn(behind: &Image) -> Image {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: [f32; 3]| a.map(|part| part / dot(a, a).sqrt());
    let forward = unit(FORWARD);
    let right = unit([-forward[2], 0.0, forward[0]]);
    let up = [0, 1, 2].map(|k| {
        (if k == 1 { 1.0 } else { 0.0 } - forward[1] * forward[k])
            / dot(right, [-forward[2], 0.0, forward[0]])
    });
    let seen = |k: u32| {
        let own = place(k, 1.0);
        let to = [0, 1, 2].map(|k| own.translation[k] - EYE[k]);
        let scale = SIZE[0] as f32 / 1.3 / dot(to, forward);
        let [x, y] = [(dot(to, right), SIZE[0]), (-dot(to, up), SIZE[1])]
            .map(|(at, side)| 0.5 * side as f32 + scale * at);
        (dot(to, forward), x, y, scale * own.columns[1][1], colour(k))
    };
    let mut lamps: Vec<_> = (0..LAMPS).map(seen).filter(|own| own.0 > 0.5).collect();
    // Farther ones first.
    lamps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut image = vec![[0.0; 4]; behind.len()];
    for (depth, x, y, radius, [red, green, blue]) in lamps {
        let range = |at: f32, side: u32| {
            let end = |by: f32| (at + by).clamp(0.0, side as f32) as u32;
            end(-2.0 * radius - 1.0)..end(2.0 * radius + 2.0)
        };
        for (column, row) in
            range(y, SIZE[1]).flat_map(|row| range(x, SIZE[0]).map(move |column| (column, row)))
        {
            let [across, along] =
                [(column, x), (row, y)].map(|(at, middle)| (at as f32 + 0.5 - middle).abs());
            let covered = (0.5 + 0.7 * (radius - across - along / 1.3)).clamp(0.0, 1.0) * radius.min(1.0);
            let own = &mut image[(row * SIZE[0] + column) as usize];
            if depth < behind[(row * SIZE[0] + column) as usize][3] {
                let lamp = [4.0 * red, 4.0 * green, 4.0 * blue, 1.0];
                *own = std::array::from_fn(|k| own[k] * (1.0 - covered) + lamp[k] * covered);
            }
        }
    }
    image
}

/// Writes images side by side, with the lamps before them, in sRGB.
pub fn write(path: &Path, images: &[&Image]) -> Result<()> {
    let lamps = drawn(images[0]);
    let mut picture = image::RgbImage::new(SIZE[0] * images.len() as u32, SIZE[1]);
    for (x, y, own) in picture.enumerate_pixels_mut() {
        let pixel = (y * SIZE[0] + x % SIZE[0]) as usize;
        let (behind, lamp) = (images[(x / SIZE[0]) as usize][pixel], lamps[pixel]);
        own.0 = [0, 1, 2].map(|k| {
            let light = 0.5 * (behind[k] * (1.0 - lamp[3]) + lamp[k]);
            // K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016.
            let shown = (light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14);
            (255.0 * shown.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8
        });
    }
    Ok(picture.save(path)?)
}
