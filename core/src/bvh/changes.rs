//! What changed since the last refit, and since the last plan.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::ops::Range;

/// What changed, for whom: edits mark what is new; what a plan has taken is still to be refitted here, and what a refit has done is
/// still to be told by a plan.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    /// Since the last plan or refit.
    pub new: Pending,
    /// Planned since the last refit.
    pub unrefitted: Pending,
    /// Refitted since the last plan, if there ever was one.
    pub unplanned: Pending,
    /// Number of plans so far, and of refits before the first that none tells of.
    pub plans: u64,
    /// Whether plans are taken.
    pub is_planned: bool,
    /// Whether the last lists are those of all that a refit has to do.
    pub is_fresh: bool,
    /// What of the last plan is to be counted by the refit that takes its lists.
    pub counted: Counted,
}

/// What a refit counts at the nodes above. Plans count nothing: trees do not depend on them.
#[derive(Clone, Debug, Default)]
pub(super) struct Counted {
    /// Leaves that were marked, some of them for what they were rebuilt by.
    pub refitted: Vec<u32>,
    /// Bottom levels that changed as a whole.
    pub swept: Vec<u32>,
    /// Those leaves, and all of bottom levels that changed.
    pub all: Vec<u32>,
}

impl Changes {
    /// A bottom level is gone.
    pub fn forget_blas(&mut self, index: u32) {
        self.is_fresh = false;
        for pending in self.all() {
            pending.blases.remove(&index);
            pending.built.remove(&index);
            pending.roots.remove(&index);
        }
    }

    /// The nodes of the top level are others.
    pub fn forget_top(&mut self) {
        self.is_fresh = false;
        for pending in self.all() {
            pending.top_nodes.clear();
        }
    }

    /// What the last plan listed is not what there is any more.
    pub fn forget_lists(&mut self) {
        self.is_fresh = false;
    }

    /// All lists.
    pub fn all(&mut self) -> [&mut Pending; 3] {
        [&mut self.new, &mut self.unrefitted, &mut self.unplanned]
    }

    /// No trails are kept from now on.
    pub fn forget_trails(&mut self) {
        for pending in self.all() {
            pending.written_trails.clear();
        }
    }
}

/// Most entries of lists that an edit sorts.
const SHORT: usize = 4096;
/// Entries of a list that are never too many.
const LEAST: usize = 8192;

/// Changes of one kind of lists.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    /// Bottom levels whose triangles changed.
    pub blases: BTreeSet<u32>,
    /// Triangles that changed without the rest of their bottom level; may overlap, and may be of bottom levels that are no more.
    pub parts: Vec<Range<u32>>,
    /// Bottom levels that are new, their bounds known.
    pub built: BTreeSet<u32>,
    /// Bottom levels whose bounds, or those of their parts, a mirror has not yet, without their instances.
    pub roots: BTreeSet<u32>,
    /// Indices of instances; may repeat.
    pub instances: Vec<u32>,
    /// Nodes of the top level that lost a child or were made anew; may repeat.
    pub top_nodes: Vec<u32>,
    /// Whether the whole top level is new.
    pub whole_top: bool,
    pub written_nodes: Vec<Range<u32>>,
    pub written_triangles: Vec<Range<u32>>,
    pub written_trails: Vec<Range<u32>>,
    /// Indices of instances whose words changed; may repeat.
    pub written_instances: Vec<u32>,
    /// Whether all instances may have changed: their lists, which are empty then but for what came since, would be longer than
    /// the arrays.
    pub all_instances: bool,
    /// Whether all nodes may have been written, and so are to be computed. Their triangles are no others for that.
    pub all_nodes: bool,
    /// How many entries were left when repeated ones were dropped last.
    kept: usize,
}

impl Pending {
    /// The triangles of a bottom level changed.
    pub fn mark_blas(&mut self, index: u32) {
        self.blases.insert(index);
    }

    /// A bottom level was built, with the bounds of its triangles as they are.
    pub fn mark_built(&mut self, index: u32) {
        self.blases.remove(&index);
        self.built.insert(index);
    }

