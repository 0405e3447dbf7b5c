//! What became of a part while its tree was built.

use super::*;

/// Every node of the top level is what a refit makes of its children.
#[track_caller]
fn is_computed(scene: &mut LightBvh) {
    let nodes = scene.nodes.clone();
    let levels = scene.top.by_height();
    for &node in levels.nodes() {
        scene.refit_node(node);
        assert!(scene.nodes[node as usize] == nodes[node as usize], "{node}");
    }
}

/// What moved far while a part was built stays with those that it went to: the tree knows it where it was, and would stretch a
/// node over the whole part.
#[test]
fn what_moved_while_a_part_was_built_stays_where_it_went() {
    let (mut scene, ids) = grid(9);
    let copy = scene.copy_part(scene.top.root, f64::INFINITY);
    let since = scene.epoch;
    let tree = copy.build::<8>(&scene.params);
    // From one corner to the other.
    let far = [32.5_f32, 32.0, 32.0];
    scene.set_transform(ids[0], Transform::at(far)).expect("there");
    let births = scene.top.births;
    scene.install_top(&tree, since, &mut Quota::default());
    assert!(scene.top.births >= births + tree.nodes.len() as u64, "it came in");
    scene.refit();
    scene.validate().expect("valid");
    let leaves = scene.below(scene.placed[ids[0].index() as usize].node).1;
    assert!(leaves.len() < 100);
    for (index, _) in leaves {
        let at = scene.placed[index as usize].transform.translation;
        let squared: f64 = (0..3).map(|k| f64::from(at[k] - far[k]).powi(2)).sum();
        assert!(squared < 400.0, "{at:?}");
    }
}

/// A mesh that got another tree while a part was built has other words at its root: nodes that come in are computed from these.
#[test]
fn trees_that_meshes_got_meanwhile_are_known() {
    let random = &mut Random(4);
    let mut scene = LightBvh::default();
    let mut lamps: Vec<_> = (0..200)
        .map(|_| {
            let [x, y, z] = random.vector().to_array();
            triangle([[x, y, z], [x + 0.01, y, z], [x, y, z + 0.02]])
        })
        .collect();
    let mesh = scene.add_mesh(lamps.clone()).expect("a mesh");
    let add = (0..200).map(|_| Edit::AddInstance {
        mesh,
        transform: Transform::at((random.vector() * 100.0).to_array()),
        radiance: 1.0,
    });
    scene.apply(add.collect()).expect("instances");
    lamps.rotate_left(77);
    for k in 0..100 {
        lamps.swap(k, (k * 37 + 100) % 200);
    }
    scene.set_triangles(mesh, lamps).expect("as many");
    scene.refit();
    let [top, drift] = [1.0, f64::INFINITY];
    let above = scene.rebuild(&RebuildParams { top, drift }).run();
    let [top, drift] = [f64::INFINITY, 1.1];
    let below = scene.rebuild(&RebuildParams { top, drift }).run();
    let before = scene.root_of(0);
    scene.install(below).expect("its own");
    scene.refit();
    assert!(scene.root_of(0) != before, "nothing is tested");
    scene.install(above).expect("its own");
    scene.refit();
    is_computed(&mut scene);
}

/// Where a device refits in place of the CPU, a part was copied with roots that are not the device's: it computes all nodes
/// that come in.
#[test]
fn a_device_computes_all_that_comes_in() {
    let (mut scene, _) = grid(9);
    scene.plan();
    let mesh = scene.mesh_id(0).expect("there");
    let other = triangle([[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]]);
    scene.set_triangles(mesh, vec![other]).expect("as many");
    scene.plan();
    let copy = scene.copy_part(scene.top.root, f64::INFINITY);
    let since = scene.epoch;
    let tree = copy.build::<8>(&scene.params);
    let births = scene.top.births;
    scene.install_top(&tree, since, &mut Quota::default());
    assert!(scene.top.births > births, "it came in");
    let computed = scene.plan().top.nodes().to_vec();
    assert!(scene.top.in_use().all(|node| computed.contains(&node)));
    scene.refit();
    is_computed(&mut scene);
}
