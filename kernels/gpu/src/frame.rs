//! The work of a device that follows a light BVH from one frame to the next.

use alloc::vec::Vec;
use core::ops::Range;

use bytemuck::{Pod, cast_slice};
use lightbvh::bvh::Cursor;
use lightbvh::node::{Holds, Node, kind};
use lightbvh::tree::{Model, OPENED};
use lightbvh::{Bvh, INVALID, TreeWords};

use crate::buffer::DeviceBuffer;
use crate::refit::{Pass, Refit};

/// The work of a device for one frame.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    resizes: Vec<(DeviceBuffer, u64)>,
    uploads: Vec<(DeviceBuffer, u64, &'a [u8])>,
    refit: Refit,
    /// Push constants of kernels that walk the tree once the steps are done.
    pub words: TreeWords,
}

/// A step of a [`Frame`]. Steps are done in their order: a device sees what those before have written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'a> {
    /// The buffer is replaced by one of at least `bytes` bytes. Its old contents are not needed: the steps that follow write all
    /// of it that is read. A buffer that grows gets half as much again, so resizes are few.
    Resize {
        /// Which one.
        buffer: DeviceBuffer,
        /// Its size, bytes, not 0.
        bytes: u64,
    },
    /// The bytes are written to the buffer from the byte `at` on; both are multiples of 4. Uploads do not overlap.
    Upload {
        /// Which one.
        buffer: DeviceBuffer,
        /// Where they begin, bytes.
        at: u64,
        /// The data, not empty.
        bytes: &'a [u8],
    },
    /// The kernel of the pass is dispatched ([`KernelSet::refit`](crate::KernelSet::refit)).
    Dispatch {
        /// The pass.
        pass: Pass,
        /// Its push constants.
        push: [u32; 3],
        /// Number of invocations, at least 1: [`Kernel::groups`](crate::Kernel::groups) says how many workgroups.
        count: u32,
    },
}

impl Frame<'_> {
    /// What the device does: resizes, then uploads, then dispatches. Nothing if nothing changed.
    pub fn steps(&self) -> impl Iterator<Item = Step<'_>> {
        let resizes = self.resizes.iter();
        let resizes = resizes.map(|&(buffer, bytes)| Step::Resize { buffer, bytes });
        let list = (DeviceBuffer::List, 0, cast_slice(&self.refit.list));
        let uploads = self.uploads.iter().copied().chain([list]);
        let uploads = uploads.filter(|(.., bytes)| !bytes.is_empty());
        let uploads = uploads.map(|(buffer, at, bytes)| Step::Upload { buffer, at, bytes });
        let dispatches = self.refit.dispatches.iter().map(|own| Step::Dispatch {
            pass: own.pass,
            push: [own.first, own.count, own.top],
            count: own.count,
        });
        resizes.chain(uploads).chain(dispatches)
    }
}

/// The device's buffer of each array: those of a light BVH, then those of a refit.
const BUFFERS: [DeviceBuffer; 10] = [
    DeviceBuffer::Nodes,
    DeviceBuffer::Nodes,
    DeviceBuffer::Lights,
    DeviceBuffer::Instances,
    DeviceBuffer::Trails,
    DeviceBuffer::Trails,
    DeviceBuffer::Trails,
    DeviceBuffer::Trails,
    DeviceBuffer::List,
    DeviceBuffer::Children,
];
/// Places in [`BUFFERS`] of the nodes of the top level and of its links; and of a refit's two.
const TOP: usize = 1;
const ABOVE: usize = 5;
const PLACES: usize = 6;
const PARTS: usize = 7;
const LIST: usize = 8;
const CHILDREN: usize = 9;

/// The arrays of a light BVH, with the bytes of an element, in the order of [`BUFFERS`].
fn arrays<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>) -> [(&[u8], u64); LIST] {
    fn of<T: Pod>(array: &[T]) -> (&[u8], u64) {
        (cast_slice(array), size_of::<T>() as u64)
    }
    let tree = bvh.tree();
    let (trails, word) = of(tree.trails);
    [
        of(bvh.view().nodes()),
        of(bvh.view().top_nodes()),
        of(bvh.view().lights()),
        of(tree.instances),
        (trails, word * u64::from(tree.trail_words)),
        of(tree.links.above),
        of(tree.links.places),
        of(tree.links.parts),
    ]
}

