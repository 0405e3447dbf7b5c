//! Running a pass: one command buffer, one submission, one wait.

use super::device::Device;
use super::error::{CallContext, VulkanError};
use super::pass::{Dispatch, Pass};
use super::queue::barrier;
use super::shared::Shared;
use ash::vk;
use lightbvh_gpu::groups;
use std::time::{Duration, Instant};

/// How long a pass took.
#[derive(Clone, Copy, Debug, Default)]
pub struct Timings {
    /// From submission to the end of the wait, on the host's clock.
    pub wall: Duration,
    /// All dispatches on the device's clock, barriers included; `None` if the device keeps no time.
    pub kernels: Option<Duration>,
}

/// Descriptor sets of one run.
struct Sets<'a> {
    shared: &'a Shared,
    pool: vk::DescriptorPool,
}

impl Device {
    /// Runs all of a pass in order and waits for its end.
    pub fn run(&self, pass: &Pass) -> Result<Timings, VulkanError> {
        let shared = &*self.shared;
        for dispatch in &pass.dispatches {
            dispatch.check(shared)?;
        }
        if pass.dispatches.is_empty() {
            return Ok(Timings::default());
        }
        let mut bound = Sets {
            shared,
            pool: vk::DescriptorPool::null(),
        };
        let sets = bound.bind(&pass.dispatches)?;
        let start = Instant::now();
        let kernels = shared.run(|device, commands| {
            for (dispatch, set) in pass.dispatches.iter().zip(sets) {
                record(device, commands, dispatch, set);
                barrier(device, commands);
            }
        })?;
        Ok(Timings {
            wall: start.elapsed(),
            kernels,
        })
    }
}

impl Sets<'_> {
    /// A descriptor set for each dispatch, with its buffers in it.
    fn bind(&mut self, dispatches: &[Dispatch]) -> Result<Vec<vk::DescriptorSet>, VulkanError> {
        let (device, name) = (&self.shared.raw, self.shared.probe.name.as_str());
        let count: usize = dispatches.iter().map(|dispatch| dispatch.buffers.len()).sum();
        let sizes = [vk::DescriptorPoolSize {
            ty: vk::DescriptorType::STORAGE_BUFFER,
            descriptor_count: count.max(1) as u32,
        }];
        let info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(dispatches.len() as u32)
            .pool_sizes(&sizes);
        // SAFETY: the device is alive and `info` outlives the call; the pool is destroyed in `drop`.
        self.pool =
            unsafe { device.create_descriptor_pool(&info, None) }.during("vkCreateDescriptorPool", name)?;
        let layouts: Vec<_> = dispatches
            .iter()
            .map(|dispatch| dispatch.kernel.set_layout)
            .collect();
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.pool)
            .set_layouts(&layouts);
        // SAFETY: the layouts belong to this device (`Dispatch::check`) and the pool is large enough for them.
        let sets =
            unsafe { device.allocate_descriptor_sets(&info) }.during("vkAllocateDescriptorSets", name)?;
        for (dispatch, set) in dispatches.iter().zip(&sets) {
            let buffers: Vec<_> = dispatch
                .buffers
                .iter()
                .map(|binding| vk::DescriptorBufferInfo {
                    buffer: binding.memory.buffer,
                    offset: 0,
                    range: binding.bytes.max(4),
                })
                .collect();
            let writes: Vec<_> = (0u32..)
                .zip(buffers.chunks(1))
                .map(|(binding, buffer)| {
                    vk::WriteDescriptorSet::default()
                        .dst_set(*set)
                        .dst_binding(binding)
                        .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                        .buffer_info(buffer)
                })
                .collect();
            // SAFETY: set and buffers belong to this device; the set has as many bindings as there are buffers
            // (`Dispatch::check`), and no submission uses it yet.
            unsafe { device.update_descriptor_sets(&writes, &[]) };
        }
        Ok(sets)
    }
}

impl Drop for Sets<'_> {
    fn drop(&mut self) {
        // SAFETY: the pool belongs to this device or is null, and the run that used it has ended.
        unsafe { self.shared.raw.destroy_descriptor_pool(self.pool, None) };
    }
}

fn record(device: &ash::Device, commands: vk::CommandBuffer, dispatch: &Dispatch, set: vk::DescriptorSet) {
    let kernel = &dispatch.kernel;
    let Some([x, y, z]) = groups(dispatch.invocations, kernel.interface.workgroup[0]) else {
        return; // Refused by `Dispatch::check`.
    };
    if x == 0 {
        return;
    }
    let compute = vk::PipelineBindPoint::COMPUTE;
    // SAFETY: the command buffer is recording; pipeline, layout and set belong to this device and match in bindings and
    // push constants (`Dispatch::check`); the counts are within what every device allows. What is bound outlives the
    // submission, for the pass holds buffers and kernels.
    unsafe {
        device.cmd_bind_pipeline(commands, compute, kernel.pipeline);
        device.cmd_bind_descriptor_sets(commands, compute, kernel.layout, 0, &[set], &[]);
        if !dispatch.push.is_empty() {
            let stage = vk::ShaderStageFlags::COMPUTE;
            device.cmd_push_constants(commands, kernel.layout, stage, 0, &dispatch.push);
        }
        device.cmd_dispatch(commands, x, y, z);
    }
}
