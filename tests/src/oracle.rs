//! Oracles in f64, independent of the arithmetic under test: angles and cones here; which light can arrive where is shared
//! with `lightbvh stability`.

use glam::DVec3;
use lightbvh::cone::Cone;
use lightbvh::{ImportanceModel, LightBounds, LightBvh, LightNode, Lights, ShadingPoint};
pub use lightbvh_host::stability::geometry::{Triangle, can_contribute, sum_tolerance, vector};

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
