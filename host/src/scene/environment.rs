//! Environment maps from pictures.

use std::path::Path;

use image::{ImageReader, Limits};
use lightbvh::light::infinite::{Environment, MAX_LEVELS};

use super::error::SceneError;

/// Most columns and rows of a picture, and bytes that it may take in memory.
const MOST: u32 = 1 << 14;
const MOST_BYTES: u64 = 1 << 31;

/// The environment map of a picture by longitude and latitude, `.hdr` or `.exr`, times `scale`: radiance in W/(m² sr). Its middle column lies in
/// direction −Z, the columns go round towards +X, its first row is above (+Y).
///
/// # Errors
/// [`SceneError::Invalid`] for a file that is none, or too large, or has a radiance that is none.
pub fn read_environment(path: &Path, scale: f32) -> Result<Environment, SceneError> {
    let invalid = |problem: String| SceneError::Invalid {
        scene: path.display().to_string(),
        problem,
    };
    let unread = |error: &dyn std::fmt::Display| {
        invalid(format!(
            "cannot be read as an environment map: {error}; name a .hdr or .exr picture by longitude and latitude"
        ))
    };
    let mut reader = ImageReader::open(path).map_err(|error| unread(&error))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST);
    limits.max_image_height = Some(MOST);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| unread(&error))?.into_rgb32f();
    let (width, height) = picture.dimensions();
    if width == 0 || height == 0 {
        return Err(invalid(String::from(
            "has no pixels; export the environment map again",
        )));
    }
    // About as many texels as pixels.
    let side = (f64::from(width) * f64::from(height)).sqrt().ceil() as u32;
    let size = side.next_power_of_two().clamp(1, 1 << MAX_LEVELS);
    let at = |direction| {
        let [x, y] = place(direction, [width, height]);
        picture.get_pixel(x, y).0.map(|channel| channel * scale)
    };
    Environment::from_fn(size, at).map_err(|error| invalid(error.to_string()))
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

    #[test]
    fn what_is_no_picture_is_named() {
        let file = std::env::temp_dir().join("lightbvh-no-picture.hdr");
        std::fs::write(&file, b"#?RADIANCE\nnothing").expect("a folder for files");
        let error = read_environment(&file, 1.0).expect_err("no picture").to_string();
        assert!(error.contains(".hdr or .exr"), "{error}");
        let _ = std::fs::remove_file(&file);
    }
}
