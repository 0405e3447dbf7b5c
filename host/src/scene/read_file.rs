//! Files of bounded size.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use flate2::read::GzDecoder;

use super::error::SceneError;

/// Largest file that is read: 2 GiB, half of what a GLB header can name.
const MAX_FILE: u64 = 1 << 31;

/// First bytes of what gzip compressed.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Reads a regular file of bounded size: a pipe or device named by a hostile file could go on for ever.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, SceneError> {
    let read = || {
        let metadata = std::fs::metadata(path)?;
        if !metadata.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
        }
        if metadata.len() > MAX_FILE {
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, "larger than 2 GiB"));
        }
        let mut bytes = Vec::new();
        File::open(path)?.take(MAX_FILE).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    read().map_err(|source| SceneError::Read {
        path: path.to_owned(),
        source,
    })
}

/// The same, unpacked where gzip compressed it.
pub(super) fn read_unpacked(path: &Path) -> Result<Vec<u8>, SceneError> {
    unpacked(read_file(path)?).map_err(|source| SceneError::Read {
        path: path.to_owned(),
        source,
    })
}

/// What `bytes` hold where they are of gzip, else `bytes`.
pub(super) fn unpacked(bytes: Vec<u8>) -> io::Result<Vec<u8>> {
    if !bytes.starts_with(&GZIP) {
        return Ok(bytes);
    }
    let mut out = Vec::new();
    GzDecoder::new(bytes.as_slice())
        .take(MAX_FILE + 1)
        .read_to_end(&mut out)?;
    if out.len() as u64 > MAX_FILE {
        return Err(io::Error::new(
            io::ErrorKind::FileTooLarge,
            "larger than 2 GiB when unpacked",
        ));
    }
    Ok(out)
}
