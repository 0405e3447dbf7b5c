//! Rebuilds beside the frame.

use super::*;
use crate::bvh::RebuildParams;
use crate::kit::{line, triangle};
use crate::{CompactNode, Edit, EmissiveTriangle, LightBvh, Transform};
use alloc::vec;

#[test]
fn without_threads_the_same_trees_come_at_the_same_frames() {
    let triangle = triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let run = |threads: bool| {
        let mut scene = Bvh::<CompactNode<4>, crate::Eq4, 4>::default();
        let triangles = vec![triangle];
        let mesh = scene
            .apply(vec![Edit::AddMesh { triangles }])
            .expect("a mesh")
            .meshes[0];
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            after: 2,
            swap: Swap::Deterministic,
            rebuild: RebuildParams::eager(),
            ..RebuilderParams::default()
        });
        if !threads {
            rebuilder.start = || Err(std::io::Error::other("no more threads"));
        }
        let frames = (0..20u16).map(|frame| {
            let start = rebuilder.begin_frame(&mut scene).expect("no panic");
            assert_eq!(start.swapped, frame >= 2 && frame % 2 == 0);
            assert_eq!(start.inline, start.swapped && !threads);
            let add = |k: u16| Edit::AddInstance {
                mesh,
                transform: Transform::at([f32::from(frame * k % 7), f32::from(k), f32::from(frame)]),
                radiance: 1.0,
            };
            scene.apply((0..5).map(add).collect()).expect("instances");
            scene.refit();
            scene.validate().expect("valid");
            rebuilder.end_frame(&scene);
            scene.nodes().to_vec()
        });
        frames.collect::<alloc::vec::Vec<_>>()
    };
    assert!(run(true) == run(false));
}

type Own = Rebuilder<crate::MomentNode<8>, 8>;

/// A mesh, and a rebuilder that has seen it.
fn seen() -> (crate::LightBvh, crate::MeshId, Own) {
    let mut bvh = crate::LightBvh::default();
    let mesh = bvh
        .add_mesh((0..200).map(|k| line(k, 1.0)).collect())
        .expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            drift: 1.5,
        },
        ..RebuilderParams::default()
    });
    rebuilder.end_frame(&bvh);
    assert!(!rebuilder.is_busy(), "as it was built");
    (bvh, mesh, rebuilder)
}

fn scrambled() -> alloc::vec::Vec<EmissiveTriangle> {
    (0..200).map(|k| line(k * 77 % 200, 10.0)).collect()
}

#[test]
fn other_refits_and_plans_hide_nothing() {
    let (mut bvh, mesh, mut rebuilder) = seen();
    bvh.set_triangles(mesh, scrambled()).expect("as many");
    bvh.refit();
    bvh.refit();
    bvh.plan();
    bvh.plan();
    rebuilder.end_frame(&bvh);
    assert!(rebuilder.is_busy());
    assert!(rebuilder.begin_frame(&mut bvh).expect("its own").swapped);
}

#[test]
fn a_scene_at_rest_is_built_once() {
    let (mut bvh, ..) = seen();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams::eager(),
        ..RebuilderParams::default()
    });
    let mut swapped = 0;
    for _ in 0..20 {
        swapped += u32::from(rebuilder.begin_frame(&mut bvh).expect("its own").swapped);
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    assert_eq!(swapped, 1);
}

#[test]
fn what_was_built_for_another_is_built_again() {
    let (mut bvh, mesh, mut rebuilder) = seen();
    bvh.set_triangles(mesh, scrambled()).expect("as many");
    bvh.refit();
    rebuilder.end_frame(&bvh);
    let mut other = crate::LightBvh::default();
    assert_eq!(rebuilder.begin_frame(&mut other), Err(RebuildError::Foreign));
    rebuilder.end_frame(&bvh);
    assert!(rebuilder.begin_frame(&mut bvh).expect("its own").swapped);
    // Once is enough.
    bvh.refit();
    rebuilder.end_frame(&bvh);
    assert!(!rebuilder.is_busy());
}

