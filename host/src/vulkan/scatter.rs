//! Many short runs of words, put in their places by one dispatch where a copy command would be one copy for each.

use super::buffer::Binding;
use super::error::{CallContext, VulkanError};
use super::kernel::Kernel;
use super::memory::Region;
use super::shared::Shared;
use ash::vk;
use lightbvh_gpu::groups;
use lightbvh_kernels::scatter::{LANES, Run, ScatterPush};

/// The kernel.
pub(super) const KERNEL: &str = "scatter";
/// So many runs of a buffer are copied as regions.
pub(super) const FEW: usize = 16;
/// Longer runs are copied as regions, bytes.
const SHORT: u64 = 4096;
/// Bytes of a run's entry in the list.
pub(super) const ENTRY: u64 = size_of::<Run>() as u64;

/// Runs of one buffer.
pub(super) struct Scatter {
    target: Binding,
    /// Their first entry in the list of all.
    first: u32,
    runs: u32,
}

impl Scatter {
    /// Takes from the `regions` of a buffer those that are short, where they are more than [`FEW`], into the list of all.
    pub fn take(target: &Binding, regions: &mut Vec<Region>, list: &mut Vec<Run>) -> Option<Self> {
        let is_short = |region: &Region| region.bytes <= SHORT;
        if regions.iter().filter(|region| is_short(region)).count() <= FEW {
            return None;
        }
        let words = |bytes: u64| (bytes / 4) as u32;
        let first = list.len() as u32;
        list.extend(
            regions
                .extract_if(.., |region| is_short(region))
                .map(|region| Run {
                    from: words(region.from),
                    to: words(region.to),
                    words: words(region.bytes),
                }),
        );
        Some(Self {
            target: target.clone(),
            first,
            runs: list.len() as u32 - first,
        })
    }

    /// Runs.
    pub fn len(&self) -> u64 {
        self.runs.into()
    }

    /// Records the dispatch. The part begins at the word `start` of the ring, the list of all at the word `list`.
    pub fn record(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        (kernel, set): (&Kernel, vk::DescriptorSet),
        ring: vk::Buffer,
        (start, list): (u32, u32),
    ) {
        let push = ScatterPush {
            runs: self.runs,
            list: list + self.first * (ENTRY / 4) as u32,
            first: start,
        };
        // Runs have 16 bytes of a part, 16 MiB, each.
        let Some([x, y, z]) = groups(self.runs * LANES, kernel.interface.workgroup[0]) else {
            return;
        };
        let whole = |buffer| vk::DescriptorBufferInfo {
            buffer,
            offset: 0,
            range: vk::WHOLE_SIZE,
        };
        let buffers = [[whole(ring)], [whole(self.target.memory.buffer)]];
        let writes = [0, 1].map(|binding: u32| {
            vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&buffers[binding as usize])
        });
        let compute = vk::PipelineBindPoint::COMPUTE;
        let stage = vk::ShaderStageFlags::COMPUTE;
        // SAFETY: the command buffer is recording; set, kernel, ring and target belong to this device; the set was made for the
        // kernel, has two storage buffers, and no submission uses it yet. Both buffers were made for storage and are no longer
        // than a binding may be. All live until the submission has ended (`retire`).
        unsafe {
            device.update_descriptor_sets(&writes, &[]);
            device.cmd_bind_pipeline(commands, compute, kernel.pipeline);
            device.cmd_bind_descriptor_sets(commands, compute, kernel.layout, 0, &[set], &[]);
            device.cmd_push_constants(commands, kernel.layout, stage, 0, bytemuck::bytes_of(&push));
            device.cmd_dispatch(commands, x, y, z);
        }
    }
}

/// A pool with `count` sets, more than none, for the kernel.
pub(super) fn sets(
    shared: &Shared,
    kernel: &Kernel,
    count: u32,
) -> Result<(vk::DescriptorPool, Vec<vk::DescriptorSet>), VulkanError> {
    let (device, name) = (&shared.raw, shared.probe.name.as_str());
    let sizes = [vk::DescriptorPoolSize {
        ty: vk::DescriptorType::STORAGE_BUFFER,
        descriptor_count: 2 * count,
    }];
    let info = vk::DescriptorPoolCreateInfo::default()
        .max_sets(count)
        .pool_sizes(&sizes);
    // SAFETY: the device is alive and `info` outlives the call; the caller destroys the pool.
    let pool =
        unsafe { device.create_descriptor_pool(&info, None) }.during("vkCreateDescriptorPool", name)?;
    let layouts = vec![kernel.set_layout; count as usize];
    let info = vk::DescriptorSetAllocateInfo::default()
        .descriptor_pool(pool)
        .set_layouts(&layouts);
    // SAFETY: the layout belongs to this device and the pool is large enough.
    let sets = unsafe { device.allocate_descriptor_sets(&info) }.during("vkAllocateDescriptorSets", name);
    sets.map(|sets| (pool, sets)).inspect_err(|_| {
        // SAFETY: it was made above, and nothing uses it.
        unsafe { device.destroy_descriptor_pool(pool, None) };
    })
}
