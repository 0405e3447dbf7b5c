//! The limits of what a frame puts in place, and of how deep a tree gets.

use super::super::cost::Cluster;
use super::super::insert::Item;
use super::*;
use crate::trail::max_levels;

/// What went while a part was built is taken out of its tree node by node, so a frame takes out 160 at most: without the limit it would
/// take longer than it may.
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

/// Where more are misplaced than a call puts in elsewhere, those go first that cost most: in any other order the brightest lamps might
/// wait for a rebuild.
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
