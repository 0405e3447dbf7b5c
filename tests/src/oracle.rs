//! Oracles in f64, independent of the arithmetic under test: angles, cones, and which light can arrive where.

use glam::DVec3;
use lightbvh::cone::Cone;
use lightbvh::{EmissiveTriangle, ImportanceModel, LightBounds, LightBvh, LightNode, Lights, ShadingPoint};

/// A vector of the crate in f64.
#[must_use]
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
    #[must_use]
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
    #[must_use]
    pub fn area(&self) -> f64 {
        0.5 * self.normal.length()
    }
}

/// The angle between two vectors of any length, precise at every angle.
#[must_use]
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    a.cross(b).length().atan2(a.dot(b))
}

/// The half-angle of a cone, whole sphere from −1 on.
#[must_use]
pub fn half_angle(cos_theta_o: f32) -> f64 {
    f64::from(cos_theta_o).clamp(-1.0, 1.0).acos()
}

/// By how much (rad) the cone `inner` reaches out of the cone `outer`; 0 if not at all.
#[must_use]
pub fn cone_excess(outer: (DVec3, f32), inner: (DVec3, f32)) -> f64 {
    let reach = angle(outer.0, inner.0) + half_angle(inner.1);
    let reach = reach.min(std::f64::consts::PI);
    (reach - half_angle(outer.1)).max(0.0)
}

/// Whether light can arrive, by geometry alone: some of the triangle is above the point's horizon, and the point is on
/// an emitting side, both by more than `margin` of the distance.
#[must_use]
pub fn can_contribute(light: &EmissiveTriangle, point: &ShadingPoint, margin: f64) -> bool {
    let triangle = Triangle::new(light);
    let (p, n) = (vector(point.p), vector(point.n));
    let length = triangle.normal.length();
    if length == 0.0 || light.luminance() == 0.0 {
        return false;
    }
    let height = triangle.normal.dot(p - triangle.p[0]) / length;
    let height = if light.is_two_sided() {
        height.abs()
    } else {
        height
    };
    let in_front = height > margin * (triangle.p[0] - p).length();
    let above = |v: &DVec3| n.dot(*v - p) > margin * (*v - p).length();
    in_front && (n == DVec3::ZERO || triangle.p.iter().any(above))
}

/// Probability of every light at `point`.
pub fn all_pmfs<I: ImportanceModel, N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    point: &ShadingPoint,
) -> Vec<f32> {
    (0..lights.triangles().len() as u32)
        .map(|i| bvh.pmf::<I>(lights, point, i))
        .collect()
}

/// By how much a sum of pmfs may be off 1: every factor of every pmf is rounded by at most 2^-24, and adopted masses add
/// as many roundings again.
#[must_use]
pub fn sum_tolerance(depth: u32) -> f64 {
    f64::from(depth * 4 + 8) * 2f64.powi(-24)
}

/// What f64 itself may be off in an angle, rad: acos and atan2 of numbers that are exact.
const ANGLE_ERROR: f64 = 1e-12;

/// Asserts that a cone lies within another.
///
/// # Panics
/// If it does not.
pub fn assert_cone_contains(outer: Cone, inner: Cone, what: &str) {
    let pair = |cone: Cone| (cone.axis.as_dvec3(), cone.cos_theta_o);
    let excess = cone_excess(pair(outer), pair(inner));
    assert!(
        excess <= ANGLE_ERROR,
        "{what}: {inner:?} reaches {excess:e} rad out of {outer:?}"
    );
}

/// Whether a box lies within another.
#[must_use]
pub fn box_contains(outer: &LightBounds, inner: &LightBounds) -> bool {
    outer.min.cmple(inner.min).all() && inner.max.cmple(outer.max).all()
}
