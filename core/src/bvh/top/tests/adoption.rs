//! What is known of a part once its tree is in place, or was tried and gains nothing.

use super::super::rebuild::PART;
use super::*;

/// The largest nodes that can be parts.
pub(super) fn parts(scene: &LightBvh) -> Vec<u32> {
    let count = |node: u32| scene.top.counts[scene.top.number(node) as usize];
    let all = scene.top.in_use().filter(|&node| node != scene.top.root);
    all.filter(|&node| count(node) <= PART && count(scene.parents[node as usize]) > PART)
        .collect()
}

/// Subtrees that a tree keeps may have been refitted since they were copied: the nodes above them are computed again, or they would
/// keep what was.
#[test]
fn nodes_above_kept_subtrees_that_changed_are_computed() {
    let (mut scene, ids) = grid(18);
    let copy = scene.copy_part(scene.top.root, f64::INFINITY);
    let since = scene.epoch;
    let tree = copy.build::<8>(&scene.params);
    for &id in ids.iter().step_by(50) {
        scene.set_radiance(id, 1.5).expect("there");
    }
    scene.refit();
    let births = scene.top.births;
    scene.install_top(&tree, since, &mut Quota::default());
    let number = scene.top.number(scene.top.root) as usize;
    assert!(scene.top.born[number] > births, "it came in");
    scene.refit();
    let nodes = scene.nodes.clone();
    let levels = scene.top.by_height();
    for &node in levels.nodes() {
        scene.refit_node(node);
        assert!(scene.nodes[node as usize] == nodes[node as usize], "{node}");
    }
}

/// A part that gains nothing is as good as built, and the nodes above know: they would be tried again in each frame.
#[test]
fn what_gains_nothing_is_known_above() {
    let (mut scene, _) = grid(18);
    let root = scene.top.root;
    let before = scene.quality(root).loss();
    // The one that tells its children apart least well.
    let part = parts(&scene)
        .into_iter()
        .max_by(|&a, &b| scene.quality(a).built.total_cmp(&scene.quality(b).built))
        .expect("a part");
    scene.quality[part as usize].built = 0.0;
    let mut node = part;
    while node != INVALID {
        scene.judge_list(&[node]);
        node = scene.parents[node as usize];
    }
    assert!(scene.quality(root).loss() > before, "it is worn");
    let tree = scene.copy_part(part, 0.0).build::<8>(&scene.params);
    scene.install_top(&tree, scene.epoch, &mut Quota::default());
    assert_eq!(scene.quality(root).loss(), before);
}

/// An instance that a new tree was built over is where it belongs, as bright as it is: measured against what it was before, the
/// next edit would put it in elsewhere for nothing. Where it was is forgotten by a tree that is built as a whole alone.
#[test]
fn what_comes_in_is_where_it_belongs() {
    for is_whole in [false, true] {
        let (mut scene, ids) = grid(18);
        for &id in &ids {
            scene.set_radiance(id, 1.9).expect("there");
            let mut to = scene.placed[id.index() as usize].transform;
            to.translation[0] += 0.25;
            scene.set_transform(id, to).expect("there");
        }
        scene.refit();
        let since = scene.epoch;
        let copy = match is_whole {
            true => scene.copy_top(),
            false => scene.copy_part(parts(&scene)[0], f64::INFINITY),
        };
        let tree = copy.build::<8>(&scene.params);
        scene.install_top(&tree, since, &mut Quota::default());
        assert!(!tree.names.is_empty());
        for &name in &tree.names {
            let placed = &scene.placed[name as usize];
            assert_eq!(placed.hung_radiance, 1.9, "{is_whole}");
            assert_eq!(placed.hung_center[0].is_nan(), is_whole);
        }
    }
}

/// The parts are the largest nodes of at most 1024 instances, each once: smaller ones would build the same instances again and
/// again, and larger ones take longer than a frame has.
#[test]
fn the_largest_nodes_that_fit_are_parts() {
    let (mut scene, _) = grid(18);
    for node in parts(&scene) {
        for below in scene.below(node).0 {
            let number = scene.top.number(below) as usize;
            scene.top.stirred[number] = scene.top.counts[number];
        }
    }
    let mut search = Search::default();
    scene.search_again(&mut search);
    let copies = scene.copy_worn_parts(1.1, u32::MAX, &mut search);
    let found = copies.iter().map(|copy| copy.root.expect("a part"));
    let mut found: Vec<u32> = found.map(|part| scene.node_of(part).expect("there")).collect();
    found.sort_unstable();
    let mut expected = parts(&scene);
    expected.retain(|&node| scene.top.heights[scene.top.number(node) as usize] > 1);
    expected.sort_unstable();
    assert!(expected.len() > 4);
    assert_eq!(found, expected);
    assert_eq!(PART, 1024);
}

/// What changed after a part was copied is still to be tried when it rests, though the tree came to nothing: that tree knew
/// nothing of it.
#[test]
fn what_changed_after_the_copy_is_still_to_be_tried() {
    for changes_after in [false, true] {
        let (mut scene, _) = grid(18);
        let part = parts(&scene)[0];
        let sway = |scene: &mut LightBvh, by: f32| {
            for (index, _) in scene.below(part).1 {
                let id = scene.instance_id(index).expect("there");
                let mut to = scene.placed[index as usize].transform;
                to.translation[0] += by;
                scene.set_transform(id, to).expect("there");
            }
            scene.refit();
        };
        sway(&mut scene, 0.01);
        let tree = scene.copy_part(part, 0.0).build::<8>(&scene.params);
        let since = scene.epoch;
        if changes_after {
            sway(&mut scene, -0.01);
        }
        scene.install_top(&tree, since, &mut Quota::default());
        // Nothing but the part.
        let number = scene.top.number(part) as usize;
        let changes = scene.top.changes[number];
        scene.top.changes.fill(0);
        scene.top.changes[number] = changes;
        let mut search = Search::default();
        for _ in 0..20 {
            search.note_frame(scene.now());
        }
        let mut is_tried = false;
        while !search.is_done() && !is_tried {
            let copies = scene.copy_worn_parts(1.1, 0, &mut search);
            is_tried = copies.iter().any(|copy| copy.root == Some(scene.part(part)));
        }
        assert_eq!(is_tried, changes_after);
    }
}

/// Over subtrees that are all mixed no order of nodes above them is better than another, while the parts below may gain all
/// that they lost: what was tried above and gains nothing says nothing of these.
#[test]
fn what_is_tried_above_parts_says_nothing_of_parts() {
    let (mut scene, _) = grid(18);
    let root = scene.top.root;
    let tree = scene.copy_part(root, 0.0).build::<8>(&scene.params);
    assert!(!tree.kept.is_empty());
    let inner = tree.inner.iter().filter_map(|&part| scene.node_of(part));
    let part = inner
        .filter(|node| parts(&scene).contains(node))
        .max_by(|&a, &b| scene.quality(a).built.total_cmp(&scene.quality(b).built))
        .expect("a part of which nodes are replaced");
    scene.quality[part as usize].built = 0.0;
    let mut node = part;
    while node != INVALID {
        scene.judge_list(&[node]);
        node = scene.parents[node as usize];
    }
    let before = scene.quality(part).drift();
    assert!(before > 1.0, "it is worn");
    scene.install_top(&tree, scene.epoch, &mut Quota::default());
    assert_eq!(scene.quality(part).drift(), before);
}
