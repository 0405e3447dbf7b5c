//! The measurements as one page, `trade.html`, which needs no network and no other file, and as JSON.

pub(in crate::cli) mod machine;
mod page;
mod pictures;
mod tree;

use std::path::Path;

use image::ExtendedColorType;
use lightbvh_kernels::bvh::{Standard, WIDTH};
use serde::Serialize;
use serde_json::Value;

use self::machine::Made;
use self::pictures::{Pictures, pictures, png_url};
use self::tree::{Drawn, drawn};
use super::front::Point;
use super::subject::{Axis, Config, tree};
use crate::backend::{Backend, CpuBackend, Integrator, Sampler};
use crate::cli::target;
use crate::error::HostError;
use crate::method::Step;
use crate::metrics::Judge;
use crate::render::Film;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at, render_params};

/// Rows of the picture that a tree is drawn over, and its shadow rays of a pixel.
const ROWS: u32 = 300;
const RAYS: u32 = 48;

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
    lights: usize,
    pictures: Pictures,
    tree: Drawn,
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

    /// Adds a scene: images of its points beside the reference, the default's tree over its image.
    pub fn scene(
        &mut self,
        scene: &Scene,
        frame: u32,
        points: &[Point],
        judge: &Judge,
    ) -> Result<(), HostError> {
        let lights = lights_at(scene, frame)?;
        let step = Step::new(scene, frame, &lights);
        let (bvh, _) = tree::<Standard, WIDTH>(&Config::new(Axis::Default), &step)?;
        let (width, height) = judge.size();
        let columns = (ROWS * width / height).clamp(1, 4 * ROWS);
        let arrays = arrays_at(scene, frame, columns, ROWS)?;
        let mut backend = CpuBackend::<Standard>::new(bvh);
        let params = render_params((columns, ROWS), RAYS, 0, scene.frame(frame).background);
        let image = backend.render(&arrays, &params, Sampler::TwoLevel, Integrator::Direct)?;
        let film = Film::new(columns, ROWS, image.value)?;
        let shown = film.shown(judge.exposure());
        let picture = png_url(&shown, (columns, ROWS), ExtendedColorType::Rgb8)?;
        self.scenes.push(SceneShown {
            name: scene.name().to_owned(),
            lights: lights.triangles().len(),
            pictures: pictures(points, judge, self.scene_count)?,
            tree: drawn(&backend.bvh().tree(), &arrays.camera, (columns, ROWS), picture),
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
