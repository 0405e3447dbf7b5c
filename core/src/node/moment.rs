//! The default layout: quantised moments, 24 bytes per child; the same for lights that shine from both sides, 20 bytes; with beams,
//! 32 bytes; with beams and masks, 36 bytes.

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::beam_row::{Near, OUTSIDE, beam_factor, beam_of, beam_word, end_word};
use super::codes::{
    BREADTH_MASK, BREADTH_SHIFT, EXTENT_RANGE, PER_EXTENT_RANGE, PHI_MASK, PHI_SHIFT, SPREAD_UNIT, SQRT_2,
    SQRT_HALF, WORD_UNIT, breadth_bias, breadth_code, breadth_value, field, fraction, frame_of, phi_code,
    phi_value, spread_code,
};
use super::{Holds, MomentLayout, Node};
use crate::beam::{Beam, Limits, Space, Union};
use crate::exact::{self, pow2};
use crate::light::{EmissiveTriangle, Light};
use crate::moments::{Frame, Framed, LEAST_LENGTH, LightMoments, row};
use crate::summary::{Lanes, SUMMARY_WORDS};
use crate::unroll::each;
use crate::vector::{abs3, dot, flush3, greatest_exponent};
use crate::weight::{Extent, Lobe, frame, side, weight, weight_over};

/// Words of a node: row 0 is the header (origin x, y, z, exponents), the others hold a word of each child. After the first ones come its
/// box and its link; a row of normals stands before them, two rows of beams and one of masks after them, where there are any.
const WORD_0: usize = 1;
const WORD_1: usize = 2;
const WORD_2: usize = 3;
/// Rows with normals, without, with normals and beams, and with normals, beams, and masks.
const ORIENTED: usize = 6;
const TWO_SIDED: usize = 5;
const SPOT: usize = ORIENTED + 2;
const LINKED_SPOT: usize = SPOT + 1;
/// Word of a mean normal of zero: fields nearest to zero, greatest spread.
const NO_NORMAL: u32 = !0;

/// √2 breadths as a deviation, and the range of half extents, in units of the words.
const PER_SQRT_2: f32 = SQRT_HALF * pow2(31);
const WORD_RANGE: f32 = EXTENT_RANGE * pow2(31);

/// The default node, of 24 bytes per child, over lights `L`.
///
/// `Bvh<(MomentNode<8, PointLight>, Defensive<Moments, 6>)>` is `LightBvh` over points. [`crate::light`] says what instances
/// that scale make of flux.
pub type MomentNode<const W: usize, L = EmissiveTriangle> = PackedMomentNode<W, ORIENTED, L>;

/// A node of 20 bytes per child for scenes whose lights all shine from both sides: the mean normals of [`MomentNode`] are then zero, and
/// its row of them is one constant. This node leaves that row out. All other words, all weights and all probabilities are those of
/// [`MomentNode`], to the bit.
///
/// A light that shines from one side is taken as if it shone from both with the same flux: that costs variance, never a light.
pub type TwoSidedMomentNode<const W: usize, L = EmissiveTriangle> = PackedMomentNode<W, TWO_SIDED, L>;

/// A node of 32 bytes per child for scenes with spots and ranges: the words of [`MomentNode`], a cone that holds all light of the child
/// ([`Light::beam`](crate::light::Light::beam)), and how far from its box it ends ([`Light::end`](crate::light::Light::end)).
///
/// For a point outside the child's cone or range the weight is multiplied by 2^-16. For a point in the cone it grows as the light is gathered.
/// Children without a range and without a common spot direction store nothing. Their weights are those of [`MomentNode`], to the bit.
///
/// `Bvh<(SpotMomentNode<8, SpotLight>, DefaultImportance)>` is a tree over [`SpotLight`](crate::light::SpotLight)s.
///
/// Beams and ends are ignored if the instance's map is not a similarity.
pub type SpotMomentNode<const W: usize, L = EmissiveTriangle> = PackedMomentNode<W, SPOT, L>;

