//! Ids as C holds them: words that say themselves whether they were given.

use lightbvh::{InstanceId, MeshId};

use crate::error::{Fault, Status};

/// `lightbvh_mesh`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CMesh {
    words: [u32; 3],
    kind: u32,
}

/// `lightbvh_instance`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CInstance {
    words: [u32; 3],
    kind: u32,
}

/// Zero is no kind, so memory that was only cleared holds no id.
const MESH: u32 = 1;
const INSTANCE: u32 = 2;

impl From<MeshId> for CMesh {
    fn from(id: MeshId) -> Self {
        Self {
            words: id.to_bits(),
            kind: MESH,
        }
    }
}

impl From<InstanceId> for CInstance {
    fn from(id: InstanceId) -> Self {
        Self {
            words: id.to_bits(),
            kind: INSTANCE,
        }
    }
}

impl CMesh {
    pub(crate) fn id(self) -> Result<MeshId, Fault> {
        match self.kind {
            MESH => Ok(MeshId::from_bits(self.words)),
            _ => Err(Fault::new(
                Status::Refused,
                "no mesh; give what lightbvh_add_mesh gave",
            )),
        }
    }
}

impl CInstance {
    pub(crate) fn id(self) -> Result<InstanceId, Fault> {
        match self.kind {
            INSTANCE => Ok(InstanceId::from_bits(self.words)),
            _ => Err(Fault::new(
                Status::Refused,
                "no instance; give what lightbvh_add_instances gave",
            )),
        }
    }
}
