//! What is due.

use alloc::vec::Vec;

use super::RebuildParams;
use crate::kit::line;
use crate::{LightBvh, Transform};

/// A mesh is due once it is worse by more than the factor: not at as much, and not far beyond alone.
#[test]
fn a_mesh_is_due_beyond_the_factor() {
    let mut bvh = LightBvh::default();
    let mut row: Vec<_> = (0..200).map(|k| line(k, 1.0)).collect();
    let mesh = bvh.add_mesh(row.clone()).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    for k in 0..40 {
        row.swap(k * 5, (k * 77 + 3) % 200);
    }
    bvh.set_triangles(mesh, row).expect("as many");
    bvh.refit();
    let found = bvh.drift(0);
    assert!(found > 1.1, "{found}");
    for (drift, is_due) in [(0.99 * found, true), (found, false), (1.01 * found, false)] {
        let params = RebuildParams {
            top: f64::INFINITY,
            drift,
        };
        let due = bvh.due(&params);
        assert_eq!(due.len(), usize::from(is_due), "{drift} of {found}");
        assert!(due.iter().all(|due| due.mesh == Some(mesh) && due.drift == found));
        assert_eq!(bvh.rebuild(&params).bottoms().count(), due.len());
    }
}
