//! Parts of meshes that are built anew alone, and how deep they are.

use super::*;

/// A mesh of clusters in a row, and two instances of it.
pub(super) fn clusters(shuffled: Option<u32>) -> Vec<EmissiveTriangle> {
    let random = &mut Random(9);
    let mut all = Vec::new();
    for cluster in 0..30 {
        let mut own: Vec<EmissiveTriangle> = lamps(cluster)[..100].to_vec();
        if shuffled == Some(cluster) {
            for k in (1..100).rev() {
                own.swap(k, (random.unit() * (k + 1) as f32) as usize % (k + 1));
            }
        }
        for lamp in &mut own {
            lamp.p = lamp.p.map(|[x, y, z]| [x + 40.0 * cluster as f32, y, z]);
        }
        all.extend(own);
    }
    all
}

/// One mesh of which one cluster has lost its order, with nothing under way.
pub(in crate::bvh::stage) fn worn_clusters() -> LightBvh {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(clusters(None)).expect("a mesh");
    for x in [0.0, 2000.0] {
        bvh.add_instance(mesh, Transform::at([x, 0.0, 0.0])).expect("one");
    }
    bvh.refit();
    bvh.set_triangle_range(mesh, 1200, clusters(Some(12))[1200..1300].to_vec())
        .expect("its own");
    bvh.refit();
    bvh
}

/// A tree that needs wide trails makes all of them wide as its first one is put in place, and the depth that files tell them by
/// grows then, not frames later.
#[test]
fn trails_are_as_wide_as_files_say_while_they_are_put_in_place() {
    let mut bvh = LightBvh::default();
    // Deep, once it is built anew: lights at powers of two.
    let deep: Vec<EmissiveTriangle> = (0..2000)
        .map(|k| {
            let size = crate::exact::pow2((k % 96) - 58);
            let z = size * 1e-3 * (k / 96) as f32;
            EmissiveTriangle {
                p: [[size, 0.0, z], [size * 1.01, 0.0, z], [size, 0.01 * size, z]],
                radiance: [1.0; 3],
                mesh: 0,
                flags: 0,
            }
        })
        .collect();
    let mesh = bvh.add_mesh(lamps(1)[..2000].to_vec()).expect("a mesh");
    for x in [0.0, 50.0] {
        bvh.add_instance(mesh, Transform::at([x, 0.0, 0.0])).expect("one");
    }
    bvh.refit();
    bvh.set_triangles(mesh, deep).expect("as many");
    bvh.refit();
    let (.., mut rebuilder) = scene();
    let (mut frames, mut wide) = (0, 0);
    loop {
        rebuilder.end_frame(&bvh);
        let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
        let words = crate::trail::trail_words(8, bvh.bottom_depth);
        assert_eq!(bvh.trail_words, words, "{frames}");
        wide += u32::from(words == 2);
        bvh.refit();
        LightBvh::from_words(&bvh.to_words()).expect("sound words");
        frames += 1;
        if start.adopted > 0 {
            break;
        }
        assert!(frames < 500);
    }
    assert!(wide > 1, "{wide}: all trails came in with one frame");
}

/// The levels of a part count where it is deeper than all that was before: files would be refused, and the depth told be too small.
#[test]
fn a_part_that_is_deeper_is_counted() {
    let mut bvh = worn_clusters();
    let (.., mut rebuilder) = scene();
    // As if the old one had been flat.
    bvh.bottom_depth = 0;
    let mut parts = 0;
    for _ in 0..100 {
        rebuilder.end_frame(&bvh);
        parts += rebuilder.begin_frame(&mut bvh).expect("no panic").parts;
        bvh.refit();
        if parts > 0 {
            break;
        }
    }
    assert!(parts > 0 && bvh.bottom_depth >= 3, "{}", bvh.bottom_depth);
}

