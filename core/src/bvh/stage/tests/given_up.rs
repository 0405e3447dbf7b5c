//! Trees that come to nothing, and those that must not.

use super::parts::clusters;
use super::*;

/// What came to nothing, as where building panicked, is begun again: the mesh is as worn as it was.
#[test]
fn what_came_to_nothing_is_begun_again() {
    for stop in [2, 12, 28] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        for _ in 0..stop {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        assert_eq!(bvh.staging.len(), 1);
        bvh.drop_stage(bvh.staging[0]);
        until_adopted(&mut bvh, &mut rebuilder, |_, _| ());
        assert_eq!(drift(&bvh, mesh), 1.0);
    }
}

/// A part that is under way comes first: a mesh that gets worn as a whole meanwhile waits, and nothing is built for nothing.
#[test]
fn a_whole_mesh_waits_for_its_part() {
    let mut bvh = worn_clusters();
    let mesh = bvh.mesh_id(0).expect("there");
    let (.., mut rebuilder) = scene();
    let mut frame = |bvh: &mut LightBvh| {
        rebuilder.end_frame(bvh);
        let start = rebuilder.begin_frame(bvh).expect("no panic");
        assert_eq!(start.dropped, 0, "{start:?}");
        bvh.refit();
        (start.parts, start.adopted)
    };
    while bvh.staging.is_empty() {
        assert_eq!(frame(&mut bvh), (0, 0));
    }
    assert!(
        bvh.blases[0]
            .staged
            .as_ref()
            .is_some_and(|own| own.part.is_some())
    );
    let all = clusters(None);
    let mixed = (0..COUNT).map(|k| all[(k * 1009 % COUNT) as usize]);
    bvh.set_triangles(mesh, mixed.collect()).expect("as many");
    bvh.refit();
    assert!(drift(&bvh, mesh) > 1.1);
    let (mut parts, mut adopted) = (0, 0);
    for _ in 0..300 {
        let came = frame(&mut bvh);
        assert!(came.1 == 0 || parts > 0, "the part is first");
        (parts, adopted) = (parts + came.0, adopted + came.1);
    }
    assert!(parts > 0 && adopted == 1, "{parts} parts, {adopted} meshes");
    assert_eq!(drift(&bvh, mesh), 1.0);
}
