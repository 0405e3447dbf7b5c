//! Files, and errors that name them.

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

/// Writes a file.
///
/// # Errors
/// Names the file when it cannot be written.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    fs::write(path, bytes).map_err(cannot("write", path))
}

/// The bytes of a file of SPIR-V words (little endian).
#[must_use]
pub fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}
