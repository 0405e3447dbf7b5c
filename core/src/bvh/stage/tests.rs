//! Trees that are put in place piece by piece.

extern crate std;

use std::vec::Vec;

use crate::bvh::{FrameStart, RebuildParams, RebuilderParams, Swap};
use crate::exact::hash;
use crate::kit::Random;
use crate::rebuilder::Rebuilder;
use crate::{Edit, EmissiveTriangle, LightBvh, MeshId, MomentNode, Transform};

mod given_up;

const COUNT: u32 = 3000;
/// The least that a frame copies: a mesh takes 21 frames to the builder and as many back.
const BYTES: u32 = 1 << 14;

type Own = Rebuilder<MomentNode<8>, 8>;

pub(super) fn lamps(seed: u32) -> Vec<EmissiveTriangle> {
    let random = &mut Random(seed);
    let lamp = |_| {
        let [x, y, z] = [0; 3].map(|_| 10.0 * random.unit());
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.02, y, z], [x, y + 0.02, z]],
            radiance: [0.5 + random.unit(); 3],
            mesh: 0,
            flags: 0,
        }
    };
    (0..COUNT).map(lamp).collect()
}

/// A mesh that has lost its order, below three instances, and small ones around it.
fn scene() -> (LightBvh, MeshId, Own) {
    let mut bvh = LightBvh::default();
    bvh.add_mesh(lamps(3)[..20].to_vec()).expect("a mesh");
    let mesh = bvh.add_mesh(lamps(1)).expect("a mesh");
    // In one batch, so that their parts have places behind all four.
    let meshes = [mesh, bvh.mesh_id(0).expect("there"), mesh, mesh];
    let add = [0.0, 30.0, 60.0, 90.0]
        .into_iter()
        .zip(meshes)
        .map(|(x, mesh)| Edit::AddInstance {
            mesh,
            transform: Transform::at([x, 0.0, 0.0]),
            radiance: 1.0,
        });
    bvh.apply(add.collect()).expect("instances");
    bvh.set_triangles(mesh, lamps(2)).expect("as many");
    bvh.refit();
    let rebuilder = Own::new(RebuilderParams {
        after: 2,
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        bytes: BYTES,
        ..RebuilderParams::default()
    });
    (bvh, mesh, rebuilder)
}

/// Frames of which each is edited by `edit` until the tree is in place; how many they were.
fn until_adopted(bvh: &mut LightBvh, rebuilder: &mut Own, mut edit: impl FnMut(&mut LightBvh, u32)) -> u32 {
    for frame in 0..2000 {
        let start: FrameStart = rebuilder.begin_frame(bvh).expect("no panic");
        assert!(!start.swapped && start.copied <= BYTES, "{start:?}");
        if start.adopted > 0 {
            bvh.refit();
            bvh.validate().expect("valid");
            return frame;
        }
        edit(bvh, frame);
        bvh.refit();
        if frame % 16 == 0 {
            bvh.validate().expect("valid");
        }
        rebuilder.end_frame(bvh);
    }
    panic!("it does not end");
}

fn drift(bvh: &LightBvh, mesh: MeshId) -> f64 {
    bvh.drift(bvh.meshes[mesh.index() as usize].blas)
}

