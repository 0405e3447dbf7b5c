//! Light BVHs over triangles that stand in the world already.

use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use crate::build::{BuildParams, build_each};
use crate::lights::Lights;
use crate::node::Node;
use crate::transform::Transform;

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// One tree over all triangles: the paper's baseline. Light `k` is triangle `k`; the only edits are those of the triangles.
    #[must_use]
    pub fn single_level(lights: &Lights<N::Light>, params: &BuildParams) -> Self {
        let all = Some(0..lights.triangles().len()).filter(|all| !all.is_empty());
        let mut bvh = Self::new(*params);
        bvh.single = true;
        bvh.over(lights.triangles(), all.into_iter());
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2), each an instance that stays where it is. Light `k` is triangle `k`, instance `i` is mesh light `i`.
    #[must_use]
    pub fn two_level(lights: &Lights<N::Light>, params: &BuildParams) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh));
        let mut bvh = Self::new(*params);
        bvh.over(lights.triangles(), meshes);
        bvh
    }

    /// A mesh and an instance of it for each range of the triangles.
    fn over(&mut self, triangles: &[N::Light], meshes: impl Iterator<Item = Range<usize>>) {
        let meshes: Vec<_> = meshes.map(|range| &triangles[range]).collect();
        let topologies = build_each(&meshes, &self.params);
        for (triangles, topology) in meshes.into_iter().zip(topologies) {
            let mesh = self.insert_mesh(triangles, &topology);
            self.insert_instance(mesh, Transform::IDENTITY, [1.0; 3], u32::MAX);
        }
        self.refit();
    }
}
