//! Builds in the background by nodes that can be held up or made to panic: nothing is lost when the worker is slow or panics. That trees
//! do not depend on its speed is in core's own tests, that a dropped rebuilder ends is in `core/tests/handover.rs`.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use bytemuck::{Pod, Zeroable};
use lightbvh::bvh::Swap;
use lightbvh::device::bounds::LightBounds;
use lightbvh::device::summary::Lanes;
use lightbvh::node::Holds;
use lightbvh::{Bvh, CompactNode, Edit, EmissiveTriangle, MeshId, Node, Rebuilder, RebuilderParams};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::placing::{self, Kind};

const REACH: f32 = 20.0;

/// The worker passes it for each child: it waits while a test holds it, and panics if it is true.
static GATE: Mutex<bool> = Mutex::new(false);
/// The tests share the gate, so only one runs at a time.
static SERIAL: Mutex<()> = Mutex::new(());

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A [`CompactNode`] of width 4 whose building on the rebuilder's thread the gate governs.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Gated(CompactNode<4>);

impl Holds for Gated {
    type Light = EmissiveTriangle;
}

impl Node<4> for Gated {
    type Summary = LightBounds;

    const EMPTY: Self = Self(<CompactNode<4> as Node<4>>::EMPTY);
    const NAME: &'static str = "gated";

    fn kind(&self, slot: usize) -> u32 {
        self.0.kind(slot)
    }
    fn link(&self, slot: usize) -> u32 {
        self.0.link(slot)
    }
    fn summary(&self, slot: usize) -> LightBounds {
        self.0.summary(slot)
    }
    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        if thread::current().name() == Some("lightbvh-rebuild") {
            assert!(!*lock(&GATE), "told to panic");
        }
        self.0.set_child(slot, kind, link);
    }
    fn relink(&mut self, slot: usize, link: u32) {
        self.0.relink(slot, link);
    }
    fn set_lanes(&mut self, summaries: &Lanes<4>) {
        self.0.set_lanes(summaries);
    }
}

type Tree = Bvh<(Gated, ()), 4>;

fn rebuilder(swap: Swap) -> Rebuilder<(Gated, ()), 4> {
    Rebuilder::new(RebuilderParams {
        after: 1,
        swap,
        idle: 0.0,
        ..RebuilderParams::default()
    })
}

/// A scene of 30 instances of a mesh, refitted.
fn town(seed: u32) -> (Tree, MeshId) {
    let random = &mut Random::new(seed);
    let mut scene = Tree::default();
    let triangles = generate::small_triangles(40, 40, 2.0, 0.2, false, seed);
    let mesh = scene.add_mesh(triangles).expect("a mesh");
    let add = (0..30).map(|_| Edit::AddInstance {
        mesh,
        transform: placing::transform(random, Kind::Similar, REACH),
        radiance: [1.0; 3],
        mask: u32::MAX,
    });
    scene.apply(add.collect()).expect("instances");
    scene.refit();
    (scene, mesh)
}

/// Moves, adds and removes instances: alike in equal scenes.
fn edit(seed: u32, scene: &mut Tree) {
    let random = &mut Random::new(seed);
    let ids: Vec<_> = scene.view().instance_ids().collect();
    let count = ids.len() as u32;
    let mesh = scene.view().mesh_of(ids[0]).expect("its mesh");
    let mut at = || placing::transform(random, Kind::Similar, REACH);
    let (moved, added) = (at(), at());
    let instance = ids[random.below(count) as usize];
    scene.set_transform(instance, moved).expect("there");
    scene.add_instance(mesh, added).expect("a mesh");
    scene.remove(ids[random.below(count) as usize]).expect("there");
    scene.take_removed_lights();
    scene.refit();
    scene.view().validate().expect("valid");
}

/// The words of the scene with rebuilt trees.
fn rebuilt(scene: &Tree) -> Vec<u32> {
    let mut scene = scene.clone();
    scene.rebuild();
    scene.to_words()
}

/// Runs frames without edits until nothing is left to build.
fn converge(rebuilder: &mut Rebuilder<(Gated, ()), 4>, scene: &mut Tree) {
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
    let _alone = lock(&SERIAL);
    let ((mut scene, _), (mut twin, _)) = (town(20), town(20));
    let mut rebuilder = rebuilder(Swap::WhenReady);
    rebuilder.begin_frame(&mut scene).expect("nothing is due");
    let held = lock(&GATE);
    rebuilder.end_frame(&scene);
    for frame in 0..20 {
        // The worker is held: if a call waited for it, the test would stop here.
        let start = rebuilder.begin_frame(&mut scene).expect("no panic");
        assert!(!start.swapped && rebuilder.is_busy());
        edit(frame, &mut scene);
        edit(frame, &mut twin);
        rebuilder.end_frame(&scene);
    }
    drop(held);
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
    assert_eq!(scene.view().world_lights(), twin.view().world_lights());
    assert!(scene.to_words() == rebuilt(&scene));
}

#[test]
fn a_panic_is_reported_once_and_the_next_build_is_sound() {
    let _alone = lock(&SERIAL);
    for swap in [Swap::Deterministic, Swap::WhenReady] {
        let (mut scene, mesh) = town(30);
        let mut rebuilder = rebuilder(swap);
        // Builds of the top level and of the mesh, in turn.
        for _ in 0..4 {
            let mut triangles = scene.view().mesh_lights(mesh).expect("there").to_vec();
            triangles.rotate_left(7);
            let edit = Edit::SetLights {
                mesh,
                lights: triangles,
            };
            scene.apply(vec![edit]).expect("as many");
            scene.refit();
            let before = scene.to_words();
            *lock(&GATE) = true;
            rebuilder.end_frame(&scene);
            let error = loop {
                match rebuilder.begin_frame(&mut scene) {
                    Err(error) => break error,
                    Ok(start) => assert!(!start.swapped && start.meshes == 0),
                }
            };
            let said = error.to_string();
            assert!(
                said.contains("panicked: told to panic") && said.contains("keeps its trees"),
                "{said}"
            );
            assert!(!rebuilder.is_busy());
            let start = rebuilder.begin_frame(&mut scene).expect("reported once");
            assert!(!start.swapped && start.meshes == 0);
            scene.refit();
            assert!(scene.to_words() == before, "the trees are as they were");
        }
        *lock(&GATE) = false;
        converge(&mut rebuilder, &mut scene);
        assert!(scene.to_words() == rebuilt(&scene));
        scene.view().validate().expect("valid");
    }
}
