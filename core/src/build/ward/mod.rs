//! The wide builder: nodes grow to `W` children at once, by Ward's criterion.
//!
//! A node starts as one range of primitives. The range of greatest cost, the sum of flux times squared distance from its
//! centre of flux, is split at the best plane between bins until there are `W` ranges; each becomes a node of its own in
//! the same way. (To split the costliest range rather than the largest is worth more than any other choice here; that
//! was measured on scenes of twelve kinds.)
//!
//! Large ranges are binned in pieces of a fixed size, whose sums are added in order.

mod bins;
mod frame;
mod grow;
mod primitive;
mod range;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;

pub use primitive::WardPrimitive;

use super::BuildParams;
use super::Topology;
use super::topology::{Child, emit};
use crate::node::Node;
use crate::trail::max_levels;
use frame::Extent;
use grow::Growth;
use range::Range;

/// Primitives in a piece that is summed by itself.
const CHUNK: usize = 4096;
/// Ranges of fewer primitives have half as many bins.
const SMALL: usize = 256;

/// Builds a tree over `primitives`, at least one, whose leaves are of `leaf_kind`. The primitives are left in another order.
pub(crate) fn build_ward<N: Node<W>, const W: usize>(
    primitives: &mut [WardPrimitive],
    leaf_kind: u32,
    params: &BuildParams,
) -> Topology<N> {
    let count = primitives.len();
    let mut room: Vec<WardPrimitive> = primitives.to_vec();
    let extent = Extent::of(primitives);
    let growth = Growth::new::<W>(count, params);
    let range = Range::new(primitives, &mut room, &extent, growth.most_whole, params);
    // Nodes are seldom filled by less than five eighths.
    let mut topology = Topology {
        nodes: Vec::with_capacity(2 * count / W + 1),
        trails: Vec::with_capacity(count),
        depth: 0,
    };
    let children = |range, level| {
        let own = Growth {
            capacity: W.checked_pow(max_levels(W) - level - 1).unwrap_or(usize::MAX),
            ..growth
        };
        let ranges = own.children::<W>(range).into_iter();
        ranges.map(|range| match &*range.here {
            [only] => Child::Leaf(only.index),
            _ => Child::Node(range),
        })
    };
    emit::<N, _, _, W>(&mut topology, leaf_kind, &children, range, Default::default());
    topology
}
