//! The choice of a light for a shading point.

use lightbvh::exact::pow2;
use lightbvh::{INVALID, Random64, SampledLight, ShadingPoint};

use super::trace::NONE;

/// A way to choose lights.
pub trait PickLight {
    /// Chooses a light for `point` by a uniformly distributed number.
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight;

    /// The probability with which [`pick`](Self::pick) returns `light` for `point`: to the bit the pmf that comes with the
    /// light when it is picked, 0 where it never is. `instance` is the light's;
    /// only a picker over instances looks at it.
    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32;

    /// For each place of `picked` the light that [`pick`](Self::pick) chooses by number `first` and so on of `count` at equal distances
    /// from `random`.
    #[cfg(not(target_arch = "spirv"))]
    fn pick_spaced(
        &self,
        point: &ShadingPoint,
        random: Random64,
        first: u32,
        count: u32,
        picked: &mut [SampledLight],
    ) {
        for (k, picked) in (first..).zip(picked) {
            *picked = self.pick(point, random.spaced(k, count));
        }
    }
}

/// Random numbers count in 2^-24 here: the number of those that lead to a light then fits an `f32` exactly, and so does
/// the probability.
const RANDOM_BITS: u32 = 24;
/// Most lights that [`Uniform`] and [`Power`] can tell apart.
pub const MAX_PICKABLE: u32 = 1 << RANDOM_BITS;

/// Every light as likely as the others, to 2^-24.
#[derive(Clone, Copy, Debug)]
pub struct Uniform {
    /// Number of lights, at most [`MAX_PICKABLE`]; those beyond it are never chosen.
    pub count: u32,
}

impl Uniform {
    /// How many lights are told apart.
    #[inline]
    fn pickable(&self) -> u32 {
        if self.count < MAX_PICKABLE {
            self.count
        } else {
            MAX_PICKABLE
        }
    }
}

impl PickLight for Uniform {
    /// Light `floor(r n / 2^24)` for the random number `r`.
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        let count = self.pickable();
        let light = multiply_shift(random.high >> (32 - RANDOM_BITS), count);
        SampledLight {
            instance: INVALID,
            light: if count == 0 { NONE } else { light },
            pmf: self.pmf(point, light, INVALID),
        }
    }

    /// Light `i` is chosen by `ceil((i+1) 2^24 / n) - ceil(i 2^24 / n)` of the `2^24` random numbers, which differs
    /// between lights by one, and the pmf says so.
    #[inline]
    fn pmf(&self, _point: &ShadingPoint, light: u32, _instance: u32) -> f32 {
        let count = self.pickable();
        // A light beyond the last is asked about as the first, whose arithmetic is in range.
        let known = light < count;
        let i = if known { light } else { 0 };
        let chances = first_random(i + 1, count).wrapping_sub(first_random(i, count));
        if known {
            chances as i32 as f32 * pow2(-24)
        } else {
            0.0
        }
    }
}

/// `floor(a b / 2^24)` for `a < 2^24`, `b <= 2^24`, in 32 bits: the product by halves of `a`.
#[inline]
fn multiply_shift(a: u32, b: u32) -> u32 {
    // a = high 2^12 + low: a b / 2^24 = (high b + low b / 2^12) / 2^12; high b and low b reach 2^36, so b is halved
    // too: b = b1 2^12 + b0.
    let (a1, a0) = (a >> 12, a & 0xfff);
    let (b1, b0) = (b >> 12, b & 0xfff);
    let middle = a1 * b0 + a0 * b1 + ((a0 * b0) >> 12);
    a1 * b1 + (middle >> 12)
}

/// The first random number that leads to light `light` of `count`: `ceil(light 2^24 / count)`.
#[inline]
fn first_random(light: u32, count: u32) -> u32 {
    // Long division, 8 bits of the quotient at a time: remainders stay below 2^24.
    let divisor = if count == 0 { 1 } else { count };
    let mut quotient = light / divisor;
    let mut remainder = light - quotient * divisor;
    for _ in 0..3 {
        let shifted = remainder << 8;
        let digit = shifted / divisor;
        remainder = shifted - digit * divisor;
        quotient = (quotient << 8) | digit;
    }
    if remainder > 0 { quotient + 1 } else { quotient }
}

/// Each light as likely as its part of the whole power, to 2^-24, and no light that emits below 2^-24.
#[derive(Clone, Copy)]
pub struct Power<'a> {
    /// Light `i` is chosen by the random numbers from `thresholds[i]` up to `thresholds[i + 1]`: one entry more than
    /// lights, from 0 to 2^24, never descending. The host's `power_thresholds` makes them.
    pub thresholds: &'a [u32],
}

impl PickLight for Power<'_> {
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        let entries = self.thresholds.len() as u32;
        let random = random.high >> (32 - RANDOM_BITS);
        let mut low = 0;
        let mut high = if entries > 1 { entries - 1 } else { 1 };
        // thresholds[low] <= random < thresholds[high]; 32 halvings end in one light, whatever the table holds.
        for _ in 0..32 {
            if high - low > 1 {
                let middle = low + ((high - low) >> 1);
                let right = self.thresholds[middle as usize] <= random;
                low = if right { middle } else { low };
                high = if right { high } else { middle };
            }
        }
        let pmf = self.pmf(point, low, INVALID);
        SampledLight {
            instance: INVALID,
            light: if pmf > 0.0 { low } else { NONE },
            pmf,
        }
    }

    #[inline]
    fn pmf(&self, _point: &ShadingPoint, light: u32, _instance: u32) -> f32 {
        let entries = self.thresholds.len() as u32;
        let mut pmf = 0.0;
        if entries > 1 && light < entries - 1 {
            let start = self.thresholds[light as usize];
            let stop = self.thresholds[light as usize + 1];
            if start < stop && stop <= MAX_PICKABLE {
                pmf = (stop - start) as i32 as f32 * pow2(-24);
            }
        }
        pmf
    }
}

/// How [`Chosen`] chooses lights.
pub mod by {
    /// [`Uniform`](super::Uniform).
    pub const UNIFORM: u32 = 0;
    /// [`Power`](super::Power).
    pub const POWER: u32 = 1;
    /// A light BVH.
    pub const TREE: u32 = 2;
}

/// One of all ways to choose lights, by a number.
#[derive(Clone, Copy)]
pub struct Chosen<'a, T> {
    /// Which: a number of [`by`].
    pub by: u32,
    /// Where it is a light BVH.
    pub tree: T,
    /// Where it is power.
    pub power: Power<'a>,
    /// Where all are alike.
    pub uniform: Uniform,
}

impl<T: PickLight> PickLight for Chosen<'_, T> {
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        if self.by == by::TREE {
            self.tree.pick(point, random)
        } else if self.by == by::POWER {
            self.power.pick(point, random)
        } else {
            self.uniform.pick(point, random)
        }
    }

    #[inline]
    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        if self.by == by::TREE {
            self.tree.pmf(point, light, instance)
        } else if self.by == by::POWER {
            self.power.pmf(point, light, instance)
        } else {
            self.uniform.pmf(point, light, instance)
        }
    }
}
