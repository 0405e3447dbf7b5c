//! Ids as C holds them: words that say themselves whether they were given, and of what.

use bytemuck::Zeroable;
use lightbvh::{InstanceId, MeshId};

use crate::error::{Fault, Status};

/// `lightbvh_id`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Zeroable)]
pub struct CId {
    words: [u32; 3],
    kind: u32,
}

/// Zero is no kind, so cleared memory holds no id.
const MESH: u32 = 1;
const INSTANCE: u32 = 2;

impl From<MeshId> for CId {
    fn from(id: MeshId) -> Self {
        let (words, kind) = (id.to_bits(), MESH);
        Self { words, kind }
    }
}

impl From<InstanceId> for CId {
    fn from(id: InstanceId) -> Self {
        let (words, kind) = (id.to_bits(), INSTANCE);
        Self { words, kind }
    }
}

impl CId {
    pub(crate) fn mesh(self) -> Result<MeshId, Fault> {
        let expected = "no id of a mesh; give what lightbvh_add_mesh returned";
        let is_own = self.kind == MESH;
        let id = is_own.then(|| MeshId::from_bits(self.words));
        id.ok_or_else(|| Fault::new(Status::UnknownMesh, expected))
    }

    pub(crate) fn instance(self) -> Result<InstanceId, Fault> {
        let expected = "no id of an instance; give what lightbvh_add_instance or lightbvh_add_light returned";
        let is_own = self.kind == INSTANCE;
        let id = is_own.then(|| InstanceId::from_bits(self.words));
        id.ok_or_else(|| Fault::new(Status::UnknownInstance, expected))
    }

    pub(crate) fn is_mesh(self) -> bool {
        self.kind == MESH
    }
}
