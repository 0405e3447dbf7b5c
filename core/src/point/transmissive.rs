//! A receiver with two sides.

use bytemuck::{Pod, Zeroable};

use super::{Receiver, ShadingPoint};
use crate::domain::DomainError;
use crate::exact;
use crate::instance::Instance;

/// A point of a surface that light reaches from both sides: a leaf, a lampshade, a sheet of glass. The viewer receives
/// `front` of the light on the side of the normal and `back` of that on the other side. The receiver of [`Transmissive`](crate::importance::Transmissive).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TransmissivePoint {
    /// Where, and its normal: towards the front.
    pub point: ShadingPoint,
    /// The part of the light from the front, 0 to 1: for a viewer in front the reflectance, for one behind the transmittance. Of luminance.
    pub front: f32,
    /// The part of the light from behind, 0 to 1.
    pub back: f32,
}

impl TransmissivePoint {
    /// Brings the point into the domain of this crate, or says why it cannot be; see [`ShadingPoint::checked`]. Parts are clamped to 0 to 1,
    /// and those below 2^-20 are none.
    ///
    /// # Errors
    /// [`DomainError`] as of the shading point, and for a part that is no number.
    pub fn checked(self) -> Result<Self, DomainError> {
        let part = |value: f32| {
            if value.is_nan() {
                let what = "a part of a transmissive point";
                Err(DomainError::number(what, value, "a number; compute it again"))
            } else {
                Ok(exact::flush(exact::clamp(value, 0.0, 1.0), LEAST_PART))
            }
        };
        Ok(Self {
            point: self.point.checked()?,
            front: part(self.front)?,
            back: part(self.back)?,
        })
    }

    /// The point seen from its other side.
    #[inline(always)]
    pub(crate) fn turned(&self) -> ShadingPoint {
        let [x, y, z] = self.point.n;
        ShadingPoint {
            p: self.point.p,
            n: [-x, -y, -z],
        }
    }
}

/// Least part that is not zero.
const LEAST_PART: f32 = exact::pow2(-20);

impl AsRef<ShadingPoint> for TransmissivePoint {
    fn as_ref(&self) -> &ShadingPoint {
        &self.point
    }
}

impl Receiver for TransmissivePoint {
    const IS_TWO_SIDED: bool = true;

    /// A map keeps what is in front in front, one that mirrors too.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        Self {
            point: instance.to_local(&self.point),
            ..*self
        }
    }

    fn is_within_reach(&self) -> bool {
        let is_part = |value: f32| (0.0..=1.0).contains(&value);
        self.point.is_within_reach() && is_part(self.front) && is_part(self.back)
    }
}
