//! Builds in the background: which trees are swapped in, when, and the scene then.

use alloc::vec::Vec;

use super::*;
use crate::kit::Random;
use crate::kit::scenes::{edits, lamps, scattered, sound, sound_samples, with_one_far};
use crate::{Edit, EmissiveTriangle, InstanceId, LightBvh, Transform};

fn rebuilder(after: u32, swap: Swap, threads: bool) -> Rebuilder {
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        after,
        swap,
        idle: 0.0,
        ..RebuilderParams::default()
    });
    if !threads {
        rebuilder.start = || Err(std::io::Error::other("no more threads"));
    }
    rebuilder
}

/// `count` instances of a mesh of `lights` lights.
fn scene(count: u32, lights: u32) -> (LightBvh, Vec<InstanceId>) {
    let random = &mut Random(3);
    let mesh = lamps(random, lights);
    scattered(mesh, count, |_| (random.vector() * 100.0).to_array())
}

/// A frame without edits; returns whether anything was swapped in.
fn frame(bvh: &mut LightBvh, rebuilder: &mut Rebuilder) -> bool {
    let start = rebuilder.begin_frame(bvh).expect("its own");
    bvh.refit();
    bvh.view().validate().expect("valid");
    rebuilder.end_frame(bvh);
    start.swapped || start.meshes > 0
}

/// Frames without edits until nothing is left to be built; returns how many swapped something in.
fn converge(bvh: &mut LightBvh, rebuilder: &mut Rebuilder) -> usize {
    let count = (0..20).filter(|_| frame(bvh, rebuilder)).count();
    assert!(!rebuilder.is_busy());
    count
}

fn shift(bvh: &mut LightBvh, id: InstanceId) {
    let at = bvh.view().instances()[id.index() as usize].translation;
    let by_one = Transform::at(at.map(|x| x + 1.0));
    bvh.set_transform(id, by_one).expect("there");
}

fn deform(bvh: &mut LightBvh, mesh: u32) {
    let mesh = bvh.view().mesh_id(mesh).expect("there");
    let count = bvh.view().mesh_lights(mesh).expect("there").len() as u32;
    bvh.apply(std::vec![Edit::SetLights {
        mesh,
        lights: lamps(&mut Random(9), count)
    }])
    .expect("as many");
}

/// The words of the scene with rebuilt trees.
fn rebuilt(bvh: &LightBvh) -> Vec<u32> {
    let mut bvh = bvh.clone();
    bvh.rebuild();
    bvh.to_words()
}

/// Edits of every kind, frames without a refit or without their end among them; the words of each frame.
fn run(mut rebuilder: Rebuilder, is_first: bool, wait: fn(u32)) -> Vec<Vec<u32>> {
    let random = &mut Random(2);
    let mut bvh = LightBvh::default();
    let mut swapped = [0; 2];
    let frames = (0..80).map(|frame| {
        let count = random.below(12);
        for begins in [is_first, !is_first] {
            if begins {
                let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
                swapped = [swapped[0] + u32::from(start.swapped), swapped[1] + start.meshes];
                sound_samples(&bvh);
            } else {
                // A refused batch changes nothing.
                let _ = bvh.apply(edits(random, &bvh, count, 60));
            }
        }
        wait(count);
        if frame % 9 != 4 {
            bvh.refit();
            sound(&bvh);
        }
        if frame % 7 != 5 {
            rebuilder.end_frame(&bvh);
        }
        bvh.to_words()
    });
    let words = frames.collect();
    assert!(swapped.iter().all(|&count| count > 3), "{swapped:?}");
    words
}

#[test]
fn deterministic_trees_depend_on_no_thread() {
    for (after, is_first) in [1, 2, 3].into_iter().flat_map(|k| [(k, true), (k, false)]) {
        let run = |threads| run(rebuilder(after, Swap::Deterministic, threads), is_first, |_| {});
        let (with, without) = (run(true), run(false));
        let first = with.iter().zip(&without).position(|(a, b)| a != b);
        assert_eq!(first, None, "{after} {is_first}: the first frame that differs");
    }
}

