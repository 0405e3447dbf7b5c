//! How kernels are made: built-in modules on first use, others from their words.

use super::device::Device;
use super::error::{CallContext, VulkanError};
use super::kernel::Kernel;
use super::shared::Shared;
use crate::renderer;
use ash::vk;
use lightbvh_gpu::spirv::Interface;
use lightbvh_gpu::with_float_modes;
use std::ffi::CString;
use std::sync::Arc;

impl Device {
    /// The built-in kernel of that name; its pipeline is made on first use.
    ///
    /// Some drivers compile only at the first dispatch: leave that one out of any timing.
    pub fn kernel(&self, name: &str) -> Result<Arc<Kernel>, VulkanError> {
        let mut kernels = self.shared.kernels();
        if let Some(kernel) = kernels.iter().rev().find(|kernel| kernel.name == name) {
            return Ok(Arc::clone(kernel));
        }
        let words = built_in(name)?.words();
        let kernel = Arc::new(Kernel::new(&self.shared, name, &words)?);
        kernels.push(Arc::clone(&kernel));
        drop(kernels);
        self.shared.check_validation()?;
        Ok(kernel)
    }

    /// A kernel from a SPIR-V module with one compute entry point. [`kernel`](Self::kernel) returns it from now on, also in the
    /// place of a built-in one of that name.
    ///
    /// Float-control execution modes are set as the device reports them. The module's instructions are trusted like
    /// any program: Vulkan does not promise to catch an invalid one.
    pub fn kernel_from_words(&self, name: &str, words: &[u32]) -> Result<Arc<Kernel>, VulkanError> {
        let kernel = Arc::new(Kernel::new(&self.shared, name, words)?);
        self.shared.kernels().push(Arc::clone(&kernel));
        self.shared.check_validation()?;
        Ok(kernel)
    }
}

/// All modules: the tree's and the renderer's.
fn all() -> impl Iterator<Item = &'static lightbvh_gpu::Kernel> {
    [lightbvh_gpu::KERNELS, renderer::KERNELS]
        .into_iter()
        .flatten()
        .copied()
}

/// The module of that name.
fn built_in(name: &str) -> Result<&'static lightbvh_gpu::Kernel, VulkanError> {
    all().find(|kernel| kernel.name == name).ok_or_else(|| {
        let known: Vec<&str> = all().map(|kernel| kernel.name).collect();
        VulkanError::UnknownKernel {
            name: name.into(),
            known: known.join(", "),
        }
    })
}

impl Kernel {
    fn new(shared: &Shared, name: &str, words: &[u32]) -> Result<Self, VulkanError> {
        let bad_module = |source| VulkanError::BadModule {
            kernel: name.into(),
            source,
        };
        let interface = Interface::read(words).map_err(bad_module)?;
        let words = with_float_modes(words, shared.probe.float_controls).map_err(bad_module)?;
        check_limits(shared, name, &interface)?;
        let mut kernel = Self {
            name: name.into(),
            device: shared.id,
            interface,
            set_layout: vk::DescriptorSetLayout::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
        };
        match kernel.create(shared, &words) {
            Ok(()) => Ok(kernel),
            Err(error) => {
                kernel.destroy(&shared.raw);
                Err(error)
            }
        }
    }

    fn create(&mut self, shared: &Shared, words: &[u32]) -> Result<(), VulkanError> {
        let (device, device_name) = (&shared.raw, shared.probe.name.as_str());
        let bindings: Vec<_> = (0..self.interface.buffers.len() as u32)
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive and `info` outlives the call; the same holds for the creations below.
        self.set_layout = unsafe { device.create_descriptor_set_layout(&info, None) }
            .during("vkCreateDescriptorSetLayout", device_name)?;

        let set_layouts = [self.set_layout];
        let push = [vk::PushConstantRange {
            stage_flags: vk::ShaderStageFlags::COMPUTE,
            offset: 0,
            size: self.interface.push_constants,
        }];
        let mut info = vk::PipelineLayoutCreateInfo::default().set_layouts(&set_layouts);
        if self.interface.push_constants > 0 {
            info = info.push_constant_ranges(&push);
        }
        // SAFETY: as above.
        self.layout = unsafe { device.create_pipeline_layout(&info, None) }
            .during("vkCreatePipelineLayout", device_name)?;

        let info = vk::ShaderModuleCreateInfo::default().code(words);
        // SAFETY: as above; the words parse as SPIR-V, and what they compute is the caller's to vouch for
        // (`kernel_from_words`): the built-in ones were verified when they were built.
        let module = unsafe { device.create_shader_module(&info, None) }
            .during("vkCreateShaderModule", device_name)?;
        // Read from a zero-terminated string, so there is no zero byte to cut at.
        let entry_point = CString::new(self.interface.entry_point.as_bytes()).unwrap_or_default();
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(&entry_point);
        let info = [vk::ComputePipelineCreateInfo::default()
            .layout(self.layout)
            .stage(stage)];
        // SAFETY: as above; the layout covers every binding and push constant that the module declares.
        let created = unsafe { device.create_compute_pipelines(vk::PipelineCache::null(), &info, None) };
        // SAFETY: pipelines do not need their module once they are made; nothing else uses it.
        unsafe { device.destroy_shader_module(module, None) };
        match created {
            Ok(pipelines) => {
                self.pipeline = pipelines[0];
                Ok(())
            }
            // A single creation that failed left a null handle.
            Err((_, result)) => Err(result).during("vkCreateComputePipelines", device_name),
        }
    }
}

/// Compares what the kernel declares with what the device has.
fn check_limits(shared: &Shared, kernel: &str, interface: &Interface) -> Result<(), VulkanError> {
    let limits = &shared.probe.limits;
    let invocations = interface
        .workgroup
        .iter()
        .fold(1, |all: u32, own| all.saturating_mul(*own));
    for (what, needed, limit) in [
        (
            "invocations per workgroup:",
            invocations,
            limits.max_compute_work_group_invocations,
        ),
        (
            "storage buffers:",
            interface.buffers.len() as u32,
            limits.max_per_stage_descriptor_storage_buffers,
        ),
        (
            "bytes of push constants:",
            interface.push_constants,
            limits.max_push_constants_size,
        ),
    ] {
        if needed > limit {
            return Err(VulkanError::KernelOverLimit {
                kernel: kernel.into(),
                device: shared.probe.name.clone(),
                what,
                needed,
                limit,
            });
        }
    }
    Ok(())
}