/// A large mesh under way is of one light BVH, and another is told so.
#[test]
fn a_large_mesh_of_another_is_an_error() {
    let mut bvh = LightBvh::default();
    let mesh = bvh
        .add_mesh((0..3000).map(|k| line(k, 1.0)).collect())
        .expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    let mixed = (0..3000)
        .map(|k: u32| line((k * 1009 % 3000) as u16, 1.0))
        .collect();
    bvh.set_triangles(mesh, mixed).expect("as many");
    bvh.refit();
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        ..RebuilderParams::default()
    });
    rebuilder.end_frame(&bvh);
    assert_eq!(rebuilder.begin_frame(&mut bvh).expect("its own").under_way, 1);
    let mut copy = bvh.clone();
    assert_eq!(rebuilder.begin_frame(&mut copy), Err(RebuildError::Foreign));
    assert_eq!(rebuilder.begin_frame(&mut copy).expect("once").dropped, 0);
    // With nobody to wait for.
    copy.refit();
    rebuilder.end_frame(&copy);
    assert_eq!(rebuilder.begin_frame(&mut copy).expect("its own").under_way, 1);
    // The first is not forgotten.
    assert_eq!(rebuilder.begin_frame(&mut bvh), Err(RebuildError::Foreign));
    let mut adopted = 0;
    for _ in 0..200 {
        bvh.refit();
        rebuilder.end_frame(&bvh);
        adopted += rebuilder.begin_frame(&mut bvh).expect("its own").adopted;
    }
    assert_eq!(adopted, 1);
    bvh.validate().expect("valid");
    rebuilder.end_frame(&copy);
    rebuilder.detach();
    copy.validate().expect("valid");
}

