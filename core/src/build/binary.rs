//! The binary tree that a wide one is made from.

use alloc::vec::Vec;

use super::primitive::{Group, Primitive};
use super::split::{Buckets, halve, split};
use super::{BuildParams, MAX_BUCKETS};

/// A child: an inner node's index, or the index of a primitive with this bit set.
pub(super) const LEAF: u32 = 1 << 31;

/// An inner node over two or more primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Binary {
    pub children: [u32; 2],
    /// Number of primitives below.
    pub count: u32,
}

/// Inner nodes in depth-first order, the root first, and the number of levels.
pub(super) struct BinaryTree {
    pub nodes: Vec<Binary>,
    pub depth: u32,
}

/// Splits `primitives`, at least two, down to single ones, in at most `most_levels` levels.
pub(super) fn binary_tree(
    primitives: &mut [Primitive],
    most_levels: u32,
    params: &BuildParams,
) -> BinaryTree {
    let mut builder = Builder {
        params,
        most_levels,
        buckets: [Group::EMPTY; MAX_BUCKETS as usize],
        out: BinaryTree {
            nodes: Vec::with_capacity(primitives.len()),
            depth: 0,
        },
    };
    let all = Group::of(primitives);
    builder.node(primitives, &all, 0);
    builder.out
}

struct Builder<'a> {
    params: &'a BuildParams,
    most_levels: u32,
    buckets: Buckets,
    out: BinaryTree,
}

impl Builder<'_> {
    /// Emits the node over `primitives`, whose union is `group`; recursion is as deep as the tree, at most 64.
    fn node(&mut self, primitives: &mut [Primitive], group: &Group, level: u32) -> u32 {
        let index = self.out.nodes.len();
        let count = primitives.len() as u32;
        self.out.nodes.push(Binary {
            children: [0; 2],
            count,
        });
        self.out.depth = self.out.depth.max(level + 1);

        // Where the parts would not fit into the levels that remain, they are made equal instead.
        let capacity = 1u64.checked_shl(self.most_levels - 1 - level).unwrap_or(u64::MAX);
        let (mut middle, mut groups) = split(primitives, group, self.params, &mut self.buckets);
        if middle.max(primitives.len() - middle) as u64 > capacity {
            middle = halve(primitives);
            groups = None;
        }
        let (left, right) = primitives.split_at_mut(middle);
        let groups = groups.unwrap_or_else(|| [Group::of_inner(left), Group::of_inner(right)]);
        for (side, part) in [left, right].into_iter().enumerate() {
            self.out.nodes[index].children[side] = if part.len() == 1 {
                LEAF | part[0].index
            } else {
                self.node(part, &groups[side], level + 1)
            };
        }
        index as u32
    }
}
