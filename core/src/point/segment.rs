//! A receiver that is a piece of a ray.

use bytemuck::{Pod, Zeroable};

use super::{Receiver, ShadingPoint};
use crate::domain::{DomainError, MIN_OFFSET};
use crate::instance::Instance;
use crate::vector::{flush3, vector};

/// A piece of a ray through a volume, from one point to another: light reaches it everywhere. The receiver of
/// [`Subtended`](crate::importance::Subtended).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RaySegment {
    /// Where it begins, metres, coordinates of magnitude at most 2^40 ([`RaySegment::checked`]).
    pub from: [f32; 3],
    /// Where it ends, metres. A segment without length is a point in a volume.
    pub to: [f32; 3],
}

impl RaySegment {
    /// Brings both ends into the domain of this crate, or says why they cannot be; see [`ShadingPoint::checked`].
    ///
    /// # Errors
    /// [`DomainError`] for a coordinate that is not finite or beyond 2^40 m.
    pub fn checked(self) -> Result<Self, DomainError> {
        let [from, to] = self.ends();
        Ok(Self {
            from: from.checked()?.p,
            to: to.checked()?.p,
        })
    }

    /// The point at the fraction `part` of the segment, 0 to 1, metres.
    #[inline]
    #[must_use]
    pub fn at(&self, part: f32) -> [f32; 3] {
        let from = flush3(vector(&self.from) * (1.0 - part), MIN_OFFSET);
        let p = from + flush3(vector(&self.to) * part, MIN_OFFSET);
        [p.x, p.y, p.z]
    }

    /// Both ends, in a volume.
    #[inline(always)]
    fn ends(&self) -> [ShadingPoint; 2] {
        let n = [0.0; 3];
        [ShadingPoint { p: self.from, n }, ShadingPoint { p: self.to, n }]
    }
}

impl Receiver for RaySegment {
    /// A map that is not a similarity changes the distances of lights from the segment: that costs variance.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        let [from, to] = self.ends();
        Self {
            from: instance.to_local(&from).p,
            to: instance.to_local(&to).p,
        }
    }

    fn is_within_reach(&self) -> bool {
        let [from, to] = self.ends();
        from.is_within_reach() && to.is_within_reach()
    }
}
