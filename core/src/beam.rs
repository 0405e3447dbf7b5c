//! Limits of the light of a set: beams, ends and masks.

use glam::Vec3;

use crate::cone::{sine_of, widened};
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::vector::{abs3, dot, flush3, length_squared, vector};

/// All light of a set leaves from within `radius` of `c`, in directions within θ_e of `axis`.
///
/// θ_e is the emission angle of Conty Estevez & Kulla 2018, section 4.1, about the set's axis: θ_o + θ_e there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Unit axis; any vector where `cos_theta_e` is −1.
    pub axis: Vec3,
    /// cos θ_e: −1 where light may go anywhere, else above 0.
    pub cos_theta_e: f32,
    /// Centre of the places, metres.
    pub c: Vec3,
    /// Their greatest distance from the centre, metres.
    pub radius: f32,
}

/// Cosines below this count as none: 2^-8 is 89.8°.
const LEAST_COSINE: f32 = pow2(-8);
/// A squared length of an axis below which it has no direction.
const LEAST_AXIS: f32 = pow2(-12);
/// Margins of a sum of angles: subtracted from the cosine; added to the angle.
const COSINE_SLACK: f32 = pow2(-21);
const WIDEN_SIN: f32 = pow2(-11);
const WIDEN_COS_DEFECT: f32 = pow2(-23);
/// Lengths below this part of a unit count as zero, squared.
const LEAST_SQUARE: f32 = pow2(-60);
/// Factor by which radii are rounded up: more than the error of the lengths in them.
const LONGER: f32 = 1.001;
/// Relative rounding error of coordinates, that of a map included.
const ROUNDING: f32 = pow2(-21);
/// Factor on [`ROUNDING`] if the map moves a place much nearer to the origin: three products cancel.
const BROUGHT_BACK: f32 = 4.0;
/// The same if the place was at least twice as far away.
const TWICE_BROUGHT_BACK: f32 = 8.0;
/// Rounding of lengths in units.
const LEAST_RADIUS: f32 = pow2(-18);
/// How far from a similarity a map may be and count as one, in squared lengths of about 1.
const UNEVEN: f32 = pow2(-14);

/// An axis of any length up to 1 at length 1, and whether it has a direction at all.
#[inline(always)]
fn unit_axis(axis: Vec3) -> (Vec3, bool) {
    let axis = flush3(axis, pow2(-30));
    let squared = length_squared(axis);
    let has_axis = squared > LEAST_AXIS;
    (
        axis * exact::rsqrt(if has_axis { squared } else { 1.0 }),
        has_axis,
    )
}

impl Beam {
    /// Light that may go anywhere.
    pub const ANYWHERE: Self = Self {
        axis: Vec3::new(0.0, 0.0, 0.0),
        cos_theta_e: -1.0,
        c: Vec3::new(0.0, 0.0, 0.0),
        radius: 0.0,
    };

    /// Whether it says anything.
    #[inline(always)]
    #[must_use]
    pub fn is_narrow(&self) -> bool {
        self.cos_theta_e > 0.0
    }

    /// The cosine of the least angle about the direction of `axis`, of any length up to 1, that holds all directions; −1 where that is
    /// 90° or about that. Rounded down.
    #[inline(always)]
    pub(crate) fn cosine_about(&self, axis: Vec3) -> f32 {
        let (unit, has_axis) = unit_axis(axis);
        let cos_d = exact::clamp(dot(unit, self.axis), -1.0, 1.0);
        // In this form the sine is precise for small angles too.
        let across = flush3(self.axis - unit * cos_d, pow2(-30));
        let sin_d = exact::sqrt(exact::min(length_squared(across), 1.0));
        let cosine = widened(
            exact::clamp(self.cos_theta_e, 0.0, 1.0),
            WIDEN_SIN,
            WIDEN_COS_DEFECT,
        );
        let sum = cos_d * cosine - sin_d * sine_of(cosine) - COSINE_SLACK;
        // Both angles are below 90° where the sum is.
        if has_axis & self.is_narrow() & (sum > LEAST_COSINE) {
            sum
        } else {
            -1.0
        }
    }

    /// The greatest distance of its places from `c`, in units of which one is 1/`per_unit` metres, rounded up. All lengths are at most some of
    /// them. The walk adds the rounding of `c`.
    #[inline(always)]
    pub(crate) fn radius_about(&self, c: Vec3, per_unit: f32) -> f32 {
        let away = flush3((self.c - c) * per_unit, pow2(-30));
        let apart = exact::sqrt(exact::flush(length_squared(away), LEAST_SQUARE));
        (apart + self.radius * per_unit) * LONGER + LEAST_RADIUS
    }

    /// The beam in the world; [`ANYWHERE`](Self::ANYWHERE) if the map is not a similarity, for such maps change angles.
    ///
    /// The radius grows if the map moves the place much nearer to the origin. The walk allows for other rounding.
    #[inline(always)]
    pub(crate) fn to_world(self, instance: &Instance) -> Self {
        if self.is_narrow() & instance.is_even() {
            let c = instance.vertex([self.c.x, self.c.y, self.c.z]);
            let c = vector(&c);
            let radius = self.radius * (instance.scale() * LONGER) + brought_back(instance, c);
            Self {
                axis: instance.direction_to_world(self.axis),
                cos_theta_e: self.cos_theta_e,
                c,
                radius: exact::flush(radius, pow2(-100)),
            }
        } else {
            Self::ANYWHERE
        }
    }
}

