//! What is checked: lights, points to light, and trees over the lights.

use lightbvh::{
    EmissiveTriangle, Eq4, INVALID, LightNode, LightTree, MeshLeaf, SampledLight, ShadingPoint, traverse,
};

/// A tree to be walked, whatever its nodes and leaves.
pub trait Subject: Sync {
    /// The lights, in the world.
    fn lights(&self) -> &[EmissiveTriangle];
    /// Greatest number of nodes on a way from the root to a light.
    fn depth(&self) -> u32;
    /// Chooses a light.
    fn sample(&self, point: &ShadingPoint, random: u32) -> SampledLight;
    /// Evaluates the probability of a light.
    fn pmf(&self, point: &ShadingPoint, light: u32) -> f32;
}

/// A light tree of any layout.
pub struct Walked<'a, N, L, const W: usize> {
    /// The tree.
    pub tree: LightTree<'a, N, L>,
    /// Its lights in the world.
    pub lights: &'a [EmissiveTriangle],
    /// Its depth.
    pub depth: u32,
}

impl<N: LightNode<W>, L: MeshLeaf, const W: usize> Subject for Walked<'_, N, L, W> {
    fn lights(&self) -> &[EmissiveTriangle] {
        self.lights
    }

    fn depth(&self) -> u32 {
        self.depth
    }

    fn sample(&self, point: &ShadingPoint, random: u32) -> SampledLight {
        traverse::sample::<N, Eq4, L, W>(&self.tree, point, random)
    }

    fn pmf(&self, point: &ShadingPoint, light: u32) -> f32 {
        let mesh = self.lights.get(light as usize).map(|triangle| triangle.mesh);
        let mesh = if self.tree.meshes.is_empty() {
            Some(INVALID)
        } else {
            mesh
        };
        mesh.map_or(0.0, |mesh| {
            traverse::pmf::<N, Eq4, L, W>(&self.tree, point, light, mesh)
        })
    }
}
