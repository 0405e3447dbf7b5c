//! Environment maps from pictures.

use std::path::Path;

use image::Rgb32FImage;
use lightbvh::light::MAX_RADIANCE;
use lightbvh::light::infinite::Environment;

use super::error::{SceneError, malformed};
use super::files::{Limits, Load};
use super::pictures;
use super::texels::Texels;

/// The environment map of a picture by longitude and latitude, `.hdr` or `.exr`, times `scale`: radiance in W/(m² sr). Its
/// middle column lies in direction −Z, the columns go round towards +X, its first row is above (+Y). Notes on the picture go to
/// `warnings`.
///
/// # Errors
/// [`SceneError::Malformed`] for a file that is none, or has a radiance that is none; [`SceneError::Memory`] for one that is too
/// large.
pub fn read_environment(
    path: &Path,
    scale: f32,
    limits: &Limits,
    warnings: &mut Vec<String>,
) -> Result<Environment, SceneError> {
    let name = path.display();
    let load = Load::new(None, limits)?;
    let bytes = load.read_any(path);
    let picture = bytes.and_then(|bytes| {
        // The first bytes that some programs (B. Walter's `rgbe.c`) write for the same format.
        let bytes = match bytes.strip_prefix(b"#?RGBE") {
            Some(rest) => [b"#?RADIANCE", rest].concat(),
            None => bytes,
        };
        pictures::decode(&load, &name.to_string(), &bytes, Some(path))
    });
    let mut picture = match picture {
        Err(error) if !error.ends_the_load() => {
            let problem = format!("cannot be read as an environment map: {error}");
            let advice = "name a .hdr or .exr picture by longitude and latitude";
            return Err(malformed(name.to_string(), problem, advice));
        }
        picture => picture?.into_rgb32f(),
    };
    warnings.extend(clean(&mut picture).map(|said| format!("{name}: {said}")));
    let (width, height) = picture.dimensions();
    for (x, y, pixel) in picture.enumerate_pixels() {
        let Some(own) = pixel.0.iter().find(|&&own| own * scale > MAX_RADIANCE) else {
            continue;
        };
        let problem = format!(
            "its radiance of {own:e} W/(m² sr) in column {x}, row {y} of {width} × {height}, times the factor {scale:e} of --environment-scale, \
             is more than 2^100 (1.3e30)"
        );
        let advice = "give a smaller factor, or repair the picture";
        return Err(malformed(name.to_string(), problem, advice));
    }
    let texels = Texels::of([width, height], |x, y| {
        picture.get_pixel(x, y).0.map(|own| f64::from(own * scale))
    });
    let radiance = |direction: [f32; 3]| texels.radiance(direction.map(f64::from)).map(|x| x as f32);
    let map = Environment::from_fn(texels.size, radiance);
    let map = map.map_err(|error| malformed(name.to_string(), error.to_string(), "repair the picture"))?;
    if map.map().radiance.iter().all(|radiance| *radiance == [0.0; 3]) {
        warnings.push(format!(
            "{name}: the environment map is black, as no pixel comes to 2^-100 W/(m² sr) (7.9e-31): it lights nothing"
        ));
    }
    Ok(map)
}

/// Numbers that are no light, negative, infinite or none, count as 0: filters leave negative ones, half floats make suns
/// infinite. What is said of them.
fn clean(picture: &mut Rgb32FImage) -> Option<String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_lie_where_the_picture_has_them() {
        // A picture of 4 columns and 2 rows, each pixel of a light of its own.
        let pixels: Vec<[u8; 4]> = (0..8).map(|k| [16 * (k + 1), 0, 0, 129]).collect();
        let (found, _) = read("places.hdr", &picture([4, 2], &pixels), 1.0);
        let map = found.expect("a map");
        for (direction, pixel) in [
            // The middle of the third column of four lies an eighth of a turn from −Z towards +X.
            ([1.0, 0.5, -1.0], 2),
            ([1.0, 0.5, 1.0], 3),
            ([-1.0, 0.5, -1.0], 1),
            ([-1.0, 0.5, 1.0], 0),
            ([1.0, -0.5, -1.0], 6),
            ([-1.0, -0.5, 1.0], 4),
        ] {
            let expected = f32::from(pixels[pixel][0]) / 128.0;
            assert_eq!(map.map().radiance(direction)[0], expected, "{direction:?}");
        }
    }

    /// A picture of columns and rows: mantissas, and the exponent of 2 plus 128.
    fn picture([width, height]: [usize; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
        let header = format!("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n");
        [header.as_bytes(), pixels.as_flattened()].concat()
    }

    /// A file with these bytes as an environment map, and what is said of it.
    fn read(name: &str, bytes: &[u8], scale: f32) -> (Result<Environment, String>, Vec<String>) {
        let file = std::env::temp_dir().join(format!("lightbvh-{}-{name}", std::process::id()));
        std::fs::write(&file, bytes).expect("a folder for files");
        let mut warnings = Vec::new();
        let found = read_environment(&file, scale, &Limits::default(), &mut warnings)
            .map_err(|error| error.to_string());
        let _ = std::fs::remove_file(&file);
        (found, warnings)
    }

    /// Ones: 128 / 256 · 2^(129 - 128).
    const ONE: [u8; 4] = [128, 128, 128, 129];

    #[test]
    fn files_that_are_no_map_and_light_that_is_too_much_or_none_are_named() {
        let one = |pixel| picture([1, 1], &[pixel]);
        for (bytes, scale, parts) in [
            (b"#?RADIANCE\nnothing".to_vec(), 1.0, [".hdr or .exr", "map.hdr"]),
            (one(ONE), 1e38, ["--environment-scale", "2^100"]),
            (one([128, 128, 128, 255]), 1.0, ["repair the picture", "2^100"]),
        ] {
            let error = read("map.hdr", &bytes, scale).0.expect_err(parts[0]);
            assert!(parts.iter().all(|part| error.contains(part)), "{error}");
        }
        // 1 / 2 · 2^-120 is none.
        for (pixel, scale) in [([0; 4], 1.0), ([128, 128, 128, 8], 1.0), (ONE, 1e-35)] {
            let (found, said) = read("black.hdr", &one(pixel), scale);
            assert!(
                found.is_ok() && said.len() == 1 && said[0].contains("is black"),
                "{said:?}"
            );
        }
    }

    #[test]
    fn numbers_that_are_no_light_count_as_none_and_are_named() {
        let mut picture = Rgb32FImage::from_pixel(16, 8, image::Rgb([1.0; 3]));
        for (x, y, number) in [(7, 1, -1e-6), (5, 2, f32::NAN), (3, 7, f32::INFINITY)] {
            picture.put_pixel(x, y, image::Rgb([2.0, number, 3.0]));
        }
        let said = clean(&mut picture).expect("three are none");
        assert!(said.starts_with("3 of its pixels"), "{said}");
        assert!(said.ends_with("column 7, row 1: -1e-6"), "{said}");
        for (x, y) in [(7, 1), (5, 2), (3, 7)] {
            assert_eq!(picture.get_pixel(x, y).0, [2.0, 0.0, 3.0]);
        }
        assert_eq!(clean(&mut picture), None);
    }
}
