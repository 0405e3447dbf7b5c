//! Edits of a scene, and reasons to refuse them.

use alloc::vec::Vec;
use core::fmt;

use crate::domain::{DomainError, Number};
use crate::light::EmissiveTriangle;
use crate::transform::Transform;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $(#[$of_index:meta])*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name {
            pub(super) tree: u32,
            pub(super) index: u32,
            pub(super) generation: u32,
        }

        impl $name {
            $(#[$of_index])*
            #[must_use]
            pub fn index(self) -> u32 {
                self.index
            }

            /// The id as words, for another language. They mean something to this light BVH alone, as long as the program runs.
            #[must_use]
            pub const fn to_bits(self) -> [u32; 3] {
                [self.tree, self.index, self.generation]
            }

            /// The inverse of [`to_bits`](Self::to_bits). Any words give an id; edits refuse an unknown or removed id.
            #[must_use]
            pub const fn from_bits([tree, index, generation]: [u32; 3]) -> Self {
                Self {
                    tree,
                    index,
                    generation,
                }
            }
        }
    };
}

id!(
    /// A mesh of emissive lights; stays the same as long as the mesh is in the scene, and never means another one.
    MeshId,
    /// Index of the mesh; free for another one after the mesh is removed.
);
id!(
    /// A mesh's place in the world; stays the same as long as the instance is in the scene, and never means another one.
    InstanceId,
    /// Index of the instance among [`View::instances`](super::View::instances), and of the mesh light that its lights belong
    /// to. The index is reused as soon as the instance is removed. Identify lights over frames by ids, or by their numbers
    /// (see [`View::removed_lights`](super::View::removed_lights)).
);

/// One change of a scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Edit<L = EmissiveTriangle> {
    /// A new mesh, not in the world yet. Lights are in the mesh's own space; their `mesh` is ignored. Its bottom level is
    /// built within the call, 0.2 to 0.4 µs for each light.
    AddMesh {
        /// At least one.
        lights: Vec<L>,
    },
    /// A mesh put into the world.
    AddInstance {
        /// Which mesh.
        mesh: MeshId,
        /// Where.
        transform: Transform,
        /// Factor on the mesh's radiance, linear RGB: each 0, or from 2^-60 to 2^60.
        radiance: [f32; 3],
        /// Which receivers it lights, as bits; `u32::MAX` for all. See [`Linked`](crate::importance::Linked).
        mask: u32,
    },
    /// A light by itself, in the world: an instance at the identity of a mesh of its own, removed with it. Its id is among
    /// [`Added::instances`](super::Added::instances).
    AddLight {
        /// In the world; its `mesh` is ignored.
        light: L,
        /// Which receivers it lights, as bits; `u32::MAX` for all.
        mask: u32,
    },
    /// A light by itself becomes another one.
    SetLight {
        /// Which one: an instance that [`Edit::AddLight`] made.
        instance: InstanceId,
        /// In the world, if the instance was not moved.
        light: L,
    },
    /// An instance moved.
    SetTransform {
        /// Which one.
        instance: InstanceId,
        /// Where to.
        transform: Transform,
    },
    /// An instance made brighter, dimmed, coloured, or turned off.
    SetRadiance {
        /// Which one.
        instance: InstanceId,
        /// Factor on the mesh's radiance, linear RGB: each 0, or from 2^-60 to 2^60.
        radiance: [f32; 3],
    },
    /// An instance made to light other receivers.
    SetMask {
        /// Which one.
        instance: InstanceId,
        /// Which receivers it lights, as bits; `u32::MAX` for all.
        mask: u32,
    },
    /// New vertices or new emission of a mesh, in all its instances.
    SetLights {
        /// Which mesh.
        mesh: MeshId,
        /// As many lights as before.
        lights: Vec<L>,
    },
    /// New vertices or new emission of some lights of a mesh, in all its instances. Takes time in proportion to them. A
    /// [`refit`](crate::Bvh::refit) then computes their paths to the root, or, above a sixteenth of the mesh, all of it. If they reach
    /// farther from the mesh's origin than any light so far, each instance of the mesh is checked. A mesh of points and spots alone is
    /// looked at as a whole.
    SetLightRange {
        /// Which mesh.
        mesh: MeshId,
        /// Index in the mesh of the first of them, counting from 0.
        first: u32,
        /// What the lights from there on become; may be none.
        lights: Vec<L>,
    },
    /// An instance, or a light by itself, taken out of the world.
    RemoveInstance(InstanceId),
    /// A mesh without instances taken out of the scene.
    RemoveMesh(MeshId),
}

/// Least and greatest factor on radiance that is not zero: 2^-60 and 2^60.
pub(crate) const RADIANCE_FACTORS: [f32; 2] = [crate::exact::pow2(-60), crate::exact::pow2(60)];

/// Why a batch of edits is refused; none of it has been done then.
#[derive(Clone, Debug, PartialEq)]
pub struct EditError {
    /// Index of the edit in the batch.
    pub edit: usize,
    /// What is wrong with it.
    pub reason: EditReason,
}

