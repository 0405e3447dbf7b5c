//! A receiver that also mirrors.

use bytemuck::{Pod, Zeroable};

use super::{Receiver, ShadingPoint, is_unit_or_zero};
use crate::domain::DomainError;
use crate::exact;
use crate::instance::Instance;
use crate::vector::vector;

/// Greatest exponent of a lobe.
const MAX_EXPONENT: f32 = 65_536.0;

/// A [`ShadingPoint`] and how its surface reflects towards the viewer: a diffuse part, and a lobe about the direction in which a mirror
/// would send the view. The receiver of [`Glossy`](crate::importance::Glossy).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GlossyPoint {
    /// Where, and its normal.
    pub point: ShadingPoint,
    /// Unit direction that a mirror would see the viewer's ray come from, away from the surface; zero for none.
    pub mirror: [f32; 3],
    /// Diffuse albedo, less what the lobe takes: from 0 to 1, of luminance.
    pub diffuse: f32,
    /// The part of the light that the lobe takes, from 0 to 1.
    pub specular: f32,
    /// Exponent k of the lobe (n · h)^k, h the half vector (Blinn 1977): from 1 to 2^16.
    pub exponent: f32,
}

impl GlossyPoint {
    /// Brings the point into the domain of this crate, or says why it cannot be; see [`ShadingPoint::checked`]. Reflectances and the
    /// exponent are clamped to their ranges.
    ///
    /// # Errors
    /// [`DomainError`] as of the shading point, and as of a normal for a mirror direction that is neither of length 1 nor zero, and for a
    /// reflectance or exponent that is no number.
    pub fn checked(self) -> Result<Self, DomainError> {
        let point = self.point.checked()?;
        let mirror = ShadingPoint {
            p: [0.0; 3],
            n: self.mirror,
        }
        .checked()
        .map_err(|_| {
            let what = "the mirror direction of a glossy point";
            DomainError::vector(what, self.mirror, "length 1, or zero for none; normalize it")
        })?
        .n;
        let within = |value: f32, least: f32, most: f32| {
            if value.is_nan() {
                let what = "a reflectance or exponent of a glossy point";
                Err(DomainError::number(what, value, "a number; compute it again"))
            } else {
                Ok(exact::clamp(value, least, most))
            }
        };
        Ok(Self {
            point,
            mirror,
            diffuse: within(self.diffuse, 0.0, 1.0)?,
            specular: within(self.specular, 0.0, 1.0)?,
            exponent: within(self.exponent, 1.0, MAX_EXPONENT)?,
        })
    }
}

impl AsRef<ShadingPoint> for GlossyPoint {
    fn as_ref(&self) -> &ShadingPoint {
        &self.point
    }
}

impl Receiver for GlossyPoint {
    /// The mirror direction as a difference of points: under a map that bends angles the lobe is another, which costs variance.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        let mirror = vector(&self.mirror);
        Self {
            point: instance.to_local(&self.point),
            mirror: instance.direction_to_local(mirror).to_array(),
            ..*self
        }
    }

    fn is_within_reach(&self) -> bool {
        let is_part = |value: f32| (0.0..=1.0).contains(&value);
        self.point.is_within_reach()
            && is_unit_or_zero(vector(&self.mirror))
            && is_part(self.diffuse)
            && is_part(self.specular)
            && (1.0..=MAX_EXPONENT).contains(&self.exponent)
    }
}
