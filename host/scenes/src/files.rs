//! What a load may read, and how much memory it may take. Every file of a scene comes through here.

use std::cell::Cell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::error::{SceneError, sentence};

/// First bytes of what stands for a file that Git LFS keeps elsewhere.
pub(super) const POINTER: &[u8] = b"version https://git-lfs";

/// What a load may read beyond its own folder, and how much memory it may take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most bytes of each file, and of decoded pictures, unpacked streams, elements, instances and frames together.
    pub memory: u64,
    /// One more folder that files of a scene may lie in.
    pub read_from: Option<PathBuf>,
}

impl Default for Limits {
    /// 2 GiB, and no other folder.
    fn default() -> Self {
        Self {
            memory: 1 << 31,
            read_from: None,
        }
    }
}

/// The folders and the memory of one load.
#[derive(Debug)]
pub(super) struct Load {
    /// Where relative paths start; `None`: nothing is read.
    folder: Option<PathBuf>,
    /// The folders that files may lie in, without links.
    permitted: Vec<PathBuf>,
    memory: u64,
    left: Cell<u64>,
}

impl Load {
    /// A load of a scene that lies in `folder`.
    pub fn new(folder: Option<&Path>, limits: &Limits) -> Result<Self, SceneError> {
        // `a.gltf` lies in the folder of an empty name.
        let folder = folder.map(|folder| match folder.as_os_str().is_empty() {
            true => PathBuf::from("."),
            false => folder.to_owned(),
        });
        // A scene in a folder that is not there is not read.
        let own = folder.as_ref().and_then(|folder| fs::canonicalize(folder).ok());
        let other = limits.read_from.as_ref().map(|folder| {
            let real = fs::canonicalize(folder);
            real.map_err(|source| unread(folder, source))
        });
        Ok(Self {
            permitted: own.into_iter().chain(other.transpose()?).collect(),
            folder,
            memory: limits.memory,
            left: Cell::new(limits.memory),
        })
    }

    /// Where relative paths of the scene's file start.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Bytes that are left of the memory.
    pub fn left(&self) -> u64 {
        self.left.get()
    }

    /// Checks that so many bytes are left for `what`, which is at `place`.
    ///
    /// # Errors
    /// [`SceneError::Memory`].
    pub fn check(&self, place: &str, what: &str, bytes: u64) -> Result<(), SceneError> {
        if bytes > self.left() {
            let numbers = [bytes, self.left(), self.memory];
            return Err(SceneError::Memory(format!("{place}: {what}"), numbers));
        }
        Ok(())
    }

    /// The same, and takes them for the rest of the load.
    pub fn take(&self, place: &str, what: &str, bytes: u64) -> Result<(), SceneError> {
        self.check(place, what, bytes)?;
        self.left.set(self.left() - bytes);
        Ok(())
    }

    /// Reads a file that a scene names.
    ///
    /// # Errors
    /// [`SceneError::Outside`], [`SceneError::Memory`], [`SceneError::Read`].
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, SceneError> {
        self.read_any(&self.real(path)?)
    }

    /// The path without links of a file that a scene names. It lies in a permitted folder, or below it.
    pub fn real(&self, path: &Path) -> Result<PathBuf, SceneError> {
        let real = fs::canonicalize(path).map_err(|source| unread(path, source))?;
        match self.permitted.iter().any(|folder| real.starts_with(folder)) {
            true => Ok(real),
            false => Err(SceneError::Outside(path.to_owned())),
        }
    }

    /// Reads a regular file, which the user named: a pipe or a device could go on for ever.
    pub fn read_any(&self, path: &Path) -> Result<Vec<u8>, SceneError> {
        let open = || {
            let metadata = fs::metadata(path)?;
            if !metadata.is_file() {
                return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
            }
            Ok((File::open(path)?, metadata.len()))
        };
        let (file, length) = open().map_err(|source| unread(path, source))?;
        self.check(&path.display().to_string(), "the file", length)?;
        let mut bytes = Vec::new();
        file.take(self.left())
            .read_to_end(&mut bytes)
            .map_err(|source| unread(path, source))?;
        Ok(bytes)
    }
}

fn unread(path: &Path, source: io::Error) -> SceneError {
    SceneError::Read(sentence(path.to_string_lossy()).into(), source)
}

/// `bytes` of a text file without the mark of UTF-8 that some editors put first; `path` is for messages.
pub(super) fn without_mark<'a>(path: &str, bytes: &'a [u8]) -> Result<&'a [u8], SceneError> {
    if bytes.starts_with(POINTER) {
        let problem = "it is a pointer of Git LFS, to be replaced by `git lfs pull`";
        let error = io::Error::new(io::ErrorKind::InvalidData, problem);
        return Err(unread(Path::new(path), error));
    }
    Ok(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_outside(found: Result<Vec<u8>, SceneError>) -> bool {
        let text = found.as_ref().map_or_else(ToString::to_string, |_| String::new());
        let is_named = text.contains("secret") && text.contains("--read-from");
        matches!(found, Err(SceneError::Outside { .. })) && is_named
    }

    #[test]
    fn files_lie_in_permitted_folders() {
        let top = std::env::temp_dir().join(format!("lightbvh-files-{}", std::process::id()));
        let (own, other) = (top.join("scene"), top.join("other"));
        for folder in [own.join("below"), other.clone()] {
            fs::create_dir_all(folder).expect("a folder");
        }
        let secret = top.join("other/secret");
        for file in [&own.join("a"), &own.join("below/b"), &secret] {
            fs::write(file, "bytes of it").expect("a file");
        }
        let load = |read_from: Option<&Path>| {
            let limits = Limits {
                read_from: read_from.map(Path::to_owned),
                ..Limits::default()
            };
            Load::new(Some(&own), &limits).expect("folders")
        };
        let plain = load(None);
        for inside in ["a", "below/b", "below/../a", "./a", "../scene/a"] {
            assert!(plain.read(&own.join(inside)).is_ok(), "{inside}");
        }
        let outside = [
            own.join("../other/secret"),
            secret.clone(),
            own.join("below/../../other/secret"),
        ];
        for path in &outside {
            assert!(is_outside(plain.read(path)), "{path:?}");
            assert!(load(Some(&other)).read(path).is_ok(), "{path:?}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&secret, own.join("secret link")).expect("a link");
            std::os::unix::fs::symlink(&other, own.join("folder")).expect("a link");
            for link in ["secret link", "folder/secret"] {
                assert!(is_outside(plain.read(&own.join(link))), "{link}");
                assert!(load(Some(&other)).read(&own.join(link)).is_ok(), "{link}");
            }
            assert!(load(None).read(Path::new("/dev/zero")).is_err());
        }
        // A folder whose name begins as the permitted one does.
        fs::create_dir_all(top.join("scene2")).expect("a folder");
        fs::write(top.join("scene2/secret"), "bytes of it").expect("a file");
        assert!(is_outside(plain.read(&own.join("../scene2/secret"))));
        fs::remove_dir_all(top).expect("removed");
    }

    #[test]
    fn memory_is_one_budget() {
        let limits = Limits {
            memory: 100,
            ..Limits::default()
        };
        let load = Load::new(None, &limits).expect("no folder");
        assert!(load.take("a", "the picture", 60).is_ok());
        assert!(load.check("b", "the stream", 40).is_ok());
        let error = load
            .take("b", "the stream", 41)
            .expect_err("too much")
            .to_string();
        for part in ["b", "the stream", "41", "40", "100", "--memory"] {
            assert!(error.contains(part), "{error}");
        }
        assert_eq!(load.left(), 40);
    }
}
