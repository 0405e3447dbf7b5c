//! Files to write, looked at before there is anything to write: a mistyped name is told at once, not after minutes of work.

use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

use crate::error::HostError;
use crate::render::{FilmError, write_whole};

/// Whether a path ends so, in letters of either case.
pub(super) fn ends_in(path: &Path, endings: &[&str]) -> bool {
    let is_own = |own: &std::ffi::OsStr| endings.iter().any(|ending| own.eq_ignore_ascii_case(ending));
    path.extension().is_some_and(is_own)
}

/// Makes a folder for output where it is not there.
pub(super) fn folder(path: &Path) -> std::result::Result<(), HostError> {
    fs::create_dir_all(path).map_err(|source| HostError::Folder {
        path: path.to_owned(),
        source,
    })
}

/// Writes a file of a report; it appears whole or not at all.
pub(super) fn store(path: &Path, bytes: &[u8]) -> std::result::Result<(), HostError> {
    write_whole(path, bytes).map_err(|source| HostError::Store {
        path: path.to_owned(),
        source,
    })
}

/// Whether a file may be written there: its folder is one, and it is none itself.
pub(super) fn check(path: &Path) -> Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    match (path.is_dir(), folder.is_none_or(Path::is_dir)) {
        (true, _) => Err(Error::new(ErrorKind::IsADirectory, "it is a folder")),
        (false, false) => Err(Error::new(ErrorKind::NotFound, "its folder is not there")),
        (false, true) => Ok(()),
    }
}

/// Whether a picture may be written there.
pub(super) fn picture(path: &Path) -> std::result::Result<(), FilmError> {
    let path = path.to_owned();
    if !ends_in(&path, &["png", "exr"]) {
        return Err(FilmError::Format { path });
    }
    check(&path).map_err(|source| FilmError::Write { path, source })
}
