//! Suns.

use bytemuck::{Pod, Zeroable};

use crate::domain::{DomainError, checked_emission};
use crate::exact;
use crate::light::record::checked_axis;
use crate::point::ShadingPoint;
use crate::vector::{dot, vector};

/// The same light from one direction, wherever a point is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DistantLight {
    /// Unit vector towards the light.
    pub direction: [f32; 3],
    /// Irradiance of a surface that faces it, W/m², linear RGB; zero or in from 2^-100 to 2^100.
    pub irradiance: [f32; 3],
}

impl DistantLight {
    /// Brings the light into the domain of this crate, or says why it cannot be: a direction whose length is not 1 up to
    /// [`NORMAL_TOLERANCE`](crate::error::NORMAL_TOLERANCE), an irradiance that is not finite, negative or out of range.
    ///
    /// # Errors
    /// [`DomainError`] of the direction or the irradiance.
    pub fn checked(mut self) -> Result<Self, DomainError> {
        self.direction = checked_axis(self.direction)?;
        self.irradiance = checked_emission("distant light", self.irradiance)?;
        Ok(self)
    }

    /// What a receiver gets where nothing is between, W/m²: irradiance times the cosine at its normal, which in a volume is 1.
    #[inline(always)]
    #[must_use]
    pub fn irradiance_at(&self, receiver: &ShadingPoint) -> [f32; 3] {
        let n = receiver.normal();
        let in_volume = (n.x == 0.0) & (n.y == 0.0) & (n.z == 0.0);
        let d = vector(&self.direction);
        let cosine = exact::flush(exact::max(dot(d, n), 0.0), exact::pow2(-24));
        let cosine = if in_volume { 1.0 } else { cosine };
        [
            self.irradiance[0] * cosine,
            self.irradiance[1] * cosine,
            self.irradiance[2] * cosine,
        ]
    }
}
