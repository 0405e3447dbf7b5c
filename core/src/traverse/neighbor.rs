//! The children beside a way down: who may be dead, or take over from the dead.

use crate::exact;
use crate::node::kind;
use crate::tree::INVALID;

/// A child beside a way down.
#[derive(Clone, Copy)]
pub(super) struct Neighbor<const W: usize> {
    /// The node that it is a child of.
    pub index: u32,
    /// [`kind`] of the child; `EMPTY` for no neighbour.
    pub kind: u32,
    /// Its link.
    pub link: u32,
    /// Mesh light that its node lies in, or [`INVALID`].
    pub mesh: u32,
    /// Position of the node that it is a child of.
    pub position: u32,
    /// Its slot there.
    pub slot: u32,
    /// Probability of reaching that node.
    pub before: f32,
    /// The weights of that node's children.
    pub weights: [f32; W],
    /// The sum of their weights.
    pub sum: f32,
}

/// Probabilities of neighbours below this, 2^-124, count as none: a device that flushes subnormal numbers agrees.
const LEAST_MASS: f32 = exact::pow2(-124);

impl<const W: usize> Neighbor<W> {
    /// No neighbour.
    pub const NONE: Self = Self {
        index: 0,
        kind: kind::EMPTY,
        link: 0,
        mesh: INVALID,
        position: 0,
        slot: 0,
        before: 0.0,
        weights: [0.0; W],
        sum: 1.0,
    };

    /// Probability of entering it; divided only here, since few neighbours turn out dead.
    #[inline(always)]
    pub fn mass(&self) -> f32 {
        let mut weight = 0.0;
        for slot in 0..W {
            weight = if slot as u32 == self.slot {
                self.weights[slot]
            } else {
                weight
            };
        }
        exact::flush(self.before * exact::div(weight, self.sum), LEAST_MASS)
    }

    #[inline(always)]
    pub fn is_none(&self) -> bool {
        self.kind == kind::EMPTY
    }
}
