//! What is shown, from the command line.

use std::path::{Path, PathBuf};

use super::list::{self, Entry};
use crate::cli::range::{self, given};
use crate::cli::trade::{positive, size};
use crate::error::HostError;
use crate::method::Method;
use crate::scene::{BUILT_IN, STAGE};

/// All frames up to the last of them are allowed.
pub(super) const MAX_FRAME: u64 = 10_000;
/// Milliseconds of an image where nothing else is said.
const USUAL_TIME: f64 = 100.0;
/// Most shadow rays per pixel.
pub(super) const MAX_SAMPLES: u32 = 65_536;

#[derive(Debug, clap::Args)]
#[command(after_help = LIST_HELP)]
pub(in crate::cli) struct Args {
    /// Built-in scenes (street, square, carousel, stage) or .gltf, .glb, .pbrt, .obj and .ply files, with their entries in the
    /// list where they have one; all of the list, or all built-in ones, if none is named.
    scenes: Vec<String>,
    /// A JSON list of scenes with their authors and licences, see below.
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// Milliseconds that each image has by every method [default: 100].
    #[arg(long, value_name = "MS", value_parser = positive, conflicts_with = "samples", allow_negative_numbers = true)]
    time: Option<f64>,
    /// Shadow rays per pixel of every method in place of equal time; ReSTIR takes as many histories of six as that allows, at
    /// least one.
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Size of the images, in pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "240x135")]
    size: (u32, u32),
    /// Methods to show; all by default.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "METHOD,...")]
    methods: Vec<Method>,
    /// Images of each method, each with its own random numbers.
    #[arg(long, default_value_t = 4)]
    seeds: u32,
    /// Shadow rays per pixel of the references.
    #[arg(long, value_name = "N", default_value_t = 1024)]
    reference_samples: u32,
    /// Frame of the animation, 25 per second, where the list has none; trees are built and ReSTIR begins eight frames before it.
    #[arg(long, default_value_t = 8)]
    frame: u32,
    /// What renders.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    pub(super) backend: BackendName,
    /// Folder for gallery.md, gallery.json and the pictures; made if it is not there. Results found there are not computed again.
    #[arg(long, default_value = "gallery", value_name = "DIR")]
    pub(super) out: PathBuf,
}

/// What a list looks like.
const LIST_HELP: &str = "A list of scenes is a JSON file:

  { \"scenes\": [ {
      \"scene\": \"lamps/lamp.glb\", \"title\": \"Lamp\", \"author\": \"A. Name\", \"licence\": \"CC0-1.0\",
      \"source\": \"https://example.org/lamp\", \"may_be_shown\": true,
      \"camera\": 0, \"frame\": 8, \"environment\": \"sky.hdr\", \"environment_scale\": 1.0
  } ] }

`scene` and `may_be_shown` are required. Paths are from the list's folder. Scenes that may not be shown are rendered and
measured too; their pictures go to DIR/not-shown, and gallery.md does not have them.";

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum BackendName {
    /// The CPU.
    Cpu,
    /// A Vulkan device.
    Vulkan,
}

/// What each image has as much of as all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Equal {
    /// Milliseconds.
    Time(f64),
    /// Shadow rays per pixel.
    Samples(u32),
}

/// What is shown.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Each with whether a list has it.
    pub entries: Vec<(Entry, bool)>,
    pub equal: Equal,
    pub width: u32,
    pub height: u32,
    pub methods: Vec<Method>,
    pub seeds: u32,
    /// Even.
    pub reference_samples: u32,
    /// Where an entry has none.
    pub frame: u32,
}

impl Args {
    /// The plan, checked.
    pub(super) fn plan(&self) -> Result<Plan, HostError> {
        range::check(&[
            given("--samples", self.samples.unwrap_or(1), 1..=MAX_SAMPLES.into()),
            given("--seeds", self.seeds, 1..=4096),
            given("--reference-samples", self.reference_samples, 2..=1 << 20),
            given("--frame", self.frame, 0..=MAX_FRAME),
        ])?;
        let mut methods = self.methods.clone();
        if methods.is_empty() {
            methods = Method::ALL.to_vec();
        }
        methods.sort_unstable();
        methods.dedup();
        Ok(Plan {
            entries: self.entries()?,
            equal: match self.samples {
                Some(samples) => Equal::Samples(samples),
                None => Equal::Time(self.time.unwrap_or(USUAL_TIME)),
            },
            width: self.size.0,
            height: self.size.1,
            methods,
            seeds: self.seeds,
            reference_samples: self.reference_samples.next_multiple_of(2),
            frame: self.frame,
        })
    }

    /// The scenes: those named, those of the list, or those built in.
    fn entries(&self) -> Result<Vec<(Entry, bool)>, HostError> {
        let listed = self.list.as_deref().map(list::read).transpose()?;
        if self.scenes.is_empty() {
            let built_in = || {
                let names = BUILT_IN.iter().chain([&STAGE]);
                names.map(|name| (Entry::named(name), false)).collect()
            };
            return Ok(listed.map_or_else(built_in, |listed| {
                listed.into_iter().map(|entry| (entry, true)).collect()
            }));
        }
        let mut entries: Vec<(Entry, bool)> = Vec::new();
        for name in &self.scenes {
            let own = listed
                .iter()
                .flatten()
                .filter(|entry| is_same(&entry.scene, name));
            let before = entries.len();
            entries.extend(own.map(|entry| (entry.clone(), true)));
            if entries.len() == before {
                entries.push((Entry::named(name), false));
            }
        }
        Ok(entries)
    }
}

/// Whether two paths or names are of one scene.
fn is_same(a: &str, b: &str) -> bool {
    let is_file = !list::is_built_in(a) && !list::is_built_in(b);
    let real = |path: &str| Path::new(path).canonicalize().ok();
    a == b || (is_file && real(a).is_some() && real(a) == real(b))
}
