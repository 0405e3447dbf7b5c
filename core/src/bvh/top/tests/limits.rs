//! The limits of what a frame puts in place, and of how deep a tree gets.

use super::super::cost::Cluster;
use super::super::insert::Item;
use super::*;
use crate::trail::max_levels;

/// What went while a part was built is taken out of its tree node by node, so a frame takes out 160 at most: without the limit
/// it would take longer than it may.
#[cfg(feature = "std")]
#[test]
fn a_frame_takes_out_no_more_than_it_has_time_for() {
    for (gone, expected) in [(0, true), (160, true), (161, false)] {
        let (mut scene, ids) = grid(9);
        let copy = scene.copy_part(scene.top.root, f64::INFINITY);
        let since = scene.epoch;
        let tree = copy.build::<8>(&scene.params);
        let remove = ids.iter().step_by(4).take(gone).copied();
        scene
            .apply(remove.map(Edit::RemoveInstance).collect())
            .expect("there");
        let births = scene.top.births;
        let mut room = Quota::default();
        scene.install_top(&tree, since, &mut room);
        let number = scene.top.number(scene.top.root) as usize;
        assert_eq!(scene.top.born[number] > births, expected, "{gone}");
        // What one has taken another one has not.
        assert_eq!(room.gone, if expected { 160 - gone } else { 160 });
        scene.refit();
        scene.validate().expect("valid");
    }
}

/// Near the last level an item goes only where it and what it displaces fit: else trails would overflow, or an instance find no
/// place further down.
#[test]
fn an_insertion_keeps_within_the_levels() {
    let mut scene = Bvh::<CompactNode<2>, crate::Eq4, 2>::default();
    let mesh = lamp(&mut scene);
    let add = [0.0, 1.0, 100.0, 101.0].map(|x| Edit::AddInstance {
        mesh,
        transform: Transform::at([x, 0.0, 0.0]),
        radiance: 1.0,
    });
    scene.apply(add.to_vec()).expect("instances");
    scene.refit();
    let root = scene.top.root;
    assert_eq!(scene.top.depth(), 2, "two nodes of two instances");
    let most = max_levels(2);
    let item = |height: u32| Item {
        height,
        ..scene.item_of(0)
    };
    let fits = |level: u32, height: u32| scene.step(root, level, &item(height)).is_some();
    // Below the root at `most - 2` all four places are taken.
    assert!(!fits(most - 2, 0));
    assert!(fits(most - 3, 0));
    // A subtree of two levels has place beside both children in one node, one of three has none.
    assert!(fits(most - 3, 2));
    assert!(!fits(most - 3, 3));
    // Two instances have no node over them on the last level.
    let lowest = scene.nodes[root as usize].link(0);
    assert!(scene.step(lowest, most - 1, &item(0)).is_none());
    assert!(scene.step(lowest, most - 2, &item(0)).is_some());
    // Nor has an empty slot there place for a node.
    let mut one = Bvh::<CompactNode<2>, crate::Eq4, 2>::default();
    let mesh = lamp(&mut one);
    one.add_instance(mesh, Transform::IDENTITY).expect("one");
    one.refit();
    let item = Item {
        kind: kind::INNER,
        height: 1,
        cluster: Cluster {
            count: 2,
            ..one.item_of(0).cluster
        },
        ..one.item_of(0)
    };
    assert!(one.step(one.top.root, most - 1, &item).is_none());
    assert!(one.step(one.top.root, most - 2, &item).is_some());
}

/// Where more are misplaced than a call puts in elsewhere, those go first that cost most: in any other order the brightest
/// lamps might wait for a rebuild.
#[test]
fn the_costliest_are_put_in_elsewhere_first() {
    let (mut scene, ids) = grid(10);
    let stamp = scene.epoch;
    let is_bright = |k: usize| k % 25 == 12;
    let edits = ids.iter().enumerate().map(|(k, &instance)| Edit::SetRadiance {
        instance,
        radiance: if is_bright(k) { 1e4 } else { 0.4 },
    });
    scene.apply(edits.collect()).expect("there");
    let is_put = |id: &InstanceId| scene.placed[id.index() as usize].hung > stamp;
    let put = (0..1000).filter(|&k| is_bright(k) && is_put(&ids[k])).count();
    // Of 40; one amid its neighbours costs nothing there. By index it would be 3.
    assert!(put >= 30, "{put}");
}

