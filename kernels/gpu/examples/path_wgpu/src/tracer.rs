//! The path tracer's pipelines and buffers: `path.wgsl`, behind the functions of lightbvh.

use std::time::Instant;

use lightbvh::TreeWords;
use lightbvh_gpu::functions;
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, Buffer, BufferBindingType, ComputePipeline};

use crate::Result;
use crate::engine::Engine;
use crate::lights::DeviceLights;

/// Radiance of each pixel, and the distance of the surface seen there, metres.
pub type Image = Vec<[f32; 4]>;

// As in `path.wgsl`.
pub const SIZE: [u32; 2] = [256, 192];
const TILE_LIGHTS: u32 = 128 * 1024;
const BYTES_OF_TILE_LIGHT: u64 = 48;

/// Passes that share tiles. At this size new ones for each would take most of the time; a frame of 1080p has 42 times the pixels.
const PASSES_OF_TILES: u32 = 8;

/// An image that grows by one sample of each pixel in a pass.
pub struct Render {
    presample: Option<ComputePipeline>,
    path: ComputePipeline,
    group: BindGroup,
    image: Buffer,
    pub passes: u32,
    /// How long the passes took.
    pub seconds: f64,
}

/// One for each method, which is `METHOD` and `CANDIDATES` in `path.wgsl`, over the same lights.
pub fn renders(
    engine: &Engine,
    lights: &DeviceLights,
    words: TreeWords,
    listed: &[[u32; 3]],
    methods: &[[u32; 2]],
) -> Vec<Render> {
    let device = &engine.device;
    // The library's nodes, instances, trails, lights and words, then the path tracer's own.
    let entry = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: match binding {
                4 => BufferBindingType::Uniform,
                _ => BufferBindingType::Storage {
                    read_only: binding < 6,
                },
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..8).map(entry).collect();
    let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&group_layout)],
        immediate_size: 4,
    });
    let text = [functions::WGSL, include_str!("path.wgsl")].concat();
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let words = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::bytes_of(&words),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let listed = engine.stored(bytemuck::cast_slice(listed));
    let [nodes, instances, trails, lights] = ["nodes", "instances", "trails", "lights"]
        .map(|name| lights.named(name).expect("a buffer of the tree"));
    let render = |&[method, candidates]: &[u32; 2]| {
        let constants = [("METHOD", method.into()), ("CANDIDATES", candidates.into())];
        let pipeline = |entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&layout),
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            })
        };
        let tiles = engine.storage(u64::from(TILE_LIGHTS) * BYTES_OF_TILE_LIGHT);
        let image = engine.storage(u64::from(SIZE[0] * SIZE[1]) * 16);
        let buffers = [nodes, instances, trails, lights, &words, &listed, &tiles, &image];
        let resources = (0..).zip(buffers.map(Buffer::as_entire_binding));
        let entries: Vec<_> = resources
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        Render {
            presample: (method == 1).then(|| pipeline("presample")),
            path: pipeline("path"),
            group: device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &group_layout,
                entries: &entries,
            }),
            image,
            passes: 0,
            seconds: 0.0,
        }
    };
    methods.iter().map(render).collect()
}

impl Render {
    /// Adds a sample to each pixel. Samples of one frame number are alike.
    pub fn pass(&mut self, engine: &Engine, frame: u32) -> Result<()> {
        let start = Instant::now();
        let mut encoder = engine.device.create_command_encoder(&Default::default());
        let mut dispatch = |pipeline: &ComputePipeline, x, y| {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.set_immediates(0, &frame.to_le_bytes());
            pass.dispatch_workgroups(x, y, 1);
        };
        if let Some(presample) = self
            .presample
            .as_ref()
            .filter(|_| self.passes.is_multiple_of(PASSES_OF_TILES))
        {
            dispatch(presample, TILE_LIGHTS / 64, 1);
        }
        dispatch(&self.path, SIZE[0] / 8, SIZE[1] / 8);
        engine.queue.submit([encoder.finish()]);
        engine.device.poll(wgpu::PollType::wait_indefinitely())?;
        self.passes += 1;
        self.seconds += start.elapsed().as_secs_f64();
        Ok(())
    }

    /// The mean of the image's samples; the image is empty then.
    pub fn take(&mut self, engine: &Engine) -> Result<Image> {
        let sums = engine.read(&self.image)?;
        let mean = |sum: &[f32; 4]| sum.map(|part| part / self.passes as f32);
        let image = bytemuck::cast_slice(&sums).iter().map(mean).collect();
        engine.queue.write_buffer(&self.image, 0, &vec![0; sums.len()]);
        (self.passes, self.seconds) = (0, 0.0);
        Ok(image)
    }
}
