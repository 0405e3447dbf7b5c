//! Builds in the background by nodes that can be held up or made to panic: nothing is lost when the worker is slow, panics, or is
//! dropped. That trees do not depend on its speed is in core's own tests.

use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use lightbvh::bvh::Swap;
use lightbvh::{Bvh, Edit, Eq4, LightBounds, MeshId, RebuildError, Rebuilder, RebuilderParams, Transform};
use lightbvh_tests::edits::{Model, edits};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::assert_sum_is_one;
use lightbvh_tests::placing::{self, Kind};
use lightbvh_tests::slowed::{self, Pace, Slowed};

mod faults;

type Tree<const TEST: usize> = Bvh<Slowed<TEST>, (), 4>;

const REACH: f32 = 20.0;

fn params(after: u32, swap: Swap) -> RebuilderParams {
    RebuilderParams {
        after,
        swap,
        idle: 0.0,
        ..RebuilderParams::default()
    }
}

fn check_pmfs<const TEST: usize>(scene: &Tree<TEST>, model: &Model, random: &mut Random) {
    let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
    assert_eq!(stats.instances as usize, model.instances.len());
    for _ in 0..8 {
        let point = generate::point(random, REACH);
        let (mut pmfs, mut any) = (Vec::new(), false);
        for (&id, (mesh, _, radiance)) in &model.instances {
            let lights = scene.lights_of(id).expect("it is there");
            for (light, local) in lights.zip(&model.meshes[mesh]) {
                let pmf = scene.by::<Eq4>().pmf(&point, light, id.index());
                let shines = *radiance > 0.0 && LightBounds::of_triangle(local).phi > 0.0;
                assert_eq!(pmf > 0.0, shines, "light {light} at {point:?}");
                any |= shines;
                pmfs.push(pmf);
            }
        }
        assert_eq!(scene.by::<Eq4>().sample(&point, random.bits()).pmf > 0.0, any);
        if any {
            assert_sum_is_one::<Slowed<TEST>, Eq4, 4>(pmfs, &point);
        }
    }
}

/// A scene of `count` instances of a mesh, refitted.
fn town<const TEST: usize>(random: &mut Random, count: u32) -> (Tree<TEST>, Model, MeshId) {
    let (mut scene, mut model) = (Tree::<TEST>::default(), Model::default());
    let triangles = generate::small_triangles(40, 40, 2.0, 0.2, false, random.bits());
    let mesh = scene.add_mesh(triangles.clone()).expect("a mesh");
    model.meshes.insert(mesh, triangles);
    let transforms: Vec<Transform> = (0..count)
        .map(|_| placing::transform(random, Kind::Similar, REACH))
        .collect();
    let batch = transforms.iter().map(|&transform| Edit::AddInstance {
        mesh,
        transform,
        radiance: 1.0,
    });
    let added = scene.apply(batch.collect()).expect("instances").instances;
    for (id, transform) in added.into_iter().zip(transforms) {
        model.instances.insert(id, (mesh, transform, 1.0));
    }
    scene.refit();
    (scene, model, mesh)
}

/// The triangles of a mesh in another order.
fn shuffle<const TEST: usize>(random: &mut Random, scene: &mut Tree<TEST>, model: &mut Model, mesh: MeshId) {
    let triangles = model.meshes.get_mut(&mesh).expect("it is there");
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, random.below(i as u32 + 1) as usize);
    }
    scene.set_triangles(mesh, triangles.clone()).expect("as many");
    scene.refit();
}

/// The words of the scene with rebuilt trees.
fn rebuilt<const TEST: usize>(scene: &Tree<TEST>) -> Vec<u32> {
    let mut scene = scene.clone();
    scene.rebuild();
    scene.to_words()
}

/// Runs frames without edits until nothing is left to build.
fn come_to_rest<const TEST: usize>(rebuilder: &mut Rebuilder<Slowed<TEST>, 4>, scene: &mut Tree<TEST>) {
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
    const TEST: usize = 1;
    slowed::spare();
    let random = &mut Random::new(20);
    let (mut scene, mut model, _) = town::<TEST>(random, 30);
    let mut rebuilder = Rebuilder::new(params(1, Swap::WhenReady));
    slowed::set::<TEST>(Pace::Held);
    rebuilder.begin_frame(&mut scene).expect("nothing is due");
    rebuilder.end_frame(&scene);
    slowed::wait_until_held::<TEST>();
    for _ in 0..20 {
        // Held, the worker cannot end: had anything here waited for it, the test would not come past it.
        let start = rebuilder.begin_frame(&mut scene).expect("no panic");
        assert!(!start.swapped && rebuilder.is_busy());
        edits(random, &mut model, &mut scene, REACH);
        scene.refit();
        check_pmfs(&scene, &model, random);
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
    check_pmfs(&scene, &model, random);
    come_to_rest(&mut rebuilder, &mut scene);
    assert!(scene.to_words() == rebuilt(&scene));
}

#[test]
fn a_mesh_that_changes_while_it_is_built_is_built_again() {
    const TEST: usize = 2;
    let random = &mut Random::new(50);
    let (mut scene, mut model, mesh) = town::<TEST>(random, 5);
    let mut rebuilder = Rebuilder::new(params(2, Swap::Deterministic));
    let mut meshes = 0;
    for frame in 0..12 {
        meshes += rebuilder.begin_frame(&mut scene).expect("no panic").meshes;
        // Each build takes two frames.
        if frame < 8 {
            shuffle(random, &mut scene, &mut model, mesh);
        }
        scene.refit();
        check_pmfs(&scene, &model, random);
        rebuilder.end_frame(&scene);
    }
    assert!(meshes > 1, "{meshes}");
    come_to_rest(&mut rebuilder, &mut scene);
    assert!(scene.to_words() == rebuilt(&scene));
}

#[test]
fn a_rebuilder_moves_between_threads() {
    fn sends<T: Send + 'static>() {}
    sends::<Rebuilder<Slowed<2>, 4>>();
}
