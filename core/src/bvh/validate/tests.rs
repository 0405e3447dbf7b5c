//! Each invariant broken by hand, and found.

use alloc::string::ToString;
use alloc::{format, vec};

use super::*;
use crate::kit::triangle;
use crate::trail::{leaf, max_levels, place_parts};
use crate::{BuildParams, CompactNode, Edit, Transform};

type Tree = Bvh<CompactNode<2>, crate::Eq4, 2>;

/// Two meshes of 5 and 4 triangles; three instances of each, one of them stretched; levels to spare.
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
        triangles: (0..count).map(lamp).collect(),
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
            radiance: 1.0,
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
    let found = scene.validate().expect_err("broken").to_string();
    assert!(found.contains(what), "{found} without {what}");
}

#[test]
fn a_sound_scene_is_counted() {
    let scene = scene();
    let stats = scene.validate().expect("sound");
    let used = scene.meshes.iter().map(|mesh| mesh.nodes.len());
    let used = used.sum::<usize>() + scene.top.nodes.len();
    assert_eq!(
        stats,
        Stats {
            nodes: used as u32,
            instances: 6,
            blases: 2,
            lights: 3 * 9,
            depth: scene.depth(),
        }
    );
}

/// A node of the top level and its slot that hold the leaf of an instance.
fn place_of(s: &Tree, instance: usize) -> (usize, usize) {
    let (node, slot) = place_parts::<2>(s.top.places[instance]);
    (node as usize, slot as usize)
}

#[test]
fn broken_trees_are_found() {
    let root = scene().top.root;
    let at = root as usize;
    assert_eq!(scene().top.nodes[at].kind(0), kind::INNER);
    finds("root", |s| s.roots[0].node += 1);
    finds("link", |s| s.top.nodes[at].relink(0, 9999));
    let end = scene().top.nodes.len() as u32;
    let mut broken = scene();
    broken.top.nodes[at].relink(1, end);
    assert_eq!(
        broken.validate(),
        Err(Violation::new(root, 1, "link", end - 1, end))
    );
    let end = scene().placed.len() as u32;
    let mut broken = scene();
    let (node, slot) = place_of(&broken, 2);
    broken.top.nodes[node].relink(slot, end);
    let found = Violation::new(node as u32, slot as u32, "instance's leaf", INVALID, end);
    assert_eq!(broken.validate(), Err(found));
    finds("instance's leaf", |s| {
        // A part of an instance that is not opened.
        let (node, slot) = place_of(s, 2);
        s.top.nodes[node].relink(slot, leaf(2, 1));
    });
    finds("times reached", |s| s.top.nodes[at].relink(0, root));
    finds("times reached", |s| {
        let nodes = &mut s.nodes[s.meshes[0].nodes.start as usize..];
        nodes[0].set_child(0, kind::INNER, 0);
    });
    finds("kind", |s| s.top.nodes[at].set_child(0, kind::LIGHT, 0));
    finds("place above", |s| {
        let child = s.top.nodes[at].link(0) as usize;
        s.top.above[child] += 1;
    });
    finds("place above", |s| s.top.above[at] = 0);
    finds("instance's leaf", |s| {
        s.top.nodes[at].set_child(0, kind::EMPTY, 0)
    });
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
        let mesh = scene.mesh_id(0).expect("there");
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
    chain(most).validate().expect("just deep enough");
    let violation = chain(most + 1).validate().expect_err("too deep");
    let deepest = violation.to_string();
    assert!(
        deepest.ends_with(&format!("level: expected {}, found {most}", most - 1)),
        "{deepest}"
    );
}

#[test]
fn broken_triangles_are_found() {
    let leaf = |s: &Tree| {
        let nodes = s.meshes[1].nodes.clone();
        nodes
            .flat_map(|node| [(node as usize, 0), (node as usize, 1)])
            .find(|&(node, slot)| s.nodes[node].kind(slot) == kind::LIGHT)
            .expect("a leaf")
    };
    // Of the bottom level before it, and of the one after it.
    for triangle in [
        scene().meshes[1].triangles.start - 1,
        scene().meshes[1].triangles.end,
    ] {
        finds("light's mesh", |s| {
            let (node, slot) = leaf(s);
            s.nodes[node].relink(slot, triangle);
        });
    }
    finds("low trail word", |s| {
        let (node, slot) = leaf(s);
        let link = s.nodes[node].link(slot);
        let other = if link == s.meshes[1].triangles.start {
            link + 1
        } else {
            link - 1
        };
        s.nodes[node].relink(slot, other);
    });
    finds("triangle's leaves", |s| {
        let (node, slot) = leaf(s);
        s.nodes[node].set_child(slot, kind::EMPTY, 0);
    });
    finds("low trail word", |s| s.trails[0] ^= 1);
    finds("low trail word", |s| s.trails[7] ^= 1 << 31);
    // Trails of two words, the high ones not all zero.
    let wide = |s: &mut Tree| {
        s.trail_words = 2;
        s.trails = s.trails.iter().flat_map(|&low| [low, 0]).collect();
    };
    let mut sound = scene();
    wide(&mut sound);
    sound.validate().expect("sound");
    finds("high trail word", |s| {
        wide(s);
        s.trails[1] = 1;
    });
    finds("light's mesh", |s| s.triangles[3].mesh += 1);
    // Moved without a refit.
    finds("least x after a refit", |s| s.triangles[0].p[0][0] -= 8.0);
}

#[test]
fn broken_instances_are_found() {
    finds("instance's leaf", |s| {
        // An instance in use, but in no leaf.
        let (node, slot) = place_of(s, 2);
        s.top.nodes[node].set_child(slot, kind::EMPTY, 0);
    });
    finds("place above", |s| s.top.places[2] ^= 1);
    finds("place above", |s| s.top.places[2] = INVALID);
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
    // The words of a record, in their order.
    finds("word 0", |s| s.instances[2].root += 1);
    finds("word 1", |s| s.instances[2].blas = 1);
    finds("word 2", |s| s.instances[2].first += 1);
    finds("word 3", |s| s.instances[2].first_triangle += 1);
    finds("word 4", |s| s.instances[2].count += 1);
    finds("word 6", |s| s.placed[2].transform.columns[0][0] = 3.0);
    finds("word 15", |s| s.instances[2].translation[0] = 0.5);
    finds("range of lights", |s| s.placed[2].lights.end += 1);
    // The lights of another instance of the mesh.
    finds("range of lights", |s| {
        s.placed[2].lights = s.placed[0].lights.clone();
        s.instances[2].first = s.instances[0].first;
    });
    // The list of instances in use: a wrong entry, and a record that is not at its place.
    finds("list entry", |s| s.instances[2].listed ^= 1);
    finds("list entry", |s| s.live.swap(2, 3));
}

#[test]
fn broken_bounds_are_found() {
    let root = scene().top.root as usize;
    // The words of flux, two slots each.
    finds("flux after a refit", |s| {
        bytemuck::cast_slice_mut::<_, u32>(&mut s.top.nodes[root..=root])[10] ^= 1 << 20;
    });
    finds("least x after a refit", |s| {
        let node = s.meshes[0].nodes.start as usize;
        let mut children = [s.nodes[node].summary(0), s.nodes[node].summary(1)];
        children[0].min -= 1.0;
        s.nodes[node].set_summaries(&children);
    });
}