/// Reason to refuse an edit: the error of single ones.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EditReason {
    /// No mesh has that id: it was removed, or is one of another light BVH.
    UnknownMesh(MeshId),
    /// No instance has that id: it was removed, or is one of another light BVH.
    UnknownInstance(InstanceId),
    /// An instance is of a mesh, no light by itself.
    NoLight(InstanceId),
    /// A mesh has no light.
    EmptyMesh,
    /// A light by itself is outside the domain.
    Alone(DomainError),
    /// A light of a mesh is outside the domain.
    Light {
        /// Its index in the edit.
        index: usize,
        /// What is wrong with it.
        error: DomainError,
    },
    /// A transform is outside the domain.
    Transform(DomainError),
    /// A factor on radiance is neither 0 nor from 2^-60 to 2^60.
    Radiance {
        /// What was found.
        value: f32,
    },
    /// A mesh is to be deformed into another number of lights.
    Count {
        /// What the mesh has.
        expected: usize,
        /// What the edit has.
        found: usize,
    },
    /// Lights to be changed are not all in the mesh.
    Range {
        /// Index of the first of them.
        first: u32,
        /// Their number.
        count: usize,
        /// What the mesh has.
        lights: usize,
    },
    /// A mesh to be removed still has instances.
    InUse {
        /// Their number.
        instances: usize,
    },
    /// More than 2^30 lights of meshes, 2^30 numbers of lights, free ones below the greatest included, or 2^27 instances.
    TooMany,
    /// A single-level BVH has one mesh and one instance, which stay.
    SingleLevel,
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "edit {}: {}", self.edit, self.reason)
    }
}

impl fmt::Display for EditReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownMesh(id) => write!(
                f,
                "mesh {} is not there: it was removed, or the id is of another light BVH (one that was cloned or read has ids of its own: `mesh_id`)",
                id.index
            ),
            Self::UnknownInstance(id) => write!(
                f,
                "instance {} is not there: it was removed, or the id is of another light BVH (one that was cloned or \
                 read has ids of its own: `instance_id`)",
                id.index
            ),
            Self::NoLight(id) => write!(
                f,
                "instance {} is of a mesh; change the mesh's lights by `Edit::SetLights`",
                id.index
            ),
            Self::EmptyMesh => write!(f, "a mesh without lights; leave it out"),
            Self::Light { index, error } => write!(f, "light {index}: {error}"),
            Self::Alone(error) | Self::Transform(error) => write!(f, "{error}"),
            Self::Radiance { value } => write!(
                f,
                "factor on radiance {}, expected 0 or a number from 2^-60 to 2^60 (8.7e-19 to 1.2e18){}",
                Number(*value),
                // A larger factor can be split between mesh and instance.
                if *value > 0.0 {
                    "; put the rest into the mesh"
                } else if *value < 0.0 {
                    "; nothing shines less than 0"
                } else {
                    ""
                }
            ),
            Self::Count { expected, found } => write!(
                f,
                "{found} light{} for a mesh of {expected}; add a mesh of its own instead",
                if *found == 1 { "" } else { "s" }
            ),
            Self::Range { first, count, lights } => write!(
                f,
                "lights {first} to {} of a mesh of {lights}; name a range within it",
                u64::from(*first) + *count as u64
            ),
            Self::InUse { instances } => {
                let s = if *instances == 1 { "" } else { "s" };
                let those = if *instances == 1 { "it" } else { "them" };
                write!(
                    f,
                    "the mesh still has {instances} instance{s}; remove {those} first"
                )
            }
            Self::TooMany => write!(
                f,
                "more than 2^30 lights, or 2^27 instances; numbers of removed lights count until `take_removed_lights`; or split the scene"
            ),
            Self::SingleLevel => write!(
                f,
                "a single-level light BVH takes new lights of its mesh and nothing else; build one of two levels"
            ),
        }
    }
}

impl core::error::Error for EditError {}

impl core::error::Error for EditReason {}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;
    use crate::LightBvh;
    use crate::kit::scenes::scattered;
    use crate::kit::triangle;

    #[test]
    fn words_of_no_id_are_refused() {
        let lamp = triangle([[0.0, 3.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 1.0]]);
        let (mut bvh, ids): (LightBvh, _) = scattered(vec![lamp], 1, |_| [0.0; 3]);
        let (instance, mesh) = (ids[0], bvh.view().mesh_of(ids[0]).unwrap());
        bvh.set_radiance(InstanceId::from_bits(instance.to_bits()), [2.0; 3])
            .unwrap();
        for word in 0..3 {
            for wrong in [1, u32::MAX] {
                let mut bits = instance.to_bits();
                bits[word] ^= wrong;
                let id = InstanceId::from_bits(bits);
                let error = bvh.set_radiance(id, [2.0; 3]).unwrap_err();
                assert_eq!(error, EditReason::UnknownInstance(id));
                let mut bits = mesh.to_bits();
                bits[word] ^= wrong;
                let id = MeshId::from_bits(bits);
                let error = bvh.add_instance(id, Transform::IDENTITY).unwrap_err();
                assert_eq!(error, EditReason::UnknownMesh(id));
            }
        }
        bvh.add_instance(MeshId::from_bits(mesh.to_bits()), Transform::IDENTITY)
            .unwrap();
    }
}
