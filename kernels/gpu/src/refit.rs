//! The dispatches of a refit.

use alloc::vec::Vec;

use lightbvh::bvh::RefitPlan;
use lightbvh::device::levels::Levels;
use lightbvh::node::Node;
use lightbvh::refit::child_rows;

/// What a dispatch of a refit computes. As a number it counts from 0 in the order of [`ALL`](Self::ALL).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// The children of nodes of bottom levels, an invocation for each.
    Bottom,
    /// The children of nodes of the top level, an invocation for each.
    Top,
    /// Nodes of either, from their children, which the dispatch before has computed.
    Nodes,
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Bottom, Self::Top, Self::Nodes];
}

/// One dispatch of a refit: a pass over a part of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dispatch {
    pub pass: Pass,
    /// First entry of the list.
    pub first: u32,
    /// Number of invocations, at least 1: one for each entry, or for each child of each entry's node.
    pub count: u32,
    /// Index of the top level's first node in the buffer.
    pub top: u32,
}

/// A refit: a list, and the dispatches over parts of it, in order. Each reads what the one before wrote.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Refit {
    /// Indices of nodes.
    pub list: Vec<u32>,
    pub dispatches: Vec<Dispatch>,
    /// Bytes by which passes [`Bottom`](Pass::Bottom) and [`Top`](Pass::Top) hand over to [`Nodes`](Pass::Nodes): at most those
    /// of [`AT_A_TIME`](Self::AT_A_TIME) nodes, 12 MiB for `LightBvh`.
    pub children: u64,
}

impl Refit {
    /// Most nodes that a dispatch computes: enough to keep a large device busy. It bounds [`children`](Self::children).
    pub const AT_A_TIME: usize = 1 << 15;

    /// The refit by `plan` of nodes `N`, those of the top level from `top` on.
    pub fn new<N: Node<W>, const W: usize>(plan: &RefitPlan, top: u32) -> Self {
        Self::of_at_most::<N, W>(plan, top, Self::AT_A_TIME)
    }

    /// In dispatches over at most `most` nodes.
    fn of_at_most<N: Node<W>, const W: usize>(plan: &RefitPlan, top: u32, most: usize) -> Self {
        let mut refit = Self::default();
        refit.levels::<N, W>(Pass::Bottom, &plan.bottom, 0, most);
        refit.levels::<N, W>(Pass::Top, &plan.top, top, most);
        refit
    }

    /// Appends two dispatches for each level, or for each part of one: over the children, then over the nodes.
    fn levels<N: Node<W>, const W: usize>(&mut self, pass: Pass, levels: &Levels, top: u32, most: usize) {
        for range in levels.ranges() {
            for nodes in levels.nodes()[range].chunks(most) {
                let first = self.list.len() as u32;
                self.list.extend(nodes.iter().map(|node| node + top));
                self.dispatch(pass, first, nodes.len() * W, top);
                self.dispatch(Pass::Nodes, first, nodes.len(), top);
                let children = nodes.len() * W * child_rows::<N, W>() * size_of::<u32>();
                self.children = self.children.max(children as u64);
            }
        }
    }

    /// Appends a dispatch, unless it has no invocations.
    fn dispatch(&mut self, pass: Pass, first: u32, count: usize, top: u32) {
        let count = count as u32;
        if count > 0 {
            self.dispatches.push(Dispatch {
                pass,
                first,
                count,
                top,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use lightbvh::MomentNode;
    use lightbvh::bvh::Cursor;

    use super::*;
    use crate::frame::tests::scene;

    /// Whether a level is computed at once or in parts: after what is below it, each node once, its children just before it.
    #[test]
    fn parts_of_a_level_are_the_level() {
        let plan = Cursor::default().plan(&scene::<MomentNode<4>, 4>().0);
        let whole = Refit::new::<MomentNode<4>, 4>(&plan, 100);
        let levels = |levels: &Levels| levels.ranges().count();
        let count = 2 * (levels(&plan.bottom) + levels(&plan.top));
        assert_eq!(whole.dispatches.len(), count);
        assert_eq!(Refit::AT_A_TIME * 8 * 12 * 4, 12 << 20, "as documented");
        let computed = |refit: &Refit| -> Vec<u32> {
            let own = refit.dispatches.iter().filter(|own| own.pass == Pass::Nodes);
            own.flat_map(|own| own.first..own.first + own.count).collect()
        };
        for most in [1, 7, 30] {
            let parts = Refit::of_at_most::<MomentNode<4>, 4>(&plan, 100, most);
            assert_eq!((&parts.list, computed(&parts)), (&whole.list, computed(&whole)));
            assert!(parts.dispatches.len() > whole.dispatches.len());
            // No part reaches from one level into the next.
            let begins = |own: &Dispatch| parts.dispatches.iter().any(|part| part.first == own.first);
            assert!(whole.dispatches.iter().all(begins));
            for pair in parts.dispatches.windows(2) {
                if let Pass::Bottom | Pass::Top = pair[0].pass {
                    let [children, nodes] = [pair[0], pair[1]];
                    let expected = (Pass::Nodes, children.first, children.count);
                    assert_eq!((nodes.pass, nodes.first, 4 * nodes.count), expected);
                    assert!(nodes.count as usize <= most);
                }
            }
            let bytes = most.min(whole.list.len()) as u64 * 4 * 12 * 4;
            assert!(parts.children <= bytes && parts.children <= whole.children);
            assert!(most > 7 || parts.children == bytes);
        }
    }
}
