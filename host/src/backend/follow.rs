//! Moving lights on a device: what changed is copied, the rest is computed there.

use std::ops::Range;
use std::time::Duration;

use bytemuck::Pod;
use lightbvh_kernels::bvh::{Choice, TreePush};

use super::device::{DeviceBackend, Dispatches};
use super::{BackendError, Bvh, Follow, Timed};
use crate::vulkan::{Buffer, Device, VulkanError};

impl<C: Choice<W>, const W: usize> Follow<C, W> for DeviceBackend<'_, C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        self.copy_changes(bvh)?;
        let dispatches = Dispatches::new(bvh.work());
        let mut time = Duration::ZERO;
        if !dispatches.list.is_empty() {
            let lists = self.device.upload(&dispatches.list)?;
            time = self.refit_by(&lists, &dispatches)?;
        }
        Ok(Timed { time, value: () })
    }
}

impl<C: Choice<W>, const W: usize> DeviceBackend<'_, C, W> {
    /// Makes the device's arrays those of `bvh`, but for the summaries that are refitted.
    fn copy_changes(&mut self, bvh: &Bvh<C, W>) -> Result<(), BackendError> {
        let (device, tree, work) = (self.device, bvh.tree(), bvh.work());
        let words = tree.trail_words;
        let trails: Vec<_> = work
            .written_trails
            .iter()
            .map(|range| range.start * words..range.end * words)
            .collect();
        let roots: Vec<_> = work.roots.iter().map(|&blas| blas..blas + 1).collect();
        renew(device, &mut self.nodes, tree.nodes, &work.written_nodes)?;
        renew(
            device,
            &mut self.instances,
            tree.instances,
            &work.written_instances,
        )?;
        renew(device, &mut self.trails, tree.trails, &trails)?;
        renew(device, &mut self.roots, bvh.roots(), &roots)?;
        renew(
            device,
            &mut self.triangles,
            bvh.triangles(),
            &work.written_triangles,
        )?;
        self.tree = TreePush::of(&tree);
        Ok(())
    }
}

/// Copies the changed ranges, or everything into a new buffer where the length is another.
fn renew<T: Pod>(
    device: &Device,
    buffer: &mut Buffer<T>,
    data: &[T],
    changed: &[Range<u32>],
) -> Result<(), VulkanError> {
    if buffer.len() == data.len() {
        for range in changed {
            let range = range.start as usize..range.end as usize;
            buffer.write_from(range.start, &data[range])?;
        }
    } else {
        *buffer = device.upload(data)?;
    }
    Ok(())
}
