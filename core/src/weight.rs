//! The weight of a child that is known by its moments.

use glam::Vec3;

use crate::exact::{self, pow2, rsqrt_rough};
use crate::vector::{abs3, dot, greatest_exponent, length_squared, max3};

/// Least cosine that the soft ones are spread by: no light is ever quite out of sight. Its square is the ε of the tables.
pub(crate) const SOFT: f32 = 0.031_622_78;
/// Least height of a box above the horizon, for sets entirely below it.
const FLOOR: f32 = 1.0e-4;
/// Variance of all three axes in squared breadths: 1 for a flat set, 1.5 for a round one.
const FAR: f32 = 1.25;
/// Squared breadths added to the squared distance in the denominator; less than [`FAR`] had less variance.
const NEAR: f32 = 0.5;
/// Squared distance of a flat set's farthest part from its centre, in squared breadths: 2 for a disc, 3 for a row.
const NEAREST: f32 = 2.5;
/// Squared distances, in units of the scale, are at least this: about (2^-25)². It absorbs whatever devices flush.
const LEAST_DISTANCE: f32 = pow2(-50);
/// Twice the mean variance of an axis of a box, in squared half diagonals.
const TWO_NINTHS: f32 = 2.0 / 9.0;
/// Squared spreads of normals are at least this.
const LEAST_SPREAD: f32 = pow2(-18);
/// A frame this much smaller than its distance counts as this small: its square is far below LEAST_DISTANCE's part of 1.
const LEAST_FRAME: i32 = -40;

/// Shared by all children of a node at a point: one power of two makes every length about 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Origin minus point, scaled.
    pub x: Vec3,
    /// The node's unit, scaled: 2^-40 to 1.
    pub unit: f32,
    /// A metre, scaled: 2^-42 to 2^40.
    pub per_metre: f32,
}

/// The scale is the exponent of the greater of distance (of the frame's origin) and 2^`least`, which is the unit, or the size of a cell if
/// that is more. Squares of what follows then neither overflow nor underflow, and a scene scaled by a power of two gives the same bits.
#[inline(always)]
pub(crate) fn frame(origin: Vec3, unit_exponent: i32, least: i32, p: Vec3) -> Frame {
    let x = origin - p;
    let e = greatest_exponent(x, least);
    let below = unit_exponent - e;
    let bounded = if below < LEAST_FRAME { LEAST_FRAME } else { below };
    let per_metre = pow2(-e);
    Frame {
        x: x * per_metre,
        unit: pow2(bounded),
        per_metre,
    }
}

/// The receiver as the weight needs it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// Twice the normal; a zero normal, in a volume, gives all children the same factor.
    pub n: Vec3,
    /// The normal by the unit of the children's mean normals, and minus twice that unit.
    pub for_m: Vec3,
    pub m_unit: f32,
    /// [`SOFT`] and [`FLOOR`], or more where normals spread.
    soft: f32,
    floor: f32,
}

impl Side {
    /// Of normals whose mean is `n`: half their spread softens the cosine and the horizon.
    #[inline(always)]
    pub fn spread(self, n: Vec3) -> Self {
        let rest = exact::max(1.0 - length_squared(n), LEAST_SPREAD);
        let half = 0.5 * (rest * rsqrt_rough(rest));
        Self {
            soft: self.soft + half,
            floor: self.floor + half,
            ..self
        }
    }
}

/// The box of a cell as the weight needs it, lengths in units of the frame's scale.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    half: Vec3,
    /// Twice the mean variance of an axis.
    squared: f32,
    /// Twice how far it reaches along the normal.
    up: f32,
}

impl Extent {
    #[inline(always)]
    pub fn new(half: Vec3, n: Vec3) -> Self {
        let along = dot(half, abs3(n));
        Self {
            half,
            squared: TWO_NINTHS * length_squared(half) + LEAST_DISTANCE,
            up: along + along,
        }
    }
}

#[inline(always)]
pub(crate) fn side(n: Vec3, m_unit: f32) -> Side {
    Side {
        n: n + n,
        for_m: n * m_unit,
        m_unit: -2.0 * m_unit,
        soft: SOFT,
        floor: FLOOR,
    }
}

