//! What each part of a frame may take: a constant, and what the frame itself changed.

use std::time::Duration;

use lightbvh::bvh::RefitPlan;

/// The part that every frame has, whatever is rebuilt beside it and however large the scene is.
const FRAME: Duration = Duration::from_micros(300);
/// For each instance that is added, removed, moved or dimmed.
const INSTANCE: Duration = Duration::from_micros(20);
/// For each triangle given by an edit that deforms a mesh.
const TRIANGLE: Duration = Duration::from_nanos(400);
/// For each triangle of a mesh that is added: its bottom level is built in the call.
const BUILT: Duration = Duration::from_micros(4);
/// For each node or root that the frame's plan has computed.
const NODE: Duration = Duration::from_micros(2);

/// Nodes of the top level that an instance touched may have computed, over many frames.
pub(super) const NODES: f64 = 100.0;

/// What a frame changed.
#[derive(Clone, Copy, Debug, Default, serde::Serialize)]
pub(super) struct Work {
    /// Instances added, removed, moved, dimmed, or of a mesh that was deformed.
    pub instances: u32,
    /// Triangles of meshes that were deformed.
    pub triangles: u32,
    /// Triangles of meshes that were added.
    pub built: u32,
    /// Nodes and roots computed.
    pub nodes: u32,
    /// Nodes of the top level computed.
    pub top: u32,
}

impl Work {
    /// The nodes of the frame's plan.
    pub fn take(&mut self, plan: &RefitPlan) {
        self.nodes = plan.computed() as u32;
        self.top = plan.top.nodes().len() as u32;
    }

    /// Most that the begin of the frame may take, its edits, its refit, and its end.
    ///
    /// The nodes of a single plan are taken as they are; those of all plans together are held against [`NODES`].
    pub fn bounds(&self) -> [Duration; 4] {
        let edits = INSTANCE * self.instances + TRIANGLE * self.triangles + BUILT * self.built;
        [
            FRAME,
            FRAME + edits,
            FRAME + INSTANCE * self.instances + NODE * self.nodes,
            FRAME,
        ]
    }
}
