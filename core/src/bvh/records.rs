//! Meshes and instances as the CPU knows them.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;
use core::sync::atomic::{AtomicU32, Ordering};

use crate::transform::Transform;

/// A mesh: the bottom level that its instances share.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub live: bool,
    pub generation: u32,
    pub blas: u32,
    /// Indices of its instances.
    pub users: Vec<u32>,
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
    pub radiance: f32,
    /// Its place in the list of instances in use.
    pub listed: u32,
    pub lights: Range<u32>,
    /// Where in the top level it is a leaf.
    pub node: u32,
    pub slot: u32,
    /// When it was put where it is in the top level, but for rebuilds.
    pub hung: u64,
    /// Its radiance then; of one that flickers, the greatest since.
    pub hung_radiance: f32,
    /// Whether it was put in elsewhere for being dimmer before. From then on only being brighter is a reason: a lamp that
    /// flickers stays where its light belongs.
    pub flickers: bool,
    /// Its centre then, metres; NaN before it is moved for the first time.
    pub hung_center: [f32; 3],
    /// The last search that came by.
    pub mark: u64,
    /// When its words changed last.
    pub changed: u64,
    /// The records of its parts, where it is opened.
    pub parts: Range<u32>,
    /// The instance that this is a part of, or [`INVALID`](crate::INVALID).
    pub part_of: u32,
}

impl InstanceState {
    /// The radiance that its place is for: one that flickers stays where it is bright.
    pub fn bright(&self) -> f32 {
        if self.flickers && self.hung_radiance > self.radiance {
            self.hung_radiance
        } else {
            self.radiance
        }
    }

    /// It was put where it is in the top level as it is now.
    pub fn settle(&mut self) {
        // What is off is as well off anywhere, and stays where it is bright.
        if self.radiance > 0.0 || !self.flickers {
            self.hung_radiance = self.radiance;
        }
        self.hung_center = [f32::NAN; 3];
    }

    /// Radiance as it was put where it is, the sign telling of [`flickers`](Self::flickers), and the centre then: words of the
    /// format.
    pub fn hung_words(&self) -> [u32; 4] {
        let sign = if self.flickers { -1.0 } else { 1.0 };
        let [x, y, z] = self.hung_center;
        [self.hung_radiance.copysign(sign), x, y, z].map(f32::to_bits)
    }

    /// Takes what [`hung_words`](Self::hung_words) told.
    pub fn set_hung_words(&mut self, words: [u32; 4]) {
        let [radiance, x, y, z] = words.map(f32::from_bits);
        self.hung_radiance = crate::exact::abs(radiance);
        self.flickers = radiance.is_sign_negative();
        self.hung_center = [x, y, z];
    }
}

/// The number by which a BVH tells its own ids and rebuilds from another's. A copy has another.
pub(super) struct TreeId(pub u32);

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
