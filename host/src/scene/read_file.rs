//! Files of bounded size.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use flate2::read::GzDecoder;

use super::error::SceneError;

/// Largest file that is read: 2 GiB, half of what a GLB header can name.
const MAX_FILE: u64 = 1 << 31;

/// First bytes of what gzip compressed.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// First bytes of what stands for a file that Git LFS keeps elsewhere.
pub(super) const POINTER: &[u8] = b"version https://git-lfs";

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
    let bytes = read_file(path)?;
    match unpacked(&path.display().to_string(), &bytes)? {
        Cow::Owned(unpacked) => Ok(unpacked),
        Cow::Borrowed(kept) if kept.len() == bytes.len() => Ok(bytes),
        Cow::Borrowed(kept) => Ok(kept.to_vec()),
    }
}

/// Where a text says that it is of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// What `bytes` hold where they are of gzip, else `bytes`, without the mark that some editors put first; `path` is for messages.
pub(super) fn unpacked<'a>(path: &str, bytes: &'a [u8]) -> Result<Cow<'a, [u8]>, SceneError> {
    let refused = |source: io::Error| SceneError::Read {
        path: path.into(),
        source,
    };
    if bytes.starts_with(POINTER) {
        let problem = "it is a pointer of Git LFS, to be replaced by `git lfs pull`";
        return Err(refused(io::Error::new(io::ErrorKind::InvalidData, problem)));
    }
    if !bytes.starts_with(&GZIP) {
        return Ok(Cow::Borrowed(bytes.strip_prefix(MARK).unwrap_or(bytes)));
    }
    let mut out = Vec::new();
    let mut decoder = GzDecoder::new(bytes).take(MAX_FILE + 1);
    decoder.read_to_end(&mut out).map_err(refused)?;
    if out.len() as u64 > MAX_FILE {
        let problem = "larger than 2 GiB when unpacked";
        return Err(refused(io::Error::new(io::ErrorKind::FileTooLarge, problem)));
    }
    if out.starts_with(MARK) {
        out.drain(..MARK.len());
    }
    Ok(Cow::Owned(out))
}
