//! Bounds as what a node knows of a child.

use glam::Vec3;

use super::{Lanes, SUMMARY_WORDS, Summary};
use crate::bounds::LightBounds;
use crate::exact::pow2;
use crate::instance::Instance;
use crate::light::{Light, LightSlots};
use crate::vector::{flush3, length_squared};

/// A constant of its own: rust-gpu does not fold an expression of literals.
const TWELFTH: f32 = 1.0 / 12.0;

impl Summary for LightBounds {
    const EMPTY: Self = Self::EMPTY;

    #[inline(always)]
    fn of_light<L: Light>(light: &L) -> Self {
        light.bounds()
    }

    #[inline(always)]
    fn of_lights<L: Light, const W: usize>(lights: &L::Slots<W>, summaries: &mut Lanes<W>) {
        for slot in 0..W {
            if lights.present(slot) != 0 {
                summaries.set(slot, &lights.get(slot).bounds());
            } else {
                summaries.set(slot, &Self::EMPTY);
            }
        }
    }

    /// In slot order: the cone around cones depends on the order.
    #[inline(always)]
    fn merged<const W: usize>(children: &Lanes<W>) -> Self {
        let mut merged = Self::EMPTY;
        for slot in 0..W {
            merged = merged.merge(&children.get(slot));
        }
        merged
    }

    #[inline(always)]
    fn to_world(&self, instance: &Instance) -> Self {
        instance.bounds_to_world(self)
    }

    #[inline(always)]
    fn phi(&self) -> f32 {
        self.phi
    }

    #[inline(always)]
    fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }

    /// That of points spread evenly over the box, of extents below 2^-60 m none.
    #[inline(always)]
    fn spread(&self) -> f32 {
        let extent = flush3(self.max - self.min, pow2(-60));
        length_squared(extent) * TWELFTH
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        *self
    }

    #[inline(always)]
    fn to_words(&self) -> [f32; SUMMARY_WORDS] {
        let (lo, hi, a) = (self.min, self.max, self.axis);
        [
            lo.x,
            lo.y,
            lo.z,
            hi.x,
            hi.y,
            hi.z,
            a.x,
            a.y,
            a.z,
            self.cos_theta_o,
            0.0,
            self.phi,
        ]
    }

    #[inline(always)]
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self {
        Self {
            min: Vec3::new(words[0], words[1], words[2]),
            max: Vec3::new(words[3], words[4], words[5]),
            axis: Vec3::new(words[6], words[7], words[8]),
            cos_theta_o: words[9],
            phi: words[11],
        }
    }
}
