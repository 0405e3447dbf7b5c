//! Trees that cannot be opened as their predecessors were.

extern crate std;

use std::vec::Vec;

use super::AT_ONCE;
use crate::bvh::stage::tests::lamps;
use crate::bvh::{RebuildParams, RebuilderParams, Swap};
use crate::kit::Random;
use crate::rebuilder::Rebuilder;
use crate::{Edit, EmissiveTriangle, LightBvh, MeshId, MomentNode, ShadingPoint, Transform};

/// Opened instances of a mesh, which then changes so that its new tree has lights below its root: three that shine far away.
fn scene(count: u32) -> (LightBvh, MeshId, Vec<EmissiveTriangle>) {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lamps(1)).expect("a mesh");
    let random = &mut Random(4);
    let add = (0..count).map(|_| Edit::AddInstance {
        mesh,
        transform: Transform::at((random.vector() * 10.0).to_array()),
        radiance: 1.0,
    });
    let add = add.collect();
    bvh.apply(add).expect("instances");
    bvh.refit();
    assert_eq!(bvh.of_mesh(0).opened, count, "all are opened");
    let mut others = lamps(2);
    for (k, light) in (0..).zip(&mut others[..3]) {
        let (x, y, z) = (300.0 * k as f32, 50.0, 300.0);
        light.p = [[x, y, z], [x + 1.0, y, z], [x, y, z + 1.0]];
        light.radiance = [36.0; 3];
    }
    (bvh, mesh, others)
}

/// A rebuilder of meshes alone.
fn of_meshes() -> Rebuilder<MomentNode<8>, 8> {
    Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        ..RebuilderParams::default()
    })
}

/// Two instances at most are closed in a frame, and the tree comes in when two are left; a mesh that changes as a whole in each
/// frame, which takes a tree as it is refitted, waits alike.
#[test]
fn instances_are_closed_a_few_in_each_frame() {
    for sways in [false, true] {
        let (mut bvh, mesh, others) = scene(40);
        let mut own = of_meshes();
        bvh.set_triangles(mesh, others.clone()).expect("as many");
        bvh.refit();
        own.end_frame(&bvh);
        let created = bvh.of_mesh(0).created;
        let (mut before, mut frames) = (40, 0);
        while bvh.of_mesh(0).created == created {
            own.begin_frame(&mut bvh).expect("no panic");
            if sways {
                bvh.set_triangles(mesh, others.clone()).expect("as many");
            }
            let is_in = bvh.of_mesh(0).created != created;
            bvh.refit();
            own.end_frame(&bvh);
            let opened = bvh.of_mesh(0).opened;
            let is_in = is_in || bvh.of_mesh(0).created != created;
            // And those that are opened anew as the tree comes in.
            let most = if is_in { 2 * AT_ONCE } else { AT_ONCE };
            assert!(opened + most >= before, "{opened} of {before}");
            assert!(!is_in || before <= 2 * AT_ONCE, "{before} were open");
            (before, frames) = (opened, frames + 1);
            assert!(frames < 1000);
            bvh.validate().expect("valid");
        }
        let lit = ShadingPoint {
            p: [1.0, 2.0, 3.0],
            n: [0.0; 3],
        };
        let sum: f64 = (0..40)
            .flat_map(|k| (0..3000).map(move |light| (k, light)))
            .filter_map(|(k, light)| bvh.pmf_of(&lit, bvh.instance_id(k)?, light))
            .map(f64::from)
            .sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    }
}

/// Of a mesh that is handed over a few records at a time all instances are closed before, where its new tree has another number
/// of parts.
#[test]
fn all_are_closed_for_a_tree_that_is_handed_over() {
    let (mut bvh, mesh, others) = scene(40);
    // Far off and small, so closed.
    let add = (0..300).map(|k| Edit::AddInstance {
        mesh,
        transform: Transform::from_rows([
            [1e-3, 0.0, 0.0, 1e4 * (k + 1) as f32],
            [0.0, 1e-3, 0.0, 0.0],
            [0.0, 0.0, 1e-3, 0.0],
        ]),
        radiance: 1e-9,
    });
    bvh.apply(add.collect()).expect("instances");
    bvh.set_triangles(mesh, others).expect("as many");
    bvh.refit();
    let mut own = of_meshes();
    let created = bvh.of_mesh(0).created;
    let mut frames = 0;
    loop {
        let before = bvh.of_mesh(0).opened;
        own.end_frame(&bvh);
        own.begin_frame(&mut bvh).expect("no panic");
        bvh.refit();
        bvh.validate().expect("valid");
        if bvh.of_mesh(0).created != created {
            assert!(
                before == 0 && bvh.of_mesh(0).outgoing.is_some(),
                "{before} were open"
            );
            break;
        }
        frames += 1;
        assert!(frames < 1000);
    }
}

