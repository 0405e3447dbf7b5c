//! Cuts of the top level: the nodes below one of its nodes that are to be replaced, and what hangs below those and stays.
//!
//! Where all leaves of a cut are instances, everything below its root is built anew. Above, the leaves are the subtrees that
//! cost little, for the costliest are opened first: a subtree whose lights have drifted apart is split rather than kept. Lights
//! that mixed over the whole scene are thus put in order as by a sort in passes: parts first, each of which is then spread over
//! the scene but well ordered, then the levels above over what the parts were split into, then the parts that these make.

#[cfg(feature = "std")]
use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
#[cfg(feature = "std")]
use core::cmp::Ordering;

#[cfg(feature = "std")]
use crate::bvh::opened;
use crate::bvh::{Bvh, Trails};
use crate::node::Node;
#[cfg(feature = "std")]
use crate::node::kind;
#[cfg(feature = "std")]
use crate::summary::Summary;
use crate::tree::INVALID;

/// Which subtree: its root's number, and when that node came into the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::bvh) struct Part {
    pub number: u32,
    pub born: u64,
}

/// A cut.
#[derive(Clone, Debug, Default)]
pub(super) struct Cut {
    /// Nodes that are to be replaced, from the root down.
    pub inner: Vec<u32>,
    /// Instances below them, in order.
    pub names: Vec<u32>,
    /// Subtrees below them that stay, in order.
    pub kept: Vec<u32>,
    /// What the nodes cost together, but for the root: flux times variance of the centers of their lights.
    pub cost: f64,
}

/// A subtree that may be opened, the costliest first.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
struct Candidate {
    cost: f64,
    count: u32,
    node: u32,
}

#[cfg(feature = "std")]
impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = self.cost.total_cmp(&other.cost);
        by_cost
            .then(self.count.cmp(&other.count))
            .then(other.node.cmp(&self.node))
    }
}

#[cfg(feature = "std")]
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(feature = "std")]
impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

#[cfg(feature = "std")]
impl Eq for Candidate {}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A node of the top level, as it is told from those that have its number later.
    pub(super) fn part(&self, node: u32) -> Part {
        let number = self.top.number(node);
        Part {
            number,
            born: self.top.born[number as usize],
        }
    }

    /// The node, while it is there.
    pub(super) fn node_of(&self, part: Part) -> Option<u32> {
        let node = *self.top.nodes.get(part.number as usize)?;
        (node != INVALID && self.top.born[part.number as usize] == part.born).then_some(node)
    }

    /// The cut below `root` of at most `most` leaves, at least `W`, in time in proportion to them.
    #[cfg(feature = "std")]
    pub(super) fn cut(&self, root: u32, most: usize) -> Cut {
        let mut cut = Cut::default();
        let mut open = BinaryHeap::new();
        let mut leaves = 1;
        let mut next = Some(root);
        while let Some(node) = next {
            let own = &self.nodes[node as usize];
            cut.inner.push(node);
            for slot in 0..W {
                let (to, link) = (own.kind(slot), own.link(slot));
                if to == kind::MESH {
                    cut.names.push(link);
                } else if to == kind::INNER {
                    open.push(Candidate {
                        cost: opened::cost(&own.summary(slot)),
                        count: self.top.counts[self.top.number(link) as usize],
                        node: link,
                    });
                }
            }
            leaves = cut.names.len() + open.len();
            let costliest = open.peek();
            let fits = costliest.filter(|costliest| leaves - 1 + self.children_of(costliest.node) <= most);
            next = fits.map(|costliest| costliest.node);
            if let Some(node) = next {
                open.pop();
                // As the tree over the copy is measured: what the node above says of it is rounded up.
                cut.cost += f64::from(self.quality(node).apart())
                    * f64::from(self.nodes[node as usize].merged().phi());
            }
        }
        debug_assert!(leaves <= most.max(W));
        cut.kept = open.into_iter().map(|candidate| candidate.node).collect();
        cut.kept.sort_unstable();
        cut.names.sort_unstable();
        cut
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;
