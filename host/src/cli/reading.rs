//! Options that commands share: what scenes may read and how much memory they may take, what runs, numbers.

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;
use std::str::FromStr;

use crate::scene::{Limits, Scene, SceneError};

/// What renders or samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum BackendName {
    Cpu,
    Vulkan,
}

/// Scenes as reports name them.
pub(super) fn shown(scenes: &[OsString]) -> Vec<String> {
    let shown = scenes.iter().map(|scene| scene.to_string_lossy().into_owned());
    shown.collect()
}

/// A finite number above zero.
pub(super) fn positive<T: FromStr + Into<f64> + Copy>(text: &str) -> Result<T, String> {
    let number = text.parse().ok();
    number
        .filter(|&number: &T| number.into().is_finite() && number.into() > 0.0)
        .ok_or_else(|| format!("{text} is no finite number above 0"))
}

#[derive(Clone, Debug, clap::Args)]
pub(super) struct Reading {
    /// Also read files of a scene from this folder; else from the scene's own folder and below alone.
    #[arg(long, value_name = "DIR")]
    read_from: Option<PathBuf>,
    /// Most memory of a scene, MiB: its pictures, unpacked streams, instances and frames together.
    #[arg(long, value_name = "MIB", default_value_t = 2048, value_parser = clap::value_parser!(u32).range(1..))]
    memory: u32,
}

impl Reading {
    pub(super) fn limits(&self) -> Limits {
        Limits {
            memory: u64::from(self.memory) << 20,
            read_from: self.read_from.clone(),
        }
    }

    /// Opens a built-in scene or a file.
    pub(super) fn open(&self, scene: impl AsRef<OsStr>) -> Result<Scene, SceneError> {
        Scene::open_within(scene.as_ref(), &self.limits())
    }
}
