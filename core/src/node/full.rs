//! The layout without quantisation, 56 bytes per child.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{BoundsNode, Holds, Node};
use crate::bounds::LightBounds;
use crate::exact;
use crate::importance::Cluster;
use crate::light::EmissiveTriangle;
use crate::summary::Lanes;
use crate::vector::length_squared;

// Words of a child; each is an array over the slots.
const MIN: usize = 0;
const MAX: usize = 3;
const AXIS: usize = 6;
const COS_THETA_O: usize = 9;
const COS_THETA_E: usize = 10;
const PHI: usize = 11;
const KIND: usize = 12;
const LINK: usize = 13;

/// 56 bytes per child: everything in full. The measure of what [`CompactNode`](super::CompactNode)'s quantisation
/// costs in accuracy and saves in bytes.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct FullNode<const W: usize>([[u32; W]; 14]);

const _: () = assert!(size_of::<FullNode<2>>() == 112);

impl<const W: usize> FullNode<W> {
    #[inline(always)]
    fn float(&self, field: usize, slot: usize) -> f32 {
        f32::from_bits(self.0[field][slot])
    }

    #[inline(always)]
    fn vector(&self, field: usize, slot: usize) -> Vec3 {
        Vec3::new(
            self.float(field, slot),
            self.float(field + 1, slot),
            self.float(field + 2, slot),
        )
    }

    #[inline(always)]
    fn set_vector(&mut self, field: usize, slot: usize, v: Vec3) {
        self.0[field][slot] = v.x.to_bits();
        self.0[field + 1][slot] = v.y.to_bits();
        self.0[field + 2][slot] = v.z.to_bits();
    }
}

impl<const W: usize> Holds for FullNode<W> {
    type Light = EmissiveTriangle;
}

impl<const W: usize> Node<W> for FullNode<W> {
    type Summary = LightBounds;

    const EMPTY: Self = Self([[0; W]; 14]);
    const NAME: &'static str = "full";

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.0[KIND][slot]
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.0[LINK][slot]
    }

    fn summary(&self, slot: usize) -> LightBounds {
        LightBounds {
            min: self.vector(MIN, slot),
            max: self.vector(MAX, slot),
            axis: self.vector(AXIS, slot),
            cos_theta_o: self.float(COS_THETA_O, slot),
            cos_theta_e: self.float(COS_THETA_E, slot),
            phi: self.float(PHI, slot),
        }
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        for field in 0..14 {
            self.0[field][slot] = 0;
        }
        self.0[KIND][slot] = kind;
        self.0[LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[LINK][slot] = link;
    }

    #[inline(always)]
    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        for slot in 0..W {
            let bounds: LightBounds = summaries.get(slot);
            self.set_vector(MIN, slot, bounds.min);
            self.set_vector(MAX, slot, bounds.max);
            self.set_vector(AXIS, slot, bounds.axis);
            self.0[COS_THETA_O][slot] = bounds.cos_theta_o.to_bits();
            self.0[COS_THETA_E][slot] = bounds.cos_theta_e.to_bits();
            self.0[PHI][slot] = bounds.phi.to_bits();
        }
    }
}

impl<const W: usize> BoundsNode<W> for FullNode<W> {
    #[inline(always)]
    fn cluster(&self, slot: usize) -> Cluster {
        // Halves that reach both corners from the rounded centre; 2^-20 outward covers their rounding, and boxes below
        // 2^-60 m count as that large, so that their square is a normal number.
        const OUTWARD: f32 = 1.0 + exact::pow2(-20);
        const TINY: f32 = exact::pow2(-60);
        let (min, max) = (self.vector(MIN, slot), self.vector(MAX, slot));
        let center = (min + max) * 0.5;
        let half = |low: f32, middle: f32, high: f32| {
            let h = exact::max(high - middle, middle - low) * OUTWARD;
            if h > 0.0 { exact::max(h, TINY) } else { 0.0 }
        };
        let extent = Vec3::new(
            half(min.x, center.x, max.x),
            half(min.y, center.y, max.y),
            half(min.z, center.z, max.z),
        );
        let cos_theta_o = self.float(COS_THETA_O, slot);
        let sin_squared = exact::max(1.0 - cos_theta_o * cos_theta_o, 0.0);
        let sin_theta_o = if sin_squared < TINY {
            0.0
        } else {
            sin_squared * exact::rsqrt(exact::max(sin_squared, TINY))
        };
        Cluster {
            center,
            extent,
            radius_squared: length_squared(extent),
            axis: self.vector(AXIS, slot),
            cos_theta_o,
            sin_theta_o,
            cos_theta_e: self.float(COS_THETA_E, slot),
            phi: self.float(PHI, slot),
        }
    }
}
