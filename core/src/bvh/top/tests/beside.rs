//! What was built beside edits comes in.

use super::*;

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

/// What comes, goes and moves while a part that keeps subtrees is built is in the tree after it.
#[cfg(feature = "std")]
#[test]
fn a_part_above_parts_comes_in_beside_edits() {
    let (mut scene, mut ids) = grid(18);
    let random = &mut Random(5);
    let mesh = scene.mesh_of(ids[0]).expect("there");
    let mut came = 0;
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
        scene.install_top(&tree, since, &mut Quota::default());
        let number = scene.top.number(scene.top.root) as usize;
        came += usize::from(scene.top.born[number] > births);
        scene.refit();
        let stats = scene
            .validate()
            .unwrap_or_else(|violation| panic!("{round}: {violation}"));
        assert_eq!(stats.instances as usize, ids.len());
    }
    // Each edit may build a subtree of hundreds anew, so with many the rest is given up.
    assert!(came >= 20, "{came}");
}

/// A frame has time for so many that came into what was built beside it, in all that it puts in place; with one more a tree is
/// given up.
#[cfg(feature = "std")]
#[test]
fn a_frame_puts_in_no_more_than_it_has_time_for() {
    for (come, expected) in [(0, true), (40, true), (41, false)] {
        let (mut scene, ids) = grid(9);
        let mesh = scene.mesh_of(ids[0]).expect("there");
        let random = &mut Random(3);
        let copy = scene.copy_part(scene.top.root, f64::INFINITY);
        let since = scene.epoch;
        let tree = copy.build::<8>(&scene.params);
        let add = (0..come).map(|_| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 30.0).to_array()),
            radiance: 1.0,
        });
        scene.apply(add.collect()).expect("more");
        let births = scene.top.births;
        let mut room = Quota::default();
        scene.install_top(&tree, since, &mut room);
        let number = scene.top.number(scene.top.root) as usize;
        assert_eq!(scene.top.born[number] > births, expected, "{come}");
        // What one has taken another one has not.
        scene.install_top(&tree, since, &mut room);
        scene.refit();
        let stats = scene.validate().expect("valid");
        assert_eq!(stats.instances as usize, ids.len() + come);
    }
}

/// A binary tree has one node fewer than instances, and there are as many numbers as records of instances. Each instance that
/// left a part has a node elsewhere now, so where two did, what was built for the part has a node more than there are numbers.
/// It is given up then.
#[cfg(feature = "std")]
#[test]
fn a_part_whose_nodes_would_have_no_records_is_given_up() {
    for leave in [0, 1, 2, 20] {
        let mut scene = Bvh::<CompactNode<2>, crate::Eq4, 2>::default();
        let mesh = lamp(&mut scene);
        let random = &mut Random(9);
        let add = (0..1400).map(|_| Edit::AddInstance {
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
        assert!(tree.kept.is_empty() && scene.top.used == 1399);
        let far = Transform::at([500.0, 500.0, 500.0]);
        for &name in tree.names.iter().take(leave) {
            let id = scene.instance_id(name).expect("there");
            scene.set_transform(id, far).expect("in the domain");
        }
        let births = scene.top.births;
        scene.install_top(&tree, since, &mut Quota::default());
        assert_eq!(scene.top.births > births, leave < 2, "{leave}");
        scene.refit();
        scene.validate().expect("valid");
    }
}