/// Tracks what a device holds of a light BVH. A new mirror holds nothing, so its first frame uploads everything.
///
/// Arrays that share a buffer stand one after another, each with capacity to grow: the nodes of bottom levels and those of the top
/// level; trails and links. Indices of nodes of bottom levels, instances and lights are those of the light BVH.
///
/// A mirror assumes that each frame was done. If the device failed to do it, begin with a new mirror, on this device or
/// another; the light BVH is not changed. Any number of mirrors may follow one light BVH.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror {
    cursor: Cursor,
    /// By array, bytes: what the device holds of it, and how much room it has.
    held: [u64; LIST],
    room: [u64; BUFFERS.len()],
}

impl Mirror {
    /// Least size of a buffer, bytes: an element of any kernel's binding.
    const LEAST: u64 = 1024;

    /// The work that updates the device's buffers to `bvh` as of its last [`refit`](Bvh::refit). Call it after all edits of a
    /// frame, the swaps of a `Rebuilder`, and the refit.
    ///
    /// Everything is uploaded and computed if the light BVH is another than last time (a clone, or one that was read), or if its
    /// log has dropped changes since.
    pub fn frame<'a, M: Model<W>, const W: usize>(&mut self, bvh: &'a Bvh<M, W>) -> Frame<'a> {
        let plan = self.cursor.plan(bvh);
        let arrays = arrays(bvh);
        // Arrays that share a buffer move if one of them needs more room.
        let mut is_new = [false; DeviceBuffer::ALL.len()];
        for (k, (own, stride)) in arrays.into_iter().enumerate() {
            is_new[BUFFERS[k] as usize] |= self.reserve(k, own.len() as u64, stride);
        }
        let written: [&[Range<u32>]; LIST] = [
            &plan.written_nodes,
            &plan.written_top,
            &plan.written_lights,
            &plan.written_instances,
            &plan.written_trails,
            &plan.written_above,
            &plan.written_places,
            &plan.written_parts,
        ];
        let mut uploads = Vec::new();
        for (k, ((own, stride), written)) in arrays.into_iter().zip(written).enumerate() {
            let bytes = own.len() as u64;
            let is_all = plan.everything
                || is_new[BUFFERS[k] as usize]
                || (plan.whole_top && [TOP, ABOVE, PLACES, PARTS].contains(&k));
            // Elements by which an array grows are new too.
            let grown = if is_all { 0 } else { self.held[k].min(bytes) }..bytes;
            let ranges = in_bytes(written, stride).chain(core::iter::once(grown));
            uploads.extend(self.pieces(k, own, ranges.collect()));
            self.held[k] = bytes;
        }
        let refit = Refit::new::<M::Node, W>(&plan, self.top::<M::Node>());
        is_new[DeviceBuffer::List as usize] = self.reserve(LIST, size_of_val(&*refit.list) as u64, 4);
        is_new[DeviceBuffer::Children as usize] = self.reserve(CHILDREN, refit.children, 4);
        let resizes = DeviceBuffer::ALL
            .into_iter()
            .filter(|&buffer| is_new[buffer as usize]);
        Frame {
            resizes: resizes.map(|buffer| (buffer, self.size(buffer))).collect(),
            uploads,
            refit,
            words: self.words(bvh),
        }
    }

    /// Push constants of kernels that walk the tree, as of the last [`frame`](Self::frame).
    #[must_use]
    pub fn words<M: Model<W>, const W: usize>(&self, bvh: &Bvh<M, W>) -> TreeWords {
        let tree = bvh.tree();
        let word = |array: usize| (self.start(array) / 4) as u32;
        TreeWords {
            root: tree.root,
            trail_words: tree.trail_words,
            live: tree.live,
            lights: tree.lights,
            depth: tree.depth,
            top: if bvh.view().is_single_level() {
                0
            } else {
                self.top::<M::Node>()
            },
            above: word(ABOVE),
            places: word(PLACES),
            parts: word(PARTS),
        }
    }

    /// Index in the device's buffer of the first node of the top level.
    #[must_use]
    pub fn top<N: Holds>(&self) -> u32 {
        (self.start(TOP) / size_of::<N>() as u64) as u32
    }

    /// The words of `bvh` in use, as a device has them once the steps of the last [`frame`](Self::frame) are done: by buffer, with
    /// the byte at which they begin. Other words of a device mean nothing.
    #[must_use]
    pub fn in_use<'a, M: Model<W>, const W: usize>(
        &self,
        bvh: &'a Bvh<M, W>,
    ) -> Vec<(DeviceBuffer, u64, &'a [u8])> {
        let (view, tree, all) = (bvh.view(), bvh.tree(), Cursor::default().plan(bvh));
        let instances = view.instances();
        let one = |index: u32| index..index + 1;
        let ones = |indices: &[u32]| indices.iter().copied().map(one).collect();
        let live = (0..).zip(instances).filter(|(_, own)| own.count > 0);
        let trails = instances
            .iter()
            .map(|own| own.first_light..own.first_light + own.count);
        let opened = instances.iter().zip(tree.links.places);
        let opened = opened.filter(|(own, place)| own.count > 0 && (OPENED..INVALID).contains(place));
        // A part is a child of the mesh's root.
        let parts = opened.map(|(own, place)| {
            let (root, first) = (&view.nodes()[own.root as usize], place - OPENED);
            first..first + (0..W).filter(|&slot| root.kind(slot) != kind::EMPTY).count() as u32
        });
        let used: [Vec<Range<u32>>; LIST] = [
            ones(all.bottom.nodes()),
            ones(all.top.nodes()),
            core::iter::once(0..view.lights().len() as u32).collect(),
            core::iter::once(0..instances.len() as u32).collect(),
            trails.collect(),
            ones(all.top.nodes()),
            live.map(|(index, _)| one(index)).collect(),
            parts.collect(),
        ];
        let all = used.iter().zip(arrays(bvh)).enumerate();
        all.flat_map(|(k, (ranges, (own, stride)))| self.pieces(k, own, in_bytes(ranges, stride).collect()))
            .collect()
    }

    /// Ranges of the bytes of an array, in order, with their places in its buffer.
    fn pieces<'a>(
        &self,
        array: usize,
        own: &'a [u8],
        ranges: Vec<Range<u64>>,
    ) -> impl Iterator<Item = (DeviceBuffer, u64, &'a [u8])> {
        let start = self.start(array);
        joined(ranges, own.len() as u64).into_iter().map(move |range| {
            let bytes = &own[range.start as usize..range.end as usize];
            (BUFFERS[array], start + range.start, bytes)
        })
    }

    /// Offset of an array in its buffer, bytes.
    fn start(&self, array: usize) -> u64 {
        let own = (0..array).filter(|&k| BUFFERS[k] == BUFFERS[array]);
        own.map(|k| self.room[k]).sum()
    }

    /// Size of a buffer, bytes.
    fn size(&self, buffer: DeviceBuffer) -> u64 {
        let own = BUFFERS.iter().zip(self.room).filter(|(own, _)| **own == buffer);
        own.map(|(_, room)| room).sum()
    }

    /// Reserves `bytes` bytes for an array, in whole elements. Returns whether it had to grow; an array that grows gets half as much
    /// again.
    fn reserve(&mut self, array: usize, bytes: u64, stride: u64) -> bool {
        let room = &mut self.room[array];
        let is_larger = bytes > *room || *room == 0;
        if is_larger {
            let more = if *room == 0 { 0 } else { bytes / 2 };
            *room = (bytes + more).max(Self::LEAST).next_multiple_of(stride);
        }
        is_larger
    }
}

/// Ranges of elements of `stride` bytes.
fn in_bytes(ranges: &[Range<u32>], stride: u64) -> impl Iterator<Item = Range<u64>> {
    let bytes = move |range: &Range<u32>| stride * u64::from(range.start)..stride * u64::from(range.end);
    ranges.iter().map(bytes)
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
