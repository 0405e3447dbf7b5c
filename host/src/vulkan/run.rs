//! Running a pass: one command buffer, one submission, a time for each dispatch.

use super::counts::count;
use super::device::Device;
use super::error::{CallContext, VulkanError};
use super::kernel::Kernel;
use super::memory::{Region, copy, fill};
use super::pass::{Dispatch, Pass};
use super::queue::Retired;
use super::scatter;
use super::shared::Shared;
use super::upload::Part;
use crate::words::UNWRITTEN;
use ash::vk;
use lightbvh_gpu::groups;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long a pass took.
#[derive(Clone, Debug)]
pub struct Timings {
    /// From submission to the end of the wait, on the host's clock.
    pub wall: Duration,
    /// Nanoseconds of each dispatch on the device's clock, barrier included; `None` if the device keeps no time.
    pub dispatch_ns: Option<Vec<f64>>,
}

impl Timings {
    /// Without the times of the first `dispatches`.
    pub(crate) fn after(mut self, dispatches: usize) -> Self {
        if let Some(ns) = &mut self.dispatch_ns {
            ns.drain(..dispatches.min(ns.len()));
        }
        self
    }
}

/// A pass under way. Dropping it waits for nothing.
pub struct Submission {
    scratch: Scratch,
    number: u64,
    start: Instant,
    /// Dispatches whose times are kept, where they are.
    timed: Option<usize>,
}

/// Vulkan objects of one run.
struct Scratch {
    shared: Arc<Shared>,
    sets: vk::DescriptorPool,
    /// Of the dispatches that put the host's bytes in their places.
    scatters: vk::DescriptorPool,
    queries: vk::QueryPool,
}

impl Device {
    /// Runs all of a pass in order and waits for the last.
    ///
    /// # Errors
    /// Those of [`Device::submit`] and [`Submission::wait`].
    pub fn run(&self, pass: &Pass<'_>) -> Result<Timings, VulkanError> {
        self.submit(pass)?.wait()
    }

    /// Submits a pass, all of it in one submission unless it writes more than 16 MiB, and waits for nothing but a place: three
    /// submissions are under way at most. Passes run in the order of their submission, each seeing what those before it wrote.
    ///
    /// # Errors
    /// [`VulkanError::BadDispatch`], [`VulkanError::ForeignObject`] or [`VulkanError::OverlappingWrites`] before anything is
    /// submitted; [`VulkanError::Timeout`], [`VulkanError::Busy`], [`VulkanError::DeviceLost`], [`VulkanError::Validation`] or
    /// [`VulkanError::Call`].
    pub fn submit(&self, pass: &Pass<'_>) -> Result<Submission, VulkanError> {
        let shared = &self.shared;
        let writes = pass.check(shared)?;
        let mut scratch = Scratch {
            shared: Arc::clone(shared),
            sets: vk::DescriptorPool::null(),
            scatters: vk::DescriptorPool::null(),
            queries: vk::QueryPool::null(),
        };
        let sets = scratch.bind(&pass.dispatches)?;
        let has_clock = shared.probe.limits.timestamp_valid_bits > 0;
        let timed = has_clock && !pass.dispatches.is_empty();
        if timed {
            scratch.make_queries(pass.len() as u32 + 1)?;
        }
        let queries = scratch.queries;
        let start = Instant::now();
        let mut parts = Part::split(&writes);
        let scatter = self.kernel(scatter::KERNEL)?;
        let all_sets = scratch.bind_scatters(&scatter, &parts)?;
        let mut all_sets = all_sets.as_slice();
        let Some(last) = parts.pop() else {
            unreachable!("there is always a last part")
        };
        // What is filled and carried comes first.
        let mut first = Some((&pass.fills, &pass.carries));
        for part in &parts {
            let first = first.take();
            let stage = |place: &mut [u8]| part.stage(place);
            let (own, others) = all_sets.split_at(part.dispatches());
            shared.submit(
                part.name(),
                part.bytes(),
                stage,
                |device, commands, ring, start| {
                    if let Some((fills, carries)) = first {
                        prepare(device, commands, fills, carries);
                    }
                    part.record(device, commands, (ring, start), &scatter, own);
                },
            )?;
            count(&shared.counters.regions, part.regions());
            count(&shared.counters.runs, part.runs());
            all_sets = others;
        }
        let work = match pass.dispatches.as_slice() {
            [] => last.name(),
            dispatches => {
                let names: Vec<&str> = dispatches.iter().map(|dispatch| dispatch.kernel.name()).collect();
                names.join(", ")
            }
        };
        let first = first.take();
        let stage = |place: &mut [u8]| last.stage(place);
        let number = shared.submit(work, last.bytes(), stage, |device, commands, ring, start| {
            if let Some((fills, carries)) = first {
                prepare(device, commands, fills, carries);
            }
            last.record(device, commands, (ring, start), &scatter, all_sets);
            if !last.is_empty()
                || first.is_some_and(|(fills, carries)| !fills.is_empty() || !carries.is_empty())
            {
                barrier(device, commands);
            }
            if timed {
                stamp_first(device, commands, queries, pass.len() as u32 + 1);
            }
            for (index, (dispatch, set)) in (1..).zip(pass.dispatches.iter().zip(&sets)) {
                record(device, commands, dispatch, *set);
                barrier(device, commands);
                if timed {
                    stamp(device, commands, queries, index);
                }
            }
        })?;
        let carried = pass.carries.len() as u64;
        count(&shared.counters.regions, last.regions() + carried);
        count(&shared.counters.runs, last.runs());
        Ok(Submission {
            scratch,
            number,
            start,
            timed: has_clock.then_some(pass.len()),
        })
    }
}

