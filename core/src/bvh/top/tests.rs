//! What is noted of top levels, and what edits leave of them.

extern crate std;

use crate::node::LightNode;
use alloc::vec;
use core::ops::Range;

use super::*;
use crate::bvh::{RebuildParams, RebuilderParams, Swap};
use crate::kit::{Random, triangle};
use crate::{CompactNode, Edit, InstanceId, LightBvh, MeshId, Rebuilder, Transform};

mod adoption;
mod beside;
mod edits;
mod insertion;
mod limits;
mod meanwhile;
mod mended;
mod moves;
#[cfg(feature = "std")]
mod turns;

fn lamp<N: LightNode<W>, I, const W: usize>(scene: &mut Bvh<N, I, W>) -> MeshId {
    scene
        .add_mesh(vec![triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])])
        .expect("a mesh")
}

/// A grid of lamps, refitted.
fn grid(side: u16) -> (LightBvh, vec::Vec<InstanceId>) {
    let mut scene = LightBvh::default();
    let mesh = lamp(&mut scene);
    let place = |k: u16| {
        [
            f32::from(k % side) * 4.0,
            f32::from(k / side % side) * 4.0,
            f32::from(k / side / side) * 4.0,
        ]
    };
    let all = (0..side * side * side).map(|k| Edit::AddInstance {
        mesh,
        transform: Transform::at(place(k)),
        radiance: 1.0,
    });
    let ids = scene.apply(all.collect()).expect("instances").instances;
    scene.refit();
    (scene, ids)
}
