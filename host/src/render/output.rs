//! Files that are whole or not there.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Held while a temporary file exists.
static WRITING: Mutex<()> = Mutex::new(());

/// Runs `work`, which makes and removes a temporary file, or which ends the program: one at a time, so that none is left.
pub fn uninterrupted<T>(work: impl FnOnce() -> T) -> T {
    let _held = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
    work()
}

/// Writes `bytes` to a temporary file in the folder of `path` and renames it: nobody sees half a file, and a failure
/// changes nothing. Follows links. Writes pipes and devices directly.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let Some(path) = real_path(path)? else {
        return fs::write(path, bytes);
    };
    let name = path
        .file_name()
        .ok_or_else(|| Error::new(ErrorKind::InvalidInput, "the path names no file"))?;
    let mut temporary_name = OsString::from(".");
    temporary_name.push(name);
    temporary_name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(temporary_name);
    uninterrupted(|| {
        let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, &path));
        if written.is_err() {
            // Best effort: the first error is the one to report.
            let _ = fs::remove_file(&temporary);
        }
        written
    })
}

/// The path of the file itself, links followed; `None` for a pipe or a device.
pub fn real_path(path: &Path) -> io::Result<Option<PathBuf>> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(Error::new(ErrorKind::IsADirectory, "it is a folder")),
        Ok(found) if !found.is_file() => Ok(None),
        Ok(_) => fs::canonicalize(path).map(Some),
        Err(_) if path.is_symlink() => Err(Error::new(
            ErrorKind::NotFound,
            "it is a link to a file that does not exist; make that file, or remove the link",
        )),
        Err(_) => Ok(Some(path.to_owned())),
    }
}
