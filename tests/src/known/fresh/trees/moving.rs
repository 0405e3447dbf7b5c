//! Moving lights: instances of every kind of transform and brightness.

use lightbvh::TreeWords;
use lightbvh::{Bvh, CompactNode, Edit, Instance, LightNode, exact};

use super::links::{links_of_nodes, links_of_roots};
use super::passes::passes_of;
use crate::generate::{Random, small_triangles};
use crate::known::tree::Tree;
use crate::placing::{Kind, transform};

/// A scene of four meshes and instances of every kind of transform and brightness.
fn moving<N: LightNode<W>, const W: usize>(random: &mut Random) -> Bvh<N, (), W> {
    let mut scene = Bvh::default();
    let add = |random: &mut Random, count: u32| {
        let mut triangles = small_triangles(count, count, 2.0, 0.4, false, random.bits());
        for (i, triangle) in triangles.iter_mut().enumerate() {
            triangle.p = triangle.p.map(|p| p.map(|x| x - 1.0));
            triangle.flags = u32::from(i % 4 == 3);
        }
        Edit::AddMesh { triangles }
    };
    let meshes = [1, 5, 9, 14].map(|count| add(random, count)).to_vec();
    let meshes = scene.apply(meshes).expect("sound meshes").meshes;
    let mut edits = Vec::new();
    let kinds = [
        Kind::Rigid,
        Kind::Similar,
        Kind::Singular,
        Kind::Affine,
        Kind::Flat,
    ];
    for i in 0..14 {
        let mut placed = transform(random, kinds[i % 5], 8.0);
        if i == 5 || i == 6 {
            // Far from the scale of the others, and mirrored.
            let scale = exact::pow2(if i == 5 { 19 } else { -55 });
            placed.columns = [[scale, 0.0, 0.0], [0.0, 0.0, scale], [0.0, scale, 0.0]];
        }
        if i == 4 {
            // So bright that it must be far off for others to be drawn.
            placed.translation = [exact::pow2(29), 0.0, 0.0];
        }
        let radiance = if i > 10 {
            1.0
        } else {
            [1.0, 0.25, 1000.0, 1.0, exact::pow2(60), exact::pow2(-60), 0.0][i % 7]
        };
        edits.push(Edit::AddInstance {
            mesh: meshes[i % 4],
            transform: placed,
            radiance,
        });
    }
    scene.apply(edits).expect("sound instances");
    scene
}

pub(super) fn instances<N: LightNode<W>, const W: usize>(random: &mut Random) -> Tree<N, W> {
    let mut scene = moving::<N, W>(random);
    scene.refit();
    let tree = scene.tree();
    let roots = links_of_roots(scene.roots());
    Tree {
        nodes: links_of_nodes(tree.nodes),
        triangles: scene.triangles().to_vec(),
        meshes_of_lights: scene.world_lights().iter().map(|light| light.mesh).collect(),
        instances: tree.instances.to_vec(),
        passes: passes_of(tree.nodes, &roots, tree.root, true),
        roots,
        trails: tree.trails.to_vec(),
        push: TreeWords::of(&tree),
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// Leaves of a top level of every kind, those in the world's own space too.
pub fn instances_of_any_kind(random: &mut Random) -> Vec<Instance> {
    let scene = moving::<CompactNode<4>, 4>(random);
    let mut out = scene.instances().to_vec();
    out.push(Instance::IDENTITY);
    out
}
