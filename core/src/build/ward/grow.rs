//! Which ranges become the children of a wide node.

use super::range::Range;
use crate::build::BuildParams;

/// The children of a node, in the order of its slots.
#[derive(Debug)]
pub(in crate::build) struct Children<'a, const W: usize> {
    ranges: [Range<'a>; W],
    count: usize,
    /// Free slots.
    slots: usize,
}

/// How the children of a node are found.
#[derive(Clone, Copy, Debug)]
pub(in crate::build) struct Growth<'p> {
    pub params: &'p BuildParams,
    /// Ranges of so many primitives or fewer are not split, but become a node each.
    pub most_whole: usize,
    /// Most primitives that fit below one child.
    pub capacity: usize,
}

impl<'p> Growth<'p> {
    /// For a tree over `all` primitives.
    pub fn new<const W: usize>(all: usize, params: &'p BuildParams) -> Self {
        // A tree of few nodes stays small: costly lights may stand alone, and variance fell to between a quarter and a twentieth.
        let is_small = all <= 4 * W;
        Self {
            params,
            most_whole: if is_small { 1 } else { W },
            capacity: usize::MAX,
        }
    }

    /// Slots that `count` primitives take at least.
    fn slots_for(&self, count: usize) -> usize {
        count.div_ceil(self.capacity)
    }

    /// Splits `range`, of at most `W · capacity` primitives, into children.
    pub fn children<'a, const W: usize>(&self, range: Range<'a>) -> Children<'a, W> {
        let mut out = Children {
            ranges: core::array::from_fn(|_| Range::default()),
            count: 1,
            slots: W - 1,
        };
        out.ranges[0] = range;
        if out.ranges[0].len() <= W {
            out.open(0);
        } else {
            while out.slots > 0 && self.split_costliest(&mut out) {}
        }
        // Every opened one is a node less; the smallest first, so that most of them fit.
        while out.slots > 0 && out.open_smallest() {}
        out
    }

    /// Splits the costliest range that may be split; where some must be, since they hold more than fits below one child,
    /// and take all free slots, one of them.
    fn split_costliest<const W: usize>(&self, out: &mut Children<'_, W>) -> bool {
        let ranges = &out.ranges[..out.count];
        let needed: usize = ranges.iter().map(|range| self.slots_for(range.len()) - 1).sum();
        let least = if needed >= out.slots {
            self.capacity
        } else {
            self.most_whole
        };
        let mut costliest = None;
        for (i, range) in ranges.iter().enumerate().filter(|(_, range)| range.len() > least) {
            // Of equal costs, as at one point, the range of most primitives.
            let key = (range.cost(), range.len());
            if costliest.is_none_or(|(_, most)| key > most) {
                costliest = Some((i, key));
            }
        }
        let Some((i, (_, count))) = costliest else {
            return false;
        };

        // Where the parts would not fit, they are made equal, in whole subtrees.
        let fits = |left: usize| {
            self.slots_for(left) + self.slots_for(count - left) + (needed + 1 - self.slots_for(count))
                <= out.slots + 1
        };
        let whole = if count > self.capacity { self.capacity } else { W };
        let halves = count.div_ceil(whole) / 2 * whole;
        let middle = if halves == 0 { count / 2 } else { halves };
        let [left, right] =
            core::mem::take(&mut out.ranges[i]).split(middle, fits, self.most_whole, self.params);
        out.ranges[i] = left;
        out.insert(i + 1, right);
        out.slots -= 1;
        true
    }
}

impl<'a, const W: usize> Children<'a, W> {
    /// Inserts `range` as child `at`.
    fn insert(&mut self, at: usize, range: Range<'a>) {
        self.ranges[self.count] = range;
        self.count += 1;
        self.ranges[at..self.count].rotate_right(1);
    }

    /// Opens the smallest range of several primitives, if it fits.
    fn open_smallest(&mut self) -> bool {
        let sizes = self.ranges[..self.count].iter().map(Range::len).enumerate();
        match sizes.filter(|&(_, size)| size > 1).min_by_key(|&(_, size)| size) {
            Some((i, size)) if size <= self.slots + 1 => {
                self.open(i);
                true
            }
            _ => false,
        }
    }

    /// Puts the primitives of range `i` in its place, at most `slots + 1` of them.
    fn open(&mut self, i: usize) {
        let range = core::mem::take(&mut self.ranges[i]);
        self.slots -= range.len() - 1;
        for (at, single) in (i..).zip(range.into_single()) {
            if at == i {
                self.ranges[i] = single;
            } else {
                self.insert(at, single);
            }
        }
    }

    /// The children in order.
    pub fn into_iter(self) -> impl Iterator<Item = Range<'a>> {
        self.ranges.into_iter().take(self.count)
    }
}
