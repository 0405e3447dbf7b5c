//! What is noted of top levels, and what edits leave of them.

extern crate std;

use alloc::vec;
use core::ops::Range;

use super::*;
use crate::bvh::RebuildParams;
use crate::kit::{Random, triangle};
use crate::{CompactNode, Edit, InstanceId, LightBvh, MeshId, Transform};

fn lamp<N: LightNode<W>, I, const W: usize>(scene: &mut Bvh<N, I, W>) -> MeshId {
    scene
        .add_mesh(vec![triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])])
        .expect("a mesh")
}

/// What edits and rebuilds note of a tree is what walking it finds.
#[test]
fn trees_are_noted_as_walked_ones() {
    let mut scene = Bvh::<CompactNode<4>, crate::Eq4, 4>::default();
    let mesh = lamp(&mut scene);
    for count in [0u16, 1, 2, 3, 50, 300] {
        let add = (0..count).map(|k| Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::from(k * 37 % 97), f32::from(k % 7), f32::from(k)]),
            radiance: 1.0,
        });
        let added = scene.apply(add.collect()).expect("instances").instances;
        // Gaps among the indices.
        let gone = added.iter().skip(1).step_by(3);
        scene
            .apply(gone.map(|&id| Edit::RemoveInstance(id)).collect())
            .expect("they are there");
        scene.refit();
        scene.validate().expect("valid");
        let rebuilt = scene.rebuild(&RebuildParams::eager()).run();
        scene.install(rebuilt).expect("its own");
        let (noted, instances) = (
            alloc::format!("{:?}{:?}", scene.top.heights, scene.placed),
            scene.instances.clone(),
        );
        scene.index_top();
        assert!(
            noted == alloc::format!("{:?}{:?}", scene.top.heights, scene.placed),
            "{count}"
        );
        assert_eq!(instances, scene.instances, "{count}");
        scene.refit();
        scene.validate().expect("valid");
    }
}

/// Random edits one by one, each followed by what it must leave.
fn edits_leave_a_valid_tree<N: LightNode<W>, I, const W: usize>(seed: u32, rounds: u32) {
    let random = &mut Random(seed);
    let mut scene = Bvh::<N, I, W>::default();
    let mesh = lamp(&mut scene);
    let mut ids: vec::Vec<InstanceId> = vec![];
    let place = |random: &mut Random| {
        let v = random.vector() * if random.unit() < 0.1 { 1000.0 } else { 10.0 };
        Transform::at(v.to_array())
    };
    for round in 0..rounds {
        let grows = round < rounds / 2;
        let at = (random.unit() * ids.len() as f32) as usize;
        let choice = random.unit();
        if ids.is_empty() || choice < if grows { 0.5 } else { 0.2 } {
            ids.push(scene.add_instance(mesh, place(random)).expect("one more"));
        } else if choice < 0.6 {
            scene
                .remove_instance(ids.swap_remove(at.min(ids.len() - 1)))
                .expect("there");
        } else {
            let id = ids[at.min(ids.len() - 1)];
            let edit = match choice {
                0.6..0.8 => scene.set_transform(id, place(random)),
                0.8..0.9 => scene.set_radiance(id, 0.0),
                _ => scene.set_radiance(id, random.unit() + 0.5),
            };
            edit.expect("there");
        }
        if round % 7 == 0 {
            scene.refit();
            let stats = scene
                .validate()
                .unwrap_or_else(|violation| panic!("{round}: {violation}"));
            assert_eq!(stats.instances as usize, ids.len());
        }
    }
    for id in ids {
        scene.remove_instance(id).expect("there");
    }
    scene.refit();
    scene.validate().expect("valid");
    assert_eq!(scene.top.len(), 1);
}

#[test]
fn edits_one_by_one_leave_valid_trees() {
    for seed in 0..4 {
        edits_leave_a_valid_tree::<crate::MomentNode<8>, crate::Moments, 8>(seed, 1500);
        edits_leave_a_valid_tree::<CompactNode<4>, crate::Eq4, 4>(seed, 1500);
        edits_leave_a_valid_tree::<CompactNode<2>, crate::Eq4, 2>(seed, 700);
        edits_leave_a_valid_tree::<crate::FullNode<3>, crate::Eq4, 3>(seed, 700);
    }
}

