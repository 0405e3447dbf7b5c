//! Environment maps from pictures.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits};
use lightbvh::light::MAX_RADIANCE;
use lightbvh::light::infinite::{Environment, EnvironmentError, MAX_LEVELS};

use super::error::SceneError;
use super::radiance_hdr;
use super::read_file::read_file;
use super::shrunk::{clean, shrunk};

/// Most columns and rows of a picture, and bytes that it may take in memory.
const MOST: u32 = 1 << 14;
const MOST_BYTES: u64 = 1 << 31;

/// The environment map of a picture by longitude and latitude, `.hdr` or `.exr`, times `scale`: radiance in W/(m² sr). Its middle column lies in
/// direction −Z, the columns go round towards +X, its first row is above (+Y). Pixels of `.hdr` pictures are divided by their `EXPOSURE` and
/// `COLORCORR`. What is said of the picture goes to `warnings`.
///
/// # Errors
/// [`SceneError::Invalid`] for a file that is none, or too large, or has a radiance that is none.
pub fn read_environment(
    path: &Path,
    scale: f32,
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
    let bytes = radiance_hdr::with_signature(read_file(path).map_err(|error| unread(&error))?);
    let header = radiance_hdr::read(&bytes)
        .transpose()
        .map_err(|problem| unread(&problem))?;
    let format = ImageFormat::from_path(path).map_err(|error| unread(&error))?;
    let mut reader = ImageReader::with_format(Cursor::new(&bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST);
    limits.max_image_height = Some(MOST);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let mut picture = reader.decode().map_err(|error| unread(&error))?.into_rgb32f();
    let said = clean(&mut picture).map(|said| format!("{}: {said}", path.display()));
    warnings.extend(said);
    let picture = shrunk(picture, false);
    let (width, height) = picture.dimensions();
    if width == 0 || height == 0 {
        return Err(invalid(String::from(
            "has no pixels; export the environment map again",
        )));
    }
    // About as many texels as pixels.
    let side = (f64::from(width) * f64::from(height)).sqrt().ceil() as u32;
    let size = side.next_power_of_two().clamp(1, 1 << MAX_LEVELS);
    let numbers = |direction| {
        let [x, y] = place(direction, [width, height]);
        picture.get_pixel(x, y).0
    };
    let light = |direction| match &header {
        Some(header) => header.light_of(numbers(direction)),
        None => numbers(direction),
    };
    let map = Environment::from_fn(size, |direction| light(direction).map(|channel| channel * scale));
    let map = map.map_err(|error| {
        let EnvironmentError::Radiance {
            direction, channel, ..
        } = error
        else {
            return invalid(error.to_string());
        };
        // Of what makes it too much, the first.
        let is_sound = |x: f32| (0.0..=MAX_RADIANCE).contains(&x);
        let [number, light] = [numbers(direction), light(direction)].map(|pixel| pixel[channel]);
        invalid(if is_sound(light) {
            format!(
                "its radiance of {light:e} W/(m² sr) times the factor {scale:e} of --environment-scale (in a list of `gallery`, \
                 environment_scale) is more than 2^100 (1.3e30); give a smaller factor"
            )
        } else if is_sound(number) {
            format!(
                "its pixel of {number:e}, divided by its EXPOSURE and COLORCORR, is more than 2^100 W/(m² sr) (1.3e30); repair those lines"
            )
        } else {
            error.to_string()
        })
    })?;
    let name = path.display();
    if header.is_some_and(|header| header.has_other_primaries) {
        warnings.push(format!(
            "{name}: its PRIMARIES are not those of sRGB, and its numbers are taken as if they were"
        ));
    }
    if map.map().radiance.iter().all(|radiance| *radiance == [0.0; 3]) {
        warnings.push(format!(
            "{name}: the environment map is black, as no pixel comes to 2^-100 W/(m² sr) (7.9e-31): it lights nothing"
        ));
    }
    Ok(map)
}

/// The pixel of a picture by longitude and latitude that a unit direction lies in.
fn place([x, y, z]: [f32; 3], [width, height]: [u32; 2]) -> [u32; 2] {
    let turns = libm::atan2(f64::from(x), f64::from(-z)) / std::f64::consts::TAU + 0.5;
    let down = libm::acos(f64::from(y.clamp(-1.0, 1.0))) / std::f64::consts::PI;
    let pixel = |part: f64, count: u32| ((part * f64::from(count)) as u32).min(count - 1);
    [pixel(turns, width), pixel(down, height)]
}

#[cfg(test)]
mod tests {
    use super::super::radiance_hdr::tests::picture;
    use super::*;

    #[test]
    fn directions_lie_where_the_picture_has_them() {
        let size = [400, 200];
        assert_eq!(place([0.0, 0.0, -1.0], size), [200, 100]);
        assert_eq!(place([1.0, 0.0, 0.0], size), [300, 100]);
        assert_eq!(place([-1.0, 0.0, 0.0], size), [100, 100]);
        assert_eq!(place([0.0, 1.0, 0.0], size)[1], 0);
        assert_eq!(place([0.0, -1.0, 0.0], size)[1], 199);
    }

    /// A file with these bytes as an environment map, and what is said of it.
    fn read(name: &str, bytes: &[u8], scale: f32) -> (Result<Environment, String>, Vec<String>) {
        let file = std::env::temp_dir().join(format!("lightbvh-{}-{name}", std::process::id()));
        std::fs::write(&file, bytes).expect("a folder for files");
        let mut warnings = Vec::new();
        let found = read_environment(&file, scale, &mut warnings).map_err(|error| error.to_string());
        let _ = std::fs::remove_file(&file);
        (found, warnings)
    }

    #[test]
    fn what_is_no_picture_is_named() {
        let (found, _) = read("no-picture.hdr", b"#?RADIANCE\nnothing", 1.0);
        let error = found.expect_err("no picture");
        assert!(error.contains(".hdr or .exr"), "{error}");
        let missing = read_environment(Path::new("missing.hdr"), 1.0, &mut Vec::new());
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
        let (_, said) = read(
            "primaries.hdr",
            &picture("PRIMARIES=0.7 0.3 0.2 0.8 0.1 0.05 0.3 0.3\n", &[ONE]),
            1.0,
        );
        assert!(said.len() == 1 && said[0].contains("PRIMARIES"), "{said:?}");
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
