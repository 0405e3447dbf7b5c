//! A light BVH of any layout on a device, for kernels that no renderer takes.

use bytemuck::{Pod, Zeroable, cast_slice, cast_slice_mut};
use lightbvh::node::Node;
use lightbvh::refit::BlasRoot;
use lightbvh::{Bvh, Instance, TreeWords};
use lightbvh_gpu::{Buffer as Array, Frame, KernelSet, Mirror};

use super::BackendError;
use crate::vulkan::{Binding, Buffer, Device, Pass};

/// The arrays of a light BVH on a device, which follows it by what [`Mirror`] tells of each frame.
///
/// Arrays are read, changed as told, and written whole: it is for comparisons. [`DeviceBackend`](super::DeviceBackend) copies
/// what changed.
pub struct Mirrored<'d, N: Node<W>, const W: usize> {
    device: &'d Device,
    kernels: KernelSet,
    mirror: Mirror,
    nodes: Buffer<N>,
    lights: Buffer<N::Light>,
    instances: Buffer<Instance>,
    roots: Buffer<BlasRoot>,
    trails: Buffer<u32>,
    words: TreeWords,
    /// Numbers of nodes of bottom levels, and of the top level.
    counts: [usize; 2],
}

impl<'d, N: Node<W>, const W: usize> Mirrored<'d, N, W> {
    /// One that holds nothing yet, refitted by the kernels of its layout.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn new(device: &'d Device, kernels: KernelSet) -> Result<Self, BackendError> {
        Ok(Self {
            device,
            kernels,
            mirror: Mirror::default(),
            nodes: device.upload(&[N::zeroed()])?,
            lights: device.upload(&[N::Light::zeroed()])?,
            instances: device.upload(&[Instance::zeroed()])?,
            roots: device.upload(&[BlasRoot::zeroed()])?,
            trails: device.upload(&[0])?,
            words: TreeWords::default(),
            counts: [0; 2],
        })
    }

    /// The device.
    pub fn device(&self) -> &'d Device {
        self.device
    }

    /// Updates the arrays to `bvh` as of its last refit: the plan's copies, then the passes of a refit.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn follow<I>(&mut self, bvh: &Bvh<N, I, W>) -> Result<(), BackendError> {
        let frame = self.mirror.frame(bvh);
        let device = self.device;
        self.nodes = updated(device, &self.nodes, Array::Nodes, &frame, bvh)?;
        self.lights = updated(device, &self.lights, Array::Triangles, &frame, bvh)?;
        self.instances = updated(device, &self.instances, Array::Instances, &frame, bvh)?;
        self.roots = updated(device, &self.roots, Array::Roots, &frame, bvh)?;
        self.trails = updated(device, &self.trails, Array::Trails, &frame, bvh)?;
        self.words = frame.words;
        self.counts = [bvh.nodes().len(), bvh.top_nodes().len()];
        if frame.refit.dispatches.is_empty() {
            return Ok(());
        }
        let list = device.upload(&frame.refit.list)?;
        let children = device.output::<u32>(frame.refit.children as usize / size_of::<u32>())?;
        let mut pass = Pass::new();
        for dispatch in &frame.refit.dispatches {
            let kernel = self.kernels.refit(dispatch.pass);
            let bindings: Vec<_> = kernel
                .bindings
                .iter()
                .map(|binding| match binding.name {
                    "list" => list.bind(),
                    "children" => children.bind().of_elements(binding.stride),
                    array => self.bind(array).expect("an array of the tree"),
                })
                .collect();
            let compiled = device.kernel(kernel.name)?;
            pass.dispatch(&compiled, &bindings, cast_slice(&dispatch.push()), dispatch.count);
        }
        device.run(&pass)?;
        Ok(())
    }

    /// All nodes: those of bottom levels, then those of the top level.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn nodes(&self) -> Result<Vec<N>, BackendError> {
        let nodes = self.nodes.read()?;
        let top = self.mirror.top::<N>() as usize;
        let [bottoms, count] = self.counts;
        Ok([&nodes[..bottoms], &nodes[top..top + count]].concat())
    }

    /// Push constants of kernels that walk the tree.
    pub fn words(&self) -> TreeWords {
        self.words
    }

    /// The roots of bottom levels.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn roots(&self) -> Result<Vec<BlasRoot>, BackendError> {
        Ok(self.roots.read()?)
    }

    /// The results of a kernel over `count` invocations. It takes the arrays of the tree and, by the names of its bindings,
    /// `others`; what is named nowhere are its results.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn ask<T: Pod>(
        &self,
        kernel: &lightbvh_gpu::kernel::Kernel,
        count: usize,
        push: &[u8],
        others: &[(&str, Binding)],
    ) -> Result<Vec<T>, BackendError> {
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
        self.device.run(&pass)?;
        Ok(output.read()?)
    }

    fn bind(&self, name: &str) -> Option<Binding> {
        Array::named(name).map(|array| match array {
            Array::Nodes => self.nodes.bind(),
            Array::Triangles => self.lights.bind(),
            Array::Instances => self.instances.bind(),
            Array::Roots => self.roots.bind(),
            Array::Trails => self.trails.bind(),
        })
    }
}

/// An array on the device again, of as many bytes and with what `frame` copies into it.
fn updated<T: Pod, N: Node<W>, I, const W: usize>(
    device: &Device,
    array: &Buffer<T>,
    which: Array,
    frame: &Frame,
    bvh: &Bvh<N, I, W>,
) -> Result<Buffer<T>, BackendError> {
    let mut held = array.read()?;
    if let Some((_, bytes)) = frame.resizes.iter().find(|(buffer, _)| *buffer == which) {
        // New memory holds anything.
        let anything = bytemuck::pod_read_unaligned(&vec![0xcd; size_of::<T>()]);
        held.resize((*bytes as usize / size_of::<T>()).max(1), anything);
    }
    for copy in frame.copies.iter().filter(|copy| copy.buffer == which) {
        let bytes: &mut [u8] = cast_slice_mut(&mut held);
        bytes[copy.bytes.start as usize..copy.bytes.end as usize].copy_from_slice(copy.source(bvh));
    }
    Ok(device.upload(&held)?)
}