/// A node of 36 bytes per child that also knows which lights a receiver may take: the words of [`SpotMomentNode`], and the union of the
/// masks of the child's instances, all bits below an instance. What [`Linked`](crate::importance::Linked) needs; any other importance
/// chooses as by [`SpotMomentNode`], to the bit.
pub type LinkedSpotMomentNode<const W: usize, L = EmissiveTriangle> = PackedMomentNode<W, LINKED_SPOT, L>;

/// The common layout of [`MomentNode`] (`ROWS` is 6), [`TwoSidedMomentNode`] (5, without word 2), [`SpotMomentNode`] (8, with beams)
/// and [`LinkedSpotMomentNode`] (9, with beams and masks), over lights `L`. `W` is at least 4.
///
/// | word | content |
/// |---|---|
/// | header | origin 3 × f32; exponent of the frame's unit + 127 (8 bits), of the greatest flux + 127 (8 bits) |
/// | 0 | centre x 15, y 15, kind 2 |
/// | 1 | centre z 15, deviation along over that across less 1: 6, flux 11 |
/// | 2 | mean normal 3 × 8, spread of normals 8 |
/// | 3 | half extents 3 × 8, breadth (√2 times the deviation across) 8 |
/// | 4 | link |
/// | 5 | beam: squared cosine 16, place of the apex 8, gain 8 |
/// | 6 | end, metres, f32; 0 without one |
/// | 7 | mask |
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct PackedMomentNode<const W: usize, const ROWS: usize, L = EmissiveTriangle>(
    [[u32; W]; ROWS],
    PhantomData<L>,
);

impl<const W: usize, const ROWS: usize, L> PackedMomentNode<W, ROWS, L> {
    const BEAMS: bool = ROWS >= SPOT;
    const WORD_3: usize = if ROWS == TWO_SIDED { WORD_2 } else { WORD_2 + 1 };
    const LINK: usize = Self::WORD_3 + 1;
    /// The last row, which is that of masks where there is one.
    const MASK: usize = ROWS - 1;
    /// The rows of beams, where there are any.
    const BEAM: usize = if Self::BEAMS { Self::LINK + 1 } else { Self::LINK };
    const END: usize = if Self::BEAMS { Self::LINK + 2 } else { Self::LINK };

    /// Word 2 of a child with flux; where no normals are stored, that of none.
    #[inline(always)]
    fn normal_word(&self, slot: usize) -> u32 {
        if ROWS != TWO_SIDED {
            self.0[WORD_2][slot]
        } else {
            NO_NORMAL
        }
    }

    #[inline(always)]
    fn origin(&self) -> Vec3 {
        Vec3::new(
            f32::from_bits(self.0[0][0]),
            f32::from_bits(self.0[0][1]),
            f32::from_bits(self.0[0][2]),
        )
    }

    #[inline(always)]
    fn unit_exponent(&self) -> i32 {
        (self.0[0][3] & 255) as i32 - 127
    }

    #[inline(always)]
    fn phi_exponent(&self) -> i32 {
        ((self.0[0][3] >> 8) & 255) as i32 - 127
    }

    /// Packs the children; slots of kind 0 are empty.
    #[inline(always)]
    fn pack(&mut self, sets: &Lanes<W>) {
        let frame = frame_of(sets);
        self.0[0][0] = frame.origin.x.to_bits();
        self.0[0][1] = frame.origin.y.to_bits();
        self.0[0][2] = frame.origin.z.to_bits();
        self.0[0][3] = (frame.unit_exponent + 127) as u32 | (((frame.phi_exponent + 127) as u32) << 8);
        let per_unit = pow2(-frame.unit_exponent);
        each!(i, W, {
            let s: LightMoments = sets.get(i);
            let c = (s.c - frame.origin) * per_unit;
            let phi = phi_code(s.phi, frame.phi_exponent);
            let across = exact::max(s.across, 0.5 * s.along);
            let breadth = breadth_code(across, per_unit);
            let per_breadth = exact::recip(breadth_value(breadth));
            // From the low fields up: each knows what lies below it.
            let ratio = s.along * (per_unit * SQRT_2) * per_breadth;
            let w1 = field(ratio - 1.0, 15, 6, phi);
            let w1 = field(c.z, 0, 15, w1);
            let kind = self.0[WORD_0][i] & 3;
            let w0 = field(c.y, 15, 15, kind);
            let w0 = field(c.x, 0, 15, w0);
            let w2 = field(s.m.z, 16, 8, spread_code(s.m));
            let w2 = field(s.m.y, 8, 8, w2);
            let w2 = field(s.m.x, 0, 8, w2);
            let per_extent = per_breadth * PER_EXTENT_RANGE;
            let w3 = field((s.h.z * per_unit) * per_extent - 1.0, 16, 8, breadth);
            let w3 = field((s.h.y * per_unit) * per_extent - 1.0, 8, 8, w3);
            let w3 = field((s.h.x * per_unit) * per_extent - 1.0, 0, 8, w3);
            let used = exact::mask(kind) & exact::mask_of(s.phi > 0.0);
            self.0[WORD_0][i] = exact::masked_u32(used, w0, kind);
            self.0[WORD_1][i] = w1 & used;
            if ROWS != TWO_SIDED {
                self.0[WORD_2][i] = w2 & used;
            }
            self.0[Self::WORD_3][i] = w3 & used;
        });
    }

