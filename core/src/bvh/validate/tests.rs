//! Each invariant broken by hand, and found.

use alloc::vec;

use super::*;
use crate::trail::max_levels;
use crate::{BuildParams, CompactNode, Edit, EmissiveTriangle, Transform};

type Tree = Bvh<CompactNode<2>, crate::Eq4, 2>;

/// Two meshes of 5 and 4 triangles; three instances of each, one of them stretched; levels to spare.
fn scene() -> Tree {
    let lamp = |i: u16| {
        let x = f32::from(i);
        EmissiveTriangle {
            p: [[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.25]],
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        }
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
fn finds(what: What, break_it: impl FnOnce(&mut Tree)) {
    let mut scene = scene();
    break_it(&mut scene);
    assert_eq!(scene.validate().expect_err("broken").what, what);
}

#[test]
fn a_sound_scene_is_counted() {
    let scene = scene();
    let stats = scene.validate().expect("sound");
    let used = scene.blases.iter().map(|blas| blas.nodes.len());
    let used = used.sum::<usize>() + scene.top.len();
    assert_eq!(
        stats,
        Stats {
            nodes: used as u32,
            instances: 6,
            blases: 2,
            lights: 3 * 9,
            depth: scene.top.depth() + scene.blases.iter().map(|blas| blas.depth).max().expect("two"),
        }
    );
}

#[test]
fn broken_trees_are_found() {
    let root = scene().top.root;
    let at = root as usize;
    assert_eq!(scene().nodes[at].kind(0), kind::INNER);
    finds(What::Root, |s| s.roots[0].node += 1);
    finds(What::Link, |s| s.nodes[at].relink(0, 9999));
    let end = scene().nodes.len() as u32;
    let mut broken = scene();
    broken.nodes[at].relink(1, end);
    assert_eq!(broken.validate(), Err(bad(root, 1, What::Link, end - 1, end)));
    let end = scene().placed.len() as u32;
    let mut broken = scene();
    let leaf = broken.placed[2].clone();
    broken.nodes[leaf.node as usize].relink(leaf.slot as usize, end);
    assert_eq!(
        broken.validate(),
        Err(bad(leaf.node, leaf.slot, What::Mesh, INVALID, end))
    );
    finds(What::Reached, |s| s.nodes[at].relink(0, root));
    finds(What::Reached, |s| {
        let blas = s.blases[0].nodes.start;
        s.nodes[at].relink(0, blas);
    });
    finds(What::Kind, |s| {
        s.nodes[at].set_child(0, kind::LIGHT, 0);
    });
    finds(What::Link, |s| {
        let child = s.nodes[at].link(0) as usize;
        s.parents[child] += 1;
    });
    finds(What::Link, |s| s.parents[at] = 0);
    finds(What::Mesh, |s| s.nodes[at].set_child(0, kind::EMPTY, 0));
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
        let mut nodes = vec![CompactNode::EMPTY; levels as usize];
        for (link, node) in (1..).zip(&mut nodes) {
            node.set_child(1, kind::MESH, link);
            if link < levels {
                node.set_child(0, kind::INNER, link);
            } else {
                node.set_child(0, kind::MESH, 0);
            }
        }
        scene.replace_top(&nodes);
        scene.changes.new.whole_top = true;
        scene.refit();
        scene
    };
    let most = max_levels(2);
    chain(most).validate().expect("just deep enough");
    let violation = chain(most + 1).validate().expect_err("too deep");
    assert_eq!(
        (violation.what, violation.expected, violation.found),
        (What::Level, most - 1, most)
    );
}

#[test]
fn broken_triangles_are_found() {
    let leaf = |s: &Tree| {
        let nodes = s.blases[1].nodes.clone();
        nodes
            .flat_map(|node| [(node as usize, 0), (node as usize, 1)])
            .find(|&(node, slot)| s.nodes[node].kind(slot) == kind::LIGHT)
            .expect("a leaf")
    };
    // Of the bottom level before it, and of the one after it.
    for triangle in [
        scene().blases[1].triangles.start - 1,
        scene().blases[1].triangles.end,
    ] {
        finds(What::Owner, |s| {
            let (node, slot) = leaf(s);
            s.nodes[node].relink(slot, triangle);
        });
    }
    finds(What::TrailLow, |s| {
        let (node, slot) = leaf(s);
        let link = s.nodes[node].link(slot);
        let other = if link == s.blases[1].triangles.start {
            link + 1
        } else {
            link - 1
        };
        s.nodes[node].relink(slot, other);
    });
    finds(What::Triangle, |s| {
        let (node, slot) = leaf(s);
        s.nodes[node].set_child(slot, kind::EMPTY, 0);
    });
    finds(What::TrailLow, |s| s.trails[0] ^= 1);
    finds(What::TrailLow, |s| s.trails[7] ^= 1 << 31);
    // Trails of two words, the high ones not all zero.
    let wide = |s: &mut Tree| {
        s.trail_words = 2;
        s.trails = s.trails.iter().flat_map(|&low| [low, 0]).collect();
    };
    let mut sound = scene();
    wide(&mut sound);
    sound.validate().expect("sound");
    finds(What::TrailHigh, |s| {
        wide(s);
        s.trails[1] = 1;
    });
    finds(What::Owner, |s| s.triangles[3].mesh += 1);
    // Moved without a refit.
    finds(What::Word(1), |s| s.triangles[0].p[0][0] -= 8.0);
}

#[test]
fn broken_instances_are_found() {
    finds(What::Mesh, |s| s.placed[2].live = false);
    finds(What::Link, |s| s.placed[2].node += 1);
    finds(What::Link, |s| s.placed[2].slot ^= 1);
    finds(What::TrailLow, |s| s.instances[2].place ^= 1);
    finds(What::TrailLow, |s| s.instances[2].place = INVALID);
    // The link upward of a node, in the record of its number.
    finds(What::TrailLow, |s| s.instances[1].above ^= 1);
    finds(What::ListedLevel, |s| s.top.heights[0] += 1);
    finds(What::Listed, |s| s.top.counts[0] += 1);
    finds(What::Listed, |s| s.top.nodes.swap(0, 1));
    finds(What::Children, |s| {
        // A node between the root and one of its nodes.
        let root = s.top.root;
        let slot = (0..2)
            .find(|&slot| s.nodes[root as usize].kind(slot) == kind::INNER)
            .expect("a node");
        let below = s.nodes[root as usize].link(slot);
        let between = s.new_top_node();
        s.hang(between, 0, kind::INNER, below);
        s.hang(root, slot, kind::INNER, between);
        s.update_path(between);
    });
    finds(What::Blas, |s| s.instances[2].blas = 1);
    finds(What::Root, |s| s.instances[2].root += 1);
    finds(What::First, |s| s.instances[2].first += 1);
    finds(What::First, |s| s.instances[2].first_triangle += 1);
    finds(What::First, |s| s.placed[2].lights.end += 1);
    // The lights of another instance of the mesh.
    finds(What::First, |s| {
        s.placed[2].lights = s.placed[0].lights.clone();
        s.instances[2].first = s.instances[0].first;
    });
    finds(What::Word(17), |s| s.instances[2].translation[0] = 0.5);
    finds(What::Word(8), |s| s.placed[2].transform.columns[0][0] = 3.0);
    finds(What::Word(6), |s| s.instances[2].count += 1);
    // The list of instances in use: a wrong entry, and a record that is not at its place.
    finds(What::Listed, |s| s.instances[2].listed ^= 1);
    finds(What::Listed, |s| s.live.swap(2, 3));
}

#[test]
fn broken_bounds_are_found() {
    let root = scene().top.root as usize;
    // The words of flux, two slots each.
    finds(What::Bounds("flux"), |s| {
        bytemuck::cast_slice_mut::<_, u32>(&mut s.nodes[root..=root])[10] ^= 1 << 20;
    });
    finds(What::Bounds("least x"), |s| {
        let node = s.blases[0].nodes.start as usize;
        let mut children = [s.nodes[node].summary(0), s.nodes[node].summary(1)];
        children[0].min -= 1.0;
        s.nodes[node].set_summaries(&children);
    });
}
