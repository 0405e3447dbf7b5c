//! Builds in the background by nodes that can be held up or made to panic: nothing is lost when the worker is slow, panics, or is
//! dropped. That trees do not depend on its speed is in core's own tests.

use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use lightbvh::bvh::Swap;
use lightbvh::{Bvh, Edit, MeshId, RebuildError, Rebuilder, RebuilderParams};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::placing::{self, Kind};
use lightbvh_tests::slowed::{self, Pace, Slowed};

type Tree<const TEST: usize> = Bvh<Slowed<TEST>, (), 4>;

const REACH: f32 = 20.0;

fn rebuilder<const TEST: usize>(swap: Swap) -> Rebuilder<Slowed<TEST>, 4> {
    Rebuilder::new(RebuilderParams {
        after: 1,
        swap,
        idle: 0.0,
        ..RebuilderParams::default()
    })
}

/// A scene of 30 instances of a mesh, refitted.
fn town<const TEST: usize>(seed: u32) -> (Tree<TEST>, MeshId) {
    let random = &mut Random::new(seed);
    let mut scene = Tree::<TEST>::default();
    let triangles = generate::small_triangles(40, 40, 2.0, 0.2, false, seed);
    let mesh = scene.add_mesh(triangles).expect("a mesh");
    let add = (0..30).map(|_| Edit::AddInstance {
        mesh,
        transform: placing::transform(random, Kind::Similar, REACH),
        radiance: 1.0,
    });
    scene.apply(add.collect()).expect("instances");
    scene.refit();
    (scene, mesh)
}

/// Moves, adds and removes instances: alike in equal scenes.
fn edit<const TEST: usize>(seed: u32, scene: &mut Tree<TEST>) {
    let random = &mut Random::new(seed);
    let all = 0..scene.instances().len() as u32;
    let ids: Vec<_> = all.filter_map(|k| scene.instance_id(k)).collect();
    let count = ids.len() as u32;
    let mesh = scene.mesh_of(ids[0]).expect("its mesh");
    let mut at = || placing::transform(random, Kind::Similar, REACH);
    let (moved, added) = (at(), at());
    let instance = ids[random.below(count) as usize];
    scene.set_transform(instance, moved).expect("there");
    scene.add_instance(mesh, added).expect("a mesh");
    scene
        .remove_instance(ids[random.below(count) as usize])
        .expect("there");
    scene.take_removed_lights();
    scene.refit();
    scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
}

/// The words of the scene with rebuilt trees.
fn rebuilt<const TEST: usize>(scene: &Tree<TEST>) -> Vec<u32> {
    let mut scene = scene.clone();
    scene.rebuild();
    scene.to_words()
}

/// Runs frames without edits until nothing is left to build.
fn converge<const TEST: usize>(rebuilder: &mut Rebuilder<Slowed<TEST>, 4>, scene: &mut Tree<TEST>) {
    loop {
        rebuilder.end_frame(scene);
        if !rebuilder.is_busy() {
            return;
        }
        rebuilder.begin_frame(scene).expect("no panic");
        scene.refit();
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn edits_during_a_build_lose_nothing_and_wait_for_nothing() {
    const TEST: usize = 0;
    slowed::spare();
    let ((mut scene, _), (mut twin, _)) = (town::<TEST>(20), town::<TEST>(20));
    let mut rebuilder = rebuilder(Swap::WhenReady);
    slowed::set::<TEST>(Pace::Held);
    rebuilder.begin_frame(&mut scene).expect("nothing is due");
    rebuilder.end_frame(&scene);
    slowed::wait_until_held::<TEST>();
    for frame in 0..20 {
        // The worker is held: if a call waited for it, the test would stop here.
        let start = rebuilder.begin_frame(&mut scene).expect("no panic");
        assert!(!start.swapped && rebuilder.is_busy());
        edit(frame, &mut scene);
        edit(frame, &mut twin);
        rebuilder.end_frame(&scene);
    }
    slowed::set::<TEST>(Pace::Full);
    let built = loop {
        let start = rebuilder.begin_frame(&mut scene).expect("no panic");
        if start.swapped {
            break start.built;
        }
        thread::sleep(Duration::from_millis(1));
    };
    assert!(built > Duration::ZERO, "building takes time");
    scene.refit();
    converge(&mut rebuilder, &mut scene);
    assert_eq!(scene.world_lights(), twin.world_lights());
    assert!(scene.to_words() == rebuilt(&scene));
    fn sends<T: Send + 'static>(_: T) {}
    sends(rebuilder);
}

#[test]
fn a_panic_is_reported_once_and_the_next_build_is_sound() {
    const TEST: usize = 1;
    for swap in [Swap::Deterministic, Swap::WhenReady] {
        slowed::spare();
        let (mut scene, mesh) = town::<TEST>(30);
        let mut rebuilder = rebuilder(swap);
        // Builds of the top level and of the mesh, in turn.
        for _ in 0..4 {
            let mut triangles = scene.mesh_triangles(mesh).expect("there").to_vec();
            triangles.rotate_left(7);
            scene.set_triangles(mesh, triangles).expect("as many");
            scene.refit();
            let before = scene.to_words();
            slowed::set::<TEST>(Pace::Panic);
            rebuilder.end_frame(&scene);
            let error = loop {
                match rebuilder.begin_frame(&mut scene) {
                    Err(error) => break error,
                    Ok(start) => assert!(!start.swapped && start.meshes == 0),
                }
            };
            let RebuildError::Panicked { message } = &error else {
                panic!("{error}");
            };
            assert_eq!(message, "told to panic");
            assert!(!rebuilder.is_busy());
            let start = rebuilder.begin_frame(&mut scene).expect("reported once");
            assert!(!start.swapped && start.meshes == 0);
            scene.refit();
            assert!(scene.to_words() == before, "the trees are as they were");
        }
        slowed::set::<TEST>(Pace::Full);
        converge(&mut rebuilder, &mut scene);
        assert!(scene.to_words() == rebuilt(&scene));
        scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
    }
}

#[test]
fn dropped_while_it_builds_it_ends() {
    const TEST: usize = 2;
    let (done, ended) = mpsc::channel();
    let dropping = thread::spawn(move || {
        slowed::spare();
        let (mut scene, _) = town::<TEST>(40);
        // Never used; idle after a build; in the middle of one.
        drop(rebuilder::<TEST>(Swap::WhenReady));
        let mut idle = rebuilder(Swap::Deterministic);
        idle.end_frame(&scene);
        idle.begin_frame(&mut scene).expect("no panic");
        drop(idle);
        let mut busy = rebuilder(Swap::Deterministic);
        slowed::set::<TEST>(Pace::Held);
        busy.end_frame(&scene);
        slowed::wait_until_held::<TEST>();
        let release = thread::spawn(|| {
            thread::sleep(Duration::from_millis(30));
            slowed::set::<TEST>(Pace::Full);
        });
        drop(busy);
        release.join().expect("released");
        done.send(()).expect("someone listens");
    });
    ended
        .recv_timeout(Duration::from_secs(60))
        .expect("dropping ends");
    dropping.join().expect("no panic");
}
