//! One large mesh changes.

use std::ops::Range;

use lightbvh::bvh::RebuildParams;

use super::rows::{Kind, Row};
use super::scene::{Sample, Scene};
use super::{Patience, frames};

pub(super) fn rows(scene: &mut Scene, patience: Patience) -> Vec<Row> {
    let mut rows = Vec::new();
    let count = scene.triangles.len();
    let samples = deformed(scene, patience, |scene| {
        let at = scene.below(count as u32) as usize;
        at..at + 1
    });
    rows.extend(Kind::of_mesh(scene, "deform", "one triangle").rows(&samples));
    let samples = deformed(scene, patience, |scene| {
        let at = scene.below((count - 100) as u32) as usize;
        at..at + 100
    });
    rows.extend(Kind::of_mesh(scene, "deform", "100 in a row").rows(&samples));
    let samples = deformed(scene, patience, |_| 0..count);
    rows.extend(Kind::of_mesh(scene, "deform", "the whole mesh").rows(&samples));
    rows.extend(rebuilt(scene, patience));
    rows
}

/// Frames in which triangles move that `which` draws, all of them or a range; the first is not counted.
fn deformed(
    scene: &mut Scene,
    patience: Patience,
    mut which: impl FnMut(&mut Scene) -> Range<usize>,
) -> Vec<Sample> {
    let mut samples = Vec::new();
    patience.frames(|frame| {
        let range = which(scene);
        scene.shake(range.clone(), 0.2);
        let (mesh, first) = (scene.lone, range.start as u32);
        let is_whole = range.len() == scene.triangles.len();
        let triangles = scene.triangles[range].to_vec();
        let sample = scene.frame(|bvh| {
            let set = if is_whole {
                bvh.set_triangles(mesh, triangles)
            } else {
                bvh.set_triangle_range(mesh, first, triangles)
            };
            set.expect("triangles of the mesh");
        });
        if frame > 0 {
            samples.push(sample);
        }
    });
    samples
}

/// The mesh's bottom level is rebuilt beside frames in which nothing changes, and such in which a lamp moves.
fn rebuilt(scene: &mut Scene, patience: Patience) -> Vec<Row> {
    let rebuild = RebuildParams {
        top: f64::INFINITY,
        drift: 0.0,
    };
    let start = |scene: &mut Scene| {
        let count = scene.triangles.len();
        scene.shake(0..count, 2.0);
        let (mesh, triangles) = (scene.lone, scene.triangles.clone());
        scene.bvh.set_triangles(mesh, triangles).expect("as many");
    };
    let change = |scene: &mut Scene| {
        let instance = scene.some();
        let transform = scene.near(instance);
        scene.bvh.set_transform(instance, transform).expect("its own");
    };
    frames::measure(
        scene,
        rebuild,
        patience,
        start,
        change,
        "bottom level",
        Kind::of_mesh,
    )
}