    /// The children as they are stored, in the node's own frame: the words are nearly that.
    #[inline(always)]
    fn framed(&self) -> Framed<W> {
        let mut rows = [[0.0; W]; SUMMARY_WORDS];
        each!(i, W, {
            let (w0, w1, w2, w3) = (
                self.0[WORD_0][i],
                self.0[WORD_1][i],
                self.normal_word(i),
                self.0[Self::WORD_3][i],
            );
            let used = exact::mask(w0 & 3);
            rows[row::PHI][i] = f32::from_bits(((w1 & PHI_MASK) << PHI_SHIFT) & used);
            rows[row::C][i] = fraction(w0, 0);
            rows[row::C + 1][i] = fraction(w0, 15);
            rows[row::C + 2][i] = fraction(w1, 0);
            let breadth = breadth_value(w3 & 255);
            let across = breadth * PER_SQRT_2;
            rows[row::ACROSS][i] = across;
            rows[row::ALONG][i] = across * (fraction(w1, 15) * WORD_UNIT + 1.0);
            rows[row::M][i] = fraction(w2, 0);
            rows[row::M + 1][i] = fraction(w2, 8);
            rows[row::M + 2][i] = fraction(w2, 16);
            let per_word = breadth * EXTENT_RANGE;
            let range = breadth * WORD_RANGE;
            rows[row::H][i] = fraction(w3, 0) * per_word + range;
            rows[row::H + 1][i] = fraction(w3, 8) * per_word + range;
            rows[row::H + 2][i] = fraction(w3, 16) * per_word + range;
        });
        Framed {
            frame: Frame {
                origin: self.origin(),
                unit_exponent: self.unit_exponent(),
                // Codes are flux in units of twice that power: the greatest is 1/2 to 1.
                phi_exponent: self.phi_exponent() + 1,
            },
            sets: Lanes(rows),
        }
    }
}

impl<const W: usize, const ROWS: usize, L: Light> Holds for PackedMomentNode<W, ROWS, L> {
    type Light = L;
}

impl<const W: usize, const ROWS: usize, L: Light> Node<W> for PackedMomentNode<W, ROWS, L> {
    type Summary = LightMoments;

