//! Kernels: compute pipelines with what their modules say they take.

use ash::vk;
use lightbvh_gpu::spirv::Interface;

/// A kernel, ready to be dispatched on the device it was made for, which owns its Vulkan objects: its number keeps the kernel from
/// being used after they are gone.
#[derive(Debug)]
pub struct Kernel {
    pub(crate) name: String,
    pub(crate) device: u64,
    pub(crate) interface: Interface,
    pub(crate) set_layout: vk::DescriptorSetLayout,
    pub(crate) layout: vk::PipelineLayout,
    pub(crate) pipeline: vk::Pipeline,
}

impl Kernel {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Destroys the pipeline. Nothing that uses it may be running.
    pub(super) fn destroy(&self, device: &ash::Device) {
        // SAFETY: the handles belong to this device or are null; they are destroyed once: by `new` (`pipeline`) on failure, or by
        // the device's end, after which the device is gone and its number in `self.device` matches no other.
        unsafe {
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