/// The frames are as many as the bytes say, whatever a thread takes, and the tree is a new one.
#[test]
fn a_large_mesh_comes_in_piece_by_piece() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    assert_eq!(bvh.due(&RebuildParams::default()).len(), 1);
    assert_eq!(bvh.due(&RebuildParams::default())[0].mesh, Some(mesh));
    let before = bvh.lights_of(bvh.instance_id(2).expect("there"));
    let world = bvh.world_lights();
    let copied = (COUNT * 112).div_ceil(BYTES);
    // Memory that is new takes three times as long.
    let fresh = (3 * COUNT * 60).div_ceil(BYTES);
    let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, _| {
        let written: usize = bvh
            .changes
            .new
            .written_triangles
            .iter()
            .map(ExactSizeIterator::len)
            .sum();
        assert!(written as u32 * 112 <= BYTES);
        let written: usize = bvh
            .changes
            .new
            .written_nodes
            .iter()
            .map(ExactSizeIterator::len)
            .sum();
        assert!(written * size_of::<MomentNode<8>>() <= BYTES as usize);
    });
    assert!(
        (copied + fresh..3 * copied + 2 * fresh).contains(&frames),
        "{frames}"
    );
    assert_eq!(drift(&bvh, mesh), 1.0);
    assert!(bvh.due(&RebuildParams::default()).is_empty() && !rebuilder.is_busy());
    // The lights are those that they were, and the tree is that of a mesh that comes in as it is.
    assert_eq!(bvh.lights_of(bvh.instance_id(2).expect("there")), before);
    assert!(bvh.world_lights() == world);
    let mut fresh = LightBvh::default();
    let same = fresh.add_mesh(lamps(2)).expect("a mesh");
    fresh.add_instance(same, Transform::IDENTITY).expect("one");
    assert_eq!(
        bvh.root_of(bvh.meshes[mesh.index() as usize].blas),
        fresh.root_of(0)
    );
}

/// A mesh that is deformed in every frame gets its tree in a frame whose sweep covers it.
#[test]
fn what_changes_as_a_whole_is_swept_once() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
        let mut all = lamps(2);
        for lamp in &mut all {
            lamp.p = lamp.p.map(|[x, y, z]| [x, y, z + 0.01 * frame as f32]);
        }
        bvh.set_triangles(mesh, all).expect("as many");
        bvh.refit();
        assert!(bvh.work().trees.len() == 1);
    });
    assert!(frames < 100, "{frames}");
    assert!(drift(&bvh, mesh) < 1.01, "{}", drift(&bvh, mesh));
}

/// A mesh that rests after that gets its nodes computed piece by piece.
#[test]
fn what_changed_as_a_whole_and_rests_is_swept_in_pieces() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    let mut computed = 0;
    until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
        computed = bvh
            .work()
            .bottom
            .nodes()
            .len()
            .max(if frame > 50 { computed } else { 0 });
        if frame == 50 {
            bvh.set_triangles(mesh, lamps(4)).expect("as many");
        }
        if frame == 120 {
            bvh.set_triangle_range(mesh, 40, lamps(5)[..3].to_vec())
                .expect("its own");
        }
    });
    // It was built for other triangles, so it is exact and not good: it is due at once.
    assert!(drift(&bvh, mesh) > 1.5);
    let due = bvh.due(&RebuildParams::default());
    assert_eq!(due.first().and_then(|due| due.mesh), Some(mesh));
    rebuilder.end_frame(&bvh);
    assert!(rebuilder.is_busy());
    until_adopted(&mut bvh, &mut rebuilder, |_, _| ());
    assert_eq!(drift(&bvh, mesh), 1.0);
}

/// However many triangles change from frame to frame.
#[test]
fn what_changes_in_part_does_not_put_it_off() {
    for count in [1, 30, 150, 200] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            let first = hash(frame) % (COUNT - count);
            let mut some = lamps(2)[first as usize..(first + count) as usize].to_vec();
            for lamp in &mut some {
                lamp.radiance = [hash(frame + 7) as f32 * 1e-9; 3];
            }
            bvh.set_triangle_range(mesh, first, some).expect("its own");
            // Those of the frame, and twice as many of those before.
            let written: usize = bvh
                .changes
                .new
                .written_nodes
                .iter()
                .map(ExactSizeIterator::len)
                .sum();
            assert!(written <= 80 + 3 * count as usize * 8, "{count}: {written}");
        });
        assert!(frames < 200, "{count}: {frames}");
    }
}

