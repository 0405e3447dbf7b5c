//! Meshes that become brighter or dimmer.

extern crate std;

use std::vec::Vec;

use super::*;
use crate::bvh::{RebuildParams, Swap};
use crate::kit::Random;
use crate::{Edit, EmissiveTriangle, LightBvh, MeshId, Rebuilder, RebuilderParams, Transform};

#[test]
fn a_flux_is_another_one_from_a_factor_of_two_on() {
    let mut known = KnownFlux::of(1.0);
    assert_eq!(known.note(2.0), None);
    assert_eq!(known.note(0.5), None);
    assert_eq!(known.note(2.1), Some(2.1));
    assert_eq!(known.note(1.1), None);
    assert_eq!(known.note(1.0), Some(2.1), "dimmer, once");
    assert_eq!(known.note(2.1), Some(2.1), "bright again");
    for _ in 0..4 {
        assert_eq!(known.note(0.0), None);
        assert_eq!(known.note(2.1), None);
    }
    assert_eq!(known.note(5.0), Some(5.0));
    let mut dark = KnownFlux::of(0.0);
    assert_eq!(dark.note(0.0), None);
    assert_eq!(dark.note(1e-30), Some(1e-30));
}

#[test]
fn words_tell_all_of_it() {
    for known in [(0.0, false), (0.0, true), (7.5, false), (7.5, true)] {
        let known = KnownFlux {
            phi: known.0,
            blinks: known.1,
        };
        assert_eq!(KnownFlux::from_word(known.word()), Some(known));
    }
    for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(KnownFlux::from_word(wrong.to_bits()), None);
    }
}

fn mesh_of(count: u32, radiance: f32) -> Vec<EmissiveTriangle> {
    let random = &mut Random(5);
    let lamp = |_| {
        let [x, y, z] = (random.vector() * 5.0).to_array();
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.3, y, z], [x, y, z + 0.3]],
            radiance: [radiance; 3],
            mesh: 0,
            flags: 0,
        }
    };
    (0..count).map(lamp).collect()
}

/// So many lamps of one triangle, and eight dim meshes of 64 among them, each with the node that it hangs in.
fn scene(lamps: u32) -> (LightBvh, Vec<MeshId>) {
    let mut bvh = LightBvh::default();
    let random = &mut Random(9);
    let lamp = bvh.add_mesh(mesh_of(1, 9.0)).expect("a lamp");
    let mut place = || Transform::at((random.vector() * 100.0).to_array());
    let mut add: Vec<Edit> = Vec::new();
    for _ in 0..lamps {
        add.push(Edit::AddInstance {
            mesh: lamp,
            transform: place(),
            radiance: 1.0,
        });
    }
    let mut meshes = Vec::new();
    for _ in 0..8 {
        let mesh = bvh.add_mesh(mesh_of(64, 0.09)).expect("a mesh");
        meshes.push(mesh);
        add.push(Edit::AddInstance {
            mesh,
            transform: place(),
            radiance: 1.0,
        });
    }
    bvh.apply(add).expect("instances");
    bvh.refit();
    (bvh, meshes)
}

