//! The engine's compute pipelines.

use std::cell::RefCell;
use std::ffi::CString;
use std::rc::Rc;

use ash::vk;
use lightbvh_gpu::spirv::Interface;
use lightbvh_gpu::{groups, with_float_modes};

use super::Result;
use super::buffer::Buffer;
use super::gpu::Gpu;

/// A pipeline with one descriptor set, whose storage buffers have names.
pub struct Pipeline {
    gpu: Rc<Gpu>,
    names: Vec<String>,
    interface: Interface,
    /// The buffers that are bound.
    bound: RefCell<Vec<vk::Buffer>>,
    set: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

impl Pipeline {
    /// A pipeline of a module of SPIR-V. Binding k is the storage buffer that the k-th of `names` means.
    pub fn new<'a>(gpu: &Rc<Gpu>, words: &[u32], names: impl IntoIterator<Item = &'a str>) -> Result<Self> {
        let interface = Interface::read(words)?;
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        if interface.buffers.len() != names.len() {
            return Err("this is another shader's module; build it again".into());
        }
        let count = names.len() as u32;
        let bindings: Vec<_> = (0..count)
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let device = &gpu.device;
        let set_info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let sizes = [vk::DescriptorPoolSize {
            ty: vk::DescriptorType::STORAGE_BUFFER,
            descriptor_count: count,
        }];
        let pool_info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(1)
            .pool_sizes(&sizes);
        // SAFETY: the device is alive, and so is what the structures point to. An error ends the program.
        let (set_layout, pool) = unsafe {
            (
                device.create_descriptor_set_layout(&set_info, None)?,
                device.create_descriptor_pool(&pool_info, None)?,
            )
        };
        let set_layouts = [set_layout];
        let set_info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(pool)
            .set_layouts(&set_layouts);
        let range = [vk::PushConstantRange::default()
            .stage_flags(vk::ShaderStageFlags::COMPUTE)
            .size(interface.push_constants)];
        let layout_info = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&set_layouts)
            .push_constant_ranges(&range);
        // The float modes that this device offers are put into the module.
        let words = with_float_modes(words, gpu.controls)?;
        let module_info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: as above; the module is SPIR-V 1.5 of capabilities that the device was opened with.
        let (set, layout, module) = unsafe {
            (
                device.allocate_descriptor_sets(&set_info)?[0],
                device.create_pipeline_layout(&layout_info, None)?,
                device.create_shader_module(&module_info, None)?,
            )
        };
        let name = CString::new(&*interface.entry_point)?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(&name);
        let info = [vk::ComputePipelineCreateInfo::default()
            .stage(stage)
            .layout(layout)];
        // SAFETY: the layout has the module's bindings and push constants.
        let pipeline = unsafe {
            let made = device.create_compute_pipelines(vk::PipelineCache::null(), &info, None);
            device.destroy_shader_module(module, None);
            made.map_err(|(_, error)| error)?[0]
        };
        Ok(Self {
            gpu: Rc::clone(gpu),
            names,
            interface,
            bound: RefCell::default(),
            set,
            pool,
            set_layout,
            layout,
            pipeline,
        })
    }

    /// Binds the buffers that `named` gives, unless they are bound. Not if a dispatch that was recorded has others.
    fn bind<'a>(&self, named: impl Fn(&str) -> Option<&'a Buffer>) {
        let buffer = |name| named(name).unwrap_or_else(|| panic!("no buffer for the binding {name}"));
        let buffers: Vec<_> = self.names.iter().map(|name| buffer(name).raw).collect();
        for (binding, &buffer) in (0..).zip(&buffers) {
            if *self.bound.borrow() == buffers {
                return;
            }
            let buffer = [vk::DescriptorBufferInfo {
                buffer,
                offset: 0,
                range: vk::WHOLE_SIZE,
            }];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(self.set)
                .dst_binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&buffer);
            // SAFETY: set and buffer are the device's, and no submission that uses the set is running.
            unsafe { self.gpu.device.update_descriptor_sets(&[write], &[]) };
        }
        self.bound.replace(buffers);
    }

    /// Records a dispatch with one invocation for each item, over the buffers that `named` gives.
    pub fn dispatch<'a>(
        &self,
        commands: vk::CommandBuffer,
        named: impl Fn(&str) -> Option<&'a Buffer>,
        push: &[u32],
        items: u32,
    ) {
        self.bind(named);
        let interface = &self.interface;
        assert_eq!(size_of_val(push), interface.push_constants as usize);
        let [x, y, z] = groups(items, interface.workgroup[0]).expect("32 bits number all items");
        let device = &self.gpu.device;
        let compute = vk::PipelineBindPoint::COMPUTE;
        let constants = vk::ShaderStageFlags::COMPUTE;
        // SAFETY: all of it is the device's; the set fits the layout and holds live buffers (`bind`).
        unsafe {
            device.cmd_bind_pipeline(commands, compute, self.pipeline);
            device.cmd_bind_descriptor_sets(commands, compute, self.layout, 0, &[self.set], &[]);
            device.cmd_push_constants(commands, self.layout, constants, 0, bytemuck::cast_slice(push));
            device.cmd_dispatch(commands, x, y, z);
        }
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        let device = &self.gpu.device;
        // SAFETY: every submission that used them has been waited for.
        unsafe {
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_pool(self.pool, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