/// Part after part is built anew while instances move, come and go, and none again once nothing changes.
#[test]
fn large_top_levels_are_built_in_parts() {
    let mut bvh = LightBvh::default();
    let mesh = bvh
        .add_mesh((0..2).map(|k| line(k, 1.0)).collect())
        .expect("a mesh");
    let random = &mut crate::kit::Random(7);
    let place = |random: &mut crate::kit::Random| Transform::at((random.vector() * 100.0).to_array());
    let add = |random: &mut crate::kit::Random| Edit::AddInstance {
        mesh,
        transform: place(random),
        radiance: 1.0,
    };
    let all = (0..18_000).map(|_| add(random)).collect();
    let mut ids = bvh.apply(all).expect("instances").instances;
    bvh.refit();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let drift = |bvh: &LightBvh| bvh.rebuild_drift();
    // All change places, more than one batch puts in elsewhere.
    let scramble = |bvh: &mut LightBvh, ids: &[crate::InstanceId], random: &mut crate::kit::Random| {
        let moves = ids.iter().map(|&instance| Edit::SetTransform {
            instance,
            transform: place(random),
        });
        bvh.apply(moves.collect()).expect("there");
        bvh.refit();
    };
    scramble(&mut bvh, &ids, random);
    let before = drift(&bvh);
    assert!(before > 1.2, "{before}");
    let mut swapped = 0;
    for frame in 0..60 {
        swapped += u32::from(rebuilder.begin_frame(&mut bvh).expect("its own").swapped);
        let at = frame * 97 % ids.len();
        bvh.remove_instance(ids[at]).expect("there");
        bvh.take_removed_lights();
        ids[at] = bvh.apply(alloc::vec![add(random)]).expect("one more").instances[0];
        bvh.refit();
        if frame % 7 == 0 {
            bvh.validate().expect("valid");
        }
        rebuilder.end_frame(&bvh);
    }
    // What parts can mend: the levels above them stay as they are.
    let after = drift(&bvh);
    assert!(
        swapped > 5 && after < 1.0 + (before - 1.0) / 2.0,
        "{swapped} swaps: {before} to {after}"
    );
    let mut last = 0;
    for frame in 0..200 {
        if rebuilder.begin_frame(&mut bvh).expect("its own").swapped {
            last = frame;
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    bvh.validate().expect("valid");
    assert!(last < 150 && !rebuilder.is_busy(), "{last}");
    // The levels above parts are mended, too.
    let end = drift(&bvh);
    assert!(end < 1.0 + (before - 1.0) / 8.0, "{before} to {end}");
}

/// What a light BVH's nodes cost, by Ward's criterion.
fn cost(bvh: &LightBvh) -> f64 {
    use crate::node::{Node, kind};
    use crate::summary::Summary;
    let (mut cost, mut nodes) = (0.0, alloc::vec![bvh.tree().root]);
    while let Some(node) = nodes.pop() {
        let own = &bvh.nodes()[node as usize];
        for slot in (0..8).filter(|&slot| own.kind(slot) == kind::INNER) {
            let child = own.summary(slot);
            cost += f64::from(child.phi()) * f64::from(child.spread());
            nodes.push(own.link(slot));
        }
    }
    cost
}

/// Clusters that change places carry whole subtrees past each other, more than a part holds: the levels above are built anew.
#[test]
fn clusters_that_change_places_are_put_in_order() {
    let (side, clusters) = (100.0, 32_u16);
    let random = &mut crate::kit::Random(3);
    let mut points = || (random.vector() * side).to_array();
    let (from, to): (alloc::vec::Vec<_>, alloc::vec::Vec<_>) =
        (0..clusters).map(|_| (points(), points())).unzip();
    let within: alloc::vec::Vec<_> = (0..clusters * 200)
        .map(|_| (random.vector() * 2.0).to_array())
        .collect();
    let place = |k: usize, t: f32| {
        let own = k % usize::from(clusters);
        let at = |axis: usize| from[own][axis] + (to[own][axis] - from[own][axis]) * t + within[k][axis];
        Transform::at([at(0), at(1), at(2)])
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![line(0, 1.0)]).expect("a mesh");
    let all = (0..within.len()).map(|k| Edit::AddInstance {
        mesh,
        transform: place(k, 0.0),
        radiance: 1.0,
    });
    let ids = bvh.apply(all.collect()).expect("instances").instances;
    bvh.refit();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let mut last = 0;
    for frame in 1..=100_u16 {
        if rebuilder.begin_frame(&mut bvh).expect("its own").swapped {
            last = frame;
        }
        if frame <= 20 {
            let moves = ids.iter().enumerate().map(|(k, &instance)| Edit::SetTransform {
                instance,
                transform: place(k, f32::from(frame) / 20.0),
            });
            bvh.apply(moves.collect()).expect("there");
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    bvh.validate().expect("valid");
    assert!(last < 80 && !rebuilder.is_busy(), "{last}");
    let mended = cost(&bvh);
    let rebuilt = bvh.rebuild(&RebuildParams::eager()).run();
    bvh.install(rebuilt).expect("its own");
    bvh.refit();
    assert!(mended < 1.1 * cost(&bvh), "{mended} against {}", cost(&bvh));
}

/// Instances that fly together are opened a few in a frame, however many a rebuilt top level wants open.
#[test]
fn a_frame_opens_few_instances() {
    let mut bvh = LightBvh::default();
    let spread = |k: u32| line(((k * 7919) % 800) as u16, 0.02);
    let mesh = bvh.add_mesh((0..800).map(spread).collect()).expect("a mesh");
    let at = |k: u32, scale: f32| {
        let x = (k % 17) as f32 * scale;
        Transform::at([x, (k / 17) as f32 * scale, (k % 5) as f32 * scale])
    };
    let add = |k: u32| Edit::AddInstance {
        mesh,
        transform: at(k, 400.0),
        radiance: 1.0,
    };
    let ids = bvh
        .apply((0..300).map(add).collect())
        .expect("instances")
        .instances;
    bvh.refit();
    let opened = |bvh: &LightBvh| -> alloc::vec::Vec<bool> {
        let own = ids.iter().map(|id| bvh.instances()[id.index() as usize]);
        own.map(|own| own.part != u32::MAX).collect()
    };
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let (mut most, mut all, mut scale) = (0, 0, 400.0);
    for frame in 0..240 {
        let before = opened(&bvh);
        rebuilder.begin_frame(&mut bvh).expect("no panic");
        let changed = before.iter().zip(opened(&bvh)).filter(|(a, b)| **a != *b).count();
        (most, all) = (most.max(changed), all + changed);
        if frame < 30 {
            scale *= 0.7;
            let edits = ids.iter().zip(0..).map(|(&instance, k)| Edit::SetTransform {
                instance,
                transform: at(k, scale),
            });
            bvh.apply(edits.collect()).expect("moved");
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    bvh.validate().expect("valid");
    assert!(all > 20, "{all}: nothing is tested");
    assert!(most <= REOPENED, "{most} in one frame");
}

/// Large meshes come in piece by piece: without threads as many frames pass for room and for the builder as with them.
#[test]
fn without_threads_large_meshes_come_at_the_same_frames() {
    let lamp = |k: u32| {
        let [x, y, z] = [1, 2, 3].map(|axis| 10.0 * crate::exact::unit_f32(crate::exact::hash(7 * k + axis)));
        triangle([[x, y, z], [x + 0.02, y, z], [x, y + 0.02, z]])
    };
    let run = |threads: bool| {
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh((0..3000).map(lamp).collect()).expect("a mesh");
        let small = bvh.add_mesh(vec![lamp(1)]).expect("a mesh");
        let add = [mesh, small, mesh].into_iter().zip([0.0, 20.0, 40.0]);
        let add = add.map(|(mesh, x)| Edit::AddInstance {
            mesh,
            transform: Transform::at([x, 0.0, 0.0]),
            radiance: 1.0,
        });
        bvh.apply(add.collect()).expect("instances");
        bvh.set_triangles(mesh, (5000..8000).map(lamp).collect())
            .expect("as many");
        bvh.refit();
        let mut rebuilder = Own::new(RebuilderParams {
            after: 3,
            swap: Swap::Deterministic,
            bytes: 1 << 14,
            ..RebuilderParams::default()
        });
        if !threads {
            rebuilder.start = || Err(std::io::Error::other("no more threads"));
        }
        rebuilder.end_frame(&bvh);
        let mut adopted = None;
        let mut words = alloc::vec::Vec::new();
        for frame in 0..150_u32 {
            let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
            if start.adopted > 0 {
                adopted.get_or_insert(frame);
            }
            bvh.refit();
            rebuilder.end_frame(&bvh);
            words.push(bvh.to_words());
        }
        (adopted.expect("a new tree"), words)
    };
    let (with, without) = (run(true), run(false));
    assert_eq!(with.0, without.0);
    let first = with.1.iter().zip(&without.1).position(|(a, b)| a != b);
    assert_eq!(first, None, "the first frame that differs");
}

/// Parts are built of a mesh with few instances. Of one with many each part would have all of them refitted, so none is.
#[test]
fn meshes_of_many_instances_are_built_as_a_whole_alone() {
    for (count, has_parts) in [(2, true), (300, false)] {
        let lamp = |k: u32| {
            let [x, y, z] =
                [1, 2, 3].map(|axis| 10.0 * crate::exact::unit_f32(crate::exact::hash(7 * k + axis)));
            triangle([[x, y, z], [x + 0.02, y, z], [x, y + 0.02, z]])
        };
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh((0..6000).map(lamp).collect()).expect("a mesh");
        let add = (0..count as u16).map(|k| Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::from(k), 0.0, 0.0]),
            radiance: 1.0,
        });
        let add = add.collect();
        bvh.apply(add).expect("instances");
        bvh.set_triangle_range(mesh, 0, (9000..9300).map(lamp).collect())
            .expect("in the mesh");
        bvh.refit();
        let mut rebuilder = Own::new(RebuilderParams {
            swap: Swap::WhenReady,
            rebuild: RebuildParams {
                top: f64::INFINITY,
                drift: 1.009,
            },
            ..RebuilderParams::default()
        });
        // As though only a part were worn.
        let strained = vec![0];
        rebuilder
            .meshes
            .await_turn([vec![], strained, vec![]], 0, &bvh, &rebuilder.params);
        assert_eq!(rebuilder.meshes.is_busy(), has_parts, "{count}");
        let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
        assert_eq!(start.waited, core::time::Duration::ZERO, "it never waits");
    }
}

/// A mesh of which each light goes round in a time of its own, so that a new tree is worn before it comes in: it was begun
/// twice each time, as it was and as it had come in, and one of them dropped.
#[test]
fn a_tree_that_is_worn_as_it_comes_in_is_begun_once() {
    let lights = |turn: u32| {
        let light = |k: u32| {
            let along = (turn * (k % 7 + 1) + 13 * k) % 400;
            line(along as u16, 1.0 + (k % 5) as f32)
        };
        (0..2000).map(light).collect::<alloc::vec::Vec<_>>()
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lights(0)).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let (mut adopted, mut dropped) = (0, 0);
    for turn in 1..200 {
        let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
        adopted += start.adopted;
        dropped += start.dropped;
        bvh.set_triangles(mesh, lights(turn)).expect("as many");
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    assert!(adopted > 20 && dropped == 0, "{adopted}, {dropped}");
}