/// The one mesh of a single level too.
#[test]
fn a_worn_part_of_a_single_level_is_built_anew() {
    let lights = crate::Lights::new(clusters(None)).expect("lights");
    let mut bvh = LightBvh::single_level(&lights, &crate::BuildParams::default());
    let (.., mut rebuilder) = scene();
    let mesh = bvh.mesh_id(0).expect("one");
    bvh.set_triangle_range(mesh, 1200, clusters(Some(12))[1200..1300].to_vec())
        .expect("its own");
    bvh.refit();
    let mut parts = 0;
    for _ in 0..60 {
        rebuilder.end_frame(&bvh);
        parts += rebuilder.begin_frame(&mut bvh).expect("no panic").parts;
        bvh.refit();
        bvh.validate().expect("valid");
    }
    assert!(parts > 0 && !rebuilder.is_busy());
}

/// A part that lost its shape is built anew alone: its nodes and trails are written, no others, and all is as a new tree has it.
#[test]
fn a_worn_part_is_built_anew_alone() {
    for sways in [0, 1, 3] {
        let (mut bvh, _, mut rebuilder) = scene();
        let mesh = bvh.add_mesh(clusters(None)).expect("a mesh");
        for x in [0.0, 2000.0] {
            bvh.add_instance(mesh, Transform::at([x, 50.0, 0.0]))
                .expect("one");
        }
        bvh.refit();
        until_adopted(&mut bvh, &mut rebuilder, |_, _| ());
        let blas = bvh.meshes[mesh.index() as usize].blas;
        let (root, nodes) = (
            bvh.roots[blas as usize].node,
            bvh.blases[blas as usize].nodes.clone(),
        );
        let triangles = bvh.blases[blas as usize].triangles.clone();
        bvh.set_triangle_range(mesh, 1200, clusters(Some(12))[1200..1300].to_vec())
            .expect("its own");
        bvh.refit();
        let before = drift(&bvh, mesh);
        assert!(before > 1.0 && before < 1.1, "{before}");
        assert!(bvh.due(&RebuildParams::default()).is_empty());
        let (mut parts, mut frames) = (0, 0);
        while parts == 0 {
            rebuilder.end_frame(&bvh);
            let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
            assert!(start.adopted == 0 && start.dropped == 0 && start.copied <= BYTES);
            parts += start.parts;
            if parts > 0 {
                let new = &bvh.changes.new;
                let written: usize = new.written_nodes.iter().map(ExactSizeIterator::len).sum();
                assert!((10..40).contains(&written), "{written}");
                assert!(
                    new.written_nodes
                        .iter()
                        .all(|own| nodes.start < own.start && own.end <= nodes.end)
                );
                let own = triangles.start + 1200..triangles.start + 1300;
                assert!(
                    new.written_trails
                        .iter()
                        .all(|written| own.start <= written.start && written.end <= own.end)
                );
                assert!(new.written_triangles.is_empty());
            } else if sways > 0 && frames % sways == 0 {
                let mut all = clusters(Some(12));
                for lamp in &mut all {
                    lamp.p = lamp.p.map(|[x, y, z]| [x, y, z + 0.01 * frames as f32]);
                }
                if frames % 2 == 0 {
                    bvh.set_triangles(mesh, all).expect("as many");
                } else {
                    bvh.set_triangle_range(mesh, 1150, all[1150..1290].to_vec())
                        .expect("its own");
                }
            }
            bvh.refit();
            bvh.validate().expect("valid");
            frames += 1;
            assert!(frames < 100);
        }
        assert_eq!(bvh.roots[blas as usize].node, root);
        assert_eq!(bvh.blases[blas as usize].nodes, nodes);
        assert!(
            drift(&bvh, mesh) < 1.0 + (before - 1.0) / 2.0,
            "{before} to {}",
            drift(&bvh, mesh)
        );
        // A sweep of the whole mesh, and files, find it as it should be.
        for _ in 0..60 {
            rebuilder.end_frame(&bvh);
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            bvh.refit();
        }
        assert!(!rebuilder.is_busy());
        bvh.set_triangles(mesh, clusters(None)).expect("as many");
        let everything = bvh.plan_of_everything().bottom;
        bvh.refit();
        bvh.validate().expect("valid");
        assert!(everything.nodes().len() >= bvh.work().bottom.nodes().len());
        let again = LightBvh::from_words(&bvh.to_words()).expect("a file");
        assert!(again.to_words() == bvh.to_words());
    }
}
