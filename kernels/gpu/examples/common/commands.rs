//! What the engine's device does: copies and dispatches, recorded one after another.

use std::rc::Rc;

use ash::vk;

use super::Result;
use super::buffer::Buffer;
use super::gpu::Gpu;
use super::pipeline::Pipeline;

/// Records commands, and waits until the device has done them.
pub fn run(gpu: &Rc<Gpu>, record: impl FnOnce(&mut Commands) -> Result<()>) -> Result<()> {
    gpu.run(|raw| {
        let mut commands = Commands {
            gpu: Rc::clone(gpu),
            raw,
            staged: Vec::new(),
        };
        commands.barrier();
        record(&mut commands)?;
        commands.barrier();
        Ok(commands)
    })
}

/// A copy of a buffer's bytes.
pub fn read(gpu: &Rc<Gpu>, buffer: &Buffer) -> Result<Vec<u8>> {
    let back = Buffer::staging(gpu, buffer.bytes)?;
    run(gpu, |commands| {
        commands.copy(buffer, &back, 0);
        Ok(())
    })?;
    back.mapped()
}

/// Commands that are being recorded. A dispatch sees what the commands before it have written.
pub struct Commands {
    gpu: Rc<Gpu>,
    raw: vk::CommandBuffer,
    /// Read by the commands.
    staged: Vec<Buffer>,
}

impl Commands {
    /// Writes `bytes` to a buffer from the byte `at` on.
    pub fn upload(&mut self, to: &Buffer, at: u64, bytes: &[u8]) -> Result<()> {
        let staged = Buffer::staged(&self.gpu, bytes)?;
        self.copy(&staged, to, at);
        self.staged.push(staged);
        Ok(())
    }

    /// Copies a buffer to another, from the byte `at` on.
    fn copy(&self, from: &Buffer, to: &Buffer, at: u64) {
        assert!(at + from.bytes <= to.bytes, "within the buffer");
        let region = [vk::BufferCopy {
            src_offset: 0,
            dst_offset: at,
            size: from.bytes,
        }];
        // SAFETY: both are the device's, made for copies, and hold the region.
        unsafe {
            self.gpu
                .device
                .cmd_copy_buffer(self.raw, from.raw, to.raw, &region);
        }
    }

    /// Dispatches a pipeline with one invocation for each item, over the buffers that `named` gives.
    pub fn dispatch<'a>(
        &self,
        pipeline: &Pipeline,
        named: impl Fn(&str) -> Option<&'a Buffer>,
        push: &[u32],
        items: u32,
    ) {
        self.barrier();
        pipeline.dispatch(self.raw, named, push, items);
    }

    /// Lets all that follows see all that was written before.
    fn barrier(&self) {
        let stages = vk::PipelineStageFlags::TRANSFER | vk::PipelineStageFlags::COMPUTE_SHADER;
        let memory = [vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)];
        let after = stages | vk::PipelineStageFlags::HOST;
        // SAFETY: the command buffer is being recorded, and its queue has these stages.
        unsafe {
            self.gpu.device.cmd_pipeline_barrier(
                self.raw,
                stages,
                after,
                vk::DependencyFlags::empty(),
                &memory,
                &[],
                &[],
            );
        }
    }
}
