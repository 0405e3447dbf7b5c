//! A BVH and its edits on a device: what changed is copied, the rest is computed there.

use std::sync::Arc;

use bytemuck::Pod;
use lightbvh::TreeWords;
use lightbvh_gpu::{Buffer as Array, Copy, Frame, Refit};
use lightbvh_kernels::bvh::Choice;

use super::device::DeviceBackend;
use super::device_arrays::own;
use super::{BackendError, Bvh, Follow, Timed};
use crate::vulkan::{Buffer, Device, VulkanError};

impl<C: Choice<W>, const W: usize> Follow<C, W> for DeviceBackend<'_, C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let frame = self.mirror.follow(bvh);
        self.copy_changes(bvh, &frame)?;
        let is_rewired = |copy: &Copy| matches!(copy.buffer, Array::Nodes | Array::Trails);
        if !frame.resizes.is_empty() || frame.copies.iter().any(is_rewired) {
            self.refit = Refit::new(&bvh.plan_of_everything());
            self.counts = bvh.mesh_counts();
        }
        let time = self.refit_by(&frame.refit)?;
        Ok(Timed { time, value: () })
    }
}

impl<C: Choice<W>, const W: usize> DeviceBackend<'_, C, W> {
    /// Makes the device's arrays those of `bvh`, but for the summaries that are refitted.
    fn copy_changes(&mut self, bvh: &Bvh<C, W>, frame: &Frame) -> Result<(), BackendError> {
        let (device, tree) = (self.device, bvh.tree());
        renew(device, &mut self.tree.nodes, tree.nodes, frame, Array::Nodes)?;
        renew_shared(
            device,
            &mut self.tree.emitters.instances,
            tree.instances,
            frame,
            Array::Instances,
        )?;
        renew(device, &mut self.tree.trails, tree.trails, frame, Array::Trails)?;
        renew(device, &mut self.roots, bvh.roots(), frame, Array::Roots)?;
        renew_shared(
            device,
            &mut self.tree.emitters.triangles,
            bvh.triangles(),
            frame,
            Array::Triangles,
        )?;
        self.tree.push = TreeWords::of(&tree);
        Ok(())
    }
}

/// Does a frame's copies of one array; one of another size is copied as a whole, for the scene's own nodes are refitted too.
fn renew<T: Pod>(
    device: &Device,
    buffer: &mut Buffer<T>,
    data: &[T],
    frame: &Frame,
    array: Array,
) -> Result<(), VulkanError> {
    if frame.resizes.iter().any(|(resized, _)| *resized == array) {
        *buffer = device.upload(data)?;
        return Ok(());
    }
    for copy in frame.copies.iter().filter(|copy| copy.buffer == array) {
        let element = |byte: u64| byte as usize / size_of::<T>();
        let first = element(copy.bytes.start);
        buffer.write_from(first, &data[first..element(copy.bytes.end)])?;
    }
    Ok(())
}

/// [`renew`] of an array that the frame before may still be read from.
fn renew_shared<T: Pod>(
    device: &Device,
    buffer: &mut Arc<Buffer<T>>,
    data: &[T],
    frame: &Frame,
    array: Array,
) -> Result<(), VulkanError> {
    let touched = frame.copies.iter().any(|copy| copy.buffer == array);
    if frame.resizes.iter().any(|(resized, _)| *resized == array) {
        *buffer = Arc::new(device.upload(data)?);
    } else if touched {
        renew(device, own(buffer)?, data, frame, array)?;
    }
    Ok(())
}
