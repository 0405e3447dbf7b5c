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
        let mut bvh = Self::over(lights.triangles(), all.into_iter(), params);
        bvh.single = true;
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2), each an instance that stays where it is. Light `k` is triangle `k`, instance `i` is mesh light `i`.
    #[must_use]
    pub fn two_level(lights: &Lights<N::Light>, params: &BuildParams) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh));
        Self::over(lights.triangles(), meshes, params)
    }

    /// A mesh and an instance of it for each range of the triangles.
    fn over(
        triangles: &[N::Light],
        meshes: impl Iterator<Item = Range<usize>>,
        params: &BuildParams,
    ) -> Self {
        let mut bvh = Self::new(*params);
        let meshes: Vec<_> = meshes.map(|range| &triangles[range]).collect();
        if meshes.is_empty() {
            return bvh;
        }
        // The top level of no instances gives its place up, so that no node is left unused.
        bvh.vacate_top();
        let topologies = build_each(&meshes, params);
        let mut added = Vec::new();
        for (triangles, topology) in meshes.into_iter().zip(topologies) {
            let mesh = bvh.insert_mesh(triangles, topology);
            added.push(bvh.insert_instance(mesh, Transform::IDENTITY, 1.0).index());
        }
        bvh.insert_instances(&added);
        bvh.reserve_room();
        bvh.refit();
        bvh
    }
}
