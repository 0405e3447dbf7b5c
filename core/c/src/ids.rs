//! Ids as C holds them: words that say themselves whether they were given.

use lightbvh::{InstanceId, MeshId};

use crate::error::{Fault, Status};

macro_rules! id {
    ($(#[$doc:meta])* $c:ident, $own:ident, $kind:literal, $expected:literal) => {
        $(#[$doc])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $c {
            words: [u32; 3],
            kind: u32,
        }

        impl From<$own> for $c {
            fn from(id: $own) -> Self {
                let words = id.to_bits();
                Self { words, kind: $kind }
            }
        }

        impl $c {
            pub(crate) fn id(self) -> Result<$own, Fault> {
                match self.kind {
                    $kind => Ok($own::from_bits(self.words)),
                    _ => Err(Fault::new(Status::Refused, $expected)),
                }
            }
        }
    };
}

// Zero is no kind, so memory that was only cleared holds no id.
id!(
    /// `lightbvh_mesh`.
    CMesh,
    MeshId,
    1,
    "no mesh; give what lightbvh_add_mesh gave"
);
id!(
    /// `lightbvh_instance`.
    CInstance,
    InstanceId,
    2,
    "no instance; give what lightbvh_add_instances gave"
);
