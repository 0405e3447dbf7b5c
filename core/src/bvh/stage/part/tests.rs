//! Which part is built anew, and what is known of the mesh after it.

use super::super::tests::worn_clusters;
use super::*;

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
