//! A light BVH whose meshes change no more: their instances do.

use alloc::vec::Vec;
use core::ops::Range;

use super::edit::{Edit, EditError, EditReason, InstanceId};
use super::{Added, Bvh, Trails, WithTrails};
use crate::node::{Holds, Node};
#[cfg(feature = "std")]
use crate::rebuilder::{FrameStart, RebuildError, Rebuilder};
use crate::tree::LightTree;

/// A [`Bvh`] whose instances are added, removed, moved and dimmed, and whose meshes do not change. It keeps no triangles, which
/// only refits of bottom levels read: 56 bytes each. The caller has the triangles;
/// [`lights_of`](Self::lights_of) says which of them a sample names, [`LightTree::triangle`] brings it into the world.
///
/// Nodes, samples and probabilities are those of the [`Bvh`] that it was made of, frame after frame. It is for the CPU: a
/// device that refits takes over triangles too.
///
/// ```
/// # use lightbvh::{Edit, EmissiveTriangle, LightBvh, ShadingPoint, Transform};
/// # let p = [[0.0, 3.0, 0.0], [0.1, 3.0, 0.0], [0.0, 3.0, 0.1]];
/// # let lamp = EmissiveTriangle { p, radiance: [9.0; 3], mesh: 0, flags: 0 };
/// # let point = ShadingPoint { p: [5.0, 0.0, 0.0], n: [0.0, 1.0, 0.0] };
/// let mut bvh = LightBvh::default();
/// let mesh = bvh.add_mesh(vec![lamp])?;
/// let instance = bvh.add_instance(mesh, Transform::IDENTITY)?;
/// let mut bvh = bvh.into_static_meshes();
/// let transform = Transform::at([4.0, 0.0, 0.0]);
/// bvh.apply(vec![Edit::SetTransform { instance, transform }])?;
/// bvh.refit();
/// let sampled = bvh.sample(&point, 7_u32);
/// # assert_eq!(sampled.instance, instance.index());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct StaticMeshBvh<N: Holds, I, const W: usize, T = WithTrails>(Bvh<N, I, W, T>);

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Refits, and drops the triangles: meshes can change no more. Ids stay valid.
    #[must_use]
    pub fn into_static_meshes(mut self) -> StaticMeshBvh<N, I, W, T> {
        self.refit();
        self.reshaped.clear();
        self.triangles = Vec::new();
        StaticMeshBvh(self)
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> StaticMeshBvh<N, I, W, T> {
    /// See [`Bvh::apply`].
    ///
    /// # Errors
    /// [`EditError`] naming the first edit that cannot be done, [`EditReason::StaticMeshes`] for meshes that are added or deformed;
    /// nothing is changed then.
    pub fn apply(&mut self, edits: Vec<Edit<N::Light>>) -> Result<Added, EditError> {
        let of_triangles = |edit: &Edit<N::Light>| {
            matches!(
                edit,
                Edit::AddMesh { .. } | Edit::SetTriangles { .. } | Edit::SetTriangleRange { .. }
            )
        };
        match edits.iter().position(of_triangles) {
            Some(edit) => Err(EditError {
                edit,
                reason: EditReason::StaticMeshes,
            }),
            None => self.0.apply(edits),
        }
    }

    /// See [`Bvh::refit`].
    pub fn refit(&mut self) {
        self.0.refit();
    }

    /// See [`Bvh::rebuild`].
    pub fn rebuild(&mut self) {
        self.0.rebuild();
    }

    /// See [`Rebuilder::begin_frame`].
    ///
    /// # Errors
    /// [`RebuildError`], once, if the build that was due failed.
    #[cfg(feature = "std")]
    pub fn begin_frame(&mut self, rebuilder: &mut Rebuilder<N, W>) -> Result<FrameStart, RebuildError> {
        rebuilder.begin_frame(&mut self.0)
    }

    /// See [`Rebuilder::end_frame`].
    #[cfg(feature = "std")]
    pub fn end_frame(&self, rebuilder: &mut Rebuilder<N, W>) {
        rebuilder.end_frame(&self.0);
    }

    /// As [`Bvh::lights_of`].
    #[must_use]
    pub fn lights_of(&self, instance: InstanceId) -> Option<Range<u32>> {
        self.0.lights_of(instance)
    }

    /// As [`Bvh::instance_id`].
    #[must_use]
    pub fn instance_id(&self, instance: u32) -> Option<InstanceId> {
        self.0.instance_id(instance)
    }

    /// As [`Bvh::take_removed_lights`].
    pub fn take_removed_lights(&mut self) -> Vec<Range<u32>> {
        self.0.take_removed_lights()
    }

    pub(super) fn arrays(&self) -> LightTree<'_, N, I, W> {
        self.0.arrays()
    }

    /// As [`Bvh::bytes`].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.bytes()
    }

    /// As [`Bvh::memory`].
    #[must_use]
    pub fn memory(&self) -> usize {
        self.0.memory()
    }
}