    pub fn is_empty(&self) -> bool {
        self.blases.is_empty()
            && self.parts.is_empty()
            && self.built.is_empty()
            && self.roots.is_empty()
            && self.instances.is_empty()
            && self.top_nodes.is_empty()
            && !self.whole_top
            && self.written_nodes.is_empty()
            && self.written_triangles.is_empty()
            && self.written_trails.is_empty()
            && self.written_instances.is_empty()
            && !self.all_instances
            && !self.all_nodes
    }

    /// Takes over what another list holds.
    pub fn join(&mut self, other: Self) {
        if self.is_empty() {
            *self = other;
            return;
        }
        self.blases.extend(other.blases);
        self.parts.extend(other.parts);
        self.built.extend(other.built);
        self.roots.extend(other.roots);
        self.instances.extend(other.instances);
        self.top_nodes.extend(other.top_nodes);
        self.whole_top |= other.whole_top;
        self.written_nodes.extend(other.written_nodes);
        self.written_triangles.extend(other.written_triangles);
        self.written_trails.extend(other.written_trails);
        self.written_instances.extend(other.written_instances);
        self.all_instances |= other.all_instances;
        self.all_nodes |= other.all_nodes;
    }

    /// Says that all of an array may have changed once its list has more than three times as many entries, so many `instances`,
    /// `nodes` and `triangles`: no edit waits for repeated ones to be sought, and what a refit or a plan then does takes no
    /// longer than the edits that came before it.
    ///
    /// Before that repeated entries of short lists are dropped once they have doubled since that was done last.
    pub fn bound(&mut self, instances: usize, nodes: usize, triangles: usize) {
        let length = self.len();
        if length > 2 * self.kept + 64 && length <= SHORT {
            self.sort();
        }
        // A mirror copies a node with what it knew, so all are computed then.
        if self.written_nodes.len() > 3 * nodes + LEAST {
            self.written_nodes = alloc::vec![0..nodes as u32];
            self.all_nodes = true;
            self.whole_top = true;
        }
        for (list, length) in [
            (&mut self.parts, triangles),
            (&mut self.written_triangles, triangles),
            (&mut self.written_trails, triangles),
        ] {
            if list.len() > 3 * length + LEAST {
                *list = alloc::vec![0..length as u32];
            }
        }
        let listed = self.instances.len() + self.top_nodes.len() + self.written_instances.len();
        // There are fewer nodes of the top level than instances.
        if listed > 3 * instances + LEAST {
            self.instances = Vec::new();
            self.top_nodes = Vec::new();
            self.written_instances = Vec::new();
            self.all_instances = true;
            self.whole_top = true;
        }
    }

    /// Drops repeated entries.
    fn sort(&mut self) {
        for list in [
            &mut self.instances,
            &mut self.top_nodes,
            &mut self.written_instances,
        ] {
            list.sort_unstable();
            list.dedup();
        }
        self.merge();
        self.kept = self.len();
    }

    /// Makes ranges that touch one.
    fn merge(&mut self) {
        for list in [
            &mut self.parts,
            &mut self.written_nodes,
            &mut self.written_triangles,
            &mut self.written_trails,
        ] {
            *list = merged(core::mem::take(list));
        }
    }

    /// Makes ranges that touch one in lists that are too long for that to be done as they grow.
    pub fn merge_long(&mut self) {
        if self.len() > SHORT {
            self.merge();
        }
    }

    /// Entries of the lists that may repeat.
    pub fn len(&self) -> usize {
        self.parts.len()
            + self.instances.len()
            + self.top_nodes.len()
            + self.written_instances.len()
            + self.written_nodes.len()
            + self.written_triangles.len()
            + self.written_trails.len()
    }

    pub fn mark_instance(&mut self, index: u32) {
        self.instances.push(index);
        self.written_instances.push(index);
    }
}

/// Ranges in order, those that touch made one.
pub(super) fn merged(mut ranges: Vec<Range<u32>>) -> Vec<Range<u32>> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    let mut out: Vec<Range<u32>> = Vec::with_capacity(ranges.len());
    for range in ranges {
        match out.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => out.push(range),
        }
    }
    out
}

#[cfg(test)]
mod costs;
#[cfg(test)]
mod mirror;
#[cfg(test)]
mod tests;
