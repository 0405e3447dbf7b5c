//! Meshes and instances as the CPU knows them.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;
use core::sync::atomic::{AtomicU32, Ordering};

use crate::transform::Transform;
use crate::tree::INVALID;

/// A mesh: lights and a tree over them in a space of their own, which its instances share.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub live: bool,
    /// Whether it is a light by itself: it goes with its last instance.
    pub is_light: bool,
    pub generation: u32,
    /// Indices of its instances.
    pub users: Vec<u32>,
    /// The nodes of its tree, in depth-first order; none where it is one light of two levels.
    pub nodes: Range<u32>,
    /// End of the places reserved for its nodes: a new tree overwrites the old one.
    pub capacity: u32,
    pub lights: Range<u32>,
    pub depth: u32,
    /// Greatest magnitude of a coordinate that its lights reached since all of them were set.
    pub reach: f32,
    /// Whether the flux of its lights grows with area where an instance scales.
    pub is_by_area: bool,
    /// Counts edits of its lights.
    pub version: u64,
}

impl Mesh {
    /// Node index of its root; [`INVALID`] if it has no nodes.
    pub fn root(&self) -> u32 {
        match self.nodes.is_empty() {
            true => INVALID,
            false => self.nodes.start,
        }
    }
}

/// An instance as the CPU knows it.
#[derive(Clone, Debug)]
pub(super) struct InstanceState {
    pub live: bool,
    pub generation: u32,
    pub mesh: u32,
    /// Its place in the mesh's list of users.
    pub user: u32,
    pub transform: Transform,
    pub radiance: [f32; 3],
    pub mask: u32,
    /// Its place in the list of instances in use.
    pub listed: u32,
    pub numbers: Range<u32>,
    /// Whether its leaf is to be computed.
    pub is_stale: bool,
}

impl InstanceState {
    /// An instance not in use.
    pub const NONE: Self = Self {
        live: false,
        generation: 0,
        mesh: 0,
        user: 0,
        transform: Transform::IDENTITY,
        radiance: [0.0; 3],
        mask: 0,
        listed: 0,
        numbers: 0..0,
        is_stale: false,
    };
}

/// Sets `list[index]`; a shorter list is filled up to there with copies.
pub(super) fn put<T: Clone>(list: &mut Vec<T>, index: u32, value: T) {
    if list.len() <= index as usize {
        list.resize(index as usize + 1, value.clone());
    }
    list[index as usize] = value;
}

/// A number that identifies a BVH, which refuses the ids of others, or a rebuilder. A clone gets another.
pub(crate) struct TreeId(pub u32);

impl TreeId {
    pub fn next() -> Self {
        // From 1: an id of zeros is none.
        static NEXT: AtomicU32 = AtomicU32::new(1);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

impl Clone for TreeId {
    fn clone(&self) -> Self {
        Self::next()
    }
}

/// Equal BVHs read alike, whatever their numbers are.
impl fmt::Debug for TreeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TreeId")
    }
}
