//! Files of words, written whole or not at all.

use std::path::Path;
use std::{fs, io};

use crate::Error;

/// The error of something that was tried with a file: "read", "write", ..
pub(crate) fn cannot(action: &str, path: &Path) -> impl FnOnce(io::Error) -> Error {
    move |source| Error(format!("cannot {action} {}: {source}", path.display()))
}

/// Reads a file.
///
/// # Errors
/// Names the file when it cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, Error> {
    fs::read(path).map_err(cannot("read", path))
}

/// Replaces a file: writes a temporary beside it, then renames, so that no reader sees half of it.
///
/// # Errors
/// Names the file when it cannot be written; the old one is then untouched.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    fs::write(&temporary, bytes)
        .and_then(|()| fs::rename(&temporary, path))
        .inspect_err(|_| {
            // Best effort: the error that matters is the first one.
            let _ = fs::remove_file(&temporary);
        })
        .map_err(cannot("write", path))
}

/// SPIR-V words from the bytes of a file (little endian), or `None` when the length is no multiple of four.
#[must_use]
pub fn words(bytes: &[u8]) -> Option<Vec<u32>> {
    let (words, rest) = bytes.as_chunks::<4>();
    rest.is_empty()
        .then(|| words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

/// The bytes of a file of SPIR-V words (little endian).
#[must_use]
pub fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}
