//! A BVH and its edits on a device: what changed is copied, the rest is computed there.

use std::ops::Range;
use std::time::Duration;

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::node::Node;
use lightbvh::refit::BlasRoot;
use lightbvh::{Instance, TreeWords};
use lightbvh_gpu::{Buffer as Array, Frame, Mirror, Pass as RefitPass, Refit};

use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// The arrays of a light BVH on a device, which follow its edits.
pub(super) struct DeviceTree<N, L> {
    pub nodes: Buffer<N>,
    /// How many of them are of bottom levels, and which are of the top level.
    pub bottoms: usize,
    pub top: Range<usize>,
    pub triangles: Buffer<L>,
    pub instances: Buffer<Instance>,
    pub roots: Buffer<BlasRoot>,
    pub trails: Buffer<u32>,
    pub push: TreeWords,
    mirror: Mirror,
}

impl<N: Pod, L: Pod> DeviceTree<N, L> {
    /// Empty arrays on `device`.
    pub fn new(device: &Device) -> Result<Self, VulkanError> {
        Ok(Self {
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

    /// All nodes: those of bottom levels, then of the top level.
    pub fn all_nodes(&self) -> Result<Vec<N>, VulkanError> {
        let nodes = self.nodes.read()?;
        Ok([&nodes[..self.bottoms], &nodes[self.top.clone()]].concat())
    }

    /// The arguments of the passes of queries.
    pub fn bindings(&self) -> [Binding; 3] {
        [self.nodes.bind(), self.instances.bind(), self.trails.bind()]
    }

    /// The array that a kernel's binding of this name takes.
    pub fn bind(&self, name: &str) -> Option<Binding> {
        Array::named(name).map(|array| match array {
            Array::Nodes => self.nodes.bind(),
            Array::Triangles => self.triangles.bind(),
            Array::Instances => self.instances.bind(),
            Array::Roots => self.roots.bind(),
            Array::Trails => self.trails.bind(),
        })
    }

    /// Copies what changed and refits by the kernels of these names; returns the time of the refit. Nothing of `bvh` depends on
    /// what becomes of the device: if this fails, all is copied the next time, or to another device.
    pub fn follow<I, const W: usize>(
        &mut self,
        device: &Device,
        bvh: &lightbvh::Bvh<N, I, W>,
        kernel: impl Fn(RefitPass) -> String,
    ) -> Result<Duration, VulkanError>
    where
        N: Node<W>,
    {
        let frame = self.mirror.frame(bvh);
        let followed = self
            .copy_changes(device, bvh, &frame)
            .and_then(|()| self.refit(device, &frame.refit, kernel));
        if followed.is_err() {
            // The mirror believes that the frame was followed.
            self.mirror = Mirror::default();
        }
        followed
    }

    /// Runs the dispatches of a refit.
    fn refit(
        &self,
        device: &Device,
        refit: &Refit,
        kernel: impl Fn(RefitPass) -> String,
    ) -> Result<Duration, VulkanError> {
        if refit.dispatches.is_empty() {
            return Ok(Duration::ZERO);
        }
        let list = device.upload(&refit.list)?;
        // By which the passes hand over from children to nodes.
        let children = device.buffer::<u32>(refit.children as usize / size_of::<u32>())?;
        let mut pass = Pass::new();
        for dispatch in &refit.dispatches {
            let kernel = device.kernel(&kernel(dispatch.pass))?;
            let known = lightbvh_gpu::Kernel::named(kernel.name()).map_or(&[][..], |known| known.bindings);
            let buffers: Vec<_> = known
                .iter()
                .map(|binding| match binding.name {
                    "list" => list.bind(),
                    "children" => children.bind().of_elements(binding.stride),
                    array => self.bind(array).expect("an array of the tree"),
                })
                .collect();
            pass.dispatch(&kernel, &buffers, bytes_of(&dispatch.push()), dispatch.count);
        }
        Ok(device_time(&device.run(&pass)?))
    }

    /// Makes the device's arrays those of `bvh`, but for the summaries that are refitted.
    fn copy_changes<I, const W: usize>(
        &mut self,
        device: &Device,
        bvh: &lightbvh::Bvh<N, I, W>,
        frame: &Frame,
    ) -> Result<(), VulkanError>
    where
        N: Node<W>,
    {
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
