//! One scene, and names and keys of its results: everything that they depend on.

use indicatif::ProgressBar;
use serde_json::{Value, json};

use super::plan::Plan;
use crate::cli::compare::store::Store;
use crate::method::Target;
use crate::workload::RenderSettings;

/// One scene on one backend.
pub(super) struct Job<'a> {
    pub plan: &'a Plan,
    pub store: &'a Store,
    pub target: Target<'a>,
    /// What this program is.
    pub program: &'a str,
    /// A name for files, of this scene alone in this run.
    pub stem: &'a str,
    /// [`super::subject::print`].
    pub print: String,
    pub frame: u32,
    pub progress: &'a ProgressBar,
}

impl Job<'_> {
    /// What all results of the scene depend on.
    pub fn key(&self) -> Value {
        json!({
            "command": "gallery", "program": self.program, "print": self.print, "frame": self.frame,
            "width": self.plan.width, "height": self.plan.height,
        })
    }

    /// A result's name.
    pub fn name(&self, rest: &str) -> String {
        format!("{}/{rest}", self.stem)
    }

    /// What is being done, beside the progress.
    pub fn says(&self, what: &str) {
        self.progress.set_message(format!("{}: {what}", self.stem));
    }

    /// For one sample per pixel.
    pub fn settings(&self, frame: u32, seed: u32) -> RenderSettings {
        RenderSettings {
            frame,
            width: self.plan.width,
            height: self.plan.height,
            samples: 1,
            seed,
        }
    }
}