impl Submission {
    /// Waits for the end.
    ///
    /// # Errors
    /// [`VulkanError::Timeout`], [`VulkanError::Busy`], [`VulkanError::DeviceLost`], [`VulkanError::Validation`] or
    /// [`VulkanError::Call`].
    pub fn wait(self) -> Result<Timings, VulkanError> {
        let shared = &*self.scratch.shared;
        shared.wait_for(&mut shared.queue(), self.number)?;
        let wall = self.start.elapsed();
        shared.check_validation()?;
        let dispatch_ns = self
            .timed
            .map(|count| self.scratch.durations(count))
            .transpose()?;
        Ok(Timings { wall, dispatch_ns })
    }
}

/// Records what comes before the host's bytes.
fn prepare(
    device: &ash::Device,
    commands: vk::CommandBuffer,
    fills: &[super::Binding],
    carries: &[(super::Binding, super::Binding, u64)],
) {
    for binding in fills {
        fill(device, commands, &binding.memory, UNWRITTEN);
    }
    if !fills.is_empty() && !carries.is_empty() {
        barrier(device, commands);
    }
    for &(ref from, ref to, bytes) in carries {
        let whole = Region {
            from: 0,
            to: 0,
            bytes,
        };
        copy(device, commands, from.memory.buffer, to.memory.buffer, &[whole]);
    }
    if !fills.is_empty() || !carries.is_empty() {
        barrier(device, commands);
    }
}

impl Scratch {
    /// A descriptor set for each dispatch, with its buffers in it.
    fn bind(&mut self, dispatches: &[Dispatch]) -> Result<Vec<vk::DescriptorSet>, VulkanError> {
        if dispatches.is_empty() {
            return Ok(Vec::new());
        }
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
        self.sets =
            unsafe { device.create_descriptor_pool(&info, None) }.during("vkCreateDescriptorPool", name)?;
        let layouts: Vec<_> = dispatches
            .iter()
            .map(|dispatch| dispatch.kernel.set_layout)
            .collect();
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.sets)
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

    /// A set for each dispatch that puts bytes in their places.
    fn bind_scatters(
        &mut self,
        kernel: &Kernel,
        parts: &[Part<'_>],
    ) -> Result<Vec<vk::DescriptorSet>, VulkanError> {
        let count: usize = parts.iter().map(Part::dispatches).sum();
        if count == 0 {
            return Ok(Vec::new());
        }
        let (pool, sets) = scatter::sets(&self.shared, kernel, count as u32)?;
        self.scatters = pool;
        Ok(sets)
    }

    fn make_queries(&mut self, count: u32) -> Result<(), VulkanError> {
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::TIMESTAMP)
            .query_count(count);
        // SAFETY: the device is alive; the pool is destroyed in `drop`.
        self.queries = unsafe { self.shared.raw.create_query_pool(&info, None) }
            .during("vkCreateQueryPool", &self.shared.probe.name)?;
        Ok(())
    }

