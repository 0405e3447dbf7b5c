//! One scene on one backend, and its results by name and key: everything that they depend on.

use indicatif::ProgressBar;
use serde_json::{Value, json};

use super::frames::Frames;
use super::plan::{BLOCK, Plan};
use super::reference::Reference;
use super::store::{Store, stem};
use crate::method::{Method, Target};

/// A result that is still wanted, with its name and key.
pub(super) struct Wanted {
    /// Frame of an image, or number of a timed block.
    pub at: u32,
    /// Of an image.
    pub seed: u32,
    pub name: String,
    pub key: Value,
}

/// One scene on one backend.
pub(super) struct Job<'a, 'd> {
    pub plan: &'a Plan,
    pub store: &'a Store,
    pub references: &'a [Reference],
    pub target: Target<'d>,
    /// Images per frame, and blocks that are timed.
    pub seeds: u32,
    pub blocks: Vec<u32>,
    /// What this program is, for keys.
    pub program: &'a str,
    pub progress: &'a ProgressBar,
}

impl Job<'_, '_> {
    pub fn wanted_image(
        &self,
        frames: &mut Frames<'_>,
        method: Method,
        frame: u32,
        seed: u32,
        reference: &Reference,
    ) -> Wanted {
        let mut key = self.key(frames, method, frame);
        key["seed"] = seed.into();
        key["reference_samples"] = self.plan.reference_samples.into();
        key["exposure"] = reference.judge.exposure().to_bits().into();
        Wanted {
            at: frame,
            seed,
            name: self.name(frames, method, &format!("f{frame:03}-s{seed:02}")),
            key,
        }
    }

    pub fn wanted_times(&self, frames: &mut Frames<'_>, method: Method, block: u32) -> Wanted {
        let last = self.plan.last().min(block * BLOCK + BLOCK - 1);
        let mut key = self.key(frames, method, last);
        key["times_from"] = (block * BLOCK).into();
        key["threads"] = rayon::current_num_threads().into();
        Wanted {
            at: block,
            seed: 0,
            name: self.name(frames, method, &format!("times-f{:03}", block * BLOCK)),
            key,
        }
    }

    fn key(&self, frames: &mut Frames<'_>, method: Method, frame: u32) -> Value {
        let driver = match self.target {
            Target::Cpu => String::new(),
            Target::Device(device) => device.probe().driver.to_string(),
        };
        json!({
            "program": self.program, "scene": frames.scene().name(), "print": frames.print(frame), "frame": frame,
            "width": self.plan.width, "height": self.plan.height, "samples": self.plan.samples,
            "method": method, "backend": self.target.name(), "driver": driver,
        })
    }

    fn name(&self, frames: &Frames<'_>, method: Method, rest: &str) -> String {
        let (scene, backend) = (stem(frames.scene().name()), stem(self.target.name()));
        format!("{scene}/{}-{backend}-{rest}", method.name())
    }
}
