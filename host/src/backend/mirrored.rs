//! A light BVH of any layout on a device, for kernels that no renderer takes.

use bytemuck::Pod;
use lightbvh::node::Node;
use lightbvh::refit::BlasRoot;
use lightbvh::{Bvh, TreeWords};
use lightbvh_gpu::KernelSet;

use super::BackendError;
use super::follow::DeviceTree;
use crate::vulkan::{Binding, Device, Pass};

/// The arrays of a light BVH on a device, which follow its edits.
pub struct Mirrored<'d, N: Node<W>, const W: usize> {
    device: &'d Device,
    kernels: KernelSet,
    tree: DeviceTree<N, N::Light>,
}

impl<'d, N: Node<W>, const W: usize> Mirrored<'d, N, W> {
    /// One that holds nothing yet, refitted by the kernels of its layout.
    pub fn new(device: &'d Device, kernels: KernelSet) -> Result<Self, BackendError> {
        Ok(Self {
            device,
            kernels,
            tree: DeviceTree::new(device)?,
        })
    }

    /// The device.
    pub fn device(&self) -> &'d Device {
        self.device
    }

    /// Updates the arrays to `bvh` as of its last refit: the plan's copies, then the passes of a refit.
    pub fn follow<I>(&mut self, bvh: &Bvh<N, I, W>) -> Result<(), BackendError> {
        let kernels = &self.kernels;
        self.tree
            .follow(self.device, bvh, |pass| kernels.refit(pass).name.to_owned())?;
        Ok(())
    }

    /// All nodes: those of bottom levels, then those of the top level.
    pub fn nodes(&self) -> Result<Vec<N>, BackendError> {
        Ok(self.tree.all_nodes()?)
    }

    /// Push constants of kernels that walk the tree.
    pub fn words(&self) -> TreeWords {
        self.tree.push
    }

    /// The roots of bottom levels.
    pub fn roots(&self) -> Result<Vec<BlasRoot>, BackendError> {
        Ok(self.tree.roots.read()?)
    }

    /// The results of a kernel over `count` invocations. Bindings are matched by name with the tree's arrays and `others`;
    /// the remaining binding holds the results.
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
            let own = || self.tree.bind(name).unwrap_or_else(|| output.bind());
            other.map_or_else(own, |(_, binding)| binding.clone())
        };
        let bindings: Vec<_> = kernel.bindings.iter().map(|binding| bind(binding.name)).collect();
        let compiled = self.device.kernel(kernel.name)?;
        let mut pass = Pass::new();
        pass.dispatch(&compiled, &bindings, push, count as u32);
        self.device.run(&pass)?;
        Ok(output.read()?)
    }
}
