//! From primitives to a tree: which node, which slot, which trail.

use alloc::vec::Vec;

use super::BuildParams;
use super::cost::Scales;
use super::primitive::{Group, Primitive};
use super::split::{halve, split};
use crate::node::{LightNode, kind};
use crate::trail::{BitTrail, max_levels};

/// A tree without bounds.
pub(crate) struct Topology<N> {
    /// Nodes in depth-first order, the root first; links within the tree already count from `base`.
    pub nodes: Vec<N>,
    /// Level of each node, the root's is 0.
    pub levels: Vec<u32>,
    /// (index of primitive, its trail), in depth-first order.
    pub trails: Vec<(u32, BitTrail)>,
    /// Number of levels.
    pub depth: u32,
}

/// Builds a tree over `primitives`, at least one, whose leaves are of `leaf_kind` and whose nodes will stand from index
/// `base` on.
pub(crate) fn build<N: LightNode<W>, const W: usize>(
    primitives: &mut [Primitive],
    leaf_kind: u32,
    base: u32,
    params: &BuildParams,
) -> Topology<N> {
    let mut builder = Builder::<N, W> {
        base,
        leaf_kind,
        params: *params,
        out: Topology {
            nodes: Vec::with_capacity(primitives.len()),
            levels: Vec::with_capacity(primitives.len()),
            trails: Vec::with_capacity(primitives.len()),
            depth: 0,
        },
    };
    builder.node(primitives, 0, BitTrail::default());
    builder.out
}

struct Builder<N, const W: usize> {
    base: u32,
    leaf_kind: u32,
    params: BuildParams,
    out: Topology<N>,
}

/// A part of a node's primitives that becomes one child.
#[derive(Clone, Copy)]
struct Part {
    start: usize,
    end: usize,
}

impl<N: LightNode<W>, const W: usize> Builder<N, W> {
    /// Emits the node over `primitives` at `level`; recursion is as deep as the tree, at most 64.
    fn node(&mut self, primitives: &mut [Primitive], level: u32, trail: BitTrail) {
        let index = self.out.nodes.len();
        self.out.nodes.push(N::EMPTY);
        self.out.levels.push(level);
        self.out.depth = self.out.depth.max(level + 1);

        let (parts, count) = self.parts(primitives, level);
        for (slot, part) in parts[..count].iter().enumerate() {
            let own_trail = trail.with::<W>(level, slot as u32);
            if part.end - part.start == 1 {
                let primitive = primitives[part.start].index;
                self.out.nodes[index].set_child(slot, self.leaf_kind, primitive);
                self.out.trails.push((primitive, own_trail));
            } else {
                let child = self.base + self.out.nodes.len() as u32;
                self.out.nodes[index].set_child(slot, kind::INNER, child);
                self.node(&mut primitives[part.start..part.end], level + 1, own_trail);
            }
        }
    }

    /// Splits `primitives` into up to `W` parts: the costliest part is split until there are `W` or only single
    /// primitives. Where the parts would not fit into the levels that remain, they are made equal instead.
    fn parts(&self, primitives: &mut [Primitive], level: u32) -> ([Part; W], usize) {
        let capacity = capacity::<W>(max_levels(W) - 1 - level);
        let (parts, count) = self.split_parts(primitives, false);
        let fits = parts[..count]
            .iter()
            .all(|p| (p.end - p.start) as u64 <= capacity);
        if fits {
            (parts, count)
        } else {
            self.split_parts(primitives, true)
        }
    }

    fn split_parts(&self, primitives: &mut [Primitive], equal: bool) -> ([Part; W], usize) {
        let mut parts = [Part {
            start: 0,
            end: primitives.len(),
        }; W];
        let mut count = 1;
        while count < W {
            let Some(chosen) = self.costliest(primitives, &parts[..count], equal) else {
                break;
            };
            let Part { start, end } = parts[chosen];
            let range = &mut primitives[start..end];
            let middle = start
                + if equal {
                    halve(range)
                } else {
                    split(range, &group(range), &self.params)
                };
            for later in (chosen + 1..count).rev() {
                parts[later + 1] = parts[later];
            }
            parts[chosen] = Part { start, end: middle };
            parts[chosen + 1] = Part { start: middle, end };
            count += 1;
        }
        (parts, count)
    }

    /// The part to split next, if any holds more than one primitive: of greatest cost, or the largest.
    fn costliest(&self, primitives: &[Primitive], parts: &[Part], equal: bool) -> Option<usize> {
        if parts.len() == 1 {
            return (primitives.len() > 1).then_some(0);
        }
        let scales = Scales::of(&group(primitives));
        let mut best = None;
        let mut best_cost = -1.0;
        for (i, part) in parts.iter().enumerate() {
            let range = &primitives[part.start..part.end];
            let cost = if equal {
                range.len() as f32
            } else {
                scales.cost(self.params.heuristic, &group(range))
            };
            if range.len() > 1 && cost > best_cost {
                best_cost = cost;
                best = Some(i);
            }
        }
        best
    }
}

fn group(range: &[Primitive]) -> Group {
    let mut all = Group::EMPTY;
    for p in range {
        all.add(p);
    }
    all
}

/// How many primitives a tree of `levels` levels of full `W`-wide nodes holds; one if no level is left.
fn capacity<const W: usize>(levels: u32) -> u64 {
    (W as u64).checked_pow(levels).unwrap_or(u64::MAX)
}