/// A beam around others, about an axis and a centre that are given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Union {
    whole: Beam,
    unit_exponent: i32,
}

impl Union {
    /// Around none. Lengths are computed in units of two to `unit_exponent` metres.
    #[inline(always)]
    pub fn about(axis: Vec3, c: Vec3, unit_exponent: i32) -> Self {
        let (unit, has_axis) = unit_axis(axis);
        let whole = Beam {
            axis: unit,
            cos_theta_e: if has_axis { 1.0 } else { -1.0 },
            c,
            radius: 0.0,
        };
        Self { whole, unit_exponent }
    }

    /// Takes `beam` in.
    #[inline(always)]
    pub fn add(&mut self, beam: &Beam) {
        let cosine = beam.cosine_about(self.whole.axis);
        let radius = beam.radius_about(self.whole.c, pow2(-self.unit_exponent));
        let own = &mut self.whole;
        own.cos_theta_e = exact::min(own.cos_theta_e, cosine);
        own.radius = exact::max(own.radius, radius);
    }

    #[inline(always)]
    pub fn beam(&self) -> Beam {
        let radius = exact::flush(self.whole.radius * pow2(self.unit_exponent), pow2(-100));
        if self.whole.is_narrow() {
            Beam { radius, ..self.whole }
        } else {
            Beam::ANYWHERE
        }
    }
}

/// Greatest error of a place that a map brings back from far away to `c`, metres.
#[inline(always)]
fn brought_back(instance: &Instance, c: Vec3) -> f32 {
    let off = rounding_at(instance.origin()) * BROUGHT_BACK;
    if off > rounding_at(c) * TWICE_BROUGHT_BACK {
        off
    } else {
        0.0
    }
}

/// Limits of a set's light: its receivers, its directions, and its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The union of the masks of its lights that have flux.
    pub mask: u32,
    /// Where their light goes.
    pub beam: Beam,
    /// The light ends at this distance from the set's box, metres; [`ENDLESS`](Self::ENDLESS) if there is none.
    pub end: f32,
}

impl Limits {
    /// Of no light at all.
    pub const NONE: Self = Self {
        mask: 0,
        beam: Beam::ANYWHERE,
        end: Self::ENDLESS,
    };

    /// The end of light that arrives anywhere, metres: beyond all lengths of this crate.
    pub const ENDLESS: f32 = pow2(63);

    /// The limits in the world. `c`: centre of the set. If the map is not a similarity only the mask stays.
    #[inline(always)]
    pub(crate) fn to_world(self, instance: &Instance, c: Vec3) -> Self {
        // Ranges do not grow with a map.
        let has_end = (self.end < Self::ENDLESS) & instance.is_even();
        Self {
            mask: self.mask,
            beam: self.beam.to_world(instance),
            end: if has_end {
                self.end + brought_back(instance, c)
            } else {
                Self::ENDLESS
            },
        }
    }
}

/// The space of a node: the world, or the space of an instance's mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    /// Greatest error of a light's place by rounding in the world, metres of this space: 2^-21 of the instance's greatest coordinate.
    /// −1 where the map is no similarity within 2^-14: beams do not count there, for angles differ.
    pub slack: f32,
    /// Metres of this space in a metre of the world, rounded up: ranges are lengths of the world.
    pub per_metre: f32,
}

impl Space {
    /// The world itself.
    pub const WORLD: Self = Self {
        slack: 0.0,
        per_metre: 1.0,
    };
}

/// Greatest rounding error of a point at `p` and of a light near it, metres.
#[inline(always)]
pub(crate) fn rounding_at(p: Vec3) -> f32 {
    let a = abs3(p);
    exact::max(exact::max(a.x, a.y), a.z) * ROUNDING
}

impl Instance {
    /// The squared length of its first column over four to some power, and that power; zero where its map is no similarity, within 2^-14.
    #[inline(always)]
    fn even_square(&self) -> (f32, i32) {
        let ([a, b, c], e) = self.columns_of_one();
        let (aa, bb, cc) = (dot(a, a), dot(b, b), dot(c, c));
        let (ab, bc, ca) = (dot(a, b), dot(b, c), dot(c, a));
        let most = UNEVEN * aa;
        let near = |x: f32| exact::abs(x) <= most;
        let is_even = near(aa - bb) & near(aa - cc) & near(ab) & near(bc) & near(ca);
        (if is_even { aa } else { 0.0 }, e)
    }

    /// Whether its map keeps angles: a similarity, within 2^-14.
    #[inline(always)]
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.even_square().0 > 0.0
    }

    /// The space of its mesh, for [`ImportanceModel::weights_in`](crate::ImportanceModel::weights_in).
    #[inline(always)]
    #[must_use]
    pub fn space(&self) -> Space {
        let (squared, e) = self.even_square();
        let is_even = squared > 0.0;
        let length = exact::sqrt(if is_even { squared } else { 1.0 });
        let away = exact::div(rounding_at(self.origin()), length);
        let slack = exact::flush(away * pow2(-e), pow2(-100));
        Space {
            slack: if is_even { slack } else { -1.0 },
            per_metre: exact::div(LONGER, length) * pow2(-e),
        }
    }
}

#[cfg(test)]
mod tests;
