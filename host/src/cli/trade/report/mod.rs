//! The measurements as one page, `trade.html`, which needs no network and no other file, and as JSON.

mod page;
mod pictures;

use std::env::consts::{ARCH, OS};
use std::ffi::{OsStr, OsString};
use std::path::Path;
use std::time::SystemTime;

use serde::Serialize;
use serde_json::Value;

use self::pictures::{Pictures, pictures};
use super::front::Point;
use crate::cli::target;
use crate::error::HostError;
use crate::metrics::Judge;

/// A page in the making.
pub(super) struct Report {
    made: Made,
    scenes: Vec<SceneShown>,
    scene_count: usize,
}

/// The parts of a page about a scene, next to its points.
#[derive(Debug, Serialize)]
struct SceneShown {
    name: String,
    pictures: Pictures,
}

impl Report {
    /// Of so many scenes, into `folder`, which is made where it is not there: better now than after the measurements.
    pub fn begin(folder: &Path, scenes: usize) -> Result<Self, HostError> {
        target::folder(folder)?;
        Ok(Self {
            made: Made::now(),
            scenes: Vec::new(),
            scene_count: scenes,
        })
    }

    /// Adds a scene: images of its points beside the reference.
    pub fn scene(&mut self, name: &str, points: &[Point], judge: &Judge) -> Result<(), HostError> {
        self.scenes.push(SceneShown {
            name: name.to_owned(),
            pictures: pictures(points, judge, self.scene_count)?,
        });
        Ok(())
    }

    /// Writes `trade.json`, what `--json` prints and the machine, and `trade.html` into `folder`, each whole or not at all.
    pub fn write(&self, folder: &Path, measured: &Value) -> Result<(), HostError> {
        let store = |name: &str, bytes: &[u8]| target::store(&folder.join(name), bytes);
        let json = |value: &Value| serde_json::to_string(value).map_err(std::io::Error::from);
        let mut measured = measured.clone();
        measured["made"] = serde_json::to_value(&self.made).map_err(std::io::Error::from)?;
        store("trade.json", format!("{}\n", json(&measured)?).as_bytes())?;
        measured["scenes"] = serde_json::to_value(&self.scenes).map_err(std::io::Error::from)?;
        store("trade.html", page::html(&json(&measured)?).as_bytes())
    }
}

/// The head of a report.
#[derive(Clone, Debug, Serialize)]
struct Made {
    /// The processor's name where the system tells it, its family and the system elsewhere.
    machine: String,
    /// Threads that images and trees have.
    threads: usize,
    /// The command line.
    command: String,
    /// Of this program.
    version: &'static str,
    /// Whether the compiler optimised it: times of one that is not say nothing.
    optimised: bool,
    /// Universal time, to the second.
    date: String,
}

impl Made {
    fn now() -> Self {
        let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
            let line = text.lines().find(|line| line.starts_with("model name"))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        });
        let args: Vec<OsString> = std::env::args_os().skip(1).collect();
        Self {
            machine: format!("{}, {OS}", processor.unwrap_or_else(|| ARCH.to_owned())),
            threads: rayon::current_num_threads(),
            // By the program's name alone, wherever it lies.
            command: format!("lightbvh {}", args.join(OsStr::new(" ")).to_string_lossy()),
            version: env!("CARGO_PKG_VERSION"),
            optimised: !cfg!(debug_assertions),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        }
    }
}
