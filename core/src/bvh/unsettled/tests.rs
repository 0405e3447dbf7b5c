//! Meshes get a tree once what changed in them a little at a time is at rest.

extern crate std;

use std::vec::Vec;

use crate::build::BuildParams;
use crate::bvh::{RebuildParams, RebuilderParams, Swap};
use crate::kit::Random;
use crate::rebuilder::Rebuilder;
use crate::{Edit, EmissiveTriangle, LightBvh, MeshId, MomentNode, Transform};

type Own = Rebuilder<MomentNode<8>, 8>;

fn lamp(random: &mut Random, radiance: f32) -> EmissiveTriangle {
    let [x, y, z] = [0; 3].map(|_| 10.0 * random.unit());
    EmissiveTriangle {
        p: [[x, y, z], [x + 0.02, y, z], [x, y + 0.02, z]],
        radiance: [radiance; 3],
        mesh: 0,
        flags: 0,
    }
}

/// A mesh of so many lamps that stands alone, and one beside it.
fn scene(random: &mut Random, count: usize) -> (LightBvh, MeshId) {
    let mut bvh = LightBvh::default();
    let mesh = bvh
        .add_mesh((0..count).map(|_| lamp(random, 1.0)).collect())
        .expect("a mesh");
    let small = bvh.add_mesh([lamp(random, 1.0)].to_vec()).expect("a mesh");
    let add = [(mesh, 0.0), (small, 30.0)].map(|(mesh, x)| Edit::AddInstance {
        mesh,
        transform: Transform::at([x, 0.0, 0.0]),
        radiance: 1.0,
    });
    bvh.apply(add.to_vec()).expect("instances");
    bvh.refit();
    (bvh, mesh)
}

/// One that builds nothing for what a tree lost.
fn rebuilder() -> Own {
    Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            drift: 1e9,
        },
        ..RebuilderParams::default()
    })
}

/// Trees that the mesh gets in so many frames.
fn trees(
    bvh: &mut LightBvh,
    rebuilder: &mut Own,
    frames: u32,
    mut edit: impl FnMut(&mut LightBvh, u32),
) -> u32 {
    let mut trees = 0;
    for frame in 0..frames {
        let before = bvh.of_mesh(0).created;
        rebuilder.begin_frame(bvh).expect("no panic");
        trees += u32::from(bvh.of_mesh(0).created != before);
        edit(bvh, frame);
        bvh.refit();
        rebuilder.end_frame(bvh);
    }
    bvh.validate().expect("valid");
    trees
}

#[test]
fn what_changed_a_little_at_a_time_gets_one_tree_at_rest() {
    // Put in place at once, and piece by piece.
    for count in [200, 3000] {
        let random = &mut Random(7);
        let (mut bvh, mesh) = scene(random, count);
        let own = &mut rebuilder();
        let mut next = 0;
        // More than one in 32, so it does not rest.
        let each = count as u32 / 32 + 1;
        let while_moving = trees(&mut bvh, own, 20, |bvh, _| {
            let some = (0..each).map(|_| lamp(random, 1.0)).collect();
            bvh.set_triangle_range(mesh, next, some).expect("in the mesh");
            next += each;
        });
        assert_eq!(while_moving, 0, "{count}");
        assert!(bvh.is_unsettled(0), "more than one in 32 changed");
        assert_eq!(trees(&mut bvh, own, 15, |_, _| {}), 0, "{count}: not yet at rest");
        assert_eq!(trees(&mut bvh, own, 400, |_, _| {}), 1, "{count}: once");
        assert!(!bvh.is_unsettled(0) && !own.is_busy());
    }
}

/// Fewer than one in 32 of those as bright as the rest ask for nothing, one that outshines them all does.
#[test]
fn bright_ones_count_more() {
    for (radiance, expected) in [(1.0, 0), (100.0, 1)] {
        let random = &mut Random(8);
        let (mut bvh, mesh) = scene(random, 200);
        let own = &mut rebuilder();
        bvh.set_triangle_range(mesh, 5, [lamp(random, radiance)].to_vec())
            .expect("in the mesh");
        bvh.refit();
        assert_eq!(trees(&mut bvh, own, 60, |_, _| {}), expected, "{radiance}");
    }
}

/// One triangle that flickers does not keep a mesh from its tree, of which much changed; where little did, it waits for rest.
#[test]
fn what_flickers_holds_nothing_up() {
    for (changed, expected) in [(60, 1), (10, 0)] {
        let random = &mut Random(12);
        let (mut bvh, mesh) = scene(random, 320);
        let own = &mut rebuilder();
        let some: Vec<_> = (0..changed).map(|_| lamp(random, 1.0)).collect();
        bvh.set_triangle_range(mesh, 0, some).expect("in the mesh");
        bvh.refit();
        let found = trees(&mut bvh, own, 24, |bvh, frame| {
            let one = bvh.triangles()[bvh.of_mesh(0).triangles.start as usize + 300];
            let radiance = [1.0 + 0.01 * (frame % 2) as f32; 3];
            bvh.set_triangle_range(mesh, 300, [EmissiveTriangle { radiance, ..one }].to_vec())
                .expect("in the mesh");
        });
        assert_eq!(found, expected, "{changed}");
    }
}

