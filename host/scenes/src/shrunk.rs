//! Pictures of skies brought down to what an environment map holds: it is known by places, and of pixels smaller than those
//! some had been missed.

use image::Rgb32FImage;

/// Most columns and rows that places of an environment map tell well.
const COLUMNS: u32 = 2048;
const ROWS: u32 = 1024;

/// Numbers that are no light, negative, infinite or none, count as 0: filters leave negative ones, half floats make suns
/// infinite. What is said of them.
pub(super) fn clean(picture: &mut Rgb32FImage) -> Option<String> {
    let is_light = |x: f32| (0.0..=f32::MAX).contains(&x);
    let mut first = None;
    let mut count = 0_u64;
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let Some(&wrong) = pixel.0.iter().find(|&&own| !is_light(own)) else {
            continue;
        };
        count += 1;
        first.get_or_insert((x, y, wrong));
        pixel.0 = pixel.0.map(|own| if is_light(own) { own } else { 0.0 });
    }
    let (x, y, wrong) = first?;
    Some(format!(
        "{count} of its pixels have a number that is no light and counts as 0, the first in column {x}, row {y}: {wrong:e}"
    ))
}

/// The picture in at most 2048 columns, and half as many rows: each pixel's light goes to those of the smaller
/// picture that it lies in, by solid angle. All its numbers are [`clean`].
pub(super) fn shrunk(picture: Rgb32FImage) -> Rgb32FImage {
    let (width, height) = picture.dimensions();
    let (to_width, to_height) = (width.min(COLUMNS), height.min(ROWS));
    if (to_width, to_height) == (width, height) {
        return picture;
    }
    let angle = |y: u32| libm::sin(std::f64::consts::PI * (f64::from(y) + 0.5) / f64::from(height));
    let columns: Vec<Vec<(u32, f64)>> = (0..width).map(|x| parts(x, width, to_width)).collect();
    let mut sums = vec![[0.0_f64; 4]; to_width as usize * to_height as usize];
    for y in 0..height {
        let below = parts(y, height, to_height);
        for (x, across) in (0..width).zip(&columns) {
            let pixel = picture.get_pixel(x, y).0.map(f64::from);
            for &(row, down) in &below {
                for &(column, over) in across {
                    let own = &mut sums[row as usize * to_width as usize + column as usize];
                    let share = down * over * angle(y);
                    (0..3).for_each(|k| own[k] += share * pixel[k]);
                    own[3] += share;
                }
            }
        }
    }
    let of = |x: u32, y: u32| {
        let [r, g, b, all] = sums[y as usize * to_width as usize + x as usize];
        image::Rgb([r, g, b].map(|sum| (sum / all) as f32))
    };
    Rgb32FImage::from_fn(to_width, to_height, of)
}

/// Where pixel `at` of `count` lies in a line of `to` pixels, no more of them: each with the part of it that lies there.
fn parts(at: u32, count: u32, to: u32) -> Vec<(u32, f64)> {
    // In parts of 1 / (count * to) of the line.
    let (from, end) = (u64::from(at) * u64::from(to), (u64::from(at) + 1) * u64::from(to));
    let count = u64::from(count);
    let (first, last) = (from / count, (end - 1) / count);
    (first..=last)
        .map(|cell| {
            let own = end.min((cell + 1) * count) - from.max(cell * count);
            (cell as u32, own as f64 / f64::from(to))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a sky sends in all: W/m² on a sphere of that section.
    fn sent(picture: &Rgb32FImage) -> f64 {
        let (width, height) = picture.dimensions();
        let of = |y: u32| libm::sin(std::f64::consts::PI * (f64::from(y) + 0.5) / f64::from(height));
        let pixels = picture.enumerate_pixels();
        let sum: f64 = pixels.map(|(_, y, pixel)| f64::from(pixel.0[1]) * of(y)).sum();
        sum / (f64::from(width) * f64::from(height))
    }

    #[test]
    fn single_pixels_keep_their_light() {
        for (width, height) in [(4096, 2048), (5000, 2500), (8192, 4096)] {
            for (x, y) in [(0, 700), (2617, 400), (308, 1383), (width - 1, height - 1)] {
                let mut picture = Rgb32FImage::new(width, height);
                picture.put_pixel(x, y, image::Rgb([0.0, 131_072.0, 0.0]));
                let before = sent(&picture);
                let after = shrunk(picture);
                assert_eq!(after.dimensions(), (2048, 1024));
                // Rows differ in their solid angle by less than this but for those next to a pole.
                let tolerance = if y + 1 == height { 0.6 } else { 0.005 };
                assert!((sent(&after) / before - 1.0).abs() < tolerance, "{width} {x} {y}");
            }
        }
    }

    #[test]
    fn even_skies_stay_even_and_small_ones_as_they_are() {
        let even = Rgb32FImage::from_pixel(5001, 2503, image::Rgb([2.0, 3.0, 5.0]));
        assert!(shrunk(even).pixels().all(|pixel| pixel.0 == [2.0, 3.0, 5.0]));
        let small = Rgb32FImage::from_fn(300, 150, |x, y| image::Rgb([x as f32, y as f32, 1.0]));
        assert_eq!(shrunk(small.clone()), small);
    }

    #[test]
    fn what_is_no_light_counts_as_none_and_is_named() {
        let mut picture = Rgb32FImage::from_pixel(4096, 2048, image::Rgb([1.0; 3]));
        assert_eq!(clean(&mut picture), None);
        for (x, y, number) in [(7, 9, -1e-6), (5, 10, f32::NAN), (3, 2000, f32::INFINITY)] {
            picture.put_pixel(x, y, image::Rgb([2.0, number, 3.0]));
        }
        let said = clean(&mut picture).expect("three are none");
        assert!(
            said.starts_with("3 of its pixels") && said.ends_with("column 7, row 9: -1e-6"),
            "{said}"
        );
        for (x, y) in [(7, 9), (5, 10), (3, 2000)] {
            assert_eq!(picture.get_pixel(x, y).0, [2.0, 0.0, 3.0]);
        }
        assert_eq!(clean(&mut picture), None);
    }
}