/// A tree that would reach below the last level by itself, or by a subtree that it keeps, does not come in: trails have no room
/// for it.
#[cfg(feature = "std")]
#[test]
fn a_tree_that_would_be_too_deep_is_given_up() {
    let (scene, _) = grid(18);
    let most = max_levels(8);
    let comes_in = |mut scene: LightBvh, tree: &TopTree<crate::MomentNode<8>>| {
        let births = scene.top.births;
        scene.install_top(tree, scene.epoch, &mut Quota::default());
        scene.top.births > births
    };
    let [root, part] = super::super::search::tests::above_and_part(&scene);
    let mut tree = scene.copy_part(part, f64::INFINITY).build::<8>(&scene.params);
    for (depth, expected) in [(most - scene.level(part), true), (most, false)] {
        tree.depth = depth;
        assert_eq!(comes_in(scene.clone(), &tree), expected, "{depth}");
    }
    assert!(scene.level(part) > 0);
    let tree = scene.copy_part(root, f64::INFINITY).build::<8>(&scene.params);
    let at = (0..tree.nodes.len())
        .find(|&k| tree.keeps[k] != 0)
        .expect("a subtree");
    let slot = tree.keeps[at].trailing_zeros() as usize;
    let kept = tree.kept[tree.nodes[at].link(slot) as usize].number as usize;
    let above = tree.levels[at] + 1;
    for (height, expected) in [(most - above, true), (most - above + 1, false)] {
        let mut scene = scene.clone();
        scene.top.heights[kept] = height;
        assert_eq!(comes_in(scene, &tree), expected, "{height}");
    }
}

/// What a frame builds anew beside what it adopts is bounded in all, however many subtrees are due: else it would take longer
/// than it may.
#[test]
fn few_instances_are_built_anew_in_all() {
    let (mut scene, _) = grid(10);
    let nodes: Vec<u32> = scene.top.in_use().collect();
    let number = |scene: &LightBvh, node: u32| scene.top.number(node) as usize;
    let due: Vec<u32> = nodes
        .into_iter()
        .filter(|&node| scene.top.heights[number(&scene, node)] == 2)
        .collect();
    let (mut least, mut all) = (u32::MAX, 0);
    for &node in &due {
        let own = number(&scene, node);
        scene.top.edits[own] = scene.top.counts[own];
        least = least.min(scene.top.counts[own]);
        all += scene.top.counts[own];
    }
    scene.top.touched.clone_from(&due);
    scene.settle_some(64);
    let built = due.iter().map(|&node| number(&scene, node));
    let built = built.filter(|&own| scene.top.edits[own] == 0);
    let built: u32 = built.map(|own| scene.top.counts[own]).sum();
    assert!(least < 64 && all > 64, "{least} to {all}");
    assert!(built > 0 && built <= 64, "{built} of {all}");
    scene.refit();
    scene.validate().expect("valid");
}

/// A tree comes in beside much that came meanwhile near one place: the subtree there is due, and the next edit below it builds it.
#[cfg(feature = "std")]
#[test]
fn what_is_due_beyond_is_built_by_the_next_edit() {
    let (mut scene, ids) = grid(10);
    let mesh = scene.mesh_of(ids[0]).expect("there");
    let copy = scene.copy_part(scene.top.root, f64::INFINITY);
    let rebuild = scene.rebuild_of(vec![copy], &[]);
    for k in 0..40_u8 {
        let at = [1.0 + f32::from(k % 5) * 0.5, f32::from(k / 5) * 0.25, 1.0];
        scene.add_instance(mesh, Transform::at(at)).expect("one more");
    }
    scene.install(rebuild.run()).expect("its own");
    let is_due = |scene: &LightBvh, node: u32| {
        let number = scene.top.number(node) as usize;
        scene.top.edits[number] >= scene.top.counts[number].div_ceil(16)
    };
    let mut node = scene.placed[ids[0].index() as usize].node;
    while scene.top.counts[scene.top.number(node) as usize] <= 64 {
        node = scene.parents[node as usize];
    }
    assert!(scene.top.counts[scene.top.number(node) as usize] <= super::settle::MOST);
    assert!(is_due(&scene, node));
    scene
        .add_instance(mesh, Transform::at([1.5, 1.5, 1.5]))
        .expect("one more");
    assert!(!is_due(&scene, node));
    scene.refit();
    scene.validate().expect("valid");
}
