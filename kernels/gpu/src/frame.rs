//! What a device does to follow a light BVH from one frame to the next.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use lightbvh::Bvh;
use lightbvh::bvh::RefitPlan;
use lightbvh::node::Node;

use crate::buffer::Buffer;
use crate::refit::Refit;

/// What a device does for one frame: resize, copy, refit, in this order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Frame {
    /// Buffers that need another size, and that size in bytes. What they hold stays, up to the lesser size. A buffer may be
    /// larger than it needs to be.
    pub resizes: Vec<(Buffer, u64)>,
    /// What is copied from the light BVH to the device.
    pub copies: Vec<Copy>,
    /// What the device computes then.
    pub refit: Refit,
}

/// A copy from the array of the light BVH to the same place in the device's buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Copy {
    /// Which one.
    pub buffer: Buffer,
    /// Where in both, bytes, in whole elements; not empty. Ranges of one buffer do not overlap.
    pub bytes: Range<u64>,
}

impl Copy {
    /// The bytes to be copied.
    ///
    /// # Panics
    /// If `bvh` is another than the one that the frame is of, and its array shorter.
    #[must_use]
    pub fn source<'a, N: Node<W>, I, const W: usize>(&self, bvh: &'a Bvh<N, I, W>) -> &'a [u8] {
        &self.buffer.bytes(bvh)[self.bytes.start as usize..self.bytes.end as usize]
    }
}

/// A region of a copy from a staging buffer, bytes: the words of `VkBufferCopy`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// First byte in the staging buffer.
    pub from: u64,
    /// First byte in the device's buffer.
    pub to: u64,
    /// How many.
    pub bytes: u64,
}

impl Region {
    /// Its entry in the list of kernel `scatter`: its first words in the staging buffer and in the device's, and how many.
    #[must_use]
    pub fn run(&self) -> [u32; 3] {
        [self.from, self.to, self.bytes].map(|bytes| (bytes / 4) as u32)
    }
}

impl Frame {
    /// Bytes of all [`copies`](Self::copies): what a staging buffer of them takes.
    #[must_use]
    pub fn staged_bytes(&self) -> u64 {
        self.copies
            .iter()
            .map(|copy| copy.bytes.end - copy.bytes.start)
            .sum()
    }

    /// The copies out of a staging buffer that holds their [sources](Copy::source) one after another, in their order: for each
    /// buffer the regions of one copy command. `start` is the first byte there, a multiple of 4: the place in a ring, for
    /// example.
    ///
    /// Drivers of real devices run one copy for each region, some 2 µs on an NVIDIA H100. Where there are dozens of short ones,
    /// put their [entries](Region::run) behind the bytes and dispatch kernel `scatter` instead, 16 invocations for each.
    #[must_use]
    pub fn regions(&self, start: u64) -> Vec<(Buffer, Vec<Region>)> {
        let mut all: Vec<(Buffer, Vec<Region>)> = Vec::new();
        let mut from = start;
        for copy in &self.copies {
            let bytes = copy.bytes.end - copy.bytes.start;
            let region = Region {
                from,
                to: copy.bytes.start,
                bytes,
            };
            from += bytes;
            match all.last_mut().filter(|(buffer, _)| *buffer == copy.buffer) {
                Some((_, regions)) => regions.push(region),
                None => all.push((copy.buffer, vec![region])),
            }
        }
        all
    }
}

/// What a device holds of a light BVH, by which it follows it. A new one holds nothing, so its first frame copies everything.
///
/// A mirror takes a frame that it has told for done. Where the device could not do it, begin with a new one; the light BVH is
/// as it was, and another device may take over so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror {
    bytes: [u64; Buffer::ALL.len()],
    /// The plan followed last: the light BVH's number, and the plan's.
    last: Option<(u32, u64)>,
}

impl Mirror {
    /// Plans and follows: what brings the device's buffers to what `bvh` is now, after all edits of a frame and what
    /// a `Rebuilder` has swapped in. The bytes of the copies are to be taken before the next edit or swap.
    ///
    /// It takes the plan, so it is for the one mirror of `bvh`, once a frame and without a [`Bvh::plan`] of one's own;
    /// otherwise everything is copied.
    pub fn frame<N: Node<W>, I, const W: usize>(&mut self, bvh: &mut Bvh<N, I, W>) -> Frame {
        bvh.plan();
        self.follow(bvh)
    }

    /// [`frame`](Self::frame), where several mirrors follow one light BVH: each after one [`Bvh::plan`], after all edits and swaps.
    ///
    /// Everything is copied and refitted where the plan does not say all that changed for this mirror: another light BVH than last
    /// time (a clone, or one that was read), a plan that was left out, a change since the plan.
    pub fn follow<N: Node<W>, I, const W: usize>(&mut self, bvh: &Bvh<N, I, W>) -> Frame {
        let (now, is_current) = bvh.last_plan();
        let is_followed = is_current && self.last == Some(now);
        let is_next = is_current && self.last.is_some_and(|(tree, plan)| (tree, plan + 1) == now);
        let everything = !is_followed && !is_next;
        self.last = Some(now);
        let (whole, none);
        let work = if everything {
            whole = bvh.plan_of_everything();
            &whole
        } else if is_followed {
            none = RefitPlan::default();
            &none
        } else {
            bvh.planned()
        };
        let mut frame = Frame {
            refit: Refit::new::<N, W>(work),
            ..Frame::default()
        };
        let roots: Vec<Range<u32>> = work.roots.iter().map(|&root| root..root + 1).collect();
        for (held, buffer) in self.bytes.iter_mut().zip(Buffer::ALL) {
            let (changed, elements) = match buffer {
                Buffer::Nodes => (&work.written_nodes, 1),
                Buffer::Triangles => (&work.written_triangles, 1),
                Buffer::Instances => (&work.written_instances, 1),
                Buffer::Roots => (&roots, 1),
                Buffer::Trails => (&work.written_trails, u64::from(bvh.tree().trail_words)),
            };
            let stride = elements * u64::from(buffer.stride::<N>());
            let now = buffer.bytes(bvh).len() as u64;
            let written = changed
                .iter()
                .map(|range| stride * u64::from(range.start)..stride * u64::from(range.end));
            // What a buffer grows by is new too.
            let grown = if everything { 0 } else { (*held).min(now) }..now;
            let ranges = written.chain(core::iter::once(grown)).collect();
            let copies = joined(ranges, now)
                .into_iter()
                .map(|bytes| Copy { buffer, bytes });
            frame.copies.extend(copies);
            if *held != now {
                frame.resizes.push((buffer, now));
                *held = now;
            }
        }
        frame
    }
}

/// The ranges below `end`, in order, those that touch made one.
fn joined(mut ranges: Vec<Range<u64>>, end: u64) -> Vec<Range<u64>> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    let mut out: Vec<Range<u64>> = Vec::new();
    for range in ranges {
        let range = range.start..range.end.min(end);
        match out.last_mut() {
            _ if range.is_empty() => {}
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => out.push(range),
        }
    }
    out
}

#[cfg(test)]
mod tests;
