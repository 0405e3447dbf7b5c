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
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Its lights, geometry or moving lights in some frame.
    #[error("scene `{scene}`, frame {frame}: {source}")]
    Frame {
        scene: String,
        frame: u32,
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The power sampler has no table for this scene.
    #[error(
        "scene `{scene}` has {lights} lights, beyond what the `{sampler}` sampler can tell apart (2^24), or none of \
         them has flux; use `--sampler two-level`"
    )]
    Sampler {
        scene: String,
        sampler: &'static str,
        lights: usize,
    },
    /// A device.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// Lights that a backend cannot follow.
    #[error("{0}")]
    Follow(FollowError),
    /// A comparison that makes no sense.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// An image.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// Two images that cannot be measured.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A rebuild in the background.
    #[error(transparent)]
    Rebuild(#[from] RebuildError),
    /// A result that cannot be kept.
    #[error(
        "cannot write {path}: {source}; choose another folder with --out, or free space, then run the command again"
    )]
    Store { path: PathBuf, source: std::io::Error },
    /// A folder for output.
    #[error("cannot create the folder {path}: {source}; choose another with --out")]
    Folder { path: PathBuf, source: std::io::Error },
    /// What an option names cannot serve, or is not there.
    #[error("{option} {value} {problem}")]
    Refused {
        option: &'static str,
        value: String,
        problem: String,
    },
    /// An option that means nothing beside the others.
    #[error("{option} needs {needs}")]
    Usage {
        option: &'static str,
        needs: &'static str,
    },
    /// No device, where one is required.
    #[error("no Vulkan device, and LIGHTBVH_REQUIRE_VULKAN is set: {0}")]
    DeviceRequired(String),
    /// Standard output is gone.
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
