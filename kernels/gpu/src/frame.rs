//! What a device does to follow a light BVH from one frame to the next.

use alloc::vec::Vec;
use core::ops::Range;

use lightbvh::Bvh;
use lightbvh::node::LightNode;

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
    #[must_use]
    pub fn source<'a, N: LightNode<W>, I, const W: usize>(&self, bvh: &'a Bvh<N, I, W>) -> &'a [u8] {
        &self.buffer.bytes(bvh)[self.bytes.start as usize..self.bytes.end as usize]
    }
}

/// The sizes of a device's buffers, by which it follows a light BVH. A new one holds nothing, so its first frame copies everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror {
    bytes: [u64; Buffer::ALL.len()],
}

impl Mirror {
    /// The frame after the edits planned last: call [`Bvh::plan`] before, and do what this says for each
    /// frame without gaps.
    pub fn follow<N: LightNode<W>, I, const W: usize>(&mut self, bvh: &Bvh<N, I, W>) -> Frame {
        let work = bvh.work();
        let mut frame = Frame {
            refit: Refit::new(work),
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
            let grown = (*held).min(now)..now;
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
