//! The work of a device that follows a light BVH from one frame to the next.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use bytemuck::cast_slice;
use lightbvh::bvh::Cursor;
use lightbvh::node::Node;
use lightbvh::{Bvh, TreeWords};

use crate::buffer::Buffer;
use crate::refit::Refit;

/// The work of a device for one frame: resize, copy, refit, in this order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Frame {
    /// Buffers that need another size, and that size in bytes. Their contents stay, up to the lesser size. A buffer may be
    /// larger than it needs to be.
    pub resizes: Vec<(Buffer, u64)>,
    /// Copies from the light BVH to the device.
    pub copies: Vec<Copy>,
    /// Nodes that the device then computes.
    pub refit: Refit,
    /// Push constants of kernels that walk the tree afterwards.
    pub words: TreeWords,
}

/// The device's buffer of each array of a light BVH.
const BUFFERS: [Buffer; 9] = [
    Buffer::Nodes,
    Buffer::Nodes,
    Buffer::Triangles,
    Buffer::Instances,
    Buffer::Roots,
    Buffer::Trails,
    Buffer::Trails,
    Buffer::Trails,
    Buffer::Trails,
];
/// Places in [`BUFFERS`] of the nodes of the top level, the trails, and the links of the top level.
const TOP: usize = 1;
const TRAILS: usize = 5;
const ABOVE: usize = 6;
const PLACES: usize = 7;
const PARTS: usize = 8;

/// The arrays, in the order of [`BUFFERS`].
fn arrays<N: Node<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> [&[u8]; BUFFERS.len()] {
    let tree = bvh.tree();
    [
        cast_slice(bvh.nodes()),
        cast_slice(bvh.top_nodes()),
        cast_slice(bvh.triangles()),
        cast_slice(tree.instances),
        cast_slice(bvh.roots()),
        cast_slice(tree.trails),
        cast_slice(tree.links.above),
        cast_slice(tree.links.places),
        cast_slice(tree.links.parts),
    ]
}

/// A copy from the light BVH to the device's buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Copy {
    /// Which one.
    pub buffer: Buffer,
    /// Range in the buffer, bytes, of whole elements; not empty. Ranges of one buffer do not overlap.
    pub bytes: Range<u64>,
    /// Place of the array in [`BUFFERS`].
    array: usize,
    /// First byte in the array.
    from: u64,
}

impl Copy {
    /// The bytes to be copied.
    ///
    /// # Panics
    /// If `bvh` is another than the one that the frame is of, and its array shorter.
    #[must_use]
    pub fn source<'a, N: Node<W>, I, const W: usize>(&self, bvh: &'a Bvh<N, I, W>) -> &'a [u8] {
        let length = self.bytes.end - self.bytes.start;
        &arrays(bvh)[self.array][self.from as usize..(self.from + length) as usize]
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

/// Tracks what a device holds of a light BVH. A new mirror holds nothing, so its first frame copies everything.
///
/// Arrays that share a buffer stand one after another, each with capacity to grow: the nodes of bottom levels and those of the top
/// level; trails and links. Indices of nodes of bottom levels, instances and triangles are those of the light BVH.
///
/// A mirror assumes that each frame was done. If the device failed to do it, begin with a new mirror, on this device or
/// another; the light BVH is not changed. Any number of mirrors may follow one light BVH.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror {
    cursor: Cursor,
    /// By array, bytes: what the device holds of it, and how much room it has.
    held: [u64; BUFFERS.len()],
    room: [u64; BUFFERS.len()],
    trail_words: u32,
}

