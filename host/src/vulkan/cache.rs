//! Compiled pipelines on disk, so that a driver compiles each kernel once.
//!
//! One file for each device and driver, `pipelines-VENDOR-DEVICE-UUID.bin`: a line of its own, the length and a hash of what
//! follows, and what `vkGetPipelineCacheData` gave. A driver may take the data on trust, so a file that is not whole, or of
//! another device, is not given to it; nor is it an error: it is replaced. Files are written beside their place and renamed, so
//! that no reader finds half of one.

use ash::vk;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a file begins with, before the length and the hash of the rest, 8 bytes each, least first.
const MAGIC: &[u8; 16] = b"lightbvh cache 1";
/// Bytes before what the driver gave.
const HEAD: usize = MAGIC.len() + 16;
/// Larger files are neither read nor written, bytes.
const MOST: u64 = 256 << 20;
/// What says where files are, or that there are none.
const VARIABLE: &str = "LIGHTBVH_PIPELINE_CACHE";

/// Where the program keeps pipelines: the directory that `LIGHTBVH_PIPELINE_CACHE` names, or none where that is `off`, `0` or
/// empty; without it `lightbvh` below `XDG_CACHE_HOME` or below `.cache` in the home directory.
#[must_use]
pub fn cache_directory() -> Option<&'static Path> {
    static DIRECTORY: OnceLock<Option<PathBuf>> = OnceLock::new();
    DIRECTORY
        .get_or_init(|| directory(|name| std::env::var_os(name)))
        .as_deref()
}

/// [`cache_directory`] by the variables that `get` knows.
fn directory(get: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    if let Some(told) = get(VARIABLE) {
        let is_off = told.is_empty() || told == "off" || told == "0";
        return (!is_off).then(|| told.into());
    }
    let absolute = |name| get(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let cache = absolute("XDG_CACHE_HOME").or_else(|| Some(absolute("HOME")?.join(".cache")))?;
    Some(cache.join("lightbvh"))
}

/// Whose pipelines they are, as Vulkan tells drivers apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    pub vendor: u32,
    pub device: u32,
    pub uuid: [u8; vk::UUID_SIZE],
}

impl Identity {
    /// The name of the device's file.
    fn file(&self) -> String {
        let uuid: String = self.uuid.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("pipelines-{:08x}-{:08x}-{uuid}.bin", self.vendor, self.device)
    }

    /// Whether `data` begins as this device's does (`VkPipelineCacheHeaderVersionOne`).
    fn wrote(&self, data: &[u8]) -> bool {
        let word = |at: usize| Some(u32::from_ne_bytes(data.get(at..at + 4)?.try_into().ok()?));
        let one = vk::PipelineCacheHeaderVersion::ONE.as_raw() as u32;
        word(0).is_some_and(|length| length >= 32)
            && word(4) == Some(one)
            && word(8) == Some(self.vendor)
            && word(12) == Some(self.device)
            && data.get(16..32) == Some(&self.uuid)
    }
}

/// A device's pipelines.
#[derive(Debug, Default)]
pub(super) struct Cache {
    /// Null without a directory, and where the driver makes none.
    pub raw: vk::PipelineCache,
    path: Option<PathBuf>,
    /// Of what is in the file.
    hash: Option<u64>,
}

impl Cache {
    /// The cache of a device, with what the directory's file holds for it. Whatever is wrong with that, it is left out.
    pub fn open(device: &ash::Device, identity: &Identity, directory: Option<&Path>) -> Self {
        let Some(path) = directory.map(|directory| directory.join(identity.file())) else {
            return Self::default();
        };
        let file = read(&path).unwrap_or_default();
        let data = unwrap(&file).filter(|data| identity.wrote(data));
        let create = |data: &[u8]| {
            let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
            // SAFETY: the device is alive and `info` outlives the call; the data are none, or whole and this device's own.
            unsafe { device.create_pipeline_cache(&info, None) }
        };
        let with_data = data.and_then(|data| create(data).ok().map(|raw| (raw, Some(hash(data)))));
        let made = with_data.or_else(|| Some((create(&[]).ok()?, None)));
        let (raw, hash) = made.unwrap_or_default();
        Self {
            raw,
            path: Some(path),
            hash,
        }
    }