/// Each lamp at half the distance of the one before: the deepest tree that criteria of distance give. It ends at the levels that
/// places have.
#[test]
fn no_order_of_additions_is_too_deep() {
    fn add<N: LightNode<W>, I, const W: usize>(count: i32) {
        let mut scene = Bvh::<N, I, W>::default();
        let mesh = lamp(&mut scene);
        let mut ids = vec![];
        for k in 0..count {
            let at = Transform::at([crate::exact::pow2(38 - k % 90), (k / 90) as f32, 0.0]);
            ids.push(scene.add_instance(mesh, at).expect("one more"));
            assert!(scene.top.depth() <= crate::trail::max_levels(W));
        }
        scene.refit();
        scene.validate().expect("valid");
        for id in ids.into_iter().rev() {
            scene.remove_instance(id).expect("there");
        }
        scene.refit();
        scene.validate().expect("valid");
    }
    add::<crate::MomentNode<8>, crate::Moments, 8>(700);
    add::<CompactNode<2>, crate::Eq4, 2>(700);
    add::<CompactNode<16>, crate::Eq4, 16>(700);
}

/// A few nodes of each level are written, and the records of what they hold, however many instances there are.
#[test]
fn an_edit_writes_what_is_on_its_path() {
    for count in [1000_u32, 20_000] {
        let mut scene = LightBvh::default();
        let mesh = lamp(&mut scene);
        let random = &mut Random(count);
        let add = |random: &mut Random| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 100.0).to_array()),
            radiance: 1.0,
        };
        let all = (0..count).map(|_| add(random)).collect();
        let mut ids = scene.apply(all).expect("instances").instances;
        scene.refit();
        scene.plan();
        // Of a build of the largest subtree that an edit builds, and on average.
        let (most, edits) = (super::settle::MOST as usize, 300);
        let (mut all_nodes, mut all_records) = (0, 0);
        for round in 0..edits {
            let at = (random.unit() * (count - 1) as f32) as usize;
            match round % 3 {
                0 => {
                    scene.remove_instance(ids[at]).expect("there");
                    ids[at] = scene.apply(vec![add(random)]).expect("one more").instances[0];
                }
                1 => scene
                    .set_transform(ids[at], Transform::at((random.vector() * 100.0).to_array()))
                    .expect("there"),
                _ => scene.set_radiance(ids[at], random.unit()).expect("there"),
            }
            let depth = scene.depth() as usize;
            let plan = scene.plan();
            let sum = |ranges: &[Range<u32>]| ranges.iter().map(|range| range.len()).sum::<usize>();
            let (nodes, records) = (sum(&plan.written_nodes), sum(&plan.written_instances));
            let computed = plan.top.nodes().len();
            assert!(
                computed <= most + 4 * depth,
                "{round}: {computed} nodes are computed"
            );
            assert!(nodes <= most + 4 * depth, "{round}: {nodes} nodes are written");
            assert!(records <= 2 * most + 8 * depth, "{round}: {records} records");
            all_nodes += computed;
            all_records += records;
        }
        let (nodes, records) = (all_nodes / edits, all_records / edits);
        assert!(
            nodes <= 40 && records <= 100,
            "{count}: {nodes} nodes, {records} records"
        );
        scene.refit();
        scene.validate().expect("valid");
    }
}

/// Most instances go while a top level is built: nodes that lose all they had, beside others that do.
#[test]
fn a_tree_most_of_whose_instances_are_gone_comes_in() {
    fn check<N: LightNode<W>, I, const W: usize>(seed: u32) {
        let random = &mut Random(seed);
        let mut scene = Bvh::<N, I, W>::default();
        let mesh = lamp(&mut scene);
        let add = |random: &mut Random| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 10.0).to_array()),
            radiance: 1.0,
        };
        let all = (0..400).map(|_| add(random)).collect();
        let ids = scene.apply(all).expect("instances").instances;
        scene.refit();
        for part in [0.5, 0.1, 0.02, 0.0] {
            let rebuild = scene.rebuild(&RebuildParams::eager());
            let gone = ids
                .iter()
                .filter(|&&id| scene.mesh_of(id).is_some() && random.unit() >= part);
            let gone = gone.map(|&id| Edit::RemoveInstance(id)).collect();
            scene.apply(gone).expect("there");
            scene.install(rebuild.run()).expect("its own");
            scene.refit();
            scene
                .validate()
                .unwrap_or_else(|violation| panic!("{seed}, {part}: {violation}"));
        }
    }
    for seed in 0..20 {
        check::<crate::MomentNode<8>, crate::Moments, 8>(seed);
        check::<crate::FullNode<4>, crate::Eq4, 4>(seed);
        check::<CompactNode<2>, crate::Eq4, 2>(seed);
    }
}