/// A rebuilder that is new has seen no rest: it waits as long over a tree as over what a file told of it.
#[test]
fn new_rebuilders_wait_for_rest() {
    let random = &mut Random(14);
    let (mut bvh, mesh) = scene(random, 160);
    for frame in 0..40 {
        bvh.set_triangle_range(mesh, 2 * frame, [lamp(random, 1.0)].to_vec())
            .expect("in the mesh");
        bvh.refit();
    }
    let mut read = LightBvh::from_words(&bvh.to_words()).expect("sound words");
    let (own, other) = (&mut rebuilder(), &mut rebuilder());
    let mut came = 0;
    for frame in 0..40 {
        let found = trees(&mut bvh, own, 1, |_, _| {});
        assert_eq!(found, trees(&mut read, other, 1, |_, _| {}), "frame {frame}");
        assert!(found == 0 || frame >= 16, "frame {frame}");
        came += found;
    }
    assert_eq!(came, 1);
    assert!(read.to_words() == bvh.to_words());
}

/// What changes while a small tree is built counts for the next one, as with large ones: by edits before the start of the frame
/// in which it comes in, and in a single level.
#[test]
fn what_changes_while_a_small_tree_is_built_counts() {
    for is_single in [false, true] {
        let random = &mut Random(13);
        let all = |random: &mut Random| -> Vec<_> { (0..300).map(|_| lamp(random, 1.0)).collect() };
        let (mut bvh, mesh) = match is_single {
            false => scene(random, 300),
            true => {
                let lights = all(random);
                let bvh = LightBvh::single_level(
                    &crate::Lights::new(lights).expect("lights"),
                    &BuildParams::default(),
                );
                let mesh = bvh.mesh_id(0).expect("there");
                (bvh, mesh)
            }
        };
        let mut own = Own::new(RebuilderParams {
            swap: Swap::Deterministic,
            rebuild: RebuildParams {
                top: f64::INFINITY,
                ..RebuildParams::default()
            },
            ..RebuilderParams::default()
        });
        let mut came = 0;
        for frame in 0..30 {
            // The second while the first is being built for.
            if frame < 2 {
                bvh.set_triangles(mesh, all(random)).expect("as many");
            }
            let before = bvh.of_mesh(0).created;
            own.begin_frame(&mut bvh).expect("no panic");
            came += u32::from(bvh.of_mesh(0).created != before);
            bvh.refit();
            own.end_frame(&bvh);
            if frame == 1 {
                assert_eq!((came, bvh.of_mesh(0).unsettled), (1, 300), "{is_single}");
            }
        }
        assert_eq!((came, bvh.of_mesh(0).unsettled), (2, 0), "{is_single}");
        assert!(!own.is_busy());
    }
}

/// What changes while a tree is built is not in it: it counts for the next one.
#[test]
fn what_changes_meanwhile_counts_for_the_next_tree() {
    let random = &mut Random(9);
    let (mut bvh, mesh) = scene(random, 3000);
    let own = &mut rebuilder();
    let all: Vec<_> = (0..2000).map(|_| lamp(random, 1.0)).collect();
    bvh.set_triangle_range(mesh, 0, all).expect("in the mesh");
    bvh.refit();
    // Under way from the 17th frame on.
    assert_eq!(trees(&mut bvh, own, 19, |_, _| {}), 0);
    assert!(bvh.of_mesh(0).staged.is_some());
    let some: Vec<_> = (0..1000).map(|_| lamp(random, 1.0)).collect();
    bvh.set_triangle_range(mesh, 2000, some).expect("in the mesh");
    bvh.refit();
    let mut first = 0;
    while first == 0 {
        first = trees(&mut bvh, own, 1, |_, _| {});
    }
    assert_eq!(bvh.of_mesh(0).unsettled, 1000);
    assert_eq!(trees(&mut bvh, own, 400, |_, _| {}), 1);
}

#[test]
fn files_tell_what_is_still_to_be_tried() {
    let random = &mut Random(10);
    let (mut bvh, mesh) = scene(random, 3000);
    let some: Vec<_> = (0..500).map(|_| lamp(random, 1.0)).collect();
    bvh.set_triangle_range(mesh, 7, some).expect("in the mesh");
    bvh.refit();
    let nodes = bvh.of_mesh(0).nodes.clone();
    bvh.blases[0].is_staged_only = true;
    bvh.blases[0].misfits = [nodes.start + 9, nodes.end - 1].to_vec();
    let words = bvh.to_words();
    let mut read = LightBvh::from_words(&words).expect("sound words");
    assert_eq!(read.of_mesh(0).misfits, bvh.of_mesh(0).misfits);
    assert_eq!(read.of_mesh(0).unsettled, 500);
    assert!(read.of_mesh(0).is_staged_only);
    assert_eq!(read.to_words(), words);
    let (own, other) = (&mut rebuilder(), &mut rebuilder());
    for frame in 0..120 {
        let found =
            [(&mut bvh, &mut *own), (&mut read, &mut *other)].map(|(bvh, own)| trees(bvh, own, 1, |_, _| {}));
        assert_eq!(found[0], found[1], "frame {frame}");
    }
    assert_eq!(read.to_words(), bvh.to_words());

    // A new tree has other nodes, and nothing is known of their parts.
    assert!(bvh.of_mesh(0).misfits.is_empty() && bvh.of_mesh(0).created > 1);
    assert!(
        !bvh.of_mesh(0).nodes.contains(&(nodes.start + 9)),
        "it stands elsewhere"
    );

    // Too many of them, and one that is no node of the mesh.
    let at = words
        .windows(4)
        .position(|some| some == [500 | 1 << 31, 2, nodes.start + 9, nodes.end - 1]);
    let at = at.expect("they are there");
    for (place, word) in [(at + 1, 65), (at + 2, nodes.end), (at + 3, u32::MAX)] {
        let mut wrong = words.clone();
        wrong[place] = word;
        assert!(LightBvh::from_words(&wrong).is_err(), "{place}");
    }
}
