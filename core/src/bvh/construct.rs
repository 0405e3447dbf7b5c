//! Light BVHs over lights that stand in the world already.

use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use crate::build::{BuildParams, build_each};
use crate::lights::Lights;
use crate::model::Model;
use crate::transform::Transform;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// One tree over all lights: the paper's baseline. Light `k` is triangle `k`; the only edits are those of the lights.
    #[must_use]
    pub fn single_level(lights: &Lights<M::Light>, params: &BuildParams) -> Self {
        let all = Some(0..lights.all().len()).filter(|all| !all.is_empty());
        let mut bvh = Self::new(*params);
        bvh.single = true;
        bvh.over(lights.all(), all.into_iter());
        bvh
    }

    /// A bottom level (BLAS) over the lights of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2), each an instance that stays where it is. Light `k` is triangle `k`, instance `i` is mesh light `i`.
    #[must_use]
    pub fn two_level(lights: &Lights<M::Light>, params: &BuildParams) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh));
        let mut bvh = Self::new(*params);
        bvh.over(lights.all(), meshes);
        bvh
    }

    /// A mesh and an instance of it for each range of the lights.
    fn over(&mut self, lights: &[M::Light], meshes: impl Iterator<Item = Range<usize>>) {
        let meshes: Vec<_> = meshes.map(|range| &lights[range]).collect();
        let topologies = build_each(&meshes, &self.params);
        for (lights, topology) in meshes.into_iter().zip(topologies) {
            let mesh = self.insert_mesh(lights, &topology);
            self.insert_instance(mesh, Transform::IDENTITY, [1.0; 3], u32::MAX);
        }
        self.refit();
    }
}