/// A grid of lamps, refitted.
fn grid(side: u16) -> (LightBvh, vec::Vec<InstanceId>) {
    let mut scene = LightBvh::default();
    let mesh = lamp(&mut scene);
    let place = |k: u16| {
        [
            f32::from(k % side) * 4.0,
            f32::from(k / side % side) * 4.0,
            f32::from(k / side / side) * 4.0,
        ]
    };
    let all = (0..side * side * side).map(|k| Edit::AddInstance {
        mesh,
        transform: Transform::at(place(k)),
        radiance: 1.0,
    });
    let ids = scene.apply(all.collect()).expect("instances").instances;
    scene.refit();
    (scene, ids)
}

/// Whether an instance is put in elsewhere by what `edit` does: links of nodes are written then.
fn is_put_elsewhere(scene: &LightBvh, edit: impl FnOnce(&mut LightBvh)) -> bool {
    let mut scene = scene.clone();
    scene.plan();
    edit(&mut scene);
    !scene.plan().written_nodes.is_empty()
}

/// On each side of what decides it.
#[test]
fn what_is_misplaced_is_put_in_elsewhere() {
    let (scene, ids) = grid(10);
    let id = |scene: &LightBvh, k: usize| scene.instance_id(ids[k].index()).expect("there");
    for k in [0, 99, 500, 555, 999] {
        let from = scene.placed[ids[k].index() as usize].transform;
        let moved = |by: f32| {
            is_put_elsewhere(&scene, |scene| {
                let mut to = from;
                to.translation[0] += by;
                scene.set_transform(id(scene, k), to).expect("there");
            })
        };
        assert!(!moved(0.5) && !moved(-0.5), "{k}: nearby");
        assert!(moved(200.0) && moved(-200.0), "{k}: far off");
        let dimmed = |to: f32| {
            is_put_elsewhere(&scene, |scene| {
                scene.set_radiance(id(scene, k), to).expect("there")
            })
        };
        assert!(!dimmed(1.9) && !dimmed(0.6), "{k}: about as bright");
        assert!(dimmed(2.5) && dimmed(0.3), "{k}: another brightness");
    }
}

/// As many as one call may put in elsewhere, and no more, however many are misplaced.
#[test]
fn no_call_puts_all_in_elsewhere() {
    let (mut scene, ids) = grid(20);
    let stamp = scene.epoch;
    let brighter = ids.iter().map(|&instance| Edit::SetRadiance {
        instance,
        radiance: 8.0,
    });
    scene.apply(brighter.collect()).expect("there");
    let put = scene.placed.iter().filter(|placed| placed.hung > stamp).count();
    assert_eq!(put, 64 + ids.len() / 64);
    scene.refit();
    scene.validate().expect("valid");
}

/// A lamp that goes dim and bright again is put in elsewhere twice, and then no more.
#[test]
fn a_lamp_that_flickers_stays_where_its_light_belongs() {
    let (mut scene, ids) = grid(10);
    for k in [0, 555] {
        let mut put = 0;
        for frame in 0..20 {
            scene.plan();
            let radiance = if frame % 2 == 0 { 0.01 } else { 1.0 };
            scene.set_radiance(ids[k], radiance).expect("there");
            put += u32::from(!scene.plan().written_nodes.is_empty());
            scene.refit();
        }
        assert_eq!(put, 2, "{k}");
        // Brighter than it ever was is another matter.
        scene.plan();
        scene.set_radiance(ids[k], 3.0).expect("there");
        assert!(!scene.plan().written_nodes.is_empty(), "{k}");
        // What is read again flickers on.
        let mut again = LightBvh::from_words(&scene.to_words()).expect("its own");
        let id = again.instance_id(ids[k].index()).expect("there");
        again.refit();
        again.plan();
        again.set_radiance(id, 0.01).expect("there");
        assert!(again.plan().written_nodes.is_empty(), "{k}");
    }
    scene.refit();
    scene.validate().expect("valid");
}

