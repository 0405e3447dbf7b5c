//! Environment maps from pictures.

use std::path::Path;

use lightbvh::light::MAX_RADIANCE;
use lightbvh::light::infinite::Environment;

use super::error::SceneError;
use super::files::{Limits, Load};
use super::shrunk::{clean, shrunk};
use super::texels::{Texels, size_for};
use super::{pictures, radiance_hdr};

/// The environment map of a picture by longitude and latitude, `.hdr` or `.exr`, times `scale`: radiance in W/(m² sr). Its
/// middle column lies in direction −Z, the columns go round towards +X, its first row is above (+Y). Pixels of `.hdr` pictures
/// are divided by their `EXPOSURE` and `COLORCORR`. What is said of the picture goes to `warnings`.
///
/// # Errors
/// [`SceneError::Invalid`] for a file that is none, or has a radiance that is none; [`SceneError::Memory`] for one that is too
/// large.
pub fn read_environment(
    path: &Path,
    scale: f32,
    limits: &Limits,
    warnings: &mut Vec<String>,
) -> Result<Environment, SceneError> {
    let invalid = |problem: String| SceneError::Invalid {
        scene: path.display().to_string(),
        problem,
    };
    let unread = |error: &dyn std::fmt::Display| {
        invalid(format!(
            "cannot be read as an environment map: {error}; name a .hdr or .exr picture by longitude and latitude"
        ))
    };
    let load = Load::new(None, limits)?;
    let bytes = radiance_hdr::with_signature(load.read_any(path).map_err(|error| unread(&error))?);
    let divisors = radiance_hdr::divisors(&bytes).map_err(|problem| unread(&problem))?;
    let decoded = pictures::decode(&load, &path.display().to_string(), &bytes, Some(path));
    let mut picture = match decoded {
        Err(error) if error.ends_the_load() => return Err(error),
        decoded => decoded.map_err(|error| unread(&error))?.into_rgb32f(),
    };
    let said = clean(&mut picture).map(|said| format!("{}: {said}", path.display()));
    warnings.extend(said);
    let picture = shrunk(picture);
    let (width, height) = picture.dimensions();
    if width == 0 || height == 0 {
        return Err(invalid(String::from(
            "has no pixels; export the environment map again",
        )));
    }
    let light = |numbers| radiance_hdr::divided(numbers, divisors);
    let is_sound = |x: &f32| (0.0..=MAX_RADIANCE).contains(x);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let own = light(pixel.0);
        let Some(channel) = own.iter().position(|x| !is_sound(&(x * scale))) else {
            continue;
        };
        // Of what makes it too much, the first.
        let at = format!("column {x}, row {y} of {width} × {height}");
        let [number, own] = [pixel.0[channel], own[channel]];
        return Err(invalid(if is_sound(&own) {
            format!(
                "its radiance of {own:e} W/(m² sr) in {at} times the factor {scale:e} of --environment-scale is more than 2^100 (1.3e30); give a smaller factor"
            )
        } else if is_sound(&number) {
            format!(
                "its pixel of {number:e} in {at}, divided by its EXPOSURE and COLORCORR, is more than 2^100 W/(m² sr) (1.3e30); repair those lines"
            )
        } else {
            format!(
                "its pixel of {number:e} in {at} is more than 2^100 W/(m² sr) (1.3e30); repair the picture"
            )
        }));
    }
    let size = size_for([width, height]);
    let mut texels = Texels::new(size);
    texels.add_longitude_latitude(
        [width, height],
        |x, y| light(picture.get_pixel(x, y).0).map(|own| f64::from(own * scale)),
        of_picture,
    );
    let map = Environment::from_fn(size, |direction| {
        // Every texel has a place, so nothing else is asked.
        let own = texels.radiance(direction.map(f64::from), || [0.0; 3]);
        own.map(|x| x as f32)
    });
    let map = map.map_err(|error| invalid(error.to_string()))?;
    let name = path.display();
    if map.map().radiance.iter().all(|radiance| *radiance == [0.0; 3]) {
        warnings.push(format!(
            "{name}: the environment map is black, as no pixel comes to 2^-100 W/(m² sr) (7.9e-31): it lights nothing"
        ));
    }
    Ok(map)
}

/// The direction of what lies in direction (x, y, z) of a picture whose first row is about +z and whose first column goes from
/// +x to +y.
fn of_picture([x, y, z]: [f64; 3]) -> [f64; 3] {
    [-y, z, x]
}

#[cfg(test)]
mod tests {
    use super::super::radiance_hdr::tests::{picture, picture_of};
    use super::*;

    #[test]
    fn directions_lie_where_the_picture_has_them() {
        // A picture of 4 columns and 2 rows, each pixel of a light of its own.
        let pixels: Vec<[u8; 4]> = (0..8).map(|k| [16 * (k + 1), 0, 0, 129]).collect();
        let (found, _) = read("places.hdr", &picture_of("", [4, 2], &pixels), 1.0);
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
            assert_eq!(map.radiance(direction)[0], expected, "{direction:?}");
        }
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

    #[test]
    fn what_is_no_picture_is_named() {
        let (found, _) = read("no-picture.hdr", b"#?RADIANCE\nnothing", 1.0);
        let error = found.expect_err("no picture");
        assert!(error.contains(".hdr or .exr"), "{error}");
        let missing = read_environment(Path::new("missing.hdr"), 1.0, &Limits::default(), &mut Vec::new());
        let error = missing.expect_err("no file").to_string();
        assert!(error.contains("missing.hdr"), "{error}");
    }

    /// Ones: 128 / 256 · 2^(129 - 128).
    const ONE: [u8; 4] = [128, 128, 128, 129];

    #[test]
    fn pixels_are_divided_by_their_exposure() {
        for (lines, expected) in [
            ("", [3.0; 3]),
            ("EXPOSURE=2\nEXPOSURE=0.25\n", [6.0; 3]),
            ("EXPOSURE=1e-20\n", [3e20; 3]),
            ("COLORCORR=1 2 4\n", [3.0, 1.5, 0.75]),
        ] {
            let (found, said) = read("exposure.hdr", &picture(lines, &[ONE; 8]), 3.0);
            let map = found.expect("a map");
            for radiance in map.map().radiance {
                for (found, expected) in radiance.iter().zip(expected) {
                    // A mean of 16 that are the same, rounded once more.
                    assert!((found / expected - 1.0).abs() < 1e-6, "{lines}: {radiance:?}");
                }
            }
            assert_eq!(said, [""; 0], "{lines}");
        }
    }

    #[test]
    fn what_makes_light_too_much_is_named() {
        for (lines, pixel, scale, what) in [
            ("", ONE, 1e38, "--environment-scale"),
            ("EXPOSURE=1e-38\n", ONE, 1.0, "EXPOSURE"),
            ("", [128, 128, 128, 255], 1.0, "repair the picture"),
        ] {
            let (found, _) = read("bright.hdr", &picture(lines, &[pixel]), scale);
            let error = found.expect_err(what);
            assert!(error.contains(what) && error.contains("2^100"), "{error}");
        }
    }

    #[test]
    fn maps_without_light_are_named() {
        // 1 / 2 · 2^-120.
        for (pixel, scale) in [([0; 4], 1.0), ([128, 128, 128, 8], 1.0), (ONE, 1e-35)] {
            let (found, said) = read("black.hdr", &picture("", &[pixel]), scale);
            assert!(found.is_ok());
            assert!(said.len() == 1 && said[0].contains("is black"), "{said:?}");
        }
    }
}
