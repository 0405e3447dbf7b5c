//! What is already known: results in files, one each, so that an interrupted comparison goes on where it was.
//!
//! A file holds a result and its key, which names everything that the result depends on; one whose key differs is as good
//! as not there.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::cli::target;
use crate::error::HostError;
use crate::render::{Film, write_whole};

/// Changes when files of older programs mean something else.
const FORMAT: u32 = 1;

/// A folder of results.
pub(in crate::cli) struct Store {
    folder: PathBuf,
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo) over words of eight bytes, with a shift so that their upper bits count as much
/// as the lower: tells files and scenes apart, not more.
pub(in crate::cli) fn fingerprint(bytes: &[u8]) -> String {
    let step = |state: u64, word: u64| {
        let product = (state ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        product ^ (product >> 32)
    };
    let (words, rest) = bytes.as_chunks::<8>();
    let state = words.iter().fold(0xcbf2_9ce4_8422_2325, |state, word| {
        step(state, u64::from_le_bytes(*word))
    });
    let state = rest.iter().fold(state, |state, &byte| step(state, byte.into()));
    format!("{:016x}", step(state, bytes.len() as u64))
}

/// A name for files: that of a scene or of a scene's file, with nothing in it that a file system minds.
pub(in crate::cli) fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    stem.chars().map(plain).take(40).collect()
}

impl Store {
    /// Opens a folder, which is made where it is not there.
    ///
    /// # Errors
    /// [`HostError::Folder`], and [`HostError::Store`] where nothing can be written to it.
    pub fn open(folder: &Path) -> Result<Self, HostError> {
        target::folder(folder)?;
        Ok(Self {
            folder: folder.to_owned(),
        })
    }

    /// The file of a result: its name to be read by people, and the key's fingerprint.
    fn path(&self, name: &str, key: &Value, extension: &str) -> PathBuf {
        let print = fingerprint(key.to_string().as_bytes());
        self.folder.join(format!("{name}-{print}.{extension}"))
    }

    /// The result under `key`, if it is known.
    pub fn load<T: DeserializeOwned>(&self, name: &str, key: &Value) -> Option<T> {
        let bytes = fs::read(self.path(name, key, "json")).ok()?;
        let mut file: Value = serde_json::from_slice(&bytes).ok()?;
        if file["format"] != FORMAT || file["key"] != *key {
            return None;
        }
        serde_json::from_value(file["value"].take()).ok()
    }

    /// Keeps a result.
    pub fn save(&self, name: &str, key: &Value, value: &impl Serialize) -> Result<(), HostError> {
        let path = self.path(name, key, "json");
        let file = json!({ "format": FORMAT, "key": key, "value": value });
        self.prepare(&path)?;
        write_whole(&path, file.to_string().as_bytes()).map_err(|source| HostError::Store { path, source })
    }

    /// The image under `key`, if it is known.
    pub fn load_image(&self, name: &str, key: &Value, size: (u32, u32)) -> Option<Film> {
        let film = Film::read(&self.path(name, key, "exr")).ok()?;
        ((film.width(), film.height()) == size).then_some(film)
    }

    /// Keeps an image.
    pub fn save_image(&self, name: &str, key: &Value, film: &Film) -> Result<(), HostError> {
        let path = self.path(name, key, "exr");
        self.prepare(&path)?;
        Ok(film.write(&path, 1.0)?)
    }

    fn prepare(&self, path: &Path) -> Result<(), HostError> {
        let parent = path.parent().unwrap_or(&self.folder);
        fs::create_dir_all(parent).map_err(|source| HostError::Store {
            path: parent.to_owned(),
            source,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_found_under_its_key_only() {
        let folder = std::env::temp_dir().join(format!("lightbvh-store-{}", std::process::id()));
        let store = Store::open(&folder).expect("a folder");
        let (key, other) = (json!({ "frame": 1 }), json!({ "frame": 2 }));
        store.save("a/b", &key, &7_u32).expect("a file");
        assert_eq!(store.load("a/b", &key), Some(7_u32));
        assert_eq!(store.load::<u32>("a/b", &other), None);
        // The right name with another key inside, half a file, and another type.
        fs::copy(store.path("a/b", &key, "json"), store.path("a/b", &other, "json")).expect("a copy");
        assert_eq!(store.load::<u32>("a/b", &other), None);
        assert_eq!(store.load::<String>("a/b", &key), None);
        fs::write(store.path("a/b", &key, "json"), b"{\"format\":1,").expect("a file");
        assert_eq!(store.load::<u32>("a/b", &key), None);
        let _ = fs::remove_dir_all(&folder);
    }

    #[test]
    fn fingerprints_see_every_byte_and_the_length() {
        let bytes: Vec<u8> = (0..19).collect();
        let print = fingerprint(&bytes);
        for i in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[i] ^= 0x80;
            assert_ne!(fingerprint(&changed), print, "{i}");
        }
        assert_ne!(fingerprint(&[0; 8]), fingerprint(&[0; 16]));
        assert_ne!(fingerprint(&[]), fingerprint(&[0]));
    }
}
