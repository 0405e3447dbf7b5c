//! A layout that quantises nothing, for formulas.

use bytemuck::{Pod, Zeroable};

use crate::exact;
use crate::importance::Cluster;
use crate::light::EmissiveTriangle;
use crate::node::{BoundsNode, Holds, LightBounds, Node};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};
use crate::vector::{length_squared, max3};

const KIND: usize = SUMMARY_WORDS;
const LINK: usize = SUMMARY_WORDS + 1;

/// The words of each child's bounds, its kind and its link, each an array over the slots.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct PlainNode<const W: usize>([[u32; W]; SUMMARY_WORDS + 2]);

impl<const W: usize> Holds for PlainNode<W> {
    type Light = EmissiveTriangle;
}

impl<const W: usize> Node<W> for PlainNode<W> {
    type Summary = LightBounds;

    const EMPTY: Self = Self([[0; W]; SUMMARY_WORDS + 2]);
    const NAME: &'static str = "plain";

    fn kind(&self, slot: usize) -> u32 {
        self.0[KIND][slot]
    }

    fn link(&self, slot: usize) -> u32 {
        self.0[LINK][slot]
    }

    fn summary(&self, slot: usize) -> LightBounds {
        LightBounds::from_words(&core::array::from_fn(|k| f32::from_bits(self.0[k][slot])))
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        self.0.iter_mut().for_each(|row| row[slot] = 0);
        self.0[KIND][slot] = kind;
        self.0[LINK][slot] = link;
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.0[LINK][slot] = link;
    }

    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        for (row, words) in self.0.iter_mut().zip(summaries.0) {
            *row = words.map(f32::to_bits);
        }
    }
}

impl<const W: usize> BoundsNode<W> for PlainNode<W> {
    fn cluster(&self, slot: usize) -> Cluster {
        let bounds = self.summary(slot);
        let center = bounds.center();
        // Halves that reach both corners from the rounded centre, of squares that are normal numbers.
        let half = max3(bounds.max - center, center - bounds.min) * (1.0 + exact::pow2(-20));
        let extent = half.map(|h| {
            if h > 0.0 {
                exact::max(h, exact::pow2(-60))
            } else {
                0.0
            }
        });
        let cosine = bounds.cos_theta_o;
        Cluster {
            center,
            extent,
            radius_squared: length_squared(extent),
            axis: bounds.axis,
            cos_theta_o: cosine,
            sin_theta_o: exact::sqrt(exact::max(1.0 - cosine * cosine, 0.0)),
            phi: bounds.phi,
        }
    }
}
