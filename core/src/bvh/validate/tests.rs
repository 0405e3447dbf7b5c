//! Invariants of what the CPU alone keeps, broken by hand, and found; `every_bit_counts` in `tests` turns each bit of the other
//! arrays.

use alloc::string::ToString;
use alloc::{format, vec};

use super::*;
use crate::kit::triangle;
use crate::trail::max_levels;
use crate::{BuildParams, CompactNode, Edit, Transform};

type Tree = Bvh<(CompactNode<2>, crate::Eq4), 2>;

/// Two meshes of 5 and 4 lights; three instances of each, one of them stretched; levels to spare.
fn scene() -> Tree {
    let lamp = |i: u16| {
        let x = f32::from(i);
        triangle([[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.25]])
    };
    let mut scene = Tree::new(BuildParams {
        opens: false,
        ..BuildParams::default()
    });
    let meshes = [5, 4].map(|count| Edit::AddMesh {
        lights: (0..count).map(lamp).collect(),
    });
    let meshes = scene.apply(meshes.into()).expect("meshes").meshes;
    let mut adds = vec![];
    for (i, &mesh) in meshes.iter().chain(&meshes).chain(&meshes).enumerate() {
        let mut transform = Transform::at([0.0, 3.0 * i as f32, 0.0]);
        if i > 3 {
            transform.columns[0][0] = 2.0;
        }
        adds.push(Edit::AddInstance {
            mesh,
            transform,
            radiance: [1.0; 3],
            mask: u32::MAX,
        });
    }
    scene.apply(adds).expect("instances");
    scene.refit();
    scene
}

#[track_caller]
fn finds(what: &str, break_it: impl FnOnce(&mut Tree)) {
    let mut scene = scene();
    break_it(&mut scene);
    let found = scene.view().validate().expect_err("broken").to_string();
    assert!(found.contains(what), "{found} without {what}");
}

#[test]
fn broken_trees_are_found() {
    let root = scene().top.root;
    let at = root as usize;
    finds("root", |s| s.roots[0].node += 1);
    finds("flux by area", |s| s.meshes[0].is_by_area = false);
    finds("depth", |s| s.bottom_depth = 0);
    finds("level", |s| s.top.shapes[at].height += 1);
    finds("instance's leaf", |s| s.top.shapes[at].words[0] += 1.0);
    finds("list entry", |s| s.top.free.push(0));
    finds("children", |s| {
        // A node between the root and one of its nodes.
        let below = s.top.nodes[at].link(0);
        let between = s.top.nodes.len() as u32;
        s.top.nodes.push(CompactNode::EMPTY);
        s.top.above.push(INVALID);
        s.top.shapes.push(Default::default());
        s.top.attach(root, 0, kind::INNER, between);
        s.top.attach(between, 0, kind::INNER, below);
        [between, root]
            .into_iter()
            .for_each(|node| s.top.refit_node(node));
    });
}

#[test]
fn trees_deeper_than_a_trail_are_found() {
    // A chain of nodes below the root, one more than a trail of one bit per level holds.
    let chain = |levels: u32| {
        let mut scene = scene();
        let mesh = scene.view().mesh_id(0).expect("there");
        while scene.live.len() <= levels as usize {
            scene.add_instance(mesh, Transform::IDENTITY).expect("one more");
        }
        scene.refit();
        let mut nodes = vec![CompactNode::EMPTY; levels as usize];
        for (link, node) in (1..).zip(&mut nodes) {
            node.set_child(1, kind::MESH, link);
            if link < levels {
                node.set_child(0, kind::INNER, link);
            } else {
                node.set_child(0, kind::MESH, 0);
            }
        }
        scene.top.replace(nodes);
        (0..levels).rev().for_each(|node| scene.top.refit_node(node));
        scene
    };
    let most = max_levels(2);
    chain(most).view().validate().expect("just deep enough");
    let violation = chain(most + 1).view().validate().expect_err("too deep");
    let deepest = violation.to_string();
    assert!(
        deepest.ends_with(&format!("level: expected {}, found {most}", most - 1)),
        "{deepest}"
    );
}

#[test]
fn broken_triangles_are_found() {
    // Trails of two words, the high ones not all zero.
    let wide = |s: &mut Tree| {
        s.trail_words = 2;
        s.trails = s.trails.iter().flat_map(|&low| [low, 0]).collect();
    };
    let mut sound = scene();
    wide(&mut sound);
    sound.view().validate().expect("sound");
    finds("high trail word", |s| {
        wide(s);
        s.trails[1] = 1;
    });
    finds("light's mesh", |s| s.lights[3].mesh += 1);
    // Moved without a refit.
    finds("word 0: expected", |s| s.lights[0].p[0][0] -= 8.0);
}

#[test]
fn broken_instances_are_found() {
    finds("instance's leaf", |s| {
        s.top.leaves[2].as_mut().expect("a leaf")[0] += 1.0
    });
    finds("instance's leaf", |s| {
        s.placed[2].live = false;
        s.instances[2] = Instance {
            listed: s.instances[2].listed,
            ..NO_INSTANCE
        };
    });
    finds("word 6", |s| s.placed[2].transform.columns[0][0] = 3.0);
    finds("range of lights", |s| s.placed[2].numbers.end += 1);
    // The lights of another instance of the mesh.
    finds("range of lights", |s| {
        s.placed[2].numbers = s.placed[0].numbers.clone();
        s.instances[2].first = s.instances[0].first;
    });
    finds("list entry", |s| s.live.swap(2, 3));
    finds("lights", |s| s.light_count += 1);
}