    const EMPTY: Self = {
        assert!(
            W >= 4,
            "the header of a packed node takes four words: it has 4 to 16 children"
        );
        assert!(
            ROWS == ORIENTED || ROWS == TWO_SIDED || ROWS == SPOT || ROWS == LINKED_SPOT,
            "a packed node of moments has six rows, five without normals, eight with beams, or nine with beams and masks"
        );
        Self([[0; W]; ROWS], PhantomData)
    };
    const NAME: &'static str = match ROWS {
        TWO_SIDED => "two-sided moments",
        ORIENTED => "moments",
        SPOT => "moments with beams",
        _ => "linked moments with beams",
    };
    const HAS_MASKS: bool = ROWS == LINKED_SPOT;
    const HAS_BEAMS: bool = Self::BEAMS;

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.0[WORD_0][slot] & 3
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.0[Self::LINK][slot]
    }

    #[inline(always)]
    fn summary(&self, slot: usize) -> LightMoments {
        let (w0, w1, w2, w3) = (
            self.0[WORD_0][slot],
            self.0[WORD_1][slot],
            self.normal_word(slot),
            self.0[Self::WORD_3][slot],
        );
        let unit = pow2(self.unit_exponent());
        let per_word = unit * WORD_UNIT;
        let breadth = breadth_value(w3 & 255) * unit;
        let across = breadth * SQRT_HALF;
        let h = Vec3::new(fraction(w3, 0), fraction(w3, 8), fraction(w3, 16)) * WORD_UNIT
            + Vec3::new(1.0, 1.0, 1.0);
        LightMoments {
            phi: phi_value(w1 & PHI_MASK, self.phi_exponent()),
            c: self.origin() + Vec3::new(fraction(w0, 0), fraction(w0, 15), fraction(w1, 0)) * per_word,
            across,
            along: across * (fraction(w1, 15) * WORD_UNIT + 1.0),
            m: Vec3::new(fraction(w2, 0), fraction(w2, 8), fraction(w2, 16)) * WORD_UNIT,
            h: flush3(h * (breadth * EXTENT_RANGE), LEAST_LENGTH),
        }
    }

    #[inline(always)]
    fn mask(&self, slot: usize) -> u32 {
        if Self::HAS_MASKS {
            self.0[Self::MASK][slot]
        } else {
            u32::MAX
        }
    }

    #[inline(always)]
    fn beam(&self, slot: usize) -> Beam {
        if Self::BEAMS {
            let unit = pow2(self.unit_exponent());
            beam_of(self.0[Self::BEAM][slot], &self.summary(slot), unit)
        } else {
            Beam::ANYWHERE
        }
    }

    #[inline(always)]
    fn end(&self, slot: usize) -> f32 {
        if Self::BEAMS && self.0[Self::END][slot] != 0 {
            f32::from_bits(self.0[Self::END][slot])
        } else {
            Limits::ENDLESS
        }
    }

    #[inline(always)]
    fn set_limits(&mut self, limits: &[Limits; W], summaries: &Lanes<W>) {
        if Self::HAS_MASKS {
            each!(slot, W, {
                let shines = exact::mask(self.0[WORD_1][slot] & PHI_MASK);
                self.0[Self::MASK][slot] = limits[slot].mask & shines;
            });
        }
        if Self::BEAMS {
            let (unit, per_unit) = (pow2(self.unit_exponent()), pow2(-self.unit_exponent()));
            // Beams are long: a loop, also in kernels.
            for slot in 0..W {
                let (mut cone, mut end) = (0, 0);
                let (beam, shines) = (&limits[slot].beam, self.0[WORD_1][slot] & PHI_MASK != 0);
                // Most lights are no spots, and most nodes above are of spots that point anywhere.
                if beam.is_narrow() && shines {
                    cone = beam_word(beam, &self.summary(slot), per_unit);
                }
                if limits[slot].end < Limits::ENDLESS && shines {
                    end = end_word(limits[slot].end, &summaries.get(slot), &self.summary(slot), unit);
                }
                self.0[Self::BEAM][slot] = cone;
                self.0[Self::END][slot] = end;
            }
        }
    }

    #[inline(always)]
    fn merged_limits(&self, whole: &LightMoments) -> Limits {
        let mut all = Limits::NONE;
        if Self::HAS_MASKS {
            each!(slot, W, {
                all.mask |= self.0[Self::MASK][slot];
            });
        }
        if Self::BEAMS {
            let shines = |slot: usize| self.0[WORD_1][slot] & PHI_MASK != 0;
            let (mut are_narrow, mut end) = (true, 0.0);
            each!(slot, W, {
                are_narrow &= !shines(slot) | (self.0[Self::BEAM][slot] != 0);
                end = exact::max(end, if shines(slot) { self.end(slot) } else { 0.0 });
            });
            all.end = if end > 0.0 { end } else { Limits::ENDLESS };
            if are_narrow {
                let mut merged = Union::about(whole.m, whole.c, self.unit_exponent());
                for slot in 0..W {
                    if shines(slot) {
                        merged.add(&self.beam(slot));
                    }
                }
                all.beam = merged.beam();
            }
        }
        all
    }

    #[inline(always)]
    fn merged(&self) -> LightMoments {
        self.framed().merged()
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        for row in 1..ROWS {
            self.0[row][slot] = 0;
        }
        self.0[WORD_0][slot] = kind & 3;
        self.0[Self::LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[Self::LINK][slot] = link;
    }

    #[inline(always)]
    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        self.pack(summaries);
    }
}

