//! Trees that are put in place piece by piece.

extern crate std;

use std::vec::Vec;

use crate::bvh::{FrameStart, RebuildParams, RebuilderParams, Swap};
use crate::exact::hash;
use crate::kit::Random;
use crate::rebuilder::Rebuilder;
use crate::{Edit, EmissiveTriangle, LightBvh, MeshId, MomentNode, Transform};

mod changes;
mod given_up;
mod parts;

pub(super) use parts::worn_clusters;

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
