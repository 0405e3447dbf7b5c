//! A BVH and its edits on a device: what changed is copied, the rest is computed there.

use lightbvh::tree::Model;
use std::time::Duration;

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::node::Node;
use lightbvh::{Instance, TreeWords};
use lightbvh_gpu::{DeviceBuffer, Frame, KernelSet, Mirror, Step};

use super::record::held_by;
use super::{BackendError, Held, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// The arrays of a light BVH of any layout on a device, which follow its edits, and the kernels over them.
pub struct Mirrored<'d, N: Node<W>, const W: usize> {
    device: &'d Device,
    kernels: KernelSet,
    pub(super) nodes: Buffer<N>,
    lights: Buffer<N::Light>,
    instances: Buffer<Instance>,
    /// Bytes of the lights and instances that there are: kernels see no more of them.
    used: [usize; 2],
    pub(super) trails: Buffer<u32>,
    list: Buffer<u32>,
    children: Buffer<u32>,
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
            lights: device.buffer(0)?,
            instances: device.buffer(0)?,
            used: [0; 2],
            trails: device.buffer(0)?,
            list: device.buffer(0)?,
            children: device.buffer(0)?,
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

    /// Push constants of kernels that walk the tree.
    pub fn words(&self) -> TreeWords {
        self.push
    }

    /// Index of the first node of the top level.
    pub(super) fn top(&self) -> usize {
        self.mirror.top::<N>() as usize
    }

    /// Reads each buffer that has words of `bvh`, which was followed last: those in use, to be compared with [`held`](super::held).
    pub fn held(&self, bvh: &lightbvh::Bvh<impl Model<W, Node = N>, W>) -> Result<Vec<Held>, BackendError> {
        held_by(bvh, &self.mirror, |buffer| Ok(Some(self.bind(buffer).read()?)))
    }

    /// A buffer as an argument.
    pub(super) fn bind(&self, buffer: DeviceBuffer) -> Binding {
        match buffer {
            DeviceBuffer::Nodes => self.nodes.bind(),
            DeviceBuffer::Lights => self.lights.bind().first(self.used[0]),
            DeviceBuffer::Instances => self.instances.bind().first(self.used[1]),
            DeviceBuffer::Trails => self.trails.bind(),
            DeviceBuffer::List => self.list.bind(),
            DeviceBuffer::Children => self.children.bind(),
        }
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
            let own = || DeviceBuffer::named(name).map_or_else(|| output.bind(), |buffer| self.bind(buffer));
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
    pub fn follow(
        &mut self,
        bvh: &lightbvh::Bvh<impl Model<W, Node = N>, W>,
    ) -> Result<Duration, BackendError> {
        let frame = self.mirror.frame(bvh);
        self.used = [
            size_of_val(bvh.view().lights()),
            size_of_val(bvh.view().instances()),
        ];
        let followed = self.write(&frame).and_then(|()| self.refit(&frame));
        if followed.is_err() {
            // The mirror believes that the frame was followed.
            self.mirror = Mirror::default();
        }
        self.push = frame.words;
        Ok(followed?)
    }

    /// Runs the dispatches of a refit.
    fn refit(&self, frame: &Frame<'_>) -> Result<Duration, VulkanError> {
        let mut all = Pass::new();
        let mut is_empty = true;
        for step in frame.steps() {
            let Step::Dispatch { pass, push, count } = step else {
                continue;
            };
            let known = self.kernels.refit(pass);
            let bind = |binding: &lightbvh_gpu::kernel::Binding| {
                let buffer = DeviceBuffer::named(binding.name).expect("a buffer of the tree");
                let buffer = self.bind(buffer);
                match binding.name {
                    "children" => buffer.of_elements(binding.stride),
                    _ => buffer,
                }
            };
            let buffers: Vec<_> = known.bindings.iter().map(bind).collect();
            all.dispatch(&self.device.kernel(known.name)?, &buffers, bytes_of(&push), count);
            is_empty = false;
        }
        match is_empty {
            true => Ok(Duration::ZERO),
            false => Ok(device_time(&self.device.run(&all)?)),
        }
    }

    /// Does the resizes and uploads of a frame.
    fn write(&mut self, frame: &Frame<'_>) -> Result<(), VulkanError> {
        let device = self.device;
        write(device, &mut self.nodes, frame, DeviceBuffer::Nodes)?;
        write(device, &mut self.lights, frame, DeviceBuffer::Lights)?;
        write(device, &mut self.instances, frame, DeviceBuffer::Instances)?;
        write(device, &mut self.trails, frame, DeviceBuffer::Trails)?;
        write(device, &mut self.list, frame, DeviceBuffer::List)?;
        write(device, &mut self.children, frame, DeviceBuffer::Children)
    }
}

/// Does a frame's resize and uploads of one buffer.
fn write<T: Pod>(
    device: &Device,
    buffer: &mut Buffer<T>,
    frame: &Frame<'_>,
    own: DeviceBuffer,
) -> Result<(), VulkanError> {
    let mut parts: Vec<(usize, &[T])> = Vec::new();
    for step in frame.steps() {
        match step {
            Step::Resize {
                buffer: resized,
                bytes,
            } if resized == own => {
                *buffer = device.buffer(bytes as usize / size_of::<T>())?;
            }
            Step::Upload {
                buffer: written,
                at,
                bytes,
            } if written == own => {
                parts.push((at as usize / size_of::<T>(), cast_slice(bytes)));
            }
            _ => {}
        }
    }
    match parts.is_empty() {
        true => Ok(()),
        false => buffer.write(&parts),
    }
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    timings.kernels.unwrap_or(timings.wall)
}
