//! Files to write, looked at before there is anything to write: a mistyped name is told at once, not after minutes of work.

use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

use crate::error::HostError;
use crate::render::{FilmError, real_path, uninterrupted, write_whole};

/// Whether a path ends so, in letters of either case.
pub(super) fn ends_in(path: &Path, endings: &[&str]) -> bool {
    let is_own = |own: &std::ffi::OsStr| endings.iter().any(|ending| own.eq_ignore_ascii_case(ending));
    path.extension().is_some_and(is_own)
}

/// Makes a folder for output where it is not there, and writes to it.
pub(super) fn folder(path: &Path) -> std::result::Result<(), HostError> {
    let made = match path.is_file() {
        true => Err(Error::new(ErrorKind::AlreadyExists, "it is a file")),
        false => fs::create_dir_all(path),
    };
    let path = || path.to_owned();
    made.map_err(|source| HostError::Folder { path: path(), source })?;
    writable(&path()).map_err(|source| HostError::Store { path: path(), source })
}

/// Writes a file of a report; it appears whole or not at all.
pub(super) fn store(path: &Path, bytes: &[u8]) -> std::result::Result<(), HostError> {
    let path = path.to_owned();
    write_whole(&path, bytes).map_err(|source| HostError::Store { path, source })
}

/// Whether files can be written to a folder: only writing tells.
fn writable(folder: &Path) -> Result<()> {
    let trial = folder.join(format!(".lightbvh.{}.tmp", std::process::id()));
    uninterrupted(|| fs::write(&trial, b"").and_then(|()| fs::remove_file(&trial)))
}

/// Whether a file can be written there: its folder is one, and can be written to, and it is none itself. Links are followed; a pipe
/// or a device is written directly.
pub(super) fn check(path: &Path) -> Result<()> {
    let Some(path) = real_path(path)? else {
        return Ok(());
    };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    match fs::metadata(folder) {
        Ok(found) if found.is_dir() => writable(folder).map_err(|error| {
            Error::new(
                error.kind(),
                format!("nothing can be written to its folder: {error}"),
            )
        }),
        Ok(_) => Err(Error::new(
            ErrorKind::NotADirectory,
            "what its folder should be is a file",
        )),
        Err(error) => Err(Error::new(error.kind(), format!("its folder: {error}"))),
    }
}

/// Whether a picture can be written there.
pub(super) fn picture(path: &Path) -> std::result::Result<(), FilmError> {
    let path = path.to_owned();
    if !ends_in(&path, &["png", "exr"]) {
        return Err(FilmError::Format { path });
    }
    check(&path).map_err(|source| FilmError::Write { path, source })
}
