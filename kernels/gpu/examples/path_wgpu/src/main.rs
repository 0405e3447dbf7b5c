//! A path tracer on wgpu that calls the functions for shaders: a city at night, 1,024 moving lamps of 10,240 triangles.
//!
//! `cargo run --manifest-path kernels/gpu/examples/path_wgpu/Cargo.toml -- <folder> [<seconds>]`
//!
//! Each method renders the same frame for that long, once in each turn, on the first Vulkan adapter. The table has the medians
//! of the errors, the picture in the folder shows uniform choice, tiles of 32 candidates, and `lightbvh_sample`.

#[path = "../../embed_wgpu/src/engine.rs"]
mod engine;
#[path = "../../embed_wgpu/src/lights.rs"]
mod lights;
mod scene;

use std::path::Path;
use std::time::Instant;

use engine::Engine;
use lightbvh::{Edit, LightBvh};
use lightbvh_gpu::functions;
use lights::DeviceLights;
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, Buffer, BufferBindingType, ComputePipeline};

/// What the program fails with: a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

type Image = Vec<[f32; 4]>;

// As in `path.wgsl`.
const SIZE: [u32; 2] = [256, 192];
const TILE_LIGHTS: u32 = 128 * 1024;
const BYTES_OF_TILE_LIGHT: u64 = 48;

const TURNS: u32 = 3;
/// Passes that share tiles. At this size new ones for each would take most of the time; a frame of 1080p has 42 times the pixels.
const PASSES_OF_TILES: u32 = 8;

/// Name, `METHOD`, and `CANDIDATES`.
const METHODS: [(&str, u32, u32); 5] = [
    ("uniform", 0, 1),
    ("presampled tiles, 8 candidates", 1, 8),
    ("presampled tiles, 32 candidates", 1, 32),
    ("`lightbvh_sample`", 2, 1),
    ("`lightbvh_sample`, 8 candidates", 2, 8),
];

/// An image that grows by one sample of each pixel in a pass.
struct Render {
    presample: Option<ComputePipeline>,
    path: ComputePipeline,
    group: BindGroup,
    image: Buffer,
    passes: u32,
    seconds: f64,
}

/// One for each method, over the same lights.
fn renders(
    engine: &Engine,
    lights: &DeviceLights,
    words: lightbvh::TreeWords,
    listed: &[[u32; 3]],
) -> Vec<Render> {
    let device = &engine.device;
    let [read, write] = [true, false].map(|read_only| BufferBindingType::Storage { read_only });
    // The library's nodes, instances, trails, lights and words, then the path tracer's own.
    let types = [
        read,
        read,
        read,
        read,
        BufferBindingType::Uniform,
        read,
        write,
        write,
    ];
    let entry = |(binding, ty)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..).zip(types).map(entry).collect();
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
    let tiles = engine.storage(u64::from(TILE_LIGHTS) * BYTES_OF_TILE_LIGHT);
    let [nodes, instances, trails, lights] = ["nodes", "instances", "trails", "lights"]
        .map(|name| lights.named(name).expect("a buffer of the tree"));
    let render = |&(_, method, candidates): &(&str, u32, u32)| {
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
    METHODS.iter().map(render).collect()
}

