//! Triangles in f64, independent of the arithmetic under test.

use glam::DVec3;
use lightbvh::EmissiveTriangle;

/// A vector of the crate in f64.
pub fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}

/// A triangle in f64.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Vertices, metres.
    pub p: [DVec3; 3],
    /// (p1 − p0) × (p2 − p0), twice the area long.
    pub normal: DVec3,
    /// By how much rounding of the edges is enlarged in the direction of the normal: |e1| |e2| / |e1 × e2|.
    pub condition: f64,
}

impl Triangle {
    /// The triangle of a light.
    pub fn new(light: &EmissiveTriangle) -> Self {
        let p = light.p.map(vector);
        let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
        let normal = e1.cross(e2);
        Self {
            p,
            normal,
            condition: e1.length() * e2.length() / normal.length(),
        }
    }

    /// Area, m².
    pub fn area(&self) -> f64 {
        0.5 * self.normal.length()
    }
}

/// Whether rounding in `f32` may leave nothing of the triangle's area: it is none, or below 2^-21 of the product of two of its
/// edges. Such a light may count as one without area, and then emits nothing.
pub fn may_lose_its_area(light: &EmissiveTriangle) -> bool {
    let triangle = Triangle::new(light);
    triangle.area() == 0.0 || triangle.condition.recip() < 1.0 / 2_097_152.0
}
