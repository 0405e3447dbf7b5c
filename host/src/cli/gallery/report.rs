//! Everything that came out, as it stands in gallery.json.

use serde::Serialize;
use serde_json::Value;

use super::list::Entry;
use super::measure::{Chosen, Image, Skipped};
use super::reference::Noise;
use crate::cli::trade::report::machine::Made;
use crate::method::Method;
use crate::metrics::{Estimate, Quality, Region};
use crate::scene::Asset;

/// A run.
#[derive(Serialize)]
pub(super) struct Report {
    #[serde(flatten)]
    pub made: Made,
    pub settings: Value,
    pub notes: &'static [&'static str],
    pub scenes: Vec<Exhibit>,
    /// Scenes that could not be shown.
    pub failed: Vec<String>,
    /// Results that this run computed, and those that it found in the folder.
    pub computed: u64,
    pub reused: u64,
}

/// A scene of the gallery.
#[derive(Serialize)]
pub(super) struct Exhibit {
    /// A built-in name, or the name of a file without its folders.
    pub scene: String,
    pub title: String,
    /// Whether the program makes it.
    pub built_in: bool,
    /// Whether a list has it.
    pub listed: bool,
    pub author: Option<String>,
    pub licence: Option<String>,
    pub source: Option<String>,
    pub may_be_shown: bool,
    /// What a glTF file says of itself.
    pub asset: Option<Asset>,
    pub camera: u32,
    pub frame: u32,
    /// The name of the picture's file.
    pub environment: Option<String>,
    /// Why there is nothing to see.
    pub error: Option<String>,
    #[serde(flatten)]
    pub measured: Option<Measured>,
}

/// What was measured of a scene.
#[derive(Serialize)]
pub(super) struct Measured {
    pub triangles: usize,
    pub emissive_triangles: usize,
    /// Lights by formula that are sampled.
    pub lights_by_formula: usize,
    pub warnings: Vec<String>,
    /// Factor on radiance of all its pictures.
    pub exposure: f32,
    pub reference: Noise,
    /// The sheet, from the folder of the page; nothing without methods.
    pub picture: Option<String>,
    /// What the close-ups show.
    pub region: Option<Region>,
    pub methods: Vec<Row>,
    pub skipped: Vec<Skipped>,
}

/// A method in a scene.
#[derive(Serialize)]
pub(super) struct Row {
    pub method: Method,
    #[serde(flatten)]
    pub chosen: Chosen,
    /// Milliseconds of an image.
    pub ms: Spread,
    /// Of the update before it, which is no part of the image's time.
    pub update_ms: Spread,
    pub mse: Spread,
    pub ssim: Spread,
    pub flip: Spread,
    pub linear_mse: Spread,
    pub relative_mse: Spread,
    /// MSE of the close-up.
    pub region_mse: Option<f64>,
    /// One for each seed.
    pub images: Vec<Image>,
}

/// Over the seeds.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Spread {
    pub mean: f64,
    /// Half the 95 % confidence interval of the mean; `null` for one seed.
    pub ci95: Option<f64>,
    pub least: f64,
    pub most: f64,
}

/// What the tables say that numbers cannot.
pub(super) const NOTES: [&str; 5] = [
    "How many shadow rays fit into the time is predicted by a line fitted to a few trials, in whole samples, at least \
     one; ReSTIR has whole histories of six rays at most. The table says what was really spent: a mean over the images.",
    "The time is that of an image. Building and following trees is not in it; `update` is what the frame stands still for beside it.",
    "MSE is of tone-mapped 8-bit sRGB (0 to 255²) at one exposure per scene, over the whole image, a mean over the seeds; ± is half the 95 % \
     confidence interval (Student's t). The picture under each figure is the first image.",
    "References come from the two-level light BVH with random numbers of their own. Their own noise, estimated from two halves, is in every \
     error.",
    "All methods look at the same points in the pixels, the references too. The close-up is where the methods' errors lie furthest apart. \
     A sheet has few colours, so that its file stays small.",
];

impl Spread {
    /// Of at least one value.
    fn of(values: &[f64]) -> Option<Self> {
        let estimate = Estimate::of(values)?;
        Some(Self {
            mean: estimate.mean,
            ci95: estimate.ci95,
            least: values.iter().copied().fold(f64::INFINITY, f64::min),
            most: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        })
    }
}

impl Row {
    /// Of at least one image.
    pub fn of(method: Method, chosen: Chosen, images: Vec<Image>, region_mse: Option<f64>) -> Option<Self> {
        let spread = |measure: fn(&Image) -> f64| {
            let values: Vec<f64> = images.iter().map(measure).collect();
            Spread::of(&values)
        };
        fn quality(image: &Image) -> &Quality {
            &image.quality
        }
        Some(Self {
            method,
            ms: spread(|image| image.ms)?,
            update_ms: spread(|image| image.update_ms)?,
            mse: spread(|image| quality(image).mse)?,
            ssim: spread(|image| quality(image).ssim)?,
            flip: spread(|image| quality(image).flip)?,
            linear_mse: spread(|image| quality(image).linear_mse)?,
            relative_mse: spread(|image| quality(image).relative_mse)?,
            region_mse,
            chosen,
            images,
        })
    }
}

impl Exhibit {
    /// Before anything is known of it but its entry.
    pub fn new(entry: &Entry, listed: bool, frame: u32, built_in: bool, asset: Option<Asset>) -> Self {
        let scene = file_name(&entry.scene);
        Self {
            title: entry.title.clone().unwrap_or_else(|| scene.clone()),
            scene,
            built_in,
            listed,
            author: entry.author.clone(),
            licence: entry.licence.clone(),
            source: entry.source.clone(),
            may_be_shown: entry.may_be_shown,
            asset,
            camera: entry.camera,
            frame,
            environment: entry.environment.as_deref().map(file_name),
            error: None,
            measured: None,
        }
    }
}

/// The last part of a path: where files lie is nobody's business.
pub(super) fn file_name(path: &str) -> String {
    let name = std::path::Path::new(path).file_name();
    name.map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// A number with three digits or more.
pub(super) fn figure(number: f64) -> String {
    match number.abs() {
        0.0 => String::from("0"),
        100.0.. => format!("{number:.0}"),
        10.0.. => format!("{number:.1}"),
        0.1.. => format!("{number:.2}"),
        _ => format!("{number:.2e}"),
    }
}
