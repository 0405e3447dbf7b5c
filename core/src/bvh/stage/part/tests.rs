//! Which part is built anew, and what is known of the mesh after it.

use super::super::tests::{lamps, worn_clusters};
use super::*;
use crate::tree::INVALID;
use crate::{LightBvh, Transform};

/// A part for which no tree of as many nodes was found is passed over: else each frame would try it again, and no other.
#[test]
fn what_did_not_fit_is_not_tried_again() {
    let mut bvh = worn_clusters();
    let builder = Builder::default();
    let params = RebuildParams::default();
    let mut tried: Vec<u32> = Vec::new();
    while let Some((id, _)) = bvh.begin_part(0, &builder, &params, 1 << 20) {
        let node = bvh
            .staged(id)
            .and_then(|staged| staged.part.as_ref())
            .expect("a part")
            .node;
        assert!(!tried.contains(&node), "{node} again");
        tried.push(node);
        // As settle_part does with a tree without nodes.
        bvh.blases[0].misfits.push(node);
        bvh.drop_stage(0);
        assert!(tried.len() < 1000);
    }
    assert!(!tried.is_empty());
}

/// What did not fit stays passed over while other parts come in; what is below it has its turn.
#[test]
fn what_did_not_fit_gives_way_to_what_is_below() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lamps(1)).expect("a mesh");
    for x in [0.0, 90.0] {
        bvh.add_instance(mesh, Transform::at([x, 0.0, 0.0])).expect("one");
    }
    bvh.set_triangles(mesh, lamps(2)).expect("as many");
    bvh.refit();
    let builder = Builder::default();
    let params = RebuildParams::default();
    let bytes = 1 << 15;
    let part = |bvh: &mut LightBvh, id: StageId| {
        let staged = bvh.staged(id).and_then(|staged| staged.part.as_ref());
        staged.expect("a part").node
    };
    let (id, _) = bvh.begin_part(0, &builder, &params, bytes).expect("a worn part");
    let first = part(&mut bvh, id);
    bvh.blases[0].misfits.push(first);
    bvh.drop_stage(0);
    let (mut below, mut last) = (0, first);
    while let Some((id, mut job)) = bvh.begin_part(0, &builder, &params, bytes) {
        let node = part(&mut bvh, id);
        assert_ne!(node, first);
        let mut above = node;
        while above != INVALID && above != first {
            above = bvh.parents[above as usize];
        }
        below += u32::from(above == first);
        while !bvh.copy_stage(id, &mut job, &mut { bytes }).expect("there") {}
        let mut tree = job.run::<8>();
        while bvh.settle_part(id, &mut tree, &mut { bytes }) == Some(false) {}
        bvh.refit();
        assert_ne!(node, last, "again and again");
        assert!(bvh.blases[0].misfits.contains(&first));
        last = node;
    }
    assert!(below > 0);
    bvh.validate().expect("valid");
}
