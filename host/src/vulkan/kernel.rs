//! Kernels: compute pipelines with what their modules say they take.

use ash::vk;
use lightbvh_gpu::spirv::Interface;
use std::collections::HashMap;
use std::sync::Arc;

/// A kernel, ready to be dispatched on the device it was made for.
#[derive(Debug)]
pub struct Kernel {
    pub(crate) name: String,
    pub(crate) device: u64,
    pub(crate) interface: Interface,
    pub(crate) set_layout: vk::DescriptorSetLayout,
    pub(crate) layout: vk::PipelineLayout,
    pub(crate) pipeline: vk::Pipeline,
}

/// All kernels of a device. It owns their Vulkan objects; [`Kernel`] only names them, and its device's number keeps
/// it from being used after they are gone.
#[derive(Default)]
pub(crate) struct Kernels {
    /// By name.
    pub(super) made: HashMap<String, Arc<Kernel>>,
    /// Those that others of the same name replaced.
    pub(super) old: Vec<Arc<Kernel>>,
}

impl Kernels {
    /// Destroys the pipelines. Nothing that uses them may be running.
    pub(crate) fn destroy(&mut self, device: &ash::Device) {
        for kernel in self
            .made
            .drain()
            .map(|(_, kernel)| kernel)
            .chain(self.old.drain(..))
        {
            kernel.destroy(device);
        }
    }
}

impl Kernel {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Destroys the pipeline. Nothing that uses it may be running.
    pub(super) fn destroy(&self, device: &ash::Device) {
        // SAFETY: the handles belong to this device or are null; they are destroyed once: by `new` (`pipeline`) on failure, or by
        // `Kernels::destroy`, after which the device is gone and its number in `self.device` matches no other.
        unsafe {
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