    /// Nanoseconds from each timestamp to the next.
    fn durations(&self, dispatches: usize) -> Result<Vec<f64>, VulkanError> {
        if dispatches == 0 {
            return Ok(Vec::new());
        }
        let mut ticks = vec![0u64; dispatches + 1];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        let raw = &self.shared.raw;
        self.shared
            .faults
            .before(raw)
            // SAFETY: the pool belongs to this device and all its queries were written by the submission that has ended.
            .and_then(|()| unsafe { raw.get_query_pool_results(self.queries, 0, &mut ticks, flags) })
            .during("vkGetQueryPoolResults", &self.shared.probe.name)?;
        let limits = &self.shared.probe.limits;
        let period = f64::from(limits.timestamp_period);
        let bits = limits.timestamp_valid_bits;
        Ok(ticks
            .windows(2)
            .map(|pair| elapsed(pair[0], pair[1], bits) as f64 * period)
            .collect())
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        self.shared.retire(Retired::Sets(self.sets));
        self.shared.retire(Retired::Sets(self.scatters));
        self.shared.retire(Retired::Queries(self.queries));
    }
}

/// Ticks between two readings of a counter that wraps after `bits` bits.
fn elapsed(from: u64, to: u64, bits: u32) -> u64 {
    let mask = u64::MAX >> 64u32.saturating_sub(bits).min(63);
    to.wrapping_sub(from) & mask
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
    // submission: the pass borrows buffers and kernels, and `retire` keeps memory that is in use after a time limit.
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

/// What was written so far is there for what follows, and what was read may be written.
pub(super) fn barrier(device: &ash::Device, commands: vk::CommandBuffer) {
    let stages = vk::PipelineStageFlags::COMPUTE_SHADER | vk::PipelineStageFlags::TRANSFER;
    let memory = [vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::SHADER_WRITE | vk::AccessFlags::TRANSFER_WRITE)
        .dst_access_mask(
            vk::AccessFlags::SHADER_READ
                | vk::AccessFlags::SHADER_WRITE
                | vk::AccessFlags::TRANSFER_READ
                | vk::AccessFlags::TRANSFER_WRITE,
        )];
    // SAFETY: the command buffer is recording, outside any render pass.
    unsafe {
        device.cmd_pipeline_barrier(
            commands,
            stages,
            stages,
            vk::DependencyFlags::empty(),
            &memory,
            &[],
            &[],
        );
    }
}

fn stamp_first(device: &ash::Device, commands: vk::CommandBuffer, queries: vk::QueryPool, count: u32) {
    // SAFETY: the command buffer is recording and the pool holds `count` queries, none of them in use.
    unsafe { device.cmd_reset_query_pool(commands, queries, 0, count) };
    stamp(device, commands, queries, 0);
}

/// The time at which all dispatches so far have ended.
fn stamp(device: &ash::Device, commands: vk::CommandBuffer, queries: vk::QueryPool, index: u32) {
    let stage = vk::PipelineStageFlags::COMPUTE_SHADER;
    // SAFETY: the command buffer is recording, the query was reset, and the queue family has timestamps.
    unsafe { device.cmd_write_timestamp(commands, stage, queries, index) };
}

#[cfg(test)]
mod tests {
    use super::elapsed;

    #[test]
    fn counters_wrap() {
        assert_eq!(elapsed(5, 12, 64), 7);
        assert_eq!(elapsed(u64::MAX, 1, 64), 2);
        assert_eq!(elapsed((1 << 36) - 1, 2, 36), 3);
        // Bits above the valid ones are undefined.
        assert_eq!(elapsed(0xabc << 36 | 1, 0xdef << 36 | 4, 36), 3);
        assert_eq!(elapsed(0, 1, 1), 1);
    }
}
