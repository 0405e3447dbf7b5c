//! A BVH and its edits on a device: what changed is copied, the rest is computed there.

use std::ops::Range;
use std::time::Duration;

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::node::Node;
use lightbvh::refit::BlasRoot;
use lightbvh::{Instance, TreeWords};
use lightbvh_gpu::{DeviceBuffer, Frame, Mirror, Pass as RefitPass, Step};

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
    list: Buffer<u32>,
    children: Buffer<u32>,
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
            list: device.buffer(0)?,
            children: device.buffer(0)?,
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
        DeviceBuffer::named(name).map(|buffer| match buffer {
            DeviceBuffer::Nodes => self.nodes.bind(),
            DeviceBuffer::Triangles => self.triangles.bind(),
            DeviceBuffer::Instances => self.instances.bind(),
            DeviceBuffer::Roots => self.roots.bind(),
            DeviceBuffer::Trails => self.trails.bind(),
            DeviceBuffer::List => self.list.bind(),
            DeviceBuffer::Children => self.children.bind(),
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
            .write(device, &frame)
            .and_then(|()| self.refit(device, &frame, kernel));
        if followed.is_err() {
            // The mirror believes that the frame was followed.
            self.mirror = Mirror::default();
        }
        let top = self.mirror.top::<N>() as usize;
        self.bottoms = bvh.nodes().len();
        self.top = top..top + bvh.top_nodes().len();
        self.push = frame.words;
        followed
    }

    /// Runs the dispatches of a refit.
    fn refit(
        &self,
        device: &Device,
        frame: &Frame<'_>,
        kernel: impl Fn(RefitPass) -> String,
    ) -> Result<Duration, VulkanError> {
        let mut all = Pass::new();
        let mut is_empty = true;
        for step in frame.steps() {
            let Step::Dispatch { pass, push, count } = step else {
                continue;
            };
            let kernel = device.kernel(&kernel(pass))?;
            let known = lightbvh_gpu::Kernel::named(kernel.name()).map_or(&[][..], |known| known.bindings);
            let buffer =
                |binding: &lightbvh_gpu::Binding| self.bind(binding.name).expect("a buffer of the tree");
            let buffers: Vec<_> = known
                .iter()
                .map(|binding| match binding.name {
                    "children" => buffer(binding).of_elements(binding.stride),
                    _ => buffer(binding),
                })
                .collect();
            all.dispatch(&kernel, &buffers, bytes_of(&push), count);
            is_empty = false;
        }
        match is_empty {
            true => Ok(Duration::ZERO),
            false => Ok(device_time(&device.run(&all)?)),
        }
    }

    /// Does the resizes and uploads of a frame.
    fn write(&mut self, device: &Device, frame: &Frame<'_>) -> Result<(), VulkanError> {
        write(device, &mut self.nodes, frame, DeviceBuffer::Nodes)?;
        write(device, &mut self.triangles, frame, DeviceBuffer::Triangles)?;
        write(device, &mut self.instances, frame, DeviceBuffer::Instances)?;
        write(device, &mut self.roots, frame, DeviceBuffer::Roots)?;
        write(device, &mut self.trails, frame, DeviceBuffer::Trails)?;
        write(device, &mut self.list, frame, DeviceBuffer::List)?;
        write(device, &mut self.children, frame, DeviceBuffer::Children)
    }
}

/// Does a frame's resize and uploads of one buffer. If something else still reads it, another with what it held replaces it.
fn write<T: Pod>(
    device: &Device,
    buffer: &mut Buffer<T>,
    frame: &Frame<'_>,
    own: DeviceBuffer,
) -> Result<(), VulkanError> {
    let mut parts: Vec<(usize, &[T])> = Vec::new();
    let mut size = None;
    for step in frame.steps() {
        match step {
            Step::Resize { buffer, bytes } if buffer == own => size = Some(bytes as usize / size_of::<T>()),
            Step::Upload { buffer, at, bytes } if buffer == own => {
                parts.push((at as usize / size_of::<T>(), cast_slice(bytes)));
            }
            _ => {}
        }
    }
    if let Some(size) = size {
        *buffer = device.buffer(size)?;
    } else if parts.is_empty() {
        return Ok(());
    } else if buffer.is_bound() {
        let new = device.buffer(buffer.len())?;
        new.copy_from(buffer)?;
        *buffer = new;
    }
    buffer.write(&parts)
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    timings.kernels.unwrap_or(timings.wall)
}
