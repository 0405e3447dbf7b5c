//! How far meshes reach, as far as a batch must know: never less than they do, and exactly where an instance would be refused else.

use super::Batch;
use crate::bvh::edit::{Edit, EditReason, InstanceId, MeshId};
use crate::bvh::{Bvh, Trails};
use crate::node::Node;
use crate::transform::Extent;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Whether an instance is refused for an extent that is perhaps not the least.
    pub(super) fn may_be_nearer(&self, edits: &[Edit<N::Light>], reason: &EditReason) -> bool {
        let in_part = |edit: &Edit<N::Light>| matches!(edit, Edit::SetTriangleRange { .. });
        matches!(reason, EditReason::Transform(_))
            && (edits.iter().any(in_part) || self.meshes.iter().any(|mesh| !mesh.extent.is_exact))
    }

    /// What is known of a mesh's extent, or once for a batch all of it.
    pub(super) fn extent(&self, batch: &mut Batch<N::Light>, id: MeshId) -> Extent {
        if let Some(&extent) = batch.extents.get(&id) {
            return extent;
        }
        let known = self.meshes[id.index as usize].extent;
        if batch.copies.is_none() || known.is_exact {
            return known;
        }
        let exact = Extent::of(self.mesh_triangles(id).unwrap_or_default());
        batch.extents.insert(id, exact);
        exact
    }

    /// The extent of a mesh with some of its triangles changed.
    pub(super) fn extent_with(
        &self,
        batch: &mut Batch<N::Light>,
        id: MeshId,
        first: u32,
        triangles: &[N::Light],
    ) -> Extent {
        let own = self.mesh_triangles(id).unwrap_or_default();
        let range = first as usize..first as usize + triangles.len();
        if let Some(copies) = &mut batch.copies {
            let copy = copies.entry(id).or_insert_with(|| own.to_vec());
            copy[range].copy_from_slice(triangles);
            return Extent::of(copy);
        }
        let mut old = Extent::of(&own[range]);
        // Others may be there since.
        old.is_exact = !batch.extents.contains_key(&id);
        self.extent(batch, id).with(&old, &Extent::of(triangles))
    }

    /// Whether all instances of a mesh, those of the batch included, may have that extent, which it gets.
    pub(super) fn check_users(
        &self,
        batch: &mut Batch<N::Light>,
        mesh: MeshId,
        extent: Extent,
    ) -> Result<(), EditReason> {
        for &index in &self.meshes[mesh.index as usize].users {
            let placed = &self.placed[index as usize];
            let id = InstanceId {
                tree: self.id.0,
                index,
                generation: placed.generation,
            };
            if !batch.removed_instances.contains(&id) {
                let transform = batch.transforms.get(&id).unwrap_or(&placed.transform);
                transform.check(&extent).map_err(EditReason::Transform)?;
            }
        }
        for transform in batch.added.get(&mesh).into_iter().flatten() {
            transform.check(&extent).map_err(EditReason::Transform)?;
        }
        batch.extents.insert(mesh, extent);
        Ok(())
    }
}
