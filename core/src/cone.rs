//! Orientation cones and their union, without a single trigonometric function.
//!
//! Every angle is carried as its cosine and sine; sums of angles are products. What the union computes is the smallest
//! cone around two cones (pbrt-v4, `DirectionCone` and `Union`; Conty Estevez & Kulla 2018, Algorithm 1), widened so
//! that rounding never leaves an emitter outside.

use glam::Vec3;

use crate::exact;
use crate::vector::{dot, length_squared};

/// Angle by which a union is widened, 2^-11 rad: its sine, and 1 − cosine rounded up. Cosines of f32 near 1 resolve
/// about 2^-11.5 rad; `tests/tests/bounds.rs` checks in f64 that unions contain their parts.
const WIDEN_SIN: f32 = exact::pow2(-11);
const WIDEN_COS_DEFECT: f32 = exact::pow2(-23);

/// Below this squared sine, 2^-40, two axes count as parallel: what is left of one across the other is rounding noise.
const PARALLEL: f32 = exact::pow2(-40);
const LEAST_SINE: f32 = exact::pow2(-20);

/// Components of directions below this count as zero, so that a device that flushes subnormal numbers agrees.
const TINY: f32 = exact::pow2(-60);

/// All directions within the angle θ_o of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit axis; any unit vector when the cone is the whole sphere.
    pub axis: Vec3,
    /// cos θ_o in −1..=1; −1 is the whole sphere.
    pub cos_theta_o: f32,
}

/// sin of the angle in `[0, π]` whose cosine is given.
#[inline(always)]
#[must_use]
pub fn sine_of(cosine: f32) -> f32 {
    // In this form the differences are precise near ±1 too, where that of 1 − cos² is not.
    exact::sqrt(exact::max((1.0 - cosine) * (1.0 + cosine), 0.0))
}

/// cos(θ + δ), −1 from θ + δ = π on. `cosine` is cos θ; δ is small and given by its sine and 1 − cos δ.
#[inline(always)]
#[must_use]
pub fn widened(cosine: f32, delta_sin: f32, delta_cos_defect: f32) -> f32 {
    let sine = sine_of(cosine);
    let sum_sin = sine * (1.0 - delta_cos_defect) + cosine * delta_sin;
    let sum_cos = (cosine - cosine * delta_cos_defect) - sine * delta_sin;
    if sum_sin <= 0.0 || sum_cos < -1.0 {
        -1.0
    } else {
        sum_cos
    }
}

impl Cone {
    /// Every direction.
    pub const SPHERE: Self = Self {
        axis: Vec3::new(0.0, 0.0, 1.0),
        cos_theta_o: -1.0,
    };

