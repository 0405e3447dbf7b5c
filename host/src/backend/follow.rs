//! Moving lights on a device: what changed is copied, the rest is computed there.

use std::ops::Range;

use bytemuck::{Pod, bytes_of};
use lightbvh::Lights;
use lightbvh_kernels::refit::RefitPush;

use super::device::{DeviceBackend, device_time};
use super::{LightScene, Timed};
use crate::vulkan::{Buffer, Device, Pass, VulkanError};

impl DeviceBackend<'_> {
    /// See [`Backend::follow`](super::Backend::follow).
    pub(super) fn follow_scene(
        &mut self,
        scene: &LightScene,
        lights: &Lights,
    ) -> Result<Timed<()>, VulkanError> {
        self.copy_changes(scene, lights)?;
        let work = scene.work();
        let mut lists = Vec::with_capacity(work.computed());
        let mut list = |entries: &[u32]| {
            let first = lists.len() as u32;
            lists.extend_from_slice(entries);
            let count = entries.len() as u32;
            RefitPush { first, count }
        };
        let bottom_leaves = list(&work.leaves);
        let bottom: Vec<_> = work
            .levels
            .ranges()
            .map(|range| list(&work.levels.nodes()[range]))
            .collect();
        let bottom_roots = list(&work.roots);
        let top_leaves = list(&work.instances);
        let top: Vec<_> = work
            .top
            .ranges()
            .map(|range| list(&work.top.nodes()[range]))
            .collect();
        if lists.is_empty() {
            return Ok(Timed {
                time: std::time::Duration::ZERO,
                value: (),
            });
        }

        let lists = self.device.upload(&lists)?;
        let [leaves, level, roots, instances] =
            ["refit_leaves", "refit_level", "refit_roots", "refit_instances"]
                .map(|name| self.device.kernel(name));
        let (leaves, level, roots, instances) = (leaves?, level?, roots?, instances?);
        let (listed, nodes) = (lists.bind(), self.nodes.bind());
        let by_triangle = [
            listed,
            self.local.as_ref().unwrap_or(&self.triangles).bind(),
            nodes,
        ];
        let by_level = [listed, nodes];
        let by_root = [listed, nodes, self.roots.bind()];
        let by_instance = [listed, self.meshes.bind(), self.roots.bind(), nodes];
        let mut pass = Pass::new();
        let dispatches = std::iter::once((&leaves, &by_triangle[..], &bottom_leaves))
            .chain(bottom.iter().map(|push| (&level, &by_level[..], push)))
            .chain([
                (&roots, &by_root[..], &bottom_roots),
                (&instances, &by_instance[..], &top_leaves),
            ])
            .chain(top.iter().map(|push| (&level, &by_level[..], push)));
        for (kernel, bindings, push) in dispatches {
            if push.count > 0 {
                pass.dispatch(kernel, bindings, bytes_of(push), push.count);
            }
        }
        let time = device_time(&self.device.run(&pass)?);
        Ok(Timed { time, value: () })
    }

    /// Makes the device's arrays those of `scene`, but for the bounds that are refitted.
    pub(super) fn copy_changes(&mut self, scene: &LightScene, lights: &Lights) -> Result<(), VulkanError> {
        let (device, tree, work) = (self.device, scene.tree(), scene.work());
        let words = tree.trail_words as usize;
        let trails: Vec<_> = work
            .written_trails
            .iter()
            .map(|range| range.start * words as u32..range.end * words as u32)
            .collect();
        let roots: Vec<_> = work.roots.iter().map(|&blas| blas..blas + 1).collect();
        renew(device, &mut self.nodes, tree.nodes, &work.written_nodes)?;
        renew(device, &mut self.meshes, tree.meshes, &work.written_instances)?;
        renew(device, &mut self.trails, tree.trails, &trails)?;
        renew(device, &mut self.roots, scene.roots(), &roots)?;
        match &mut self.local {
            Some(local) => renew(device, local, scene.triangles(), &work.written_triangles)?,
            None => self.local = Some(device.upload(scene.triangles())?),
        }
        let all = 0..lights.triangles().len() as u32;
        renew(device, &mut self.triangles, lights.triangles(), &[all])?;
        self.tree.root = tree.root;
        self.tree.trail_words = tree.trail_words;
        self.tree.two_level = 1;
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
