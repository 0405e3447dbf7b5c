//! What moves in a scene: its instances over one round of its longest animation.

use lightbvh::{BuildParams, Edit, InstanceId};
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde::Serialize;

use crate::error::HostError;
use crate::scene::{FRAMES_PER_SECOND, Instances, Scene};

/// Frames looked at, at most.
const MOST_FRAMES: u32 = 1000;

/// What changes from frame to frame.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Motion {
    /// Frames looked at, the first not counted.
    pub frames: u32,
    pub instances: usize,
    /// Instances that move at all; so many deform, and so many change what they emit.
    pub moving: usize,
    pub deforming: usize,
    pub varying: usize,
    pub tracks: Vec<Track>,
}

/// An instance that changes.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Track {
    pub instance: u32,
    /// Node and mesh.
    pub name: String,
    /// Frames in which it moves, its mesh deforms, its emission changes.
    pub moves: u32,
    pub deforms: u32,
    pub varies: u32,
}

/// Frames of one round of the longest animation.
fn frames(scene: &Scene) -> u32 {
    let animations = scene.data().animations.iter();
    let longest = animations
        .map(|animation| f64::from(animation.duration()))
        .fold(0.0, f64::max);
    ((longest * f64::from(FRAMES_PER_SECOND)).ceil() as u32).min(MOST_FRAMES)
}

impl Motion {
    pub fn of(scene: &Scene) -> Result<Self, HostError> {
        let frames = frames(scene);
        let names = scene.frame(0).mesh_lights;
        let (bvh, mut instances) = Instances::new::<Node, (), WIDTH>(scene, 0, BuildParams::FAST)
            .map_err(|error| HostError::in_frame(scene.name(), 0, error))?;
        let mut counts = vec![[0_u32; 3]; names.len()];
        let mut count = |id: InstanceId, what: usize| {
            if let Some(counts) = counts.get_mut(id.index() as usize) {
                counts[what] += 1;
            }
        };
        for frame in 1..=frames {
            for edit in instances.edits(scene, frame) {
                match edit {
                    Edit::SetTransform { instance, .. } => count(instance, 0),
                    Edit::SetTriangles { mesh, .. } => {
                        for id in (0..names.len() as u32).filter_map(|index| bvh.instance_id(index)) {
                            if bvh.mesh_of(id) == Some(mesh) {
                                count(id, 1);
                            }
                        }
                    }
                    Edit::SetRadiance { instance, .. } => count(instance, 2),
                    _ => {}
                }
            }
        }
        let so_many = |what: usize| counts.iter().filter(|counts| counts[what] > 0).count();
        let (moving, deforming, varying) = (so_many(0), so_many(1), so_many(2));
        let named = (0..).zip(names.iter().zip(&counts));
        Ok(Self {
            frames,
            instances: names.len(),
            moving,
            deforming,
            varying,
            tracks: named
                .filter(|(_, (_, counts))| **counts != [0; 3])
                .map(|(instance, (light, &[moves, deforms, varies]))| Track {
                    instance,
                    name: light.name.clone(),
                    moves,
                    deforms,
                    varies,
                })
                .collect(),
        })
    }

    /// In words.
    pub fn said(&self) -> String {
        let Self {
            frames,
            instances,
            moving,
            deforming,
            varying,
            ..
        } = self;
        let least = self.tracks.iter().map(|track| track.moves).min().unwrap_or(0);
        let most = self.tracks.iter().map(|track| track.moves).max().unwrap_or(0);
        format!(
            "{moving} of {instances} instances move, in {least} to {most} of {frames} frames; {deforming} deform, {varying} change what \
             they emit"
        )
    }
}