/// What comes, goes and moves while a part that keeps subtrees is built is in the tree after it.
#[cfg(feature = "std")]
#[test]
fn a_part_above_parts_comes_in_beside_edits() {
    let (mut scene, mut ids) = grid(18);
    let random = &mut Random(5);
    let mesh = scene.mesh_of(ids[0]).expect("there");
    for round in 0..30_usize {
        let root = scene.top.root;
        let copy = scene.copy_part(root, f64::INFINITY);
        let since = scene.epoch;
        let tree = copy.build::<8>(&scene.params);
        for k in 0..round {
            let at = (random.unit() * (ids.len() - 1) as f32) as usize;
            let to = Transform::at((random.vector() * 70.0).to_array());
            match k % 3 {
                0 => scene.remove_instance(ids.swap_remove(at)).expect("there"),
                1 => scene.set_transform(ids[at], to).expect("there"),
                _ => ids.push(scene.add_instance(mesh, to).expect("one more")),
            }
        }
        let births = scene.top.births;
        scene.install_top(&tree, since);
        let number = scene.top.number(scene.top.root) as usize;
        assert!(scene.top.born[number] > births, "{round}: it came in");
        scene.refit();
        let stats = scene
            .validate()
            .unwrap_or_else(|violation| panic!("{round}: {violation}"));
        assert_eq!(stats.instances as usize, ids.len());
    }
}

/// A binary tree has nearly as many nodes as instances, so where many left a part, what was built for it has more nodes than there are
/// records for. It is given up then.
#[cfg(feature = "std")]
#[test]
fn a_part_whose_nodes_would_have_no_records_is_given_up() {
    for leave in [0, 20, 100] {
        let mut scene = Bvh::<CompactNode<2>, crate::Eq4, 2>::default();
        let mesh = lamp(&mut scene);
        let random = &mut Random(9);
        let add = (0..2400).map(|_| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 50.0).to_array()),
            radiance: 1.0,
        });
        scene.apply(add.collect()).expect("instances");
        scene.refit();
        let part = scene.nodes[scene.top.root as usize].link(0);
        let copy = scene.copy_part(part, f64::INFINITY);
        let since = scene.epoch;
        let tree = copy.build::<2>(&scene.params);
        let below = scene.below(part).1;
        let far = Transform::at([500.0, 500.0, 500.0]);
        for &(index, _) in below.iter().take(leave) {
            let id = scene.instance_id(index).expect("there");
            scene.set_transform(id, far).expect("in the domain");
        }
        let births = scene.top.births;
        scene.install_top(&tree, since);
        assert_eq!(scene.top.births > births, leave == 0, "{leave}");
        scene.refit();
        scene.validate().expect("valid");
    }
}

/// Edits between a batch that builds the top level and the first refit find nodes that know what is below them, and count as edits of a
/// built tree.
#[test]
fn edits_before_the_first_refit_are_put_where_they_belong() {
    let random = &mut Random(21);
    let mut trees = vec![];
    for refits in [true, false] {
        let mut scene = LightBvh::default();
        let mesh = lamp(&mut scene);
        random.0 = 21;
        let place = |random: &mut Random| Transform::at((random.vector() * 50.0).to_array());
        let add = (0..2000).map(|_| Edit::AddInstance {
            mesh,
            transform: place(random),
            radiance: 1.0,
        });
        let add: vec::Vec<_> = add.collect();
        let ids = scene.apply(add).expect("instances").instances;
        if refits {
            scene.refit();
        }
        for _ in 0..200 {
            scene.add_instance(mesh, place(random)).expect("one more");
        }
        scene.refit();
        trees.push(scene.depth());
        // All moved in the frame that added them: the tree is worse than as built, and due.
        if !refits {
            let moves = ids.iter().map(|&instance| Edit::SetTransform {
                instance,
                transform: place(random),
            });
            let moves: vec::Vec<_> = moves.collect();
            let mut scene = LightBvh::default();
            let mesh = lamp(&mut scene);
            let add = (0..2000).map(|k| Edit::AddInstance {
                mesh,
                transform: Transform::at([k as f32, 0.0, 0.0]),
                radiance: 1.0,
            });
            let ids = scene.apply(add.collect()).expect("instances").instances;
            let there = ids.iter().zip(moves).map(|(&instance, edit)| match edit {
                Edit::SetTransform { transform, .. } => Edit::SetTransform { instance, transform },
                other => other,
            });
            scene.apply(there.collect()).expect("moves");
            scene.refit();
            let root = scene.top.root;
            assert!(
                scene.quality(root).drift() > 1.1,
                "{}",
                scene.quality(root).drift()
            );
        }
    }
    assert_eq!(trees[0], trees[1]);
}
