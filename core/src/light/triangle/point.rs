//! Points on triangles.

use super::EmissiveTriangle;
use super::summaries::flux;
use crate::exact;
use crate::light::point::{LightPoint, uniform_point};
use crate::vector::{abs3, greatest_exponent, max3};

impl EmissiveTriangle {
    /// A point that is uniformly distributed over the triangle, where the numbers of `uv` are over [0, 1).
    #[inline]
    #[must_use]
    pub fn point(&self, uv: [f32; 2]) -> LightPoint {
        let p0 = self.vertex(0);
        let (e1, e2) = (self.vertex(1) - p0, self.vertex(2) - p0);
        // Edges of about 1, so that no product leaves the range.
        let e = greatest_exponent(max3(abs3(e1), abs3(e2)), -127);
        let to_one = exact::pow2(-e);
        let emission = flux(e1 * to_one, e2 * to_one, e, self);
        let has_area = emission.exponent >= -100;
        let per_length = exact::div(1.0, exact::sqrt(emission.squared));
        // Twice the area is √squared · 2^exponent.
        let exponent = emission.exponent + e + e;
        let density = (per_length + per_length) * exact::pow2(-exponent);
        let p = uniform_point(p0, e1, e2, uv[0], uv[1]);
        let n = emission.normal * per_length;
        LightPoint::on_surface((p, n), has_area, density, self.flags, self.radiance)
    }
}
