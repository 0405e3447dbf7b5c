//! Moments without quantisation.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::codes::{SQRT_2, spread};
use super::{Holds, MomentLayout, Node};
use crate::exact::{self, exponent, pow2};
use crate::importance::{Lobe, Math, dot_by, side, weight};
use crate::light::EmissiveTriangle;
use crate::moments::{LEAST_EXPONENT, LEAST_LENGTH, LightMoments};
use crate::summary::Lanes;
use crate::vector::abs3;

/// A node in full `f32`: 60 bytes per child and no header, for refit in place and as the measure of the packed one.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct FullMomentNode<const W: usize>([[u32; W]; 15]);

/// Breadths, in units of the scale, are at least this.
const LEAST_BREADTH: f32 = pow2(-70);
/// Half extents, in units of the scale, are at most this.
const MOST_EXTENT: f32 = pow2(40);

const FULL_LINK: usize = 13;
const FULL_KIND: usize = 14;

impl<const W: usize> FullMomentNode<W> {
    #[inline(always)]
    fn float(&self, field: usize, slot: usize) -> f32 {
        f32::from_bits(self.0[field][slot])
    }

    /// The node of these children; slots of kind 0 are empty.
    #[inline(always)]
    fn pack(sets: &Lanes<W>, kinds: &[u32; W], links: &[u32; W]) -> Self {
        let mut node = Self::EMPTY;
        for i in 0..W {
            let s: LightMoments = sets.get(i);
            let shines = (kinds[i] & 3 != 0) & (s.phi > 0.0);
            // A ratio, of numbers of about the same size: scaled, so that neither is too small to divide by.
            let e = exponent(s.across);
            let bounded = if e < LEAST_EXPONENT { LEAST_EXPONENT } else { e };
            let to_one = pow2(-bounded);
            let ratio = if s.across > 0.0 {
                exact::min(
                    exact::min(s.along, s.across + s.across)
                        * to_one
                        * exact::recip(exact::max(s.across * to_one, 0.5)),
                    2.0,
                )
            } else {
                1.0
            };
            let fields = [
                s.phi,
                s.c.x,
                s.c.y,
                s.c.z,
                s.across,
                ratio,
                s.m.x,
                s.m.y,
                s.m.z,
                spread(s.m),
                s.h.x,
                s.h.y,
                s.h.z,
            ];
            for k in 0..13 {
                node.0[k][i] = if shines { fields[k].to_bits() } else { 0 };
            }
            node.0[FULL_LINK][i] = links[i];
            node.0[FULL_KIND][i] = kinds[i] & 3;
        }
        node
    }
}

impl<const W: usize> Holds for FullMomentNode<W> {
    type Light = EmissiveTriangle;
}

impl<const W: usize> Node<W> for FullMomentNode<W> {
    type Summary = LightMoments;

    const EMPTY: Self = Self([[0; W]; 15]);
    const NAME: &'static str = "full moments";

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.0[FULL_KIND][slot] & 3
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.0[FULL_LINK][slot]
    }

    #[inline(always)]
    fn summary(&self, slot: usize) -> LightMoments {
        let vector = |field| {
            Vec3::new(
                self.float(field, slot),
                self.float(field + 1, slot),
                self.float(field + 2, slot),
            )
        };
        LightMoments {
            phi: self.float(0, slot),
            c: vector(1),
            across: self.float(4, slot),
            along: exact::flush(self.float(4, slot) * self.float(5, slot), LEAST_LENGTH),
            m: vector(6),
            h: vector(10),
        }
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        for row in 0..15 {
            self.0[row][slot] = 0;
        }
        self.0[FULL_KIND][slot] = kind & 3;
        self.0[FULL_LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[FULL_LINK][slot] = link;
    }

    #[inline(always)]
    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        let (mut kinds, mut links) = ([0; W], [0; W]);
        for slot in 0..W {
            kinds[slot] = self.kind(slot);
            links[slot] = self.link(slot);
        }
        *self = Self::pack(summaries, &kinds, &links);
    }
}

impl<const W: usize> MomentLayout<W> for FullMomentNode<W> {
    #[inline(always)]
    fn moment_weights<M: Math>(&self, p: Vec3, n: Vec3, _slack: f32) -> [f32; W] {
        // One scale for all: of the farthest or largest child with flux, and of the brightest one.
        let mut size = LEAST_EXPONENT;
        let mut greatest = 0.0;
        for i in 0..W {
            let phi = self.float(0, i);
            let x = Vec3::new(self.float(1, i), self.float(2, i), self.float(3, i)) - p;
            let a = abs3(x);
            let reach = exact::max(exact::max(exact::max(a.x, a.y), a.z), self.float(4, i));
            let e = exponent(reach);
            size = if (phi > 0.0) & (e > size) { e } else { size };
            greatest = exact::max(phi, greatest);
        }
        let to_one = pow2(-size);
        let half = exponent(greatest) / 2;
        let (first, second) = (pow2(-half), pow2(half - exponent(greatest)));
        let side = side(n, 1.0);
        let up = abs3(n) * 2.0;
        let mut weights = [0.0; W];
        for i in 0..W {
            let phi = self.float(0, i);
            // Nothing is known of where a child without flux is; a mask, since a select would become a branch.
            let offset = Vec3::new(self.float(1, i), self.float(2, i), self.float(3, i)) - p;
            // As little as a packed node knows: 2^-62 of the greatest.
            let scaled = exact::max((phi * first) * second, pow2(-62));
            let breadth = exact::max(self.float(4, i) * (to_one * SQRT_2), LEAST_BREADTH);
            let bounded = |field| exact::min(self.float(field, i) * to_one, MOST_EXTENT);
            let h = Vec3::new(bounded(10), bounded(11), bounded(12));
            let lobe = Lobe {
                phi: if phi > 0.0 { scaled } else { 0.0 },
                x: offset * f32::from_bits(to_one.to_bits() & u32::from(phi > 0.0).wrapping_neg()),
                breadth,
                less: self.float(5, i) - 1.0,
                m: Vec3::new(self.float(6, i), self.float(7, i), self.float(8, i)),
                spread: self.float(9, i),
                reach: dot_by::<M>(up, h) * M::recip(breadth),
            };
            weights[i] = weight::<M>(&lobe, &side);
        }
        weights
    }
}
