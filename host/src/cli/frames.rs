//! Ranges of frames on the command line, and files that are numbered by frame.

use std::ops::Range;
use std::path::{Path, PathBuf};

/// Most frames of one animation.
const MAX_FRAMES: u32 = 100_000;

/// Frames `A..B`, B left out.
pub(super) fn parse(text: &str) -> Result<Range<u32>, String> {
    let parsed = text
        .split_once("..")
        .and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    match parsed {
        Some(range) if range.is_empty() => {
            Err("the last frame must come after the first: A..B without B".to_owned())
        }
        Some(range) if range.len() > MAX_FRAMES as usize => Err(format!("more than {MAX_FRAMES} frames")),
        Some(range) => Ok(range),
        None => Err("expected two frame numbers as A..B, for example 0..150".to_owned()),
    }
}

/// `path/name.png` as `path/name-0007.png`.
pub(super) fn numbered(path: &Path, frame: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut name = format!("{stem}-{frame:04}");
    if let Some(extension) = path.extension() {
        name.push('.');
        name.push_str(&extension.to_string_lossy());
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_of_frames() {
        assert_eq!(parse("0..150"), Ok(0..150));
        assert_eq!(parse("7..8"), Ok(7..8));
        for wrong in ["5", "..5", "5..5", "6..5", "-1..5", "a..b", "0..100001"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