    /// The smallest cone around `self` and `other`, widened by 2^-11 rad. The order of the arguments is part of the
    /// result's bits.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        // Bulbs shine everywhere: most unions high up in a tree are of spheres, and need no arithmetic.
        if self.cos_theta_o <= -1.0 {
            self
        } else if other.cos_theta_o <= -1.0 {
            other
        } else {
            self.smallest_around(other)
        }
    }

    /// [`union`](Self::union) of two cones neither of which is the whole sphere.
    #[inline(always)]
    fn smallest_around(self, other: Self) -> Self {
        let (cos_a, cos_b) = (self.cos_theta_o, other.cos_theta_o);
        let (sin_a, sin_b) = (sine_of(cos_a), sine_of(cos_b));
        let cos_d = exact::clamp(dot(self.axis, other.axis), -1.0, 1.0);
        // The part of the other axis across this one: its length is sin θ_d, precise where 1 − cos² is not. Where it is
        // short, the rounding of the first difference still lies along this axis; the second takes that away. (Without it,
        // validate found an emitter outside the cone around two opposite ones in a street's sign.)
        let first = other.axis - self.axis * cos_d;
        let across = first - self.axis * exact::flush(dot(self.axis, first), TINY);
        let sin_d_squared = exact::min(length_squared(across), 1.0);
        let parallel = sin_d_squared < PARALLEL;
        let sin_d = exact::sqrt(sin_d_squared);

        // One contains the other when θ_d + θ_other ≤ θ_own. A sum above π shows in its negative sine; near 2π it may not,
        // for rounding, but both angles are obtuse then.
        let (cos_db, sin_db) = (cos_d * cos_b - sin_d * sin_b, sin_d * cos_b + cos_d * sin_b);
        let (cos_da, sin_da) = (cos_d * cos_a - sin_d * sin_a, sin_d * cos_a + cos_d * sin_a);
        let beyond_db = sin_db < 0.0 || (cos_d < 0.0 && cos_b < 0.0);
        let beyond_da = sin_da < 0.0 || (cos_d < 0.0 && cos_a < 0.0);
        // Cosines do not tell angles near 0 and π apart, so the sine of the difference must agree: it is precise there, and
        // ambiguous only where the angles are π apart.
        let b_within_a = cos_db >= cos_a && sin_db * cos_a <= cos_db * sin_a;
        let a_within_b = cos_da >= cos_b && sin_da * cos_b <= cos_da * sin_b;
        let contains_other = !beyond_db && b_within_a;
        let contained = !beyond_da && a_within_b;

        // Half of x = θ_a + θ_d + θ_b, by the half-angle formula for the larger of cosine and sine, and from sin x for the
        // other, which the formula would lose near its zero; x beyond 2π means everything.
        let (cos_x, sin_x) = (cos_db * cos_a - sin_db * sin_a, sin_db * cos_a + cos_db * sin_a);
        let beyond_pi = beyond_db || sin_x < 0.0;
        let everything = beyond_db && sin_x >= 0.0;
        let larger = exact::sqrt(0.5 + 0.5 * exact::abs(cos_x));
        let smaller = exact::div(0.5 * exact::abs(sin_x), larger);
        let obtuse = cos_x < 0.0;
        let half = if obtuse { smaller } else { larger };
        let sin_o = if obtuse { larger } else { smaller };
        let cos_o = if beyond_pi { -half } else { half };
        // The new axis is this axis turned towards the other by θ_o − θ_a.
        let (cos_r, sin_r) = (cos_o * cos_a + sin_o * sin_a, sin_o * cos_a - cos_o * sin_a);
        let turn = sin_r * exact::recip(exact::max(sin_d, LEAST_SINE));
        let axis = Vec3::new(
            self.axis.x * cos_r + across.x * turn,
            self.axis.y * cos_r + across.y * turn,
            self.axis.z * cos_r + across.z * turn,
        );
        let turned = Self {
            axis: normalized(axis),
            cos_theta_o: cos_o,
        };

        // Parallel axes: the wider of the two, widened by θ_d; opposite axes: everything.
        let wide = if cos_a <= cos_b { self } else { other };
        let wider = Self {
            axis: wide.axis,
            cos_theta_o: widened(wide.cos_theta_o, sin_d, 1.0 - cos_d),
        };
        let chosen = if contains_other {
            self
        } else if contained {
            other
        } else if parallel && cos_d > 0.0 {
            wider
        } else if parallel || everything {
            Self::SPHERE
        } else {
            turned
        };
        Self {
            axis: chosen.axis,
            cos_theta_o: widened(chosen.cos_theta_o, WIDEN_SIN, WIDEN_COS_DEFECT),
        }
    }
}

/// `v` scaled to unit length; `v` need only be within a factor of 2^20 of it. Components below 2^-60 become +0.
#[inline(always)]
#[must_use]
pub fn normalized(v: Vec3) -> Vec3 {
    let length = exact::sqrt(exact::max(length_squared(v), 1e-30));
    Vec3::new(
        exact::flush(exact::div(v.x, length), TINY),
        exact::flush(exact::div(v.y, length), TINY),
        exact::flush(exact::div(v.z, length), TINY),
    )
}
