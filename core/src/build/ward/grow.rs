//! Which ranges become the children of a wide node.

use super::Leaves;
use super::range::Range;
use crate::build::{BuildParams, Effort};

/// The children of a node, in the order of its slots.
#[derive(Debug)]
pub(in crate::build) struct Children<'a, const W: usize> {
    ranges: [Range<'a>; W],
    count: usize,
    /// Free slots: less than `W − count` where groups give up their place to their lights.
    slots: usize,
    /// Bit `i` is set where range `i`, a group, gives up its place to its lights.
    opened: u32,
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
        let small = all <= 4 * W;
        let to_lights = small || params.effort == Effort::Most;
        Self {
            params,
            most_whole: if to_lights { 1 } else { W },
            capacity: usize::MAX,
        }
    }

    /// Slots that `count` primitives take at least.
    fn slots_for(&self, count: usize) -> usize {
        count.div_ceil(self.capacity)
    }

    /// Splits `range`, of at most `W · capacity` primitives, into children.
    pub fn children<'a, const W: usize, L: Leaves>(&self, range: Range<'a>, leaves: &L) -> Children<'a, W> {
        let mut out = Children {
            ranges: core::array::from_fn(|_| Range::default()),
            count: 1,
            slots: W - 1,
            opened: 0,
        };
        out.ranges[0] = range;
        if out.ranges[0].len() <= W {
            out.open(0, leaves);
        } else {
            while out.slots > 0 && self.split_costliest(&mut out) {}
        }
        // Every opened one is a node less; the smallest first, so that most of them fit.
        while out.slots > 0 && out.open_smallest(leaves) {}
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

    /// Slots that range `i` takes once it is opened.
    fn size<L: Leaves>(&self, i: usize, leaves: &L) -> usize {
        match &*self.ranges[i].here {
            [only] if self.opened & (1 << i) == 0 => leaves.count(only.index),
            [_] => 1,
            many => many.len(),
        }
    }

    /// Opens the smallest range of several, if it fits.
    fn open_smallest<L: Leaves>(&mut self, leaves: &L) -> bool {
        let mut smallest = None;
        for i in 0..self.count {
            let size = self.size(i, leaves);
            if size > 1 && smallest.is_none_or(|(_, least)| size < least) {
                smallest = Some((i, size));
            }
        }
        match smallest {
            Some((i, size)) if size <= self.slots + 1 => {
                self.open(i, leaves);
                true
            }
            _ => false,
        }
    }

    /// Puts what range `i` holds in its place, at most `slots + 1` children.
    fn open<L: Leaves>(&mut self, i: usize, leaves: &L) {
        self.slots -= self.size(i, leaves) - 1;
        if self.ranges[i].len() == 1 {
            self.opened |= 1 << i;
            return;
        }
        let range = core::mem::take(&mut self.ranges[i]);
        let more = range.len() as u32 - 1;
        let before = self.opened & ((1 << i) - 1);
        self.opened = before | ((self.opened ^ before) << more);
        for (at, single) in (i..).zip(range.into_single()) {
            if at == i {
                self.ranges[i] = single;
            } else {
                self.insert(at, single);
            }
        }
    }

    /// The children in order, each with whether it gives up its place to its lights.
    pub fn into_iter(self) -> impl Iterator<Item = (Range<'a>, bool)> {
        let Self {
            ranges,
            count,
            opened,
            ..
        } = self;
        (0..)
            .zip(ranges)
            .take(count)
            .map(move |(i, range)| (range, opened & (1 << i) != 0))
    }
}