#[test]
fn every_frame_is_sound_whenever_builds_come_in() {
    for is_first in [true, false] {
        let wait = |k| std::thread::sleep(Duration::from_micros(150 * u64::from(k)));
        run(rebuilder(1, Swap::WhenReady, true), is_first, wait);
        // Built on the frame's thread; the frame that swaps applies later batches.
        run(rebuilder(3, Swap::WhenReady, false), is_first, |_| {});
    }
}

#[test]
fn a_scene_at_rest_is_a_fresh_build() {
    let (mut bvh, ids) = scene(300, 200);
    let mut own = rebuilder(1, Swap::Deterministic, true);
    frame(&mut bvh, &mut own);
    for k in 0..20 {
        shift(&mut bvh, ids[7 * k]);
        frame(&mut bvh, &mut own);
    }
    deform(&mut bvh, 0);
    bvh.refit();
    let expected = rebuilt(&bvh);
    assert!(bvh.to_words() != expected);
    // The top level, the mesh, and the top level that knows of it.
    let count = converge(&mut bvh, &mut own);
    assert!((2..=4).contains(&count), "{count}");
    assert!(bvh.to_words() == expected && rebuilt(&bvh) == expected);
    // A single level is one mesh.
    let lights = crate::Lights::new(lamps(&mut Random(2), 300)).expect("lights");
    let mut bvh = LightBvh::single_level(&lights, &crate::BuildParams::default());
    deform(&mut bvh, 0);
    bvh.refit();
    let expected = rebuilt(&bvh);
    assert_eq!(converge(&mut bvh, &mut own), 1);
    assert!(bvh.to_words() == expected);
}

/// Builds of the top level, or of a mesh.
#[test]
fn builds_of_another_scene_are_dropped() {
    for (deforms, frames) in [(false, 1), (true, 1), (true, 2)] {
        let (mut bvh, ids) = scene(50, 100);
        let mut other = bvh.clone();
        deform(&mut other, 0);
        other.refit();
        let words = other.to_words();
        let mut own = rebuilder(1, Swap::Deterministic, true);
        converge(&mut bvh, &mut own);
        let begin_build = |bvh: &mut LightBvh, own: &mut Rebuilder| {
            shift(bvh, ids[3]);
            if deforms {
                deform(bvh, 0);
            }
            (0..frames).for_each(|_| _ = frame(bvh, own));
            assert!(own.is_busy());
        };
        begin_build(&mut bvh, &mut own);
        let start = own.begin_frame(&mut other).expect("no panic");
        assert_eq!((start.swapped, start.meshes), (false, 0));
        // The scene that lost its build gets another.
        own.end_frame(&bvh);
        converge(&mut bvh, &mut own);
        assert!(bvh.to_words() == rebuilt(&bvh));
        // A build under way is dropped if another scene follows.
        begin_build(&mut bvh, &mut own);
        own.end_frame(&other);
        let start = own.begin_frame(&mut other).expect("nothing is due");
        assert_eq!((start.swapped, start.meshes), (false, 0));
        assert!(other.to_words() == words);
        own.end_frame(&other);
        converge(&mut other, &mut own);
        assert!(other.to_words() == rebuilt(&other));
    }
}

/// Batches that the first tree misses when the second is swapped in reach the next build, which is of the first.
#[test]
fn swaps_without_a_refit_between_lose_no_edit() {
    let (mut bvh, ids) = scene(100, 10);
    let mut own = rebuilder(2, Swap::WhenReady, false);
    frame(&mut bvh, &mut own);
    for round in 0..12 {
        shift(&mut bvh, ids[round]);
        frame(&mut bvh, &mut own);
        for _ in 0..round % 4 * 3 {
            own.begin_frame(&mut bvh).expect("its own");
            own.end_frame(&bvh);
            sound_samples(&bvh);
        }
    }
    converge(&mut bvh, &mut own);
    assert!(bvh.to_words() == rebuilt(&bvh));
}

