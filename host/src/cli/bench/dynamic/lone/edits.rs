//! One of many instances changes.

use lightbvh::Edit;

use super::Patience;
use super::rows::{Kind, Row};
use super::scene::{Sample, Scene};
use crate::backend::Bvh;

const SOUND: &str = "the edit is within the domain";

pub(super) fn rows(scene: &mut Scene, patience: Patience) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut push = |scene: &Scene, what, case, samples: &[Sample]| {
        rows.extend(Kind::of_instances(scene, what, case).rows(samples));
    };
    let samples = frames(scene, patience, |scene| {
        let instance = scene.some();
        let transform = scene.near(instance);
        vec![Edit::SetTransform { instance, transform }]
    });
    push(scene, "move", "near", &samples);
    let samples = frames(scene, patience, |scene| {
        let instance = scene.some();
        let radiance = 0.1 + scene.unit();
        vec![Edit::SetRadiance { instance, radiance }]
    });
    push(scene, "dim", "any", &samples);
    let samples = frames(scene, patience, |scene| {
        let count = scene.triangles.len();
        scene.shake(0..count, 0.2);
        vec![Edit::SetTriangles {
            mesh: scene.lone,
            triangles: scene.triangles.clone(),
        }]
    });
    push(scene, "deform", "a mesh of 100 with one instance", &samples);
    let samples = frames(scene, patience, |scene| {
        let (instance, transform) = (scene.some(), scene.anywhere());
        vec![Edit::SetTransform { instance, transform }]
    });
    push(scene, "move", "anywhere", &samples);
    let (removed, added) = come_and_go(scene, patience);
    push(scene, "remove", "one", &removed);
    push(scene, "add", "one", &added);
    rows
}

/// Frames of the edits that `change` draws; the first is not counted.
fn frames(
    scene: &mut Scene,
    patience: Patience,
    mut change: impl FnMut(&mut Scene) -> Vec<Edit>,
) -> Vec<Sample> {
    let mut samples = Vec::new();
    patience.frames(|frame| {
        let edits = change(scene);
        let sample = scene.frame(|bvh| apply(bvh, edits));
        if frame > 0 {
            samples.push(sample);
        }
    });
    samples
}

/// Frames in which one goes, in turn with such in which another comes.
fn come_and_go(scene: &mut Scene, patience: Patience) -> (Vec<Sample>, Vec<Sample>) {
    let (mut removed, mut added) = (Vec::new(), Vec::new());
    patience.frames(|_| {
        let gone = scene.one_less();
        removed.push(scene.frame(|bvh| {
            apply(bvh, vec![Edit::RemoveInstance(gone)]);
            bvh.take_removed_lights();
        }));
        let edit = scene.new_instance();
        let mut new = Vec::new();
        added.push(scene.frame(|bvh| new = bvh.apply(vec![edit]).expect(SOUND).instances));
        scene.instances.extend(new);
    });
    (removed, added)
}

fn apply(bvh: &mut Bvh, edits: Vec<Edit>) {
    bvh.apply(edits).expect(SOUND);
}
