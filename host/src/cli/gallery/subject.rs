//! A scene as it is shown: opened, with its camera and environment, and its frames up to the one that counts.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use bytemuck::cast_slice;

use super::list::{Entry, is_built_in};
use crate::backend::SceneArrays;
use crate::cli::compare::store::fingerprint;
use crate::error::HostError;
use crate::method::Step;
use crate::scene::{Asset, Scene, SceneError, SceneLight, read_environment};
use crate::workload::arrays_lit_by;

/// Frames before the one that counts: ReSTIR's history, and what trees follow.
const BEFORE: u32 = 8;

/// A scene and its environment.
pub(super) struct Opened {
    pub scene: Scene,
    /// Tells environment maps apart.
    environment: String,
}

/// Opens the scene of an entry.
pub(super) fn open(entry: &Entry) -> Result<Opened, HostError> {
    let mut scene = Scene::open(&entry.scene)?;
    let cameras = scene.data().cameras.len();
    if entry.camera > 0 {
        if entry.camera as usize >= cameras {
            return Err(SceneError::Invalid {
                scene: entry.scene.clone(),
                problem: format!(
                    "camera {} is not there: the scene has {cameras}; correct `camera` in the list",
                    entry.camera
                ),
            }
            .into());
        }
        let mut data = scene.into_data();
        data.cameras.swap(0, entry.camera as usize);
        scene = Scene::new(data)?;
    }
    let mut environment = String::new();
    if let Some(path) = &entry.environment {
        let path = Path::new(path);
        let mut data = scene.into_data();
        let map = read_environment(path, entry.environment_scale, &mut data.warnings)?;
        data.environment = Some(Arc::new(map));
        scene = Scene::new(data)?;
        // It has just been read.
        environment = fingerprint(&fs::read(path).unwrap_or_default());
    }
    Ok(Opened { scene, environment })
}

/// What a glTF file says of who made it.
pub(super) fn asset(entry: &Entry) -> Option<Asset> {
    let path = Path::new(&entry.scene);
    let extension = path.extension()?.to_ascii_lowercase();
    let is_gltf = !is_built_in(&entry.scene) && (extension == "gltf" || extension == "glb");
    is_gltf.then(|| Asset::read(path).ok()).flatten()
}

/// A scene whose lights are of type `L`, frame by frame up to the one that counts.
pub(super) struct Subject<'a, L: SceneLight> {
    pub scene: &'a Scene,
    pub first: u32,
    pub frame: u32,
    /// From `first` on; one for all where nothing moves.
    arrays: Vec<Arc<SceneArrays<L>>>,
}

impl<'a, L: SceneLight> Subject<'a, L> {
    pub fn new(scene: &'a Scene, frame: u32, (width, height): (u32, u32)) -> Result<Self, HostError> {
        let first = frame.saturating_sub(BEFORE);
        let moves = !scene.data().animations.is_empty();
        let last = if moves { frame } else { first };
        let arrays = (first..=last).map(|at| arrays_lit_by(scene, at, width, height).map(Arc::new));
        Ok(Self {
            scene,
            first,
            frame,
            arrays: arrays.collect::<Result<_, _>>()?,
        })
    }

    pub fn arrays(&self, frame: u32) -> &Arc<SceneArrays<L>> {
        let at = (frame - self.first) as usize;
        &self.arrays[at.min(self.arrays.len() - 1)]
    }

    pub fn step(&self, frame: u32) -> Step<'_, L> {
        Step {
            scene: self.scene,
            frame,
            lights: &self.arrays(frame).lights,
        }
    }
}

/// Tells scenes of one name apart, at the first frame and at the one that counts.
pub(super) fn print(opened: &Opened, frames: [u32; 2]) -> String {
    let mut parts = opened.environment.clone();
    let data = opened.scene.data();
    for frame in frames {
        let of = opened.scene.frame(frame);
        let rest = format!("{:?} {:?} {:?}", of.camera, of.background, of.others);
        for bytes in [
            cast_slice(&of.triangles),
            cast_slice(&of.emissive),
            cast_slice(&of.materials),
            rest.as_bytes(),
        ] {
            parts += &fingerprint(bytes);
        }
    }
    // Suns are in no frame's lists.
    for light in &data.analytic {
        let on = &data.nodes[light.node as usize];
        parts += &fingerprint(format!("{light:?} {:?}", on.transform).as_bytes());
    }
    fingerprint(parts.as_bytes())
}