/// A child as the weight needs it, lengths in units of the frame's scale.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobe {
    pub phi: f32,
    pub x: Vec3,
    /// √2 times the deviation across the mean normal, and how much less than it the one along is: their ratio less 1.
    pub breadth: f32,
    pub less: f32,
    /// Mean normal, in units of [`Side::m_unit`].
    pub m: Vec3,
    /// √(1 − |m|²).
    pub spread: f32,
    /// Twice the height of the box above its centre, along the receiver's normal, in breadths.
    pub reach: f32,
}

/// Twice a soft max(0, cosine): `2 max(0, a) + s·cut / (2|a| + s)`. Where cut = s that is about a + √(a² + s²), without its
/// root and without its cancellation. As numerator and denominator, for one reciprocal serves both cosines and the
/// distance; `a` comes doubled.
#[inline(always)]
pub(crate) fn soft(doubled: f32, s: f32, cut: f32) -> (f32, f32) {
    let below = exact::abs(doubled) + s;
    (exact::max(doubled, 0.0) * below + s * cut, below)
}

/// [`recip_rough`](exact::recip_rough) of a positive number, whose sign need not be kept.
#[inline(always)]
pub(crate) fn recip(x: f32) -> f32 {
    let seed = f32::from_bits(0x7ef3_11c7_u32.wrapping_sub(x.to_bits()));
    seed * (2.0 - x * seed)
}

/// Φ · soft cos θ · soft cos θ' / distance², positive for any positive Φ.
#[inline(always)]
pub(crate) fn weight(l: &Lobe, side: &Side) -> f32 {
    from_nearest(l, side, l.x)
}

/// Adds the variance of a cell's points to that of the lights, and takes the distance from the nearest point of the box.
#[inline(always)]
pub(crate) fn weight_over(l: &Lobe, side: &Side, cell: &Extent) -> f32 {
    let own = l.breadth * l.breadth;
    let ratio = 1.0 + l.less;
    let across = own + cell.squared;
    let along = own * (ratio * ratio) + cell.squared;
    let inverse = rsqrt_rough(across);
    let both = Lobe {
        breadth: across * inverse,
        less: (along * rsqrt_rough(along)) * inverse - 1.0,
        reach: (l.reach * l.breadth + cell.up) * inverse,
        ..*l
    };
    from_nearest(&both, side, max3(abs3(l.x) - cell.half, Vec3::ZERO))
}

/// [`weight`], `nearest` away from the nearest receiver.
#[inline(always)]
fn from_nearest(l: &Lobe, side: &Side, nearest: Vec3) -> f32 {
    let squared = l.breadth * l.breadth;
    let d_squared = dot(l.x, l.x) + LEAST_DISTANCE;
    let near = (dot(nearest, nearest) + LEAST_DISTANCE) + NEAR * squared;
    let inverse = rsqrt_rough(d_squared + FAR * squared);
    let u = l.breadth * inverse;

    // The receiver's side. The spread along its normal is the breadth, but less where that runs along the mean normal.
    let turn = dot(side.for_m, l.m);
    let incident_spread = side.soft + u * (1.0 + l.less * (turn * turn));
    let incident = dot(side.n, l.x) * inverse;
    // The box limits the part above the horizon: a low top cuts the tail.
    let cut = exact::min(exact::max(incident + l.reach * u, side.floor), incident_spread);
    let (n1, d1) = soft(incident, incident_spread, cut);

    // The emitters' side, from the nearest part of the set: spread by its depth along its normal, and by the spread of the normals.
    let (ratio, height) = (1.0 + l.less, dot(l.m, l.x) * side.m_unit);
    let deep = l.breadth * exact::max(ratio, l.spread);
    let nearest = exact::max(d_squared - NEAREST * squared, 0.25 * (height * height));
    let inverse = rsqrt_rough((nearest + LEAST_DISTANCE) + FAR * (deep * deep));
    let depth = (l.breadth * inverse) * ratio;
    let emitted_spread = (SOFT + depth) + l.spread * (0.5 - depth);
    let emitted = height * inverse;
    let (n2, d2) = soft(emitted, emitted_spread, emitted_spread);

    (l.phi * (n1 * n2)) * recip((d1 * d2) * near)
}
