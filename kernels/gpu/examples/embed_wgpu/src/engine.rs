//! The engine's device, buffers and pipelines on wgpu. It knows nothing of lights.

use std::borrow::Cow;

use lightbvh_gpu::{Access, Kernel, without_vulkan_memory_model};
use wgpu::{Buffer, BufferUsages, Features};

use crate::Result;

/// How a module reaches the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Road {
    /// As it is.
    Passthrough,
    /// By naga.
    Translated,
}

/// An open device.
pub struct Engine {
    pub name: String,
    pub road: Road,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

/// A kernel's pipeline.
pub struct Pipeline {
    kernel: &'static Kernel,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// Each Vulkan adapter, by each road that it offers.
pub fn engines() -> Vec<Engine> {
    let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
    description.backends = wgpu::Backends::VULKAN;
    let instance = wgpu::Instance::new(description);
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    let mut engines = Vec::new();
    for adapter in adapters {
        for (road, own) in [
            (Road::Passthrough, Features::PASSTHROUGH_SHADERS),
            (Road::Translated, Features::empty()),
        ] {
            let name = adapter.get_info().name;
            let description = wgpu::DeviceDescriptor {
                required_features: own | Features::IMMEDIATES,
                required_limits: wgpu::Limits {
                    max_immediate_size: 128,
                    ..wgpu::Limits::default()
                },
                ..Default::default()
            };
            match pollster::block_on(adapter.request_device(&description)) {
                Ok((device, queue)) => engines.push(Engine {
                    name,
                    road,
                    device,
                    queue,
                }),
                Err(error) => println!("{name}, {road:?}: {error}"),
            }
        }
    }
    engines
}

impl Engine {
    /// A storage buffer; at least 256 bytes, since wgpu binds none of less than one element.
    pub fn storage(&self, bytes: u64) -> Buffer {
        self.buffer(
            bytes.max(256),
            BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST,
        )
    }

    /// A storage buffer that holds `data`.
    pub fn stored(&self, data: &[u8]) -> Buffer {
        let buffer = self.storage(data.len() as u64);
        self.queue.write_buffer(&buffer, 0, data);
        buffer
    }

    fn buffer(&self, size: u64, usage: BufferUsages) -> Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// The pipeline of a kernel.
    pub fn pipeline(&self, kernel: &'static Kernel) -> Result<Pipeline> {
        let words = without_vulkan_memory_model(&kernel.words())?;
        let module = match self.road {
            Road::Passthrough => {
                let [x, y, z] = kernel.workgroup;
                let entry_point = wgpu::PassthroughShaderEntryPoint {
                    name: Cow::Borrowed(kernel.name),
                    workgroup_size: (x, y, z),
                };
                let module = wgpu::ShaderModuleDescriptorPassthrough {
                    entry_points: Cow::Owned(vec![entry_point]),
                    spirv: Some(Cow::Borrowed(&words)),
                    ..Default::default()
                };
                // SAFETY: the module is valid Vulkan 1.2 without any feature, its bindings and push constants are those of
                // the layout below, and it reads no element beyond a buffer's length.
                unsafe { self.device.create_shader_module_passthrough(module) }
            }
            Road::Translated => self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(kernel.name),
                source: wgpu::ShaderSource::SpirV(Cow::Borrowed(&words)),
            }),
        };
        let entries: Vec<_> = kernel
            .bindings
            .iter()
            .map(|binding| wgpu::BindGroupLayoutEntry {
                binding: binding.binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage {
                        read_only: binding.access == Access::Read,
                    },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            })
            .collect();
        let layout = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(kernel.name),
                entries: &entries,
            });
        let pipeline_layout = self
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(kernel.name),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: kernel.push_constants,
            });
        let pipeline = self
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(kernel.name),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(kernel.name),
                compilation_options: Default::default(),
                cache: None,
            });
        Ok(Pipeline {
            kernel,
            pipeline,
            layout,
        })
    }

    /// Records a dispatch with one invocation for each item, over the buffers that `named` gives. wgpu puts barriers between
    /// dispatches by itself.
    pub fn dispatch<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &Pipeline,
        named: impl Fn(&str) -> Option<&'a Buffer>,
        push: &[u32],
        items: u32,
    ) {
        let kernel = pipeline.kernel;
        let buffer = |name| named(name).unwrap_or_else(|| panic!("no buffer for the binding {name}"));
        let entries: Vec<_> = kernel
            .bindings
            .iter()
            .map(|binding| wgpu::BindGroupEntry {
                binding: binding.binding,
                resource: buffer(binding.name).as_entire_binding(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(kernel.name),
            layout: &pipeline.layout,
            entries: &entries,
        });
        let [x, y, z] = kernel.groups(items).expect("32 bits number all items");
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.set_immediates(0, bytemuck::cast_slice(push));
        pass.dispatch_workgroups(x, y, z);
    }

    /// A copy of a buffer's bytes, once all that was submitted is done.
    pub fn read(&self, buffer: &Buffer) -> Result<Vec<u8>> {
        let back = self.buffer(buffer.size(), BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &back, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        back.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        Ok(back.get_mapped_range(..)?.to_vec())
    }
}