impl Render {
    /// Adds a sample to each pixel. Samples of one frame number are alike.
    fn pass(&mut self, engine: &Engine, frame: u32) -> Result<()> {
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
            .filter(|_| self.passes % PASSES_OF_TILES == 0)
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
    fn take(&mut self, engine: &Engine) -> Result<Image> {
        let sums = engine.read(&self.image)?;
        let mean = |sum: &[f32; 4]| sum.map(|part| part / self.passes as f32);
        let image = bytemuck::cast_slice(&sums).iter().map(mean).collect();
        engine.queue.write_buffer(&self.image, 0, &vec![0; sums.len()]);
        (self.passes, self.seconds) = (0, 0.0);
        Ok(image)
    }
}

/// Mean squared error of the image, and relative to the squared reference and a hundredth of its squared mean.
fn errors(image: &Image, reference: &Image) -> [f64; 2] {
    let values = |own: &Image| -> Vec<f64> {
        own.iter()
            .flat_map(|own| &own[..3])
            .map(|&own| own.into())
            .collect()
    };
    let (image, reference) = (values(image), values(reference));
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / reference.len() as f64;
    let least = 0.01 * mean(&mut reference.iter().copied()).powi(2);
    let squares = || {
        image
            .iter()
            .zip(&reference)
            .map(|(a, b)| ((a - b).powi(2), b * b + least))
    };
    [
        mean(&mut squares().map(|(square, _)| square)),
        mean(&mut squares().map(|(square, scale)| square / scale)),
    ]
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments
        .next()
        .ok_or("path_wgpu: name a folder for the picture")?;
    let seconds: f64 = arguments.next().map_or(Ok(10.0), |own| own.parse())?;
    let engines = engine::engines();
    let engine = engines
        .first()
        .ok_or("path_wgpu: no Vulkan adapter with immediates")?;

    // The lamps, and a second of their way.
    let mut bvh = LightBvh::default();
    let lamps = bvh
        .apply(vec![Edit::AddMesh {
            lights: scene::lamp(),
        }])?
        .meshes[0];
    let lamps = bvh
        .apply((0..scene::LAMPS).map(|k| scene::added(lamps, k)).collect())?
        .instances;
    let mut lights = DeviceLights::new(engine)?;
    let mut frame_times = Vec::new();
    let mut words = lights.update(engine, &bvh);
    for frame in 1..=30_u16 {
        let start = Instant::now();
        let edit = |(k, &instance)| Edit::SetTransform {
            instance,
            transform: scene::place(k, f32::from(frame) / 30.0),
        };
        bvh.apply((0..).zip(&lamps).map(edit).collect())?;
        bvh.refit();
        words = lights.update(engine, &bvh);
        engine.device.poll(wgpu::PollType::wait_indefinitely())?;
        frame_times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let listed = scene::listed(&bvh);
    let mut renders = renders(engine, &lights, words, &listed);
    println!(
        "{}: edits and refit of a frame {:.1} ms",
        engine.name,
        median(frame_times)
    );

    // Methods alternate by passes, so that what else the machine does slows all alike.
    let mut frame = 0;
    let mut until = |renders: &mut [Render], seconds: f64| -> Result<()> {
        while let Some(next) = (renders.iter_mut().filter(|own| own.seconds < seconds))
            .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
        {
            frame += 1;
            next.pass(engine, frame)?;
        }
        Ok(())
    };
    // Drivers compile in the first pass.
    until(&mut renders, 1e-9)?;
    for render in &mut renders {
        render.take(engine)?;
    }
    // The mean of an image by one sample and one by eight candidates.
    until(&mut renders[3..], 8.0 * seconds)?;
    let halves = [renders[3].take(engine)?, renders[4].take(engine)?];
    let pixels = halves[0].iter().zip(&halves[1]);
    let reference: Image = pixels
        .map(|(a, b)| std::array::from_fn(|k| 0.5 * (a[k] + b[k])))
        .collect();
    let [mse, relative] = errors(&halves[0], &halves[1]).map(|error| error / 4.0);
    println!("error of the reference: MSE {mse:.2e}, relMSE {relative:.4}\n");

    let mut results = vec![Vec::new(); METHODS.len()];
    let mut images = Vec::new();
    for _ in 0..TURNS {
        until(&mut renders, seconds)?;
        images.clear();
        for (render, results) in renders.iter_mut().zip(&mut results) {
            let (passes, spent) = (f64::from(render.passes), render.seconds);
            let image = render.take(engine)?;
            let [mse, relative] = errors(&image, &reference);
            results.push([passes, spent / passes * 1e3, mse, relative]);
            images.push(image);
        }
    }
    println!(
        "| {seconds} s of each | samples of a pixel | ms of one | MSE | relMSE |\n|---|---|---|---|---|"
    );
    for ((name, ..), results) in METHODS.iter().zip(&results) {
        let [passes, milliseconds, mse, relative] =
            std::array::from_fn(|k| median(results.iter().map(|own| own[k]).collect()));
        println!("| {name} | {passes} | {milliseconds:.0} | {mse:.2e} | {relative:.4} |");
    }
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    scene::write(&folder.join("reference.png"), &[&reference])?;
    scene::write(
        &folder.join("functions.png"),
        &[&images[0], &images[2], &images[3]],
    )
}
