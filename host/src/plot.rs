//! Pictures as data URLs.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::{ExtendedColorType, ImageFormat};

use crate::render::FilmError;

/// `data:image/png;base64,…` of 8-bit pixels by rows.
///
/// # Errors
/// [`FilmError::Encode`] for pixels that do not fit the size, and an empty picture.
pub fn png_url(
    bytes: &[u8],
    (width, height): (u32, u32),
    color: ExtendedColorType,
) -> Result<String, FilmError> {
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