/// A small mesh, which is put in place at once, waits for its instances too where its new tree has another number of parts;
/// where it has as many it does not.
#[test]
fn small_meshes_wait_for_their_instances() {
    for (far, expected) in [(0, true), (3, false)] {
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(lamps(1)[..900].to_vec()).expect("a mesh");
        let random = &mut Random(4);
        let add = (0..24).map(|_| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 10.0).to_array()),
            radiance: 1.0,
        });
        let add = add.collect();
        bvh.apply(add).expect("instances");
        bvh.refit();
        assert_eq!(bvh.of_mesh(0).opened, 24);
        let mut others = lamps(2)[..900].to_vec();
        for (k, light) in (0..).zip(&mut others[..far]) {
            let (x, y, z) = (300.0 * k as f32, 50.0, 300.0);
            light.p = [[x, y, z], [x + 1.0, y, z], [x, y, z + 1.0]];
            light.radiance = [36.0; 3];
        }
        bvh.set_triangles(mesh, others).expect("as many");
        bvh.refit();
        let mut own = of_meshes();
        own.end_frame(&bvh);
        let created = bvh.of_mesh(0).created;
        let (mut before, mut at_once) = (24, None);
        for frame in 0..200 {
            own.begin_frame(&mut bvh).expect("no panic");
            bvh.refit();
            own.end_frame(&bvh);
            let opened = bvh.of_mesh(0).opened;
            assert!(opened + 2 * AT_ONCE >= before, "{opened} of {before}");
            before = opened;
            if bvh.of_mesh(0).created != created {
                at_once.get_or_insert(frame < 10);
            }
        }
        assert_eq!(at_once, Some(expected), "{far} far off");
        bvh.validate().expect("valid");
    }
}

/// Beside lamps that move in every frame, so that a part of a large top level comes in with each, instances are still closed
/// and opened.
#[test]
fn frames_in_which_parts_come_in_hold_nothing_up() {
    let (mut bvh, mesh, others) = scene(12);
    let lamp = bvh.add_mesh([lamps(3)[0]].to_vec()).expect("a mesh");
    let random = &mut Random(6);
    let place = |random: &mut Random| Transform::at((random.vector() * 20.0).to_array());
    let add = (0..600).map(|_| Edit::AddInstance {
        mesh: lamp,
        transform: place(random),
        radiance: 1.0,
    });
    let ids = bvh.apply(add.collect()).expect("instances").instances;
    bvh.set_triangles(mesh, others).expect("as many");
    bvh.refit();
    let mut own: Rebuilder<MomentNode<8>, 8> = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let (mut swapped, mut adopted) = (0, None);
    for frame in 0..160 {
        let start = own.begin_frame(&mut bvh).expect("no panic");
        swapped += u32::from(start.swapped);
        if start.adopted > 0 {
            adopted.get_or_insert(frame);
        }
        let moves = ids.iter().map(|&instance| Edit::SetTransform {
            instance,
            transform: place(random),
        });
        bvh.apply(moves.collect()).expect("there");
        bvh.refit();
        own.end_frame(&bvh);
    }
    assert!(swapped > 140, "{swapped}");
    assert!(adopted.is_some_and(|frame| frame < 120), "{adopted:?}");
    // What waits is known once, however often it is wanted.
    assert!(own.waiting_to_reopen() <= 612);
}

/// The search for those to be closed begins anew at the end of the list, and none is opened meanwhile, unless nobody builds the
/// tree any more.
#[test]
fn none_is_opened_while_a_tree_waits() {
    let (mut bvh, mesh, others) = scene(40);
    let mut own: Rebuilder<MomentNode<8>, 8> = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    bvh.set_triangles(mesh, others).expect("as many");
    bvh.refit();
    while !bvh.stays_closed(0) {
        own.begin_frame(&mut bvh).expect("no panic");
        bvh.refit();
        own.end_frame(&bvh);
    }
    let before = bvh.of_mesh(0).opened;
    if let Some(staged) = &mut bvh.blases[0].staged {
        staged.closes = Some(40);
    }
    assert_eq!(bvh.close_for_stages(2), 0, "the end of the list");
    assert_eq!(bvh.close_for_stages(2), 2);
    assert_eq!(bvh.of_mesh(0).opened, before - 2);
    let closed = (0..40).find(|&k| bvh.placed[k].parts.is_empty()).expect("two") as u32;
    assert!(!bvh.reopen_one(closed, true));
    drop(own);
    assert!(bvh.reopen_one(closed, true));
}