/// Single triangles at random places, each with a path of its own, that change in every frame put it off by little, however many they are: those
/// of a frame are computed beside what the bytes are for.
#[test]
fn what_changes_at_random_places_does_not_put_it_off() {
    let frames = [0, 1, 20, 80, 200].map(|count| {
        let (mut bvh, mesh, mut rebuilder) = scene();
        until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            let edits = (0..count).map(|k| {
                let first = hash(frame * 1000 + k) % COUNT;
                let mut one = lamps(2)[first as usize];
                one.radiance = [1.0 + hash(frame + k) as f32 * 1e-10; 3];
                Edit::SetTriangleRange {
                    mesh,
                    first,
                    triangles: std::vec![one],
                }
            });
            bvh.apply(edits.collect()).expect("its own");
        })
    });
    let most = frames.iter().max().expect("some");
    assert!(2 * most <= 3 * frames[0], "{frames:?}");
}

/// A mesh that goes, a light BVH that is another, a rebuilder that is dropped: nothing of it stays.
#[test]
fn what_comes_to_nothing_leaves_nothing() {
    for stop in [1, 12, 23, 28] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let frames = |bvh: &mut LightBvh, rebuilder: &mut Own| {
            for _ in 0..stop {
                rebuilder.begin_frame(bvh).expect("no panic");
                bvh.refit();
                rebuilder.end_frame(bvh);
            }
        };
        frames(&mut bvh, &mut rebuilder);
        assert!(rebuilder.is_busy());
        drop(rebuilder);
        let (.., mut other) = scene();
        other.begin_frame(&mut bvh).expect("nothing");
        assert!(bvh.staging.is_empty());
        frames(&mut bvh, &mut other);
        for k in [0, 2, 3] {
            let id = bvh.instance_id(k).expect("there");
            bvh.remove_instance(id).expect("its own");
        }
        bvh.remove_mesh(mesh).expect("unused");
        bvh.refit();
        bvh.validate().expect("valid");
        let newcomer = bvh.add_mesh(lamps(6)).expect("a mesh");
        bvh.add_instance(newcomer, Transform::IDENTITY).expect("one");
        for _ in 0..60 {
            assert_eq!(other.begin_frame(&mut bvh).expect("no panic").adopted, 0);
            bvh.refit();
            other.end_frame(&bvh);
        }
        assert!(!other.is_busy());
        bvh.validate().expect("valid");
        // What was given back is what is taken next: a mesh of that size finds room.
        let end = bvh.triangle_ranges.end();
        bvh.add_mesh(lamps(7)).expect("a mesh");
        assert_eq!(bvh.triangle_ranges.end(), end.max(2 * COUNT + 20));
    }
}

/// Parts of it that change again and again, each time more than are left when the next change comes, put it off for a while only.
#[test]
fn what_changes_in_parts_now_and_then_does_not_put_it_off() {
    for (every, share) in [(20, 20), (7, 40), (3, 17)] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let count = COUNT / share;
        let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            if frame % every == 0 {
                let first = frame / every * count % (COUNT - count);
                let mut some = lamps(2)[first as usize..(first + count) as usize].to_vec();
                for lamp in &mut some {
                    lamp.radiance = [1.0 + hash(frame) as f32 * 1e-10; 3];
                }
                bvh.set_triangle_range(mesh, first, some).expect("its own");
            }
        });
        assert!(frames < 400, "{every}: {frames}");
        assert!(drift(&bvh, mesh) < 1.01, "{}", drift(&bvh, mesh));
    }
}