impl Mirror {
    /// The work that updates the device's buffers to `bvh` as of its last [`refit`](Bvh::refit). Call it after all edits of a
    /// frame, the swaps of a `Rebuilder`, and the refit. Take the bytes of the copies before the next edit or swap.
    ///
    /// Everything is copied and computed if the light BVH is another than last time (a clone, or one that was read), or if its
    /// log has dropped changes since.
    pub fn frame<N: Node<W>, I, const W: usize>(&mut self, bvh: &Bvh<N, I, W>) -> Frame {
        let mut plan = bvh.plan(&mut self.cursor);
        let trail_words = bvh.tree().trail_words;
        let resizes = self.make_room(bvh);
        // If a shared buffer was resized, arrays in it have moved.
        let is_moved = |buffer: Buffer| {
            let shares = matches!(buffer, Buffer::Nodes | Buffer::Trails);
            shares && resizes.iter().any(|(resized, _)| *resized == buffer)
        };
        if is_moved(Buffer::Nodes) && !plan.everything {
            let all = bvh.plan_of_everything();
            (plan.bottom, plan.roots, plan.top) = (all.bottom, all.roots, all.top);
        }
        let roots: Vec<_> = plan.roots.iter().map(|&root| root..root + 1).collect();
        let written: [&[Range<u32>]; BUFFERS.len()] = [
            &plan.written_nodes,
            &plan.written_top,
            &plan.written_triangles,
            &plan.written_instances,
            &roots,
            &plan.written_trails,
            &plan.written_above,
            &plan.written_places,
            &plan.written_parts,
        ];
        let mut copies = Vec::new();
        for (k, (own, written)) in arrays(bvh).into_iter().zip(written).enumerate() {
            let (bytes, buffer) = (own.len() as u64, BUFFERS[k]);
            let stride = match k {
                TRAILS => 4 * u64::from(trail_words),
                _ => u64::from(buffer.stride::<N>()),
            };
            let is_all = plan.everything
                || is_moved(buffer)
                || (plan.whole_top && [TOP, ABOVE, PLACES, PARTS].contains(&k))
                || (k == TRAILS && trail_words != self.trail_words);
            let written = written
                .iter()
                .map(|range| stride * u64::from(range.start)..stride * u64::from(range.end));
            // Elements by which an array grows are new too.
            let grown = if is_all { 0 } else { self.held[k].min(bytes) }..bytes;
            let ranges = written.chain(core::iter::once(grown)).collect();
            let start = self.start(k);
            copies.extend(joined(ranges, bytes).into_iter().map(|range| Copy {
                buffer,
                bytes: start + range.start..start + range.end,
                array: k,
                from: range.start,
            }));
            self.held[k] = bytes;
        }
        self.trail_words = trail_words;
        let words = self.words(bvh);
        Frame {
            resizes,
            copies,
            refit: Refit::new::<N, W>(&plan, self.top::<N>()),
            words,
        }
    }

    /// Push constants of kernels that walk the tree, as of the last [`frame`](Self::frame).
    #[must_use]
    pub fn words<N: Node<W>, I, const W: usize>(&self, bvh: &Bvh<N, I, W>) -> TreeWords {
        let tree = bvh.tree();
        let word = |array: usize| (self.start(array) / 4) as u32;
        TreeWords {
            root: tree.root,
            trail_words: tree.trail_words,
            live: tree.live,
            lights: tree.lights,
            depth: tree.depth,
            top: if bvh.is_single_level() { 0 } else { self.top::<N>() },
            above: word(ABOVE),
            places: word(PLACES),
            parts: word(PARTS),
        }
    }

    /// Index in the device's buffer of the first node of the top level.
    #[must_use]
    pub fn top<N: lightbvh::node::Holds>(&self) -> u32 {
        (self.start(TOP) / u64::from(Buffer::Nodes.stride::<N>())) as u32
    }

    /// Offset of an array in its buffer, bytes.
    fn start(&self, array: usize) -> u64 {
        let before = BUFFERS.iter().zip(self.room).take(array);
        let own = before.filter(|(buffer, _)| **buffer == BUFFERS[array]);
        own.map(|(_, room)| room).sum()
    }

    /// Reserves capacity for every array; returns the buffers that need another size.
    fn make_room<N: Node<W>, I, const W: usize>(&mut self, bvh: &Bvh<N, I, W>) -> Vec<(Buffer, u64)> {
        let size = |room: &[u64; BUFFERS.len()], buffer: Buffer| -> u64 {
            let own = BUFFERS.iter().zip(room).filter(|(own, _)| **own == buffer);
            own.map(|(_, room)| room).sum()
        };
        let before = self.room;
        for ((room, array), buffer) in self.room.iter_mut().zip(arrays(bvh)).zip(BUFFERS) {
            let now = array.len() as u64;
            let shares = matches!(buffer, Buffer::Nodes | Buffer::Trails);
            if now > *room {
                let stride = u64::from(buffer.stride::<N>());
                // An array that grows will grow again, and arrays behind it are copied then.
                let more = if *room > 0 && shares { now / stride / 2 } else { 0 };
                *room = now + more * stride;
            }
        }
        let all = Buffer::ALL.into_iter();
        all.map(|buffer| (buffer, size(&self.room, buffer)))
            .filter(|&(buffer, now)| now != size(&before, buffer))
            .collect()
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
pub(crate) mod tests;
