//! What a rebuilder looks for until a tree is as good as new.

use super::*;

/// A pool of lamps parked at one point scatters: more than a part holds, so that levels above parts are tried over subtrees
/// that are all mixed and gain nothing. The parts are still built, and the tree comes to cost what a new one does.
#[test]
fn a_parked_pool_that_scatters_is_mended() {
    for seed in [1, 3, 5] {
        let random = &mut Random(seed);
        let mut scene = LightBvh::default();
        let mesh = lamp(&mut scene);
        let add = (0..4000).map(|_| Edit::AddInstance {
            mesh,
            transform: Transform::at([50.0, 2.0, 50.0]),
            radiance: 1.0,
        });
        let ids = scene.apply(add.collect()).expect("instances").instances;
        scene.refit();
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        for frame in 0..100 {
            rebuilder.begin_frame(&mut scene).expect("no panic");
            if frame == 0 {
                let moves = ids.iter().map(|&instance| Edit::SetTransform {
                    instance,
                    transform: Transform::at((random.vector() * 100.0).to_array()),
                });
                scene.apply(moves.collect()).expect("moves");
            }
            scene.refit();
            rebuilder.end_frame(&scene);
        }
        assert!(!rebuilder.is_busy());
        let whole = |scene: &LightBvh| scene.cut(scene.top.root, usize::MAX).cost;
        let mut new = scene.clone();
        let built = new.rebuild(&RebuildParams::eager()).run();
        new.install(built).expect("its own");
        new.refit();
        let (found, least) = (whole(&scene), whole(&new));
        assert!(found < 1.2 * least, "seed {seed}: {found} of {least}");
    }
}

/// Lamps that were off when the tree was built come on, all in one call: more than that call puts in elsewhere, and no node has
/// lost its order. The rest gets a tree nevertheless.
#[test]
fn lamps_that_come_on_at_once_get_a_tree() {
    for (count, seed) in [(1000, 1), (2000, 1), (10_000, 2)] {
        let random = &mut Random(seed);
        let mut scene = LightBvh::default();
        let mesh = lamp(&mut scene);
        let add = (0..count).map(|k| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 100.0).to_array()),
            radiance: (k % 2) as f32,
        });
        let ids = scene.apply(add.collect()).expect("instances").instances;
        scene.refit();
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        let mut swaps = 0;
        for frame in 0..60 {
            swaps += u32::from(rebuilder.begin_frame(&mut scene).expect("no panic").swapped);
            if frame == 0 {
                let on = ids.iter().map(|&instance| Edit::SetRadiance {
                    instance,
                    radiance: 1.0,
                });
                scene.apply(on.collect()).expect("lamps");
            }
            scene.refit();
            rebuilder.end_frame(&scene);
        }
        assert!(swaps > 0 && !rebuilder.is_busy());
        // A tree that is built as a whole knows all of them; parts come in where they pay.
        let bright = ids.iter().filter(|id| scene.shines_otherwise(id.index).0).count();
        assert!(bright == 0 || count > super::rebuild::PART, "{bright} of {count}");
    }
}

/// A part is tried once an eighth of it is in subtrees that were kept while the nodes above were built; a node above parts once
/// half of it is built anew.
#[test]
fn a_part_of_which_an_eighth_was_kept_is_tried() {
    let (mut scene, _) = grid(18);
    let root = scene.top.number(scene.top.root) as usize;
    let is_part = |scene: &LightBvh, node: u32| {
        scene.top.counts[scene.top.number(node) as usize] <= super::rebuild::PART
    };
    let nodes: Vec<u32> = scene.top.in_use().collect();
    let part = nodes.iter().copied().find(|&node| {
        node != scene.top.root && is_part(&scene, node) && !is_part(&scene, scene.parents[node as usize])
    });
    let number = scene.top.number(part.expect("a part")) as usize;
    for (at, count, share) in [
        (number, scene.top.counts[number], 8),
        (root, scene.top.counts[root], 2),
    ] {
        for (stirred, expected) in [(count.div_ceil(share) - 1, false), (count.div_ceil(share), true)] {
            scene.top.stirred[at] = stirred;
            let mut search = Search::default();
            scene.search_again(&mut search);
            let mut found = Vec::new();
            while !search.is_done() && found.is_empty() {
                found = scene.copy_worn_parts(1.1, 0, &mut search);
            }
            assert_eq!(!found.is_empty(), expected, "{stirred} of {count}");
            scene.top.stirred[at] = 0;
        }
    }
}

/// Edits between a top level that was built as a whole and its first refit count alone, not with them all that it was built of:
/// what rests has nothing to be tried.
#[test]
fn what_a_whole_top_level_was_built_of_is_no_change() {
    let random = &mut crate::kit::Random(5);
    let mut scene = LightBvh::default();
    let mesh = lamp(&mut scene);
    let mut add = |count: u32| -> Vec<Edit> {
        let place = |_| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 100.0).to_array()),
            radiance: 1.0,
        };
        (0..count).map(place).collect()
    };
    let all = add(20_000);
    scene.apply(all).expect("instances");
    for _ in 0..3 {
        let few = add(1);
        scene.apply(few).expect("instances");
    }
    scene.refit();
    let number = scene.top.number(scene.top.root) as usize;
    assert!(scene.top.changes[number] < 50, "{}", scene.top.changes[number]);
    let mut own = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let mut swapped = 0;
    for _ in 0..60 {
        swapped += u32::from(own.begin_frame(&mut scene).expect("no panic").swapped);
        scene.refit();
        own.end_frame(&scene);
    }
    assert!(swapped <= 1, "{swapped} trees for nothing");
}
