//! What moves in a scene: its instances over one round of its longest animation, and of each that is left out beside others.
//! Looked at are frames evenly over each round, and those at the keys of what moves lights.

use std::collections::BTreeSet;

use lightbvh::{BuildParams, Edit};
use lightbvh_kernels::bvh::{Choice, WIDTH};
use serde::Serialize;

use super::keys;
use crate::error::HostError;
use crate::scene::{FRAMES_PER_SECOND, Instances, Scene, SceneLight};

/// Frames looked at of what is shown, at most, and as many of all that is left out: of what is longer some, evenly over it.
const MOST_FRAMES: u32 = 1000;
/// Animations looked at of those that are left out: the first.
const MOST_CLIPS: usize = 250;
/// Frames at keys that are looked at besides, of all animations together.
const MOST_KEYS: usize = 2000;

/// Which instances move, and whose meshes bend. Scenes of the host do not vary what they emit.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Motion {
    /// Frames looked at, the first not counted.
    pub frames: u32,
    /// Rounds: one, and one more for each animation that moves what another does.
    pub rounds: u32,
    pub instances: usize,
    /// Instances that move at all.
    pub moving: usize,
    /// Instances whose mesh bends.
    pub bending: usize,
    pub tracks: Vec<Track>,
    /// Rounds whose keys were not all looked at.
    pub cut: usize,
    /// Animations that were not looked at, as there are too many.
    pub beyond: usize,
    /// Animations that cannot be shown, and why.
    pub broken: Vec<String>,
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
fn round(scene: &Scene) -> u32 {
    let animations = scene.data().animations.iter();
    let longest = animations
        .map(|animation| f64::from(animation.duration()))
        .fold(0.0, f64::max);
    (longest * f64::from(FRAMES_PER_SECOND)).ceil() as u32
}

/// Node and mesh of each instance, or the name of the light that it is.
fn names<L: SceneLight>(scene: &Scene) -> Vec<String> {
    let meshes = scene.frame(0).mesh_lights.into_iter().map(|light| light.name);
    let own = scene.data().analytic.iter();
    let others = own.filter(|light| light.light().and_then(L::of_kind).is_some());
    meshes.chain(others.map(|light| light.name.clone())).collect()
}

impl Motion {
    /// Of the lights that trees of a choice hold.
    pub fn of<C: Choice<WIDTH, Light: SceneLight>>(scene: &Scene) -> Result<Self, HostError> {
        let (mut frames, mut rounds) = (0, 0);
        let names = names::<C::Light>(scene);
        let (_, mut instances) =
            Instances::new::<C::Node, C::Importance, WIDTH>(scene, 0, BuildParams::BALANCED)
                .map_err(|error| HostError::in_frame(scene.name(), 0, error))?;
        let mut moves = vec![0_u32; names.len()];
        let mut bends = vec![false; names.len()];
        let carries = keys::carriers(scene.data());
        // What is shown together, then each that is left out.
        let data = scene.data();
        let clips = data.clips.len().min(MOST_CLIPS);
        let rounds_of = std::iter::once(&data.animations[..]).chain(data.clips[..clips].chunks(1));
        let at_keys: Vec<Vec<u32>> = rounds_of.map(|own| keys::frames(own, &carries)).collect();
        let wanted: Vec<usize> = at_keys.iter().map(Vec::len).collect();
        let given = keys::share(&wanted, MOST_KEYS);
        let mut look = |scene: &Scene, most: u32, own_keys: usize| {
            let whole = round(scene);
            let own = whole.min(most);
            let evenly = (0..=own).map(|step| match own {
                0 => 0,
                _ => (u64::from(step) * u64::from(whole) / u64::from(own)) as u32,
            });
            let some = keys::some(&at_keys[own_keys], given[own_keys]);
            let mut all: BTreeSet<u32> = evenly.chain(some).collect();
            frames += all.iter().filter(|&&frame| frame > 0).count() as u32;
            // Of the first round frame 0 is where the instances are.
            if rounds == 0 {
                all.remove(&0);
            }
            for frame in all {
                for edit in instances.edits(scene, frame) {
                    match edit {
                        Edit::SetTransform { instance, .. } => moves[instance.index() as usize] += 1,
                        Edit::SetTriangles { mesh, .. } => {
                            if let Some(instance) = instances.of_bent(mesh) {
                                bends[instance.index() as usize] = true;
                            }
                        }
                        _ => {}
                    }
                }
            }
            rounds += 1;
        };
        look(scene, MOST_FRAMES, 0);
        let most = MOST_FRAMES / clips.max(1) as u32;
        let broken = scene.each_clip(clips, |index, alone| look(alone, most, 1 + index));
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
            rounds,
            instances: names.len(),
            moving: tracks.len(),
            bending: bends.into_iter().filter(|bends| *bends).count(),
            tracks,
            cut: wanted
                .iter()
                .zip(&given)
                .filter(|(wanted, given)| given < wanted)
                .count(),
            beyond: scene.data().clips.len() - clips,
            broken,
        })
    }

    /// What was not looked at, a sentence each.
    pub fn notes(&self) -> Vec<String> {
        let rounds = match self.cut {
            0 => None,
            1 => Some(String::from("in 1 round")),
            cut => Some(format!("in {cut} rounds")),
        };
        let cut = rounds.map(|rounds| {
            format!("{rounds} the keys of lights were not all looked at: at most {MOST_KEYS} frames at keys are, over all animations")
        });
        let beyond = match self.beyond {
            0 => None,
            1 => Some(format!(
                "1 animation beyond the first {MOST_CLIPS} was not looked at"
            )),
            more => Some(format!(
                "{more} animations beyond the first {MOST_CLIPS} were not looked at"
            )),
        };
        cut.into_iter()
            .chain(beyond)
            .chain(self.broken.iter().cloned())
            .collect()
    }

    /// In words.
    pub fn said(&self) -> String {
        let Self {
            frames,
            rounds,
            instances,
            moving,
            bending,
            tracks,
            ..
        } = self;
        if *frames == 0 {
            return "no: nothing is animated".to_owned();
        }
        let frames = match rounds {
            1 => format!("{frames} frames"),
            _ => format!("{frames} frames of {rounds} animations"),
        };
        if *bending > 0 {
            return format!(
                "yes: meshes of {bending} of {instances} instances bend in {frames}, {moving} move"
            );
        }
        let moves = tracks.iter().map(|track| track.moves);
        let (Some(least), Some(most)) = (moves.clone().min(), moves.max()) else {
            return format!("no: in {frames} no instance that emits moves");
        };
        let often = if least == most {
            format!("{most}")
        } else {
            format!("{least} to {most}")
        };
        format!("yes: {moving} of {instances} instances, in {often} of {frames}")
    }
}