/// A light is a child of the new tree's root, so its subtrees can be no leaves of the top level.
#[test]
fn walks_find_their_way_where_a_mesh_has_other_subtrees() {
    let (mut bvh, _) = scene(5, 200);
    let mut own = rebuilder(1, Swap::Deterministic, true);
    converge(&mut bvh, &mut own);
    let mesh = bvh.view().mesh_id(0).expect("there");
    let other = with_one_far(&mut Random(4), 200);
    bvh.apply(std::vec![Edit::SetLights { mesh, lights: other }])
        .expect("as many");
    let mut meshes = 0;
    for _ in 0..4 {
        bvh.refit();
        own.end_frame(&bvh);
        meshes += own.begin_frame(&mut bvh).expect("its own").meshes;
        sound_samples(&bvh);
    }
    assert_eq!(meshes, 1);
}

/// Each voids the builds of the other, and misses frames besides.
#[test]
fn two_rebuilders_of_one_scene_lose_no_light() {
    let random = &mut Random(5);
    let mut bvh = LightBvh::default();
    let mut both = [1, 2].map(|after| rebuilder(after, Swap::Deterministic, true));
    for _ in 0..80 {
        let takes_part = [0; 2].map(|_| random.below(3) > 0);
        for (own, _) in both.iter_mut().zip(takes_part).filter(|(_, part)| *part) {
            own.begin_frame(&mut bvh).expect("no panic");
        }
        let _ = bvh.apply(edits(random, &bvh, 8, 60));
        bvh.refit();
        sound(&bvh);
        sound_samples(&bvh);
        for (own, _) in both.iter_mut().zip(takes_part).filter(|(_, part)| *part) {
            own.end_frame(&bvh);
        }
    }
}

#[test]
fn a_scene_left_alone_for_long_is_followed_again() {
    let (mut bvh, ids) = scene(200, 1);
    let mut own = rebuilder(1, Swap::Deterministic, true);
    frame(&mut bvh, &mut own);
    for _ in 0..200 {
        ids.iter().for_each(|&id| shift(&mut bvh, id));
        bvh.refit();
    }
    for round in 0..50 {
        shift(&mut bvh, ids[round]);
        frame(&mut bvh, &mut own);
        // Batches that the rebuilder has seen are dropped.
        assert!(bvh.batches_from(0).len() <= 2, "{round}");
    }
    converge(&mut bvh, &mut own);
    assert!(bvh.to_words() == rebuilt(&bvh));
}

#[test]
fn meshes_beyond_the_bytes_keep_their_trees() {
    let (mut bvh, _) = scene(3, 100);
    bvh.add_mesh(lamps(&mut Random(7), 200)).expect("lights");
    (0..2).for_each(|mesh| deform(&mut bvh, mesh));
    bvh.refit();
    for (lights, meshes) in [(0, 0), (150, 1), (200, 1), (200, 0)] {
        let mut own = rebuilder(1, Swap::Deterministic, true);
        own.params.bytes = lights * size_of::<EmissiveTriangle>();
        own.end_frame(&bvh);
        let mut count = 0;
        for _ in 0..9 {
            count += own.begin_frame(&mut bvh).expect("its own").meshes;
            bvh.refit();
            own.end_frame(&bvh);
        }
        assert_eq!(count, meshes, "{lights}");
    }
}

/// A build is swapped in every `after` frames plus the whole frames of the pause, `idle` times `after`.
#[test]
fn pauses_are_frames_where_trees_depend_on_frames_alone() {
    let endless = f64::INFINITY;
    let cases = [
        (1, 0.0, 1),
        (1, 1.0, 2),
        (2, 1.0, 4),
        (3, 0.5, 4),
        (2, 3.0, 8),
        (0, 2.0, 3),
    ];
    for (after, idle, period) in cases.into_iter().chain([(1, f64::NAN, 1), (1, endless, 99)]) {
        let (mut bvh, ids) = scene(50, 1);
        let mut own = rebuilder(after, Swap::Deterministic, true);
        own.params.idle = idle;
        let swaps = (0..40).filter(|&frame| {
            let start = own.begin_frame(&mut bvh).expect("its own");
            shift(&mut bvh, ids[frame]);
            bvh.refit();
            own.end_frame(&bvh);
            start.swapped
        });
        let first = after.max(1) as usize;
        assert!(swaps.eq((first..40).step_by(period)), "{after} {idle}");
    }
}
