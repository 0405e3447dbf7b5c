//! Light BVHs over triangles that stand in the world already.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use super::Bvh;
use super::edit::EditReason;
use crate::build::{BuildParams, build_each};
use crate::light::EmissiveTriangle;
use crate::lights::Lights;
use crate::node::LightNode;
use crate::transform::{Extent, Transform};

impl<N: LightNode<W>, I, const W: usize> Bvh<N, I, W> {
    /// One tree over all triangles: the paper's baseline. Light `k` is triangle `k`; the only edits are those of the triangles.
    #[must_use]
    pub fn single_level(lights: &Lights, params: &BuildParams) -> Self {
        let all = Some(0..lights.triangles().len()).filter(|all| !all.is_empty());
        let mut bvh = Self::over(lights.triangles(), all.into_iter(), params);
        bvh.single = true;
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2), each an instance that stays where it is. Light `k` is triangle `k`, instance `i` is mesh light `i`.
    #[must_use]
    pub fn two_level(lights: &Lights, params: &BuildParams) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh));
        Self::over(lights.triangles(), meshes, params)
    }

    /// A mesh and an instance of it for each range of the triangles.
    fn over(
        triangles: &[EmissiveTriangle],
        meshes: impl Iterator<Item = Range<usize>>,
        params: &BuildParams,
    ) -> Self {
        let mut bvh = Self::new(*params);
        let meshes: Vec<_> = meshes.map(|range| &triangles[range]).collect();
        if meshes.is_empty() {
            return bvh;
        }
        // The top level of no instances gives its place up, so that no node is left unused.
        for range in core::mem::take(&mut bvh.top.ranges) {
            bvh.node_ranges.give(range);
        }
        let topologies = build_each(&meshes, params);
        let mut added = Vec::new();
        for (triangles, topology) in meshes.into_iter().zip(topologies) {
            let mesh = bvh.insert_mesh(triangles, topology);
            added.push(bvh.insert_instance(mesh, Transform::IDENTITY, 1.0).index());
        }
        bvh.insert_instances(&added);
        bvh.refit();
        bvh
    }

    /// Moves or changes all triangles of a BVH built over [`Lights`], and refits it: the triangles of mesh `k` are those of mesh light
    /// `k`, or all of them in a single-level BVH.
    ///
    /// # Errors
    /// [`FollowError`] naming the mesh light whose number of triangles is another (0 where there is no such), or that would be out of
    /// range where an instance has moved it meanwhile; the BVH is as before then.
    pub fn follow(&mut self, lights: &Lights) -> Result<(), FollowError> {
        let all = lights.triangles().len();
        let mut meshes: Vec<_> = if self.single {
            Some(0..all).filter(|all| !all.is_empty()).into_iter().collect()
        } else {
            (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh)).collect()
        };
        meshes.resize(meshes.len().max(self.meshes.len()), 0..0);
        let mut changes = Vec::new();
        for (index, range) in meshes.into_iter().enumerate() {
            let error = |reason| FollowError { mesh: index, reason };
            let mesh = self.meshes.get(index).filter(|mesh| mesh.live);
            let expected = mesh.map_or(0, |mesh| self.blases[mesh.blas as usize].triangles.len());
            if range.len() != expected {
                let found = range.len();
                return Err(error(EditReason::Count { expected, found }));
            }
            let Some(mesh) = mesh else { continue };
            let triangles = &lights.triangles()[range];
            let extent = Extent::of(triangles);
            for &user in &mesh.users {
                let transform = &self.placed[user as usize].transform;
                transform
                    .check(&extent)
                    .map_err(|reason| error(EditReason::Transform(reason)))?;
            }
            changes.push((mesh.blas, triangles, extent));
        }
        for (blas, triangles, extent) in changes {
            self.deform(blas, triangles, extent);
        }
        self.refit();
        Ok(())
    }
}

/// Why a light BVH cannot follow [`Lights`]: they are not those that it was built over.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowError {
    /// Index of the mesh light; 0 in a single-level BVH.
    pub mesh: usize,
    /// What is wrong with it.
    pub reason: EditReason,
}

impl fmt::Display for FollowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reason {
            EditReason::Count { expected, found } => write!(
                f,
                "mesh light {}: {found} triangles, expected {expected}; these are not the lights that the light BVH was built over: \
                 build it anew",
                self.mesh
            ),
            ref reason => write!(f, "mesh light {}: {reason}", self.mesh),
        }
    }
}

impl core::error::Error for FollowError {}