impl<const W: usize, const ROWS: usize, L: Light> MomentLayout<W> for PackedMomentNode<W, ROWS, L> {
    #[inline(always)]
    fn moment_weights(&self, p: Vec3, n: Vec3, space: Space) -> [f32; W] {
        self.weights_over::<false>(p, n, Vec3::ZERO, space)
    }

    #[inline(always)]
    fn cell_weights(&self, p: Vec3, n: Vec3, half: Vec3, space: Space) -> [f32; W] {
        self.weights_over::<true>(p, n, half, space)
    }
}

impl<const W: usize, const ROWS: usize, L> PackedMomentNode<W, ROWS, L> {
    /// At a point, or over a cell.
    #[inline(always)]
    fn weights_over<const CELL: bool>(&self, p: Vec3, n: Vec3, half: Vec3, space: Space) -> [f32; W] {
        let unit_exponent = self.unit_exponent();
        let mut least = unit_exponent;
        let mut side = side(n, WORD_UNIT);
        let mut slack = space.slack;
        if CELL {
            least = greatest_exponent(half, least);
            side = side.spread(n);
            slack += (half.x + half.y) + half.z;
        }
        let frame = frame(self.origin(), unit_exponent, least, p);
        let extent = Extent::new(half * frame.per_metre, n);
        let word_unit = frame.unit * WORD_UNIT;
        let breadth_bias = breadth_bias(frame.unit);
        let up = abs3(n) * (2.0 * EXTENT_RANGE);
        let up_sum = (up.x + up.y) + up.z;
        let up = up * WORD_UNIT;
        let near = Near::new(p, &Space { slack, ..space }, frame.per_metre);
        let mut weights = [0.0; W];
        for i in 0..W {
            let (w0, w1, w2, w3) = (
                self.0[WORD_0][i],
                self.0[WORD_1][i],
                self.normal_word(i),
                self.0[Self::WORD_3][i],
            );
            let lobe = Lobe {
                phi: f32::from_bits((w1 & PHI_MASK) << PHI_SHIFT),
                x: frame.x + Vec3::new(fraction(w0, 0), fraction(w0, 15), fraction(w1, 0)) * word_unit,
                breadth: f32::from_bits(((w3 << BREADTH_SHIFT) & BREADTH_MASK).wrapping_add(breadth_bias)),
                less: fraction(w1, 15) * WORD_UNIT,
                m: Vec3::new(fraction(w2, 0), fraction(w2, 8), fraction(w2, 16)),
                spread: (w2 & 255) as i32 as f32 * SPREAD_UNIT,
                reach: up_sum + dot(up, Vec3::new(fraction(w3, 0), fraction(w3, 8), fraction(w3, 16))),
            };
            weights[i] = if CELL {
                weight_over(&lobe, &side, &extent)
            } else {
                weight(&lobe, &side)
            };
            if Self::BEAMS {
                let cone = beam_factor(self.0[Self::BEAM][i], &lobe, WORD_UNIT, frame.unit, near.slack);
                let h = Vec3::new(fraction(w3, 0), fraction(w3, 8), fraction(w3, 16)) * WORD_UNIT
                    + Vec3::new(1.0, 1.0, 1.0);
                let left = near.within(self.0[Self::END][i], &lobe, h * EXTENT_RANGE, frame.unit);
                // Both at once would make some weights subnormal.
                let factor = exact::max(cone * left, OUTSIDE);
                weights[i] *= if space.slack >= 0.0 { factor } else { 1.0 };
            }
        }
        weights
    }
}
