//! A mesh of many instances gets a new tree, which they follow over frames.

use std::time::Instant;

use lightbvh::Rebuilder;
use lightbvh::bvh::{RebuildParams, RebuilderParams};

use super::Patience;
use super::rows::{Kind, Row};
use super::scene::{Sample, Scene};

/// Metres by which all triangles of a mesh of one metre move: their order is lost.
const LOST: f32 = 2.0;

/// Starts of frames with their refits, from the one in which the tree comes in to the last in which instances follow it.
pub(super) fn rows(scene: &mut Scene, patience: Patience) -> Vec<Row> {
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        ..RebuilderParams::default()
    });
    let mut samples = Vec::new();
    let patience = Patience { least: 2, ..patience };
    patience.frames(|_| {
        let count = scene.triangles.len();
        scene.shake(0..count, LOST);
        let (mesh, triangles) = (scene.lone, scene.triangles.clone());
        scene.bvh.set_triangles(mesh, triangles).expect("as many");
        scene.bvh.refit();
        scene.bytes();
        let mut is_in = false;
        loop {
            rebuilder.end_frame(&scene.bvh);
            let began = Instant::now();
            let start = rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
            scene.bvh.refit();
            let time = began.elapsed();
            is_in |= start.swapped || start.adopted > 0;
            if is_in {
                let nodes = scene.bvh.work().computed();
                let bytes = scene.bytes();
                samples.push(Sample { time, nodes, bytes });
            }
            if start.under_way == 0 && !rebuilder.is_busy() {
                break;
            }
        }
    });
    Kind::of_instances(scene, "adopt", "of many instances").rows(&samples)
}
