//! Edits one by one, and what they write.

use alloc::vec;

use super::*;

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

/// A subtree of *n* instances, 512 at most, is built anew after *n*/16 edits below it: insertion makes trees worse by and by.
#[test]
fn subtrees_are_built_anew_after_a_sixteenth_of_their_instances() {
    let (mut scene, ids) = grid(10);
    let random = &mut Random(6);
    for _ in 0..300 {
        let id = ids[(random.unit() * 999.0) as usize];
        let to = Transform::at((random.vector() * 20.0).to_array().map(|x| x + 20.0));
        scene.set_transform(id, to).expect("there");
        for node in scene.top.in_use() {
            let number = scene.top.number(node) as usize;
            let (edits, count) = (scene.top.edits[number], scene.top.counts[number]);
            let is_built = scene.top.heights[number] > 1 && count <= super::settle::MOST;
            assert!(
                !is_built || edits < count.div_ceil(16),
                "{edits} edits of {count}"
            );
        }
    }
}

/// What is due at several levels is built once: a move has two subtrees of at most 512 instances built, the one where it was
/// and the one where it is. Among lamps at all distances nearly all nodes of a path are due together.
#[test]
fn no_subtree_is_built_within_another() {
    let random = &mut Random(12);
    let mut scene = LightBvh::default();
    let mesh = lamp(&mut scene);
    let far = |random: &mut Random| {
        let reach = crate::exact::pow2(38 - (60.0 * random.unit()) as i32);
        Transform::at((random.vector() * reach).to_array())
    };
    let add = (0..1000).map(|_| Edit::AddInstance {
        mesh,
        transform: Transform::at(random.vector().to_array()),
        radiance: 1.0,
    });
    let ids = scene.apply(add.collect()).expect("instances").instances;
    scene.refit();
    let mut most = 0;
    for _ in 0..4000 {
        let id = ids[(random.unit() * 999.0) as usize];
        scene.set_transform(id, far(random)).expect("there");
        most = most.max(scene.changes.new.top_nodes.len());
        scene.refit();
    }
    // Nodes of two such trees, about half full, and two paths.
    assert!(most < 2 * (512 / 4 + 2 * scene.depth() as usize), "{most}");
}
