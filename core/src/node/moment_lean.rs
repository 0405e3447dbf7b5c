//! Moments without box and with one deviation, 16 bytes per child and a frame.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::codes::{
    EXTENT_RANGE, PHI_MASK, PHI_SHIFT, SPREAD_UNIT, SQRT_HALF, WORD_UNIT, breadth_code, breadth_value, field,
    fraction, frame_of, phi_code, phi_value, spread_code,
};
use super::{Holds, MomentLayout, Node};
use crate::exact::pow2;
use crate::importance::{Lobe, Math, frame, side, weight};
use crate::light::EmissiveTriangle;
use crate::moments::LightMoments;
use crate::summary::Lanes;

const WORD_0: usize = 1;
const WORD_1: usize = 2;
const WORD_2: usize = 3;
/// A node of 16 bytes per child and a header of as much as one word of each: no box, one deviation. `W` is at least 4.
///
/// | word | content |
/// |---|---|
/// | header | as of [`MomentNode`](super::MomentNode) |
/// | 0 | centre x 15, y 15, kind 2 |
/// | 1 | centre z 14, breadth 7, flux 11 |
/// | 2 | mean normal 3 × 8, spread of normals 8 |
/// | 3 | link |
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct LeanMomentNode<const W: usize>([[u32; W]; 5]);

const LEAN_LINK: usize = 4;
/// A lean breadth code in place: 5 bits of exponent, 2 of significand.
const LEAN_MASK: u32 = 0x7f << 21;

impl<const W: usize> LeanMomentNode<W> {
    #[inline(always)]
    fn origin(&self) -> Vec3 {
        Vec3::new(
            f32::from_bits(self.0[0][0]),
            f32::from_bits(self.0[0][1]),
            f32::from_bits(self.0[0][2]),
        )
    }

    /// The node of these children; slots of kind 0 are empty.
    #[inline(always)]
    fn pack(sets: &Lanes<W>, kinds: &[u32; W], links: &[u32; W]) -> Self {
        let mut node = Self::EMPTY;
        let frame = frame_of(sets);
        node.0[0][0] = frame.origin.x.to_bits();
        node.0[0][1] = frame.origin.y.to_bits();
        node.0[0][2] = frame.origin.z.to_bits();
        node.0[0][3] = (frame.unit_exponent + 127) as u32 | (((frame.phi_exponent + 127) as u32) << 8);
        for i in 0..W {
            let s: LightMoments = sets.get(i);
            let c = (s.c - frame.origin) * pow2(-frame.unit_exponent);
            // Of the eight bits of a breadth the last is rounded away.
            let fine = breadth_code(lean_deviation(&s), pow2(-frame.unit_exponent)) + 1;
            let code = if fine > 255 { 127 } else { fine >> 1 };
            let w1 = phi_code(s.phi, frame.phi_exponent) | (code << 11);
            let w1 = field(c.z, 0, 14, w1);
            let w0 = field(c.y, 15, 15, kinds[i] & 3);
            let w0 = field(c.x, 0, 15, w0);
            let w2 = field(s.m.z, 16, 8, spread_code(s.m));
            let w2 = field(s.m.y, 8, 8, w2);
            let w2 = field(s.m.x, 0, 8, w2);
            let used = (kinds[i] & 3 != 0) & (s.phi > 0.0);
            node.0[WORD_0][i] = if used { w0 } else { kinds[i] & 3 };
            node.0[WORD_1][i] = if used { w1 } else { 0 };
            node.0[WORD_2][i] = if used { w2 } else { 0 };
            node.0[LEAN_LINK][i] = links[i];
        }
        node
    }
}

impl<const W: usize> Holds for LeanMomentNode<W> {
    type Light = EmissiveTriangle;
}

impl<const W: usize> Node<W> for LeanMomentNode<W> {
    type Summary = LightMoments;

    const EMPTY: Self = {
        assert!(
            W >= 4,
            "the header of a packed node takes four words: it has 4 to 16 children"
        );
        Self([[0; W]; 5])
    };
    const NAME: &'static str = "lean moments";

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.0[WORD_0][slot] & 3
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.0[LEAN_LINK][slot]
    }

    #[inline(always)]
    fn summary(&self, slot: usize) -> LightMoments {
        let (w0, w1, w2) = (self.0[WORD_0][slot], self.0[WORD_1][slot], self.0[WORD_2][slot]);
        let unit = pow2((self.0[0][3] & 255) as i32 - 127);
        let across = breadth_value(((w1 >> 11) & 127) << 1) * (unit * SQRT_HALF);
        let h = 3.0 * across;
        LightMoments {
            phi: phi_value(w1 & PHI_MASK, ((self.0[0][3] >> 8) & 255) as i32 - 127),
            c: self.origin()
                + Vec3::new(fraction(w0, 0), fraction(w0, 15), fraction(w1, 0)) * (unit * WORD_UNIT),
            across,
            along: across,
            m: Vec3::new(fraction(w2, 0), fraction(w2, 8), fraction(w2, 16)) * WORD_UNIT,
            h: Vec3::new(h, h, h),
        }
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        for row in 1..5 {
            self.0[row][slot] = 0;
        }
        self.0[WORD_0][slot] = kind & 3;
        self.0[LEAN_LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[LEAN_LINK][slot] = link;
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

impl<const W: usize> MomentLayout<W> for LeanMomentNode<W> {
    #[inline(always)]
    fn moment_weights<M: Math>(&self, p: Vec3, n: Vec3, _slack: f32) -> [f32; W] {
        let frame = frame(self.origin(), (self.0[0][3] & 255) as i32 - 127, p);
        let side = side(n, WORD_UNIT);
        let word_unit = frame.unit * WORD_UNIT;
        let breadth_bias = frame.breadth_bias();
        let mut weights = [0.0; W];
        for i in 0..W {
            let (w0, w1, w2) = (self.0[WORD_0][i], self.0[WORD_1][i], self.0[WORD_2][i]);
            let lobe = Lobe {
                phi: f32::from_bits((w1 & PHI_MASK) << PHI_SHIFT),
                x: Vec3::new(
                    M::add_product(frame.x.x, fraction(w0, 0), word_unit),
                    M::add_product(frame.x.y, fraction(w0, 15), word_unit),
                    M::add_product(frame.x.z, fraction(w1, 0), word_unit),
                ),
                breadth: f32::from_bits(((w1 << 10) & LEAN_MASK).wrapping_add(breadth_bias)),
                less: 0.0,
                m: Vec3::new(fraction(w2, 0), fraction(w2, 8), fraction(w2, 16)),
                spread: (w2 & 255) as i32 as f32 * SPREAD_UNIT,
                // As high as a box may be: only a narrow set below the horizon is cut.
                reach: EXTENT_RANGE,
            };
            weights[i] = weight::<M>(&lobe, &side);
        }
        weights
    }
}

/// The one deviation, per axis, of a set: between those across and along.
#[inline(always)]
fn lean_deviation(s: &LightMoments) -> f32 {
    // Of (2a² + b²)/3 the root, to a few per cent.
    s.across * 0.75 + s.along * 0.25
}
