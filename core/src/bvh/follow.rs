//! A light BVH that was built over [`Lights`] follows them.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use super::edit::EditReason;
use super::{Bvh, Trails};
use crate::light::Light;
use crate::lights::Lights;
use crate::node::Node;
use crate::transform::Extent;

/// How many triangles each mesh of a BVH has: what [`Lights`] must have for the BVH, or a copy of it, to follow them.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshCounts {
    /// One mesh holds all triangles.
    single: bool,
    /// Numbers of triangles by the indices of the meshes, 0 where one was removed.
    counts: Vec<usize>,
}

impl MeshCounts {
    /// Compares with the mesh lights of `lights`, in their order.
    ///
    /// # Errors
    /// [`FollowError`] naming the first mesh light whose number of triangles is another, 0 where there is no such.
    pub fn check<L: Light>(&self, lights: &Lights<L>) -> Result<(), FollowError> {
        let meshes = if self.single { 1 } else { lights.mesh_count() };
        for mesh in 0..meshes.max(self.counts.len()) {
            let expected = self.counts.get(mesh).copied().unwrap_or(0);
            let found = self.range(lights, mesh).len();
            if expected != found {
                let reason = EditReason::Count { expected, found };
                return Err(FollowError { mesh, reason });
            }
        }
        Ok(())
    }

    /// The triangles of `lights` that are those of mesh `mesh`; none where there is no such mesh light.
    fn range<L: Light>(&self, lights: &Lights<L>, mesh: usize) -> Range<usize> {
        match mesh {
            0 if self.single => 0..lights.triangles().len(),
            _ if mesh < lights.mesh_count() => lights.mesh(mesh),
            _ => 0..0,
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// How many triangles each mesh has.
    #[doc(hidden)]
    #[must_use]
    pub fn mesh_counts(&self) -> MeshCounts {
        let count = |mesh: &super::Mesh| match mesh.live {
            true => mesh.triangles.len(),
            false => 0,
        };
        MeshCounts {
            single: self.single,
            counts: self.meshes.iter().map(count).collect(),
        }
    }

    /// Moves or changes all triangles of a BVH built over [`Lights`], and refits it: the triangles of mesh `k` are those of
    /// mesh light `k`, or all of them in a single-level BVH.
    ///
    /// # Errors
    /// [`FollowError`] naming the mesh light whose number of triangles is another (0 where there is no such), or that would be
    /// out of range where an instance has moved it meanwhile; the BVH is as before then.
    pub fn follow(&mut self, lights: &Lights<N::Light>) -> Result<(), FollowError> {
        let counts = self.mesh_counts();
        counts.check(lights)?;
        let mut changes = Vec::new();
        for (index, mesh) in self.meshes.iter().enumerate().filter(|(_, mesh)| mesh.live) {
            let triangles = &lights.triangles()[counts.range(lights, index)];
            let extent = Extent::of(triangles);
            for &user in &mesh.users {
                let transform = &self.placed[user as usize].transform;
                transform.check(&extent).map_err(|reason| FollowError {
                    mesh: index,
                    reason: EditReason::Transform(reason),
                })?;
            }
            changes.push((index as u32, triangles, extent));
        }
        for (mesh, triangles, extent) in changes {
            self.meshes[mesh as usize].extent = extent;
            self.write_triangles(mesh, 0, triangles);
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
