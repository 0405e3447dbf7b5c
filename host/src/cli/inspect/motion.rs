//! What moves in a scene: its instances over one round of its longest animation.

use lightbvh::node::{Holds, Node};
use lightbvh::{BuildParams, Edit};
use lightbvh_kernels::bvh::WIDTH;
use serde::Serialize;

use crate::error::HostError;
use crate::scene::{FRAMES_PER_SECOND, Instances, Scene, SceneLight};

/// Frames looked at, at most.
const MOST_FRAMES: u32 = 1000;

/// Which instances move, and whose meshes bend. Scenes of the host do not vary what they emit.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Motion {
    /// Frames looked at, the first not counted.
    pub frames: u32,
    pub instances: usize,
    /// Instances that move at all.
    pub moving: usize,
    /// Instances whose mesh bends.
    pub bending: usize,
    pub tracks: Vec<Track>,
}

/// An instance that moves.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Track {
    pub instance: u32,
    /// Node and mesh.
    pub name: String,
    /// Frames in which it moves.
    pub moves: u32,
}

/// Frames of one round of the longest animation.
fn frames(scene: &Scene) -> u32 {
    let animations = scene.data().animations.iter();
    let longest = animations
        .map(|animation| f64::from(animation.duration()))
        .fold(0.0, f64::max);
    ((longest * f64::from(FRAMES_PER_SECOND)).ceil() as u32).min(MOST_FRAMES)
}

/// Node and mesh of each instance, or the name of the light that it is.
fn names<L: SceneLight>(scene: &Scene) -> Vec<String> {
    let meshes = scene.frame(0).mesh_lights.into_iter().map(|light| light.name);
    let own = scene.data().analytic.iter();
    let others = own.filter(|light| light.light().and_then(L::of_kind).is_some());
    meshes.chain(others.map(|light| light.name.clone())).collect()
}

impl Motion {
    /// Of the lights that the nodes of a tree hold.
    pub fn of<N: Node<WIDTH> + Holds<Light: SceneLight>>(scene: &Scene) -> Result<Self, HostError> {
        let frames = frames(scene);
        let names = names::<N::Light>(scene);
        let (_, mut instances) = Instances::<N::Light>::new::<N, (), WIDTH>(scene, 0, BuildParams::FAST)
            .map_err(|error| HostError::in_frame(scene.name(), 0, error))?;
        let mut moves = vec![0_u32; names.len()];
        let mut bends = vec![false; names.len()];
        for frame in 1..=frames {
            for edit in instances.edits(scene, frame) {
                match edit {
                    Edit::SetTransform { instance, .. } => moves[instance.index() as usize] += 1,
                    Edit::SetTriangles { mesh, .. } => {
                        let instance = instances.of_bent(mesh);
                        if let Some(instance) = instance {
                            bends[instance.index() as usize] = true;
                        }
                    }
                    _ => {}
                }
            }
        }
        let named = (0..).zip(names.iter().zip(&moves));
        let tracks: Vec<Track> = named
            .filter(|(_, (_, moves))| **moves > 0)
            .map(|(instance, (name, &moves))| Track {
                instance,
                name: name.clone(),
                moves,
            })
            .collect();
        Ok(Self {
            frames,
            instances: names.len(),
            moving: tracks.len(),
            bending: bends.into_iter().filter(|bends| *bends).count(),
            tracks,
        })
    }

    /// In words.
    pub fn said(&self) -> String {
        let Self {
            frames,
            instances,
            moving,
            bending,
            tracks,
        } = self;
        if *frames == 0 {
            return "no: nothing is animated".to_owned();
        }
        if *bending > 0 {
            return format!(
                "yes: meshes of {bending} of {instances} instances bend in {frames} frames, {moving} move"
            );
        }
        let moves = tracks.iter().map(|track| track.moves);
        let (Some(least), Some(most)) = (moves.clone().min(), moves.max()) else {
            return format!("no: in {frames} frames of animation no instance that emits moves");
        };
        let often = if least == most {
            format!("{most}")
        } else {
            format!("{least} to {most}")
        };
        format!("yes: {moving} of {instances} instances, in {often} of {frames} frames")
    }
}