/// Swaps in each of some frames in which a few triangles of each mesh, too few to count as a change of it, have the given radiance.
fn swaps(lamps: u32, params: RebuildParams, frames: u32, radiance: impl Fn(u32) -> f32) -> Vec<bool> {
    let (mut bvh, meshes) = scene(lamps);
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: params,
        ..RebuilderParams::default()
    });
    let mut swaps = Vec::new();
    for frame in 0..frames {
        swaps.push(rebuilder.begin_frame(&mut bvh).expect("no panic").swapped);
        for &mesh in &meshes {
            bvh.set_triangle_range(mesh, 0, mesh_of(3, radiance(frame)))
                .expect("its own");
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    bvh.validate().expect("valid");
    swaps
}

/// Meshes that outshine all others get a top level for it at once, though they change in every frame and no node tells its
/// children apart any worse; those that blink ask for no more than that.
#[test]
fn what_outshines_others_gets_a_tree_while_it_changes() {
    let swaps_after = |radiance: fn(u32) -> f32| {
        let swaps = swaps(500, RebuildParams::default(), 60, radiance);
        let at: Vec<usize> = (0..60).filter(|&frame| swaps[frame]).collect();
        at
    };
    assert!(swaps_after(|frame| 0.09 + 1e-4 * frame as f32).is_empty());
    let brighter = swaps_after(|frame| if frame < 10 { 0.09 } else { 900.0 + frame as f32 });
    assert!(
        matches!(brighter[..], [11, ..]) && brighter.len() <= 3,
        "{brighter:?}"
    );
    let blinking = swaps_after(|frame| if frame % 2 == 0 { 900.0 } else { 0.09 });
    // And once where it rests but for that.
    assert!(blinking.iter().all(|&frame| frame <= 20), "{blinking:?}");
}

/// By `eager` whatever has changed is built, as good as it may be.
#[test]
fn the_eager_build_what_changed() {
    let radiance = |frame| 900.0 + frame as f32;
    for lamps in [500, 2500] {
        let often = swaps(lamps, RebuildParams::eager(), 40, radiance);
        let count = often.iter().filter(|&&swapped| swapped).count();
        assert!(count >= 30, "{lamps}: {count}");
        let seldom = swaps(lamps, RebuildParams::default(), 40, radiance);
        let count = seldom.iter().filter(|&&swapped| swapped).count();
        assert!(count < 15, "{lamps}: {count}");
    }
}

/// What was read, or is read before it is refitted, asks for the same.
#[test]
fn files_tell_it() {
    let (mut bvh, meshes) = scene(100);
    let again = |bvh: &LightBvh| LightBvh::from_words(&bvh.to_words()).expect("its own");
    bvh.set_triangle_range(meshes[3], 0, mesh_of(3, 900.0))
        .expect("its own");
    let unrefitted = again(&bvh);
    bvh.refit();
    let stirred = |bvh: &LightBvh| bvh.top.stirred.iter().sum::<u32>();
    assert!(stirred(&bvh) > 50);
    for read in [&unrefitted, &again(&bvh)] {
        assert_eq!(stirred(read), stirred(&bvh));
        let known = |bvh: &LightBvh| bvh.blases.iter().map(|own| own.known_flux).collect::<Vec<_>>();
        assert_eq!(known(read), known(&bvh));
    }
}

/// What is noted in a frame that computes nothing is of an epoch that has come: files know what is later than what they tell of
/// as no later.
#[test]
fn what_is_noted_alone_brings_the_epoch_on() {
    let (mut bvh, _) = scene(100);
    let before = bvh.epoch;
    bvh.note_reopened(&[]);
    assert_eq!(bvh.epoch, before, "nothing is");
    bvh.note_reopened(&[3]);
    bvh.refit();
    let number = bvh.top.number(bvh.top.root) as usize;
    assert!(bvh.top.moved[number] > before && bvh.top.moved[number] <= bvh.epoch);
}

/// And goes on word for word, where another flux was the last thing that changed before the file was written.
#[test]
fn files_of_another_flux_go_on() {
    for refits in 1..4 {
        let mut bvh = LightBvh::default();
        let random = &mut Random(refits);
        let lamp = bvh.add_mesh(mesh_of(1, 1.0)).expect("a lamp");
        let mesh = bvh.add_mesh(mesh_of(20, 1.0)).expect("a mesh");
        let add = (0..60).map(|_| Edit::AddInstance {
            mesh: lamp,
            transform: Transform::at((random.vector() * 20.0).to_array()),
            radiance: 1.0,
        });
        bvh.apply(add.collect()).expect("instances");
        bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
        bvh.refit();
        bvh.set_triangles(mesh, mesh_of(20, 3.0)).expect("as many");
        (0..refits).for_each(|_| bvh.refit());
        let mut read = LightBvh::from_words(&bvh.to_words()).expect("its own");
        let own = || {
            Rebuilder::new(RebuilderParams {
                swap: Swap::Deterministic,
                ..RebuilderParams::default()
            })
        };
        let mut rebuilders = [own(), own()];
        for frame in 0..40 {
            for (bvh, rebuilder) in [&mut bvh, &mut read].into_iter().zip(&mut rebuilders) {
                rebuilder.begin_frame(bvh).expect("no panic");
                bvh.refit();
                rebuilder.end_frame(bvh);
            }
            assert!(bvh.to_words() == read.to_words(), "{refits}: {frame}");
        }
    }
}

/// Each instance counts, by its own flux, for what it outshines in each node above: the root's share is that of its instances,
/// and no node counts fewer than the one below.
#[test]
fn what_is_outshone_counts() {
    let (mut bvh, meshes) = scene(100);
    let mesh = meshes[2];
    let add = |radiance, x| Edit::AddInstance {
        mesh,
        transform: Transform::at([x, 50.0, 50.0]),
        radiance,
    };
    bvh.apply(std::vec![add(0.5, 5.0), add(0.25, 95.0)])
        .expect("two more");
    bvh.refit();
    let blas = bvh.meshes[mesh.index() as usize].blas;
    let before = bvh.top.stirred.clone();
    bvh.set_triangle_range(mesh, 0, mesh_of(3, 120.0))
        .expect("its own");
    bvh.refit();
    let root = bvh.top.root;
    let number = bvh.top.number(root) as usize;
    let all = f64::from(bvh.nodes[root as usize].merged().phi());
    let count = f64::from(bvh.top.counts[number]);
    let phi = f64::from(bvh.root_of(blas).phi());
    let users = bvh.meshes[mesh.index() as usize].users.clone();
    assert_eq!(users.len(), 3);
    let mut expected = 0;
    for &user in &users {
        assert!(bvh.placed[user as usize].parts.is_empty(), "one leaf each");
        let share = phi * f64::from(bvh.instances[user as usize].flux) / all;
        assert!(share > 0.05 && share < 0.9, "{share}");
        expected += ((share * count) as u32).max(LEAST);
    }
    let found = bvh.top.stirred[number] - before[number];
    assert!(
        (expected..expected + 12).contains(&found),
        "{found} for {expected}"
    );
    for &user in &users {
        let mut node = bvh.placed[user as usize].node;
        let mut below = LEAST;
        while node != INVALID {
            let number = bvh.top.number(node) as usize;
            assert!(bvh.top.stirred[number] >= below, "{node}");
            assert!(bvh.top.changes[number] >= LEAST);
            below = bvh.top.stirred[number];
            node = bvh.parents[node as usize];
        }
    }
}

/// What comes in so bright that it outshines the others was put into a tree that was built without it: that is tried anew,
/// though nothing in it lost its order. Dim ones ask for nothing.
#[test]
fn bright_ones_that_come_in_get_a_tree() {
    for (opens, radiance, gets) in [(true, 900.0, true), (false, 900.0, true), (true, 0.001, false)] {
        let (mut bvh, _) = scene(500);
        bvh.params.opens = opens;
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        let mut swaps = 0;
        for frame in 0..60 {
            if frame == 20 {
                assert_eq!(swaps, 0, "as it was built");
                let mesh = bvh.add_mesh(mesh_of(400, radiance)).expect("a mesh");
                bvh.add_instance(mesh, Transform::at([40.0, 40.0, 40.0]))
                    .expect("one");
            }
            swaps += u32::from(rebuilder.begin_frame(&mut bvh).expect("no panic").swapped);
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        assert_eq!(swaps > 0, gets, "opens {opens}, radiance {radiance}");
        bvh.validate().expect("valid");
    }
}
