//! The wide builder: nodes grow to `W` children at once, by Ward's criterion.
//!
//! A node starts as one range of primitives. The range of greatest cost, the sum of flux times squared distance from its
//! centre of flux, is split at the best plane between bins until there are `W` ranges; each becomes a node of its own in
//! the same way. (To split the costliest range rather than the largest is worth more than any other choice here; that
//! was measured on scenes of twelve kinds.)
//!
//! Large ranges are binned and moved in pieces of a fixed size, whose sums are added in order: the tree is the same to
//! the bit for any number of threads.

mod bins;
mod emit;
mod frame;
mod grow;
mod partition;
#[cfg(feature = "rayon")]
mod parts;
mod primitive;
mod range;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;

pub(crate) use emit::Leaves;
pub(super) use frame::{DARK, Extent};
pub use primitive::{WardPrimitive, ward_primitives};

use super::topology::Topology;
use super::{BuildParams, Heuristic, morton};
use crate::node::Node;
use emit::{Emitter, Single};
use grow::Growth;
use range::Range;

/// Primitives in a piece that is summed by itself.
pub(super) const CHUNK: usize = 4096;
/// Subtrees of so many primitives or more are worth a thread of their own.
#[cfg(feature = "rayon")]
const SUBTREE: usize = 2048;
/// Ranges of fewer primitives have half as many bins.
const SMALL: usize = 256;

/// Whether a range of `count` primitives is worth the threads that there are.
#[cfg(feature = "rayon")]
pub(super) fn is_parallel(count: usize) -> bool {
    count >= 2 * CHUNK && rayon::current_num_threads() > 1
}

/// A primitive that is written over.
pub(super) const NOTHING: WardPrimitive = WardPrimitive {
    c: [0.0; 3],
    phi: 0.0,
    index: 0,
};

/// Builds a tree over `primitives`, at least one, whose leaves are of `leaf_kind`, with [`Heuristic::Morton`] or, for any
/// other, [`Heuristic::Ward`]. The primitives are left in another order.
pub(crate) fn build_ward<N: Node<W>, const W: usize>(
    primitives: &mut [WardPrimitive],
    leaf_kind: u32,
    params: &BuildParams,
) -> Topology<N> {
    // A few lights are sorted as well as can be in no time.
    if params.heuristic == Heuristic::Morton && primitives.len() > 4 * W {
        let (clusters, mut centres) = morton::clusters::<W>(primitives);
        return over(&mut centres, &clusters, leaf_kind, params);
    }
    over(primitives, &Single, leaf_kind, params)
}

/// Builds a tree over `primitives`, each of them a light or a group of up to `W` of them.
fn over<N: Node<W>, L: Leaves, const W: usize>(
    primitives: &mut [WardPrimitive],
    leaves: &L,
    leaf_kind: u32,
    params: &BuildParams,
) -> Topology<N> {
    let mut room: Vec<WardPrimitive> = primitives.to_vec();
    let extent = extent_of(primitives);
    let growth = Growth::new::<W>(primitives.len(), params);
    let range = Range::new(primitives, &mut room, &extent, growth.most_whole, params);
    let emitter = Emitter::<L, W> {
        leaves,
        leaf_kind,
        growth,
    };
    #[cfg(feature = "rayon")]
    if is_parallel(2 * range.len()) {
        return emitter.in_parallel(range);
    }
    let mut topology = emitter.room_for(range.len());
    emitter.node(range, 0, Default::default(), &mut topology);
    topology
}

/// The box of `primitives`.
pub(super) fn extent_of(primitives: &[WardPrimitive]) -> Extent {
    #[cfg(feature = "rayon")]
    if is_parallel(primitives.len()) {
        use rayon::prelude::*;
        return primitives.par_chunks(CHUNK).map(Extent::of).reduce(
            || Extent::EMPTY,
            |mut a, b| {
                a.grow(&b.low, &b.high);
                a
            },
        );
    }
    Extent::of(primitives)
}
