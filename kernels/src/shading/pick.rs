//! The choice of a light for a shading point.

use lightbvh::exact::pow2;
use lightbvh::{INVALID, Random64, SampledLight, ShadingPoint};

use super::grid::div;
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

/// Every light as likely as the others, as a light BVH's share of uniform choice has it.
#[derive(Clone, Copy, Debug)]
pub struct Uniform {
    /// Number of lights, below 2^31.
    pub count: u32,
}

impl PickLight for Uniform {
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        let (light, _) = random.pick(self.count);
        SampledLight {
            instance: INVALID,
            light: if self.count == 0 { NONE } else { light },
            pmf: self.pmf(point, light, INVALID),
        }
    }

    #[inline]
    fn pmf(&self, _point: &ShadingPoint, light: u32, _instance: u32) -> f32 {
        if light < self.count {
            div(1.0, self.count as i32 as f32)
        } else {
            0.0
        }
    }
}

/// The random numbers of [`Power`] count in 2^-24: the number of those that lead to a light then fits an `f32` exactly, and so
/// does the probability.
const RANDOM_BITS: u32 = 24;
/// Most lights that [`Power`] can tell apart.
pub const MAX_PICKABLE: u32 = 1 << RANDOM_BITS;

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
