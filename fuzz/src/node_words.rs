//! Arrays of a tree that hold any words.

use arbitrary::{Result, Unstructured};
use lightbvh::{CompactNode, Eq4, INVALID, Instance, LightTree, refit, traverse};

use crate::{Forms, input};

/// Bytes as the arrays of a tree: whatever they are, sampling, pmf and refit return.
pub fn node_words(data: &[u8], _: Forms) {
    fn run(u: &mut Unstructured<'_>) -> Result<()> {
        let point = input::any_point(u)?;
        let triangles = input::any_triangles(u)?;
        let (random, light, mesh): (u32, u32, u32) = u.arbitrary()?;
        let meshes: Vec<Instance> = (0..u.int_in_range(0..=3)?)
            .map(|_| Ok(bytemuck::cast(u.arbitrary::<[u32; 24]>()?)))
            .collect::<Result<_>>()?;
        let roots: Vec<refit::BlasRoot> = (0..u.int_in_range(0..=3)?)
            .map(|_| Ok(bytemuck::cast(u.arbitrary::<[u32; 13]>()?)))
            .collect::<Result<_>>()?;
        let trails: Vec<u32> = (0..u.int_in_range(0..=8)?)
            .map(|_| u.arbitrary())
            .collect::<Result<_>>()?;
        let trail_words = u.arbitrary::<u32>()? & 3;
        let root = u.arbitrary::<u32>()? & 7;
        let nodes: Vec<CompactNode<2>> = (0..u.int_in_range(1..=8)?)
            .map(|_| input::node(u))
            .collect::<Result<_>>()?;

        let tree = LightTree {
            nodes: &nodes,
            root,
            meshes: &meshes,
            trails: &trails,
            trail_words,
        };
        let sampled = traverse::sample::<_, Eq4, _, 2>(&tree, &point, random);
        for (light, mesh) in [
            (sampled.light, mesh),
            (light, mesh),
            (light & 7, mesh & 3),
            (sampled.light, INVALID),
        ] {
            let _ = traverse::pmf::<_, Eq4, _, 2>(&tree, &point, light, mesh);
        }
        for i in 0..nodes.len() as u32 {
            let _ = refit::leaves(&nodes, &triangles, i);
            let _ = refit::level(&nodes, i);
            let _ = refit::mesh_leaves(&nodes, &meshes, &roots, i);
            let _ = refit::root(&nodes, i);
        }
        Ok(())
    }
    let _ = run(&mut Unstructured::new(data));
}
