//! The layout of 28 bytes per child.

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{BoundsNode, Cluster, Holds, Node};
use crate::bounds::LightBounds;
use crate::cone::{normalized, widened};
use crate::exact::{self, exponent, pow2};
use crate::light::{EmissiveTriangle, Light};
use crate::summary::Lanes;
use crate::vector::{flush3, length_squared, max3};

// Words of a child; each is an array over the slots.
const CENTER_X: usize = 0;
const CENTER_Y: usize = 1;
const CENTER_Z: usize = 2;
/// Half extents of the box: 8 bits of exponent as in an f32, then 3 × 8 bits in units of that power of two.
const EXTENT: usize = 3;
/// Axis as 3 × 10 bits, then 2 bits of kind.
const AXIS_KIND: usize = 4;
/// Flux as the upper 24 bits of an f32 without its sign, then 8 bits of cone.
const PHI_CONE: usize = 5;
const LINK: usize = 6;

/// Units of the half extents are 2^(stored − 127), so that the stored exponent is that of an f32.
const UNIT_BIAS: i32 = 127;
/// Least unit that importance computes with: its square is a normal number.
const LEAST_UNIT: f32 = pow2(-60);
/// Least exponent of the greatest half extent: boxes below 2^-100 m are rounded up to it.
const MIN_EXTENT_EXPONENT: i32 = -100;
/// An axis component is stored in units of 1/511.
const AXIS_UNIT: f32 = 1.0 / 511.0;
/// Length of the axis before it is quantised: what remains after the greatest error of quantisation is never above 1.
/// An axis too long would make a point behind an emitter seem farther behind than it is, and a root of 1 − cos² there
/// turns an error of 2^-9 into one of 2^-4; too short is the safe side.
const AXIS_LENGTH: f32 = 0.9983;
/// sin(θ_o/2) is stored in units of 1/254; 255 is the whole sphere, and counts as 1.
const CONE_UNIT: f32 = 1.0 / 254.0;
const CONE_SPHERE: u32 = 255;
/// Widening that covers the axis's quantisation: each component is off by at most half a unit, so the axis by at most
/// √3/2/511 = 0.0016949 in length, and by no more than 2^-9 rad in angle.
const AXIS_ERROR_SIN: f32 = pow2(-9);
const AXIS_ERROR_COS_DEFECT: f32 = pow2(-19);

/// 28 bytes per child: box centre in full, half extents in a shared exponent, axis, cone and flux quantised outward.
/// Lights are diffuse emitters: they reach up to 90° from a normal.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct CompactNode<const W: usize, L = EmissiveTriangle>([[u32; W]; 7], PhantomData<L>);

const _: () = assert!(size_of::<CompactNode<2>>() == 56);

impl<const W: usize, L> CompactNode<W, L> {
    #[inline(always)]
    fn float(&self, field: usize, slot: usize) -> f32 {
        f32::from_bits(self.0[field][slot])
    }

    #[inline(always)]
    fn center(&self, slot: usize) -> Vec3 {
        Vec3::new(
            self.float(CENTER_X, slot),
            self.float(CENTER_Y, slot),
            self.float(CENTER_Z, slot),
        )
    }

    /// The stored axis, of length 0.9966 to 1.
    #[inline(always)]
    fn axis(&self, slot: usize) -> Vec3 {
        let word = self.0[AXIS_KIND][slot];
        let component = |shift: u32| ((((word >> shift) & 1023) as i32) - 511) as f32 * AXIS_UNIT;
        Vec3::new(component(22), component(12), component(2))
    }

    #[inline(always)]
    fn phi(&self, slot: usize) -> f32 {
        f32::from_bits((self.0[PHI_CONE][slot] & 0xffff_ff00) >> 1)
    }

    /// (cos θ_o, sin(θ_o/2)).
    #[inline(always)]
    fn cone(&self, slot: usize) -> (f32, f32) {
        let code = self.0[PHI_CONE][slot] & 0xff;
        let half_sine = exact::min(code as i32 as f32 * CONE_UNIT, 1.0);
        (1.0 - 2.0 * (half_sine * half_sine), half_sine)
    }

    /// Half extents of the box in units, and the unit.
    #[inline(always)]
    fn half_extents(&self, slot: usize) -> (Vec3, f32) {
        let word = self.0[EXTENT][slot];
        let half = Vec3::new(
            ((word >> 16) & 255) as i32 as f32,
            ((word >> 8) & 255) as i32 as f32,
            (word & 255) as i32 as f32,
        );
        (half, f32::from_bits((word >> 1) & 0x7f80_0000))
    }
}

impl<const W: usize, L: Light> Holds for CompactNode<W, L> {
    type Light = L;
}

impl<const W: usize, L: Light> Node<W> for CompactNode<W, L> {
    type Summary = LightBounds;

