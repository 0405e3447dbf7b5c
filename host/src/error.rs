//! What can go wrong in a command; the program prints it and exits with 2.

use std::path::PathBuf;

use lightbvh::RebuildError;
use lightbvh::error::FollowError;

use crate::backend::BackendError;
use crate::metrics::MetricError;
use crate::render::FilmError;
use crate::scene::SceneError;
use crate::vulkan::VulkanError;
use crate::words::CompareError;

/// An error of a command.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Debug, thiserror::Error)]
pub enum HostError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error("scene `{scene}`, frame {frame}: {source}")]
    Frame {
        scene: String,
        frame: u32,
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    #[error(
        "scene `{scene}` has {lights} lights, beyond what the `{sampler}` sampler can tell apart (2^24), or none of \
         them has flux; use `--sampler two-level`"
    )]
    Sampler {
        scene: String,
        sampler: &'static str,
        lights: usize,
    },
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    #[error("{0}")]
    Follow(FollowError),
    #[error(transparent)]
    Compare(#[from] CompareError),
    #[error(transparent)]
    Film(#[from] FilmError),
    #[error(transparent)]
    Metric(#[from] MetricError),
    #[error(transparent)]
    Rebuild(#[from] RebuildError),
    #[error(
        "cannot write {path}: {source}; choose another folder with --out, or free space, then run the command again"
    )]
    Store { path: PathBuf, source: std::io::Error },
    #[error("cannot create the folder {path}: {source}; choose another with --out")]
    Folder { path: PathBuf, source: std::io::Error },
    #[error("{option} needs {needs}")]
    Usage {
        option: &'static str,
        needs: &'static str,
    },
    #[error("no Vulkan device, and LIGHTBVH_REQUIRE_VULKAN is set: {0}")]
    DeviceRequired(String),
    #[error("cannot write to standard output: {0}")]
    Output(#[from] std::io::Error),
}

impl HostError {
    /// What is wrong in a frame of a scene.
    pub(crate) fn in_frame(
        scene: &str,
        frame: u32,
        source: impl std::error::Error + Send + Sync + 'static,
    ) -> Self {
        Self::Frame {
            scene: scene.to_owned(),
            frame,
            source: Box::new(source),
        }
    }
}

impl From<BackendError> for HostError {
    fn from(error: BackendError) -> Self {
        match error {
            BackendError::Vulkan(error) => Self::Vulkan(error),
            BackendError::Lights(error) => Self::Follow(error),
        }
    }
}
