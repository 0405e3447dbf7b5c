//! The dispatches of a refit.

use alloc::vec::Vec;

use lightbvh::bvh::RefitPlan;
use lightbvh::levels::Levels;

/// What a dispatch of a refit computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// Nodes of bottom levels.
    Bottom,
    /// Roots of bottom levels.
    Roots,
    /// Nodes of the top level.
    Top,
}

impl Pass {
    /// Name of its kernel, without the suffix of the choice of layout.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bottom => "refit_bottom",
            Self::Roots => "refit_roots",
            Self::Top => "refit_top",
        }
    }
}

/// One dispatch of a refit: a pass over a part of the list, an invocation for each entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dispatch {
    /// What it computes.
    pub pass: Pass,
    /// First entry of the list.
    pub first: u32,
    /// Number of entries, at least 1; [`groups`](crate::groups) says how many workgroups.
    pub count: u32,
}

impl Dispatch {
    /// Its push constants.
    #[must_use]
    pub fn push(&self) -> [u32; 2] {
        [self.first, self.count]
    }
}

/// A refit: a list, which the kernels take as the buffer `list`, and the dispatches over parts of it, in order. Each dispatch
/// reads what the one before wrote, so a barrier stands between any two.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Refit {
    /// Indices of nodes and roots.
    pub list: Vec<u32>,
    /// The dispatches.
    pub dispatches: Vec<Dispatch>,
}

impl Refit {
    /// The refit that `plan` says.
    #[must_use]
    pub fn new(plan: &RefitPlan) -> Self {
        let mut refit = Self::default();
        refit.levels(Pass::Bottom, &plan.bottom);
        refit.part(Pass::Roots, plan.roots.iter().copied());
        refit.levels(Pass::Top, &plan.top);
        refit
    }

    /// Appends a dispatch for each level.
    fn levels(&mut self, pass: Pass, levels: &Levels) {
        for range in levels.ranges() {
            self.part(pass, levels.nodes()[range].iter().copied());
        }
    }

    /// Appends a dispatch over `entries`, or none where there are none.
    fn part(&mut self, pass: Pass, entries: impl IntoIterator<Item = u32>) {
        let first = self.list.len() as u32;
        self.list.extend(entries);
        let count = self.list.len() as u32 - first;
        if count > 0 {
            self.dispatches.push(Dispatch { pass, first, count });
        }
    }
}