    /// Writes what there is, if it is not in the file. A file that cannot be written is none the next time.
    pub fn save(&self, device: &ash::Device) {
        let Some(path) = self
            .path
            .as_ref()
            .filter(|_| self.raw != vk::PipelineCache::null())
        else {
            return;
        };
        // SAFETY: the cache belongs to this device.
        let Ok(data) = (unsafe { device.get_pipeline_cache_data(self.raw) }) else {
            return;
        };
        if !data.is_empty() && data.len() as u64 <= MOST && self.hash != Some(hash(&data)) {
            let _ = write(path, &wrap(&data));
        }
    }

    pub fn destroy(&self, device: &ash::Device) {
        // SAFETY: it belongs to this device or is null, and is not used afterwards.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

fn read(path: &Path) -> Option<Vec<u8>> {
    let length = fs::metadata(path).ok()?.len();
    (length <= MOST + HEAD as u64).then(|| fs::read(path).ok())?
}

/// Writes a file beside its place, then renames it.
fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    if let Some(directory) = path.parent() {
        fs::create_dir_all(directory)?;
    }
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let new = path.with_extension(format!("{}-{number}.new", std::process::id()));
    let written = fs::write(&new, bytes).and_then(|()| fs::rename(&new, path));
    if written.is_err() {
        let _ = fs::remove_file(&new);
    }
    written
}

/// A file of `data`.
fn wrap(data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u64).to_le_bytes();
    [MAGIC.as_slice(), &length, &hash(data).to_le_bytes(), data].concat()
}

/// The data of a file that is whole.
fn unwrap(file: &[u8]) -> Option<&[u8]> {
    let (head, data) = file.split_at_checked(HEAD)?;
    let length = (data.len() as u64).to_le_bytes();
    let whole = [MAGIC.as_slice(), &length, &hash(data).to_le_bytes()].concat();
    (head == whole).then_some(data)
}

/// FNV-1a: finds what disks and interrupted copies do, not what someone does on purpose.
fn hash(data: &[u8]) -> u64 {
    data.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SELF: Identity = Identity {
        vendor: 0x1_0005,
        device: 7,
        uuid: *b"sixteen bytes ok",
    };

    fn data() -> Vec<u8> {
        let words = [32_u32, 1, SELF.vendor, SELF.device].map(u32::to_ne_bytes);
        [words.as_flattened(), &SELF.uuid, b"compiled kernels"].concat()
    }

    #[test]
    fn a_file_that_is_not_whole_is_none() {
        let file = wrap(&data());
        assert_eq!(unwrap(&file), Some(data().as_slice()));
        for end in 0..file.len() {
            assert_eq!(unwrap(&file[..end]), None, "{end} bytes of it");
        }
        assert_eq!(unwrap(&[file.as_slice(), &[0]].concat()), None);
        for at in 0..file.len() {
            let mut broken = file.clone();
            broken[at] ^= 4;
            assert_eq!(unwrap(&broken), None, "byte {at}");
        }
    }

    #[test]
    fn what_another_device_wrote_is_not_taken() {
        assert!(SELF.wrote(&data()));
        for at in 4..32 {
            let mut other = data();
            other[at] ^= 1;
            assert!(!SELF.wrote(&other), "byte {at}");
        }
        assert!(!SELF.wrote(&data()[..31]) && !SELF.wrote(&[]));
    }

    #[test]
    fn the_directory_is_told_or_the_users() {
        let of = |variables: &[(&str, &str)]| {
            let get = |name: &str| variables.iter().find(|(known, _)| *known == name);
            directory(|name| get(name).map(|(_, value)| value.into()))
        };
        let home = ("HOME", "/home/ada");
        assert_eq!(of(&[home]), Some("/home/ada/.cache/lightbvh".into()));
        assert_eq!(
            of(&[home, ("XDG_CACHE_HOME", "/var/c")]),
            Some("/var/c/lightbvh".into())
        );
        assert_eq!(
            of(&[home, ("XDG_CACHE_HOME", "relative")]),
            Some("/home/ada/.cache/lightbvh".into())
        );
        assert_eq!(of(&[home, (VARIABLE, "kept/here")]), Some("kept/here".into()));
        for off in ["off", "0", ""] {
            assert_eq!(of(&[home, (VARIABLE, off)]), None);
        }
        assert_eq!(of(&[]), None);
    }
}