/// Of two rebuilders of one light BVH the second waits, and says so, until the first is done or gone.
#[test]
fn two_rebuilders_do_not_hold_each_other_up() {
    for leaves in [false, true] {
        let (mut bvh, mesh, rebuilder) = scene();
        let (.., mut second) = scene();
        let mut first = Some(rebuilder);
        let (mut adopted, mut waited) = ([0, 0], 0);
        for frame in 0..400 {
            if leaves && frame == 30 {
                first = None;
            }
            if let Some(first) = &mut first {
                let start = first.begin_frame(&mut bvh).expect("no panic");
                assert!(!start.is_second && start.dropped == 0, "{start:?}");
                adopted[0] += start.adopted;
            }
            let start = second.begin_frame(&mut bvh).expect("no panic");
            assert_eq!(start.dropped, 0);
            adopted[1] += start.adopted;
            waited += u32::from(start.is_second);
            bvh.refit();
            if let Some(first) = &mut first {
                first.end_frame(&bvh);
            }
            second.end_frame(&bvh);
        }
        assert_eq!(adopted, if leaves { [0, 1] } else { [1, 0] });
        assert!(waited >= 28, "{waited}");
        assert_eq!(drift(&bvh, mesh), 1.0);
        assert!(!second.is_busy());
        // A copy is another, for which nobody builds.
        let (mut bvh, mesh, mut rebuilder) = scene();
        rebuilder.end_frame(&bvh);
        rebuilder.begin_frame(&mut bvh).expect("no panic");
        assert_eq!(bvh.staging.len(), 1);
        let mut copy = bvh.clone();
        until_adopted(&mut copy, &mut second, |_, _| ());
        assert_eq!(copy.drift(copy.meshes[mesh.index() as usize].blas), 1.0);
    }
}

/// What comes to nothing is told.
#[test]
fn a_mesh_that_goes_is_told_of() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    rebuilder.end_frame(&bvh);
    for _ in 0..9 {
        let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
        assert!(start.dropped == 0 && start.under_way == 1, "{start:?}");
    }
    for k in [0, 2, 3] {
        let id = bvh.instance_id(k).expect("there");
        bvh.remove_instance(id).expect("its own");
    }
    bvh.remove_mesh(mesh).expect("unused");
    let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
    assert!(start.dropped == 1 && start.under_way == 0, "{start:?}");
}

/// A mesh of clusters in a row, and two instances of it.
fn clusters(shuffled: Option<u32>) -> Vec<EmissiveTriangle> {
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
pub(super) fn worn_clusters() -> LightBvh {
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

/// A tree that needs wide trails makes all of them wide as its first one is put in place, and the depth that files tell them by grows then, not frames later.
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

/// Without trails all nodes are computed where anything changed, in pieces too.
#[test]
fn without_trails_it_comes_in_pieces() {
    let (bvh, mesh, mut rebuilder) = scene();
    let mut bvh = bvh.without_trails();
    let mut most = 0;
    for frame in 0..400 {
        let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
        let new = &bvh.changes.new.written_nodes;
        most = most.max(new.iter().map(ExactSizeIterator::len).sum());
        if start.adopted > 0 {
            bvh.refit();
            bvh.validate().expect("valid");
            assert!((8..90).contains(&most), "{most}");
            assert_eq!(bvh.drift(bvh.meshes[mesh.index() as usize].blas), 1.0);
            return;
        }
        if frame == 60 {
            bvh.set_triangle_range(mesh, 7, lamps(2)[7..9].to_vec())
                .expect("its own");
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    panic!("it does not end");
}

/// A mesh that goes on losing its order while its tree is built comes to rest once it rests: nothing stays due.
#[test]
fn what_changed_while_it_was_built_is_built_again() {
    for (seed, moving) in [(3, 20), (80, 20), (157, 40), (234, 40)] {
        let random = &mut Random(seed);
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(lamps(seed)).expect("a mesh");
        let small = bvh.add_mesh(lamps(5)[..1].to_vec()).expect("a mesh");
        for (mesh, x) in [(mesh, 0.0), (small, 50.0)] {
            bvh.add_instance(mesh, Transform::at([x; 3])).expect("one");
        }
        bvh.refit();
        let mut rebuilder = Own::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        let mut came = 0;
        for frame in 0..moving + 200 {
            let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
            came += start.adopted + start.parts;
            if frame < moving {
                let first = (random.unit() * 2700.0) as u32;
                let other = lamps(seed + 1000 + frame)[..300].to_vec();
                bvh.set_triangle_range(mesh, first, other).expect("its own");
            }
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        assert!(came > 0);
        assert_eq!(bvh.due(&RebuildParams::default()), []);
        assert!(!rebuilder.is_busy());
    }
}
