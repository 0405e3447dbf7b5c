//! The dispatches of a refit.

use alloc::vec::Vec;

use lightbvh::bvh::RefitPlan;
use lightbvh::levels::Levels;
use lightbvh::node::Node;
use lightbvh::refit::child_rows;

/// What a dispatch of a refit computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// The children of nodes of bottom levels, an invocation for each.
    Bottom,
    /// Roots of bottom levels.
    Roots,
    /// The children of nodes of the top level, an invocation for each.
    Top,
    /// Nodes of either, from their children, which the dispatch before has computed.
    Nodes,
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Bottom, Self::Roots, Self::Top, Self::Nodes];

    /// Name of its kernel, without the suffix of the choice of layout.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bottom => "refit_bottom",
            Self::Roots => "refit_roots",
            Self::Top => "refit_top",
            Self::Nodes => "refit_nodes",
        }
    }
}

/// One dispatch of a refit: a pass over a part of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dispatch {
    /// What it computes.
    pub pass: Pass,
    /// First entry of the list.
    pub first: u32,
    /// Number of invocations, at least 1: one for each entry, or for each child of each entry's node. [`groups`](crate::groups)
    /// says how many workgroups.
    pub count: u32,
    /// Index of the top level's first node in the buffer.
    pub top: u32,
}

impl Dispatch {
    /// Its push constants: [`first`](Self::first), [`count`](Self::count), [`top`](Self::top).
    #[must_use]
    pub fn push(&self) -> [u32; 3] {
        [self.first, self.count, self.top]
    }
}

/// A refit: a list, which the kernels take as the buffer `list`, and the dispatches over parts of it, in order. Each dispatch
/// reads what the one before wrote, so a barrier stands between any two.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Refit {
    /// Indices of nodes and roots.
    pub list: Vec<u32>,
    /// The dispatches, in their order.
    pub dispatches: Vec<Dispatch>,
    /// Bytes of the buffer `children` that the kernels need, by which passes [`Bottom`](Pass::Bottom) and [`Top`](Pass::Top)
    /// hand over to [`Nodes`](Pass::Nodes). What it holds before and after a refit means nothing. At most those of
    /// [`AT_A_TIME`](Self::AT_A_TIME) nodes, 12 MiB for `LightBvh`.
    pub children: u64,
}

impl Refit {
    /// Most nodes that a dispatch computes: enough to keep a large device busy. It bounds [`children`](Self::children).
    pub const AT_A_TIME: usize = 1 << 15;

    /// The refit by `plan` of nodes `N`, those of the top level from `top` on.
    #[must_use]
    pub fn new<N: Node<W>, const W: usize>(plan: &RefitPlan, top: u32) -> Self {
        Self::of_at_most::<N, W>(plan, top, Self::AT_A_TIME)
    }

    /// In dispatches over at most `most` nodes.
    fn of_at_most<N: Node<W>, const W: usize>(plan: &RefitPlan, top: u32, most: usize) -> Self {
        let mut refit = Self::default();
        refit.levels::<N, W>(Pass::Bottom, &plan.bottom, 0, most);
        let first = refit.list.len() as u32;
        refit.list.extend(&plan.roots);
        refit.dispatch(Pass::Roots, first, plan.roots.len(), 0);
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
    use lightbvh::light::EmissiveTriangle;
    use lightbvh::{Bvh, MomentNode, Transform};

    use super::*;

    /// Two meshes, 40 instances.
    fn plan() -> RefitPlan {
        let mut bvh = Bvh::<MomentNode<4>, (), 4>::default();
        for count in [3_u16, 300] {
            let row = (0..count).map(|i| {
                let x = f32::from(i);
                EmissiveTriangle {
                    p: [[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.1]],
                    radiance: [1.0; 3],
                    mesh: 0,
                    flags: 0,
                }
            });
            let mesh = bvh.add_mesh(row.collect()).expect("a mesh");
            for i in 0..20_u8 {
                let at = Transform::at([f32::from(i), f32::from(count), 0.0]);
                bvh.add_instance(mesh, at).expect("an instance");
            }
        }
        bvh.plan_of_everything()
    }

    /// Whether a level is computed at once or in parts: after what is below it, each node once, its children just before it.
    #[test]
    fn parts_of_a_level_are_the_level() {
        let plan = plan();
        let whole = Refit::new::<MomentNode<4>, 4>(&plan, 100);
        let passes = |refit: &Refit| {
            refit
                .dispatches
                .iter()
                .map(|dispatch| dispatch.pass)
                .collect::<Vec<_>>()
        };
        let levels = |levels: &Levels| levels.ranges().count();
        assert_eq!(
            passes(&whole).len(),
            2 * levels(&plan.bottom) + 1 + 2 * levels(&plan.top)
        );
        assert_eq!(Refit::AT_A_TIME * 8 * 12 * 4, 12 << 20, "as documented");
        for most in [1, 7, 30] {
            let parts = Refit::of_at_most::<MomentNode<4>, 4>(&plan, 100, most);
            assert_eq!(parts.list, whole.list);
            assert!(parts.dispatches.len() > whole.dispatches.len());
            let mut next = 0;
            for (k, dispatch) in parts.dispatches.iter().enumerate() {
                assert_eq!(dispatch.first, next);
                match dispatch.pass {
                    Pass::Bottom | Pass::Top => {
                        let nodes = parts.dispatches[k + 1];
                        assert_eq!(
                            (nodes.pass, nodes.first, 4 * nodes.count),
                            (Pass::Nodes, dispatch.first, dispatch.count)
                        );
                        continue;
                    }
                    Pass::Roots => {}
                    Pass::Nodes => {
                        assert!(dispatch.count as usize <= most);
                        // No part reaches from one level into the next.
                        let entries = dispatch.first as usize..(dispatch.first + dispatch.count) as usize;
                        let within = |part: &Dispatch| {
                            part.first as usize <= entries.start
                                && entries.end <= (part.first + part.count) as usize
                        };
                        let nodes = |part: &&Dispatch| part.pass == Pass::Nodes;
                        assert!(whole.dispatches.iter().filter(nodes).any(within));
                    }
                }
                next += dispatch.count;
            }
            assert_eq!(next as usize, parts.list.len());
            let bytes = most.min(whole.list.len()) as u64 * 4 * 12 * 4;
            assert!(parts.children <= bytes && parts.children <= whole.children);
            assert!(most > 7 || parts.children == bytes);
        }
    }
}
