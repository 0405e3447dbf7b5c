//! A BVH and its edits on a device: what changed is copied, the rest is computed there.

use std::ops::Range;
use std::time::Duration;

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::node::Node;
use lightbvh::refit::BlasRoot;
use lightbvh::{Instance, TreeWords};
use lightbvh_gpu::{Buffer as Array, Frame, KernelSet, Mirror, Refit};

use super::{BackendError, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// The arrays of a light BVH of any layout on a device, which follow its edits, and the kernels over them.
pub struct Mirrored<'d, N: Node<W>, const W: usize> {
    device: &'d Device,
    kernels: KernelSet,
    pub(super) nodes: Buffer<N>,
    /// How many of them are of bottom levels, and which are of the top level.
    bottoms: usize,
    pub(super) top: Range<usize>,
    pub(super) triangles: Buffer<N::Light>,
    pub(super) instances: Buffer<Instance>,
    roots: Buffer<BlasRoot>,
    pub(super) trails: Buffer<u32>,
    push: TreeWords,
    mirror: Mirror,
}

impl<'d, N: Node<W>, const W: usize> Mirrored<'d, N, W> {
    /// One that holds nothing yet, with the kernels of its layout.
    pub fn new(device: &'d Device, kernels: KernelSet) -> Result<Self, BackendError> {
        Ok(Self {
            device,
            kernels,
            nodes: device.buffer(0)?,
            bottoms: 0,
            top: 0..0,
            triangles: device.buffer(0)?,
            instances: device.buffer(0)?,
            roots: device.buffer(0)?,
            trails: device.buffer(0)?,
            push: TreeWords::default(),
            mirror: Mirror::default(),
        })
    }

    /// The device.
    pub fn device(&self) -> &'d Device {
        self.device
    }

    /// The kernels.
    pub(super) fn kernels(&self) -> KernelSet {
        self.kernels
    }

    /// All nodes: those of bottom levels, then those of the top level.
    pub fn nodes(&self) -> Result<Vec<N>, BackendError> {
        let nodes = self.nodes.read()?;
        Ok([&nodes[..self.bottoms], &nodes[self.top.clone()]].concat())
    }

    /// Push constants of kernels that walk the tree.
    pub fn words(&self) -> TreeWords {
        self.push
    }

    /// The roots of bottom levels.
    pub fn roots(&self) -> Result<Vec<BlasRoot>, BackendError> {
        Ok(self.roots.read()?)
    }

    /// The array that a kernel's binding of this name takes.
    fn bind(&self, name: &str) -> Option<Binding> {
        Array::named(name).map(|array| match array {
            Array::Nodes => self.nodes.bind(),
            Array::Triangles => self.triangles.bind(),
            Array::Instances => self.instances.bind(),
            Array::Roots => self.roots.bind(),
            Array::Trails => self.trails.bind(),
        })
    }

    /// The results of a kernel over `count` invocations. Bindings are matched by name with the tree's arrays and `others`;
    /// the remaining binding holds the results.
    pub fn ask<T: Pod>(
        &self,
        kernel: &lightbvh_gpu::Kernel,
        count: usize,
        push: &[u8],
        others: &[(&str, Binding)],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        let output = self.device.output::<T>(count)?;
        let bind = |name| {
            let other = others.iter().find(|(other, _)| *other == name);
            let own = || self.bind(name).unwrap_or_else(|| output.bind());
            other.map_or_else(own, |(_, binding)| binding.clone())
        };
        let bindings: Vec<_> = kernel.bindings.iter().map(|binding| bind(binding.name)).collect();
        let compiled = self.device.kernel(kernel.name)?;
        let mut pass = Pass::new();
        pass.dispatch(&compiled, &bindings, push, count as u32);
        let time = device_time(&self.device.run(&pass)?);
        let value = output.read()?;
        Ok(Timed { value, time })
    }

    /// Updates the arrays to `bvh` as of its last refit: the plan's copies, then the passes of a refit, whose time is returned.
    /// Nothing of `bvh` depends on what becomes of the device: if this fails, all is copied the next time, or to another device.
    pub fn follow<I>(&mut self, bvh: &lightbvh::Bvh<N, I, W>) -> Result<Duration, BackendError> {
        let frame = self.mirror.frame(bvh);
        let followed = self
            .copy_changes(bvh, &frame)
            .and_then(|()| self.refit(&frame.refit));
        if followed.is_err() {
            // The mirror believes that the frame was followed.
            self.mirror = Mirror::default();
        }
        Ok(followed?)
    }

    /// Runs the dispatches of a refit.
    fn refit(&self, refit: &Refit) -> Result<Duration, VulkanError> {
        if refit.dispatches.is_empty() {
            return Ok(Duration::ZERO);
        }
        let list = self.device.upload(&refit.list)?;
        // By which the passes hand over from children to nodes.
        let children = self
            .device
            .buffer::<u32>(refit.children as usize / size_of::<u32>())?;
        let mut pass = Pass::new();
        for dispatch in &refit.dispatches {
            let known = self.kernels.refit(dispatch.pass);
            let bind = |binding: &lightbvh_gpu::kernel::Binding| match binding.name {
                "list" => list.bind(),
                "children" => children.bind().of_elements(binding.stride),
                array => self.bind(array).expect("an array of the tree"),
            };
            let buffers: Vec<_> = known.bindings.iter().map(bind).collect();
            let kernel = self.device.kernel(known.name)?;
            pass.dispatch(&kernel, &buffers, bytes_of(&dispatch.push()), dispatch.count);
        }
        Ok(device_time(&self.device.run(&pass)?))
    }

    /// Makes the device's arrays those of `bvh`, but for the summaries that are refitted.
    fn copy_changes<I>(&mut self, bvh: &lightbvh::Bvh<N, I, W>, frame: &Frame) -> Result<(), VulkanError> {
        let device = self.device;
        renew(device, &mut self.nodes, bvh, frame, Array::Nodes)?;
        renew(device, &mut self.instances, bvh, frame, Array::Instances)?;
        renew(device, &mut self.trails, bvh, frame, Array::Trails)?;
        renew(device, &mut self.roots, bvh, frame, Array::Roots)?;
        renew(device, &mut self.triangles, bvh, frame, Array::Triangles)?;
        let top = self.mirror.top::<N>() as usize;
        self.bottoms = bvh.nodes().len();
        self.top = top..top + bvh.top_nodes().len();
        self.push = frame.words;
        Ok(())
    }
}

/// Does a frame's copies of one buffer. If its length changes, another buffer with what it held replaces it.
fn renew<T: Pod, N: Node<W>, I, const W: usize>(
    device: &Device,
    buffer: &mut Buffer<T>,
    bvh: &lightbvh::Bvh<N, I, W>,
    frame: &Frame,
    array: Array,
) -> Result<(), VulkanError> {
    let copies = frame.copies.iter().filter(|copy| copy.buffer == array);
    let parts: Vec<(usize, &[T])> = copies
        .map(|copy| {
            let first = copy.bytes.start as usize / size_of::<T>();
            (first, cast_slice(copy.source(bvh)))
        })
        .collect();
    let resized = frame.resizes.iter().find(|(resized, _)| *resized == array);
    let len = resized.map_or(buffer.len(), |(_, bytes)| *bytes as usize / size_of::<T>());
    if len == buffer.len() && parts.is_empty() {
        return Ok(());
    }
    if len != buffer.len() {
        let new = device.buffer(len)?;
        new.copy_from(buffer)?;
        *buffer = new;
    }
    buffer.write(&parts)
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    timings.kernels.unwrap_or(timings.wall)
}
