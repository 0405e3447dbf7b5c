//! The receiver of light.

mod cell;
mod glossy;
mod linked;
mod segment;
mod transmissive;

pub use cell::Cell;
pub use glossy::GlossyPoint;
pub use linked::LinkedPoint;
pub use segment::RaySegment;
pub use transmissive::TransmissivePoint;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

pub use crate::domain::NORMAL_TOLERANCE;
use crate::domain::{DomainError, MIN_COORDINATE, checked_place};
use crate::exact::{self, flush, pow2};
use crate::instance::{FAR, Instance, TINY, flushed};
use crate::vector::{dot, length_squared, vector};

/// Magnitude of a coordinate, metres, beyond which squares overflow and numbers mean nothing: 2^60. Up to here trees over
/// triangles in the world keep every guarantee, though [`ShadingPoint::checked`] accepts 2^40 only, as of lights.
pub const MAX_REACH: f32 = exact::pow2(60);

/// A point to be lit (pbrt's `LightSampleContext`).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShadingPoint {
    /// Position, metres, magnitude at most 2^40 ([`ShadingPoint::checked`]).
    pub p: [f32; 3],
    /// Unit normal of an opaque surface, its squared length within 2^-7 of 1: only light from its side counts. Zero for a point in a
    /// volume, which receives from everywhere.
    pub n: [f32; 3],
}

impl ShadingPoint {
    /// Brings the point into the domain of this crate, or says why it cannot be. [`LightTree`](crate::LightTree) does not check again; a
    /// [`Bvh`](crate::Bvh) chooses no light for an invalid point.
    ///
    /// Components smaller than [`MIN_COORDINATE`] become zero (with the sign of zero dropped); nothing else changes.
    ///
    /// # Errors
    /// [`DomainError`] for a coordinate that is not finite or beyond [`MAX_COORDINATE`](crate::error::MAX_COORDINATE), and for a normal that is neither of
    /// length 1 (up to [`NORMAL_TOLERANCE`]) nor zero.
    pub fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("shading point", self.p)?;
        self.n = self.n.map(|x| exact::flush(x, MIN_COORDINATE));
        if self.has_sound_normal() {
            Ok(self)
        } else {
            let expected = "length 1, or zero in a volume; normalize it";
            Err(DomainError::vector(
                "the normal of a shading point",
                self.n,
                expected,
            ))
        }
    }

    /// Whether the normal is zero or of length 1.
    fn has_sound_normal(&self) -> bool {
        is_unit_or_zero(self.normal())
    }

    /// Position.
    #[inline]
    #[must_use]
    pub fn position(&self) -> Vec3 {
        vector(&self.p)
    }

    /// Normal, or zero.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        vector(&self.n)
    }
}

/// Whether a vector is zero or of length 1.
fn is_unit_or_zero(v: Vec3) -> bool {
    let excess = length_squared(v) - 1.0;
    v == Vec3::ZERO || (-NORMAL_TOLERANCE..=NORMAL_TOLERANCE).contains(&excess)
}

impl Instance {
    /// A point of the world in the space of the mesh, its normal again of about unit length.
    #[inline(always)]
    #[must_use]
    pub fn to_local(&self, point: &ShadingPoint) -> ShadingPoint {
        let away = flushed(point.position() - self.origin());
        let p = (vector(&self.inverse[0]) * away.x + vector(&self.inverse[1]) * away.y)
            + vector(&self.inverse[2]) * away.z;
        let n = point.normal();
        let back = flushed(Vec3::new(
            dot(self.column(0), n),
            dot(self.column(1), n),
            dot(self.column(2), n),
        ));
        let length = length_squared(back);
        // If the map makes the normal zero, the point counts as in a volume.
        let scale = if length >= pow2(-119) {
            exact::rsqrt(length)
        } else {
            0.0
        };
        ShadingPoint {
            p: [
                flush(exact::clamp(p.x, -FAR, FAR), TINY),
                flush(exact::clamp(p.y, -FAR, FAR), TINY),
                flush(exact::clamp(p.z, -FAR, FAR), TINY),
            ],
            n: [
                flush(back.x * scale, TINY),
                flush(back.y * scale, TINY),
                flush(back.z * scale, TINY),
            ],
        }
    }
}

/// A receiver type: a [`ShadingPoint`], or one with more data for an importance that uses it. A walk transforms it into the space of each
/// instance.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no receiver of light",
    note = "take a `ShadingPoint`, a `LinkedPoint` for `MaskedLights`, or another of `lightbvh::importance`"
)]
pub trait Receiver: Copy {
    /// Whether it receives what reaches the back of its surface, too.
    const IS_TWO_SIDED: bool = false;

    /// The receiver in the space of the instance's mesh.
    fn to_local(&self, instance: &Instance) -> Self;

    /// Whether sampling means anything here: coordinates of magnitude at most 2^60, unit vectors, numbers in their ranges.
    fn is_within_reach(&self) -> bool;
}

impl AsRef<Self> for ShadingPoint {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl Receiver for ShadingPoint {
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        instance.to_local(self)
    }

    fn is_within_reach(&self) -> bool {
        let mut within = self.has_sound_normal();
        for axis in 0..3 {
            within &= (-MAX_REACH..=MAX_REACH).contains(&self.p[axis]);
        }
        within
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::domain::MAX_COORDINATE;

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn points_of_the_domain_are_accepted_as_they_are() {
        let far = MAX_COORDINATE;
        let slanted = [0.6, -0.64, 0.48];
        let [longer, shorter] = [1.003, 0.997].map(|by| slanted.map(|x| x * by));
        for p in [[0.0; 3], [far, -far, far], [MIN_COORDINATE, -MIN_COORDINATE, 1.0]] {
            for n in [[0.0; 3], UP, slanted, longer, shorter] {
                let point = ShadingPoint { p, n };
                assert_eq!(point.checked(), Ok(point));
            }
        }
    }

    #[test]
    fn tiny_components_and_minus_zero_become_zero() {
        let tiny = MIN_COORDINATE.next_down();
        let (p, n) = ([tiny, -0.0, f32::from_bits(1)], [-0.0, 1.0, -tiny]);
        let words = ShadingPoint { p, n }.checked().map(bytemuck::cast::<_, [u32; 6]>);
        assert_eq!(words, Ok([0, 0, 0, 0, 1.0_f32.to_bits(), 0]));
        // A normal of nothing but those is none.
        let volume = ShadingPoint { p, n: [tiny; 3] }.checked();
        assert_eq!(volume.map(|point| point.n), Ok([0.0; 3]));
    }

    #[test]
    fn what_is_out_of_the_domain_is_refused_by_name() {
        let refused = |p, n, text: &str| {
            let error = ShadingPoint { p, n }.checked().expect_err("out of the domain");
            assert!(std::format!("{error}").starts_with(text), "{error}");
        };
        let most = MAX_COORDINATE.next_up();
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, most, f32::MIN] {
            refused([value, 1.0, 1.0], UP, "coordinate x");
            refused([1.0, value, 1.0], UP, "coordinate y");
            refused([1.0, 1.0, value], UP, "coordinate z");
        }
        for n in [
            [1.0; 3],
            [0.0, 0.99, 0.0],
            [0.0, 1.01, 0.0],
            [f32::NAN, 0.0, 0.0],
            [0.0, f32::INFINITY, 0.0],
            [f32::MAX; 3],
            [MIN_COORDINATE; 3],
        ] {
            refused([0.0; 3], n, "the normal of a shading point is (");
        }
    }
}