    const EMPTY: Self = Self([[0; W]; 7], PhantomData);
    const NAME: &'static str = "compact";

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.0[AXIS_KIND][slot] & 3
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.0[LINK][slot]
    }

    #[inline(always)]
    fn summary(&self, slot: usize) -> LightBounds {
        let (half_units, unit) = self.half_extents(slot);
        let half = half_units * unit;
        let center = self.center(slot);
        LightBounds {
            min: center - half,
            max: center + half,
            axis: normalized(self.axis(slot)),
            cos_theta_o: self.cone(slot).0,
            phi: self.phi(slot),
        }
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        for field in 0..7 {
            self.0[field][slot] = 0;
        }
        self.0[AXIS_KIND][slot] = kind & 3;
        self.0[LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[LINK][slot] = link;
    }

    #[inline(always)]
    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        for slot in 0..W {
            let bounds: LightBounds = summaries.get(slot);
            let (center, extent) = pack_box(bounds.min, bounds.max);
            self.0[CENTER_X][slot] = center.x.to_bits();
            self.0[CENTER_Y][slot] = center.y.to_bits();
            self.0[CENTER_Z][slot] = center.z.to_bits();
            self.0[EXTENT][slot] = extent;
            self.0[AXIS_KIND][slot] = pack_axis(bounds.axis) | (self.0[AXIS_KIND][slot] & 3);
            self.0[PHI_CONE][slot] = pack_phi(bounds.phi) | pack_cone(bounds.cos_theta_o);
        }
    }
}

impl<const W: usize, L: Light> BoundsNode<W> for CompactNode<W, L> {
    #[inline(always)]
    fn cluster(&self, slot: usize) -> Cluster {
        let (half, stored_unit) = self.half_extents(slot);
        let unit = exact::max(stored_unit, LEAST_UNIT);
        let (cos_theta_o, half_sine) = self.cone(slot);
        // sin θ = 2 sin(θ/2) cos(θ/2). The bound below keeps the root's argument normal; it leaves a sphere's sine at
        // 2e-6, which no sign hangs on.
        let half_cosine_squared = exact::max(1.0 - half_sine * half_sine, 1e-12);
        let half_cosine = half_cosine_squared * exact::rsqrt_rough(half_cosine_squared);
        Cluster {
            center: self.center(slot),
            extent: half * unit,
            // The sum of squares is an integer below 2^18, so exact.
            radius_squared: length_squared(half) * (unit * unit),
            axis: self.axis(slot),
            cos_theta_o,
            sin_theta_o: 2.0 * (half_sine * half_cosine),
            phi: self.phi(slot),
        }
    }
}

/// Centre, and the word of half extents that reach both corners from it.
#[inline(always)]
fn pack_box(min: Vec3, max: Vec3) -> (Vec3, u32) {
    let center = flush3((min + max) * 0.5, crate::light::MIN_COORDINATE);
    // The rounded difference is short of the true one by at most 2^-24 of it; 2^-20 more than makes up for that.
    const OUTWARD: f32 = 1.0 + pow2(-20);
    let h = max3(max - center, center - min) * OUTWARD;
    let greatest = exact::max(h.x, exact::max(h.y, h.z));
    let e = exponent(greatest);
    let bounded = if e < MIN_EXTENT_EXPONENT {
        MIN_EXTENT_EXPONENT
    } else {
        e
    };
    // Seven bits below the greatest's exponent fill eight bits, unless rounding up carries into a ninth.
    let carries = ceil_u32(greatest * pow2(7 - bounded)) > 255;
    let unit_exponent = if carries { bounded - 6 } else { bounded - 7 };
    let per_unit = pow2(-unit_exponent);
    let units = |h: f32| {
        // A product that a device flushes to zero still takes one unit, if it was of anything.
        let up = ceil_u32(h * per_unit);
        if up == 0 && h > 0.0 { 1 } else { up }
    };
    let word =
        (((unit_exponent + UNIT_BIAS) as u32) << 24) | (units(h.x) << 16) | (units(h.y) << 8) | units(h.z);
    (center, if greatest > 0.0 { word } else { 0 })
}

/// Each component, a little shortened, to the nearest 1/511.
#[inline(always)]
fn pack_axis(axis: Vec3) -> u32 {
    let component = |a: f32| exact::floor_small(exact::clamp(a, -1.0, 1.0) * (511.0 * AXIS_LENGTH) + 511.5);
    (component(axis.x) << 22) | (component(axis.y) << 12) | (component(axis.z) << 2)
}

/// The upper 24 of the 31 bits below the sign, rounded up.
#[inline(always)]
fn pack_phi(phi: f32) -> u32 {
    ((phi.to_bits() << 1).wrapping_add(0xff)) & 0xffff_ff00
}

/// Code of the smallest stored cone around the cone, axis error included.
#[inline(always)]
fn pack_cone(cos_theta_o: f32) -> u32 {
    let wide = widened(cos_theta_o, AXIS_ERROR_SIN, AXIS_ERROR_COS_DEFECT);
    let half_sine = exact::sqrt(exact::clamp(0.5 - 0.5 * wide, 0.0, 1.0));
    // 2^-20 more than covers the rounding of the decoded product.
    let code = ceil_u32(half_sine * 254.0 + 2.5e-4);
    if wide <= -0.9999 || code > 254 {
        CONE_SPHERE
    } else {
        code
    }
}

/// Least integer not below `x`, for `x` in `[0, 2^22)`; any other from malformed words.
#[inline(always)]
fn ceil_u32(x: f32) -> u32 {
    let down = exact::floor_small(x);
    let up = (down as i32 as f32) < x;
    if up { down.wrapping_add(1) } else { down }
}
