//! A path tracer on wgpu that calls the functions for shaders: a city at night, 1,024 moving lamps of 10,240 triangles.
//!
//! `cargo run --manifest-path kernels/gpu/examples/path_wgpu/Cargo.toml -- <folder> [<seconds> [<turns> [<seconds of the reference>]]]`
//!
//! Each method renders the same frame for equally long, once in each turn; the table has the medians of its errors, the picture
//! the last turn. What `path.wgsl` calls is `functions::WGSL`, put before it; what it reads, `DeviceLights` of `embed_wgpu` keeps.

#[path = "../../embed_wgpu/src/engine.rs"]
mod engine;
#[path = "../../embed_wgpu/src/lights.rs"]
mod lights;

use std::time::Instant;

use engine::Engine;
use lightbvh::exact::hash;
use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, Transform};
use lightbvh_gpu::functions;
use lights::DeviceLights;
use wgpu::{BindGroup, Buffer, ComputePipeline, ShaderStages};

/// What the program fails with: a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

// As in `path.wgsl`.
const SIZE: [u32; 2] = [256, 192];
const TILE_LIGHTS: u32 = 128 * 1024;
const BYTES_OF_TILE_LIGHT: u64 = 48;
const CELLS: u16 = 12;
const PITCH: f32 = 10.0;
const EYE: [f32; 3] = [50.3, 8.6, 1.0];
const FORWARD: [f32; 3] = [0.36, -0.29, 0.85];

const LAMPS: u32 = 1024;

/// Name, `METHOD`, and `CANDIDATES`.
const METHODS: [(&str, u32, u32); 5] = [
    ("uniform", 0, 1),
    ("presampled tiles, 8 candidates", 1, 8),
    ("presampled tiles, 32 candidates", 1, 32),
    ("`lightbvh_sample`", 2, 1),
    ("`lightbvh_sample`, 8 candidates", 2, 8),
];

/// In [0, 1), of a thing and a question.
fn unit(thing: u32, question: u32) -> f32 {
    lightbvh::exact::unit_f32(hash(thing ^ hash(question)))
}

/// A lamp of unit radius: two pyramids of five sides, base to base.
fn lamp() -> Vec<EmissiveTriangle> {
    let corner = |k: u8| {
        let (z, x) = (f32::from(k) * std::f32::consts::TAU / 5.0).sin_cos();
        [x, 0.0, z]
    };
    let side = |p| EmissiveTriangle {
        p,
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    (0..5)
        .flat_map(|k| {
            let (a, b) = (corner(k), corner(k + 1));
            [side([a, [0.0, 1.3, 0.0], b]), side([b, [0.0, -1.3, 0.0], a])]
        })
        .collect()
}

/// Where lamp `k` is after `time` seconds: it drifts along a street, and turns.
fn place(k: u32, time: f32) -> Transform {
    let street = (1.0 + (f32::from(CELLS) - 1.0) * unit(k, 0)).floor() * PITCH;
    let across = street + 2.6 * (unit(k, 1) - 0.5);
    let length = f32::from(CELLS) * PITCH;
    let along = (unit(k, 2) * length + (unit(k, 3) - 0.5) * time).rem_euclid(length);
    let height = 0.8 + 8.0 * unit(k, 4);
    let p = if k % 2 == 0 {
        [along, height, across]
    } else {
        [across, height, along]
    };
    let (sin, cos) = (unit(k, 6) * 3.0 + 0.5 * time).sin_cos();
    Transform::from_trs(p, [0.0, sin, 0.0, cos], [0.12 + 0.16 * unit(k, 7); 3])
}

/// Dim lamps, and a few bright ones, in five colours.
fn radiance(k: u32) -> [f32; 3] {
    let power = 6.0 * (6.0 * unit(k, 8)).exp2();
    let colours = [
        [1.0, 0.55, 0.18],
        [1.0, 0.42, 0.12],
        [1.0, 0.75, 0.40],
        [1.0, 0.25, 0.22],
        [0.25, 0.75, 0.95],
    ];
    colours[k as usize % 5].map(|part| part * power)
}

/// Each light, its instance, and the sum of the powers before it in parts of 2^32: `Listed` in `path.wgsl`.
fn listed(bvh: &LightBvh) -> Vec<[u32; 3]> {
    let power = |own: &EmissiveTriangle| {
        let [a, b, c] = own.p;
        let edge = |to: [f32; 3]| [0, 1, 2].map(|k| f64::from(to[k] - a[k]));
        let (u, v) = (edge(b), edge(c));
        let area = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| (u[i] * v[j] - u[j] * v[i]).powi(2));
        let [red, green, blue] = own.radiance.map(f64::from);
        area.iter().sum::<f64>().sqrt() * (0.2126 * red + 0.7152 * green + 0.0722 * blue)
    };
    let lights = bvh.view().world_lights();
    let all: f64 = lights.iter().map(power).sum();
    let mut below = 0.0;
    let with_sum = |(light, own): (u32, &EmissiveTriangle)| {
        let at = (below / all * 4_294_967_296.0) as u32;
        below += power(own);
        // The `mesh` of a light in the world is the index of its instance.
        [light, own.mesh, at]
    };
    (0..).zip(&lights).map(with_sum).collect()
}

/// The path tracer's pipelines and what they read.
struct Tracer<'a> {
    engine: &'a Engine,
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    lights: BindGroup,
    own: wgpu::BindGroupLayout,
    heights: Buffer,
    listed: Buffer,
    tiles: Buffer,
}

/// An image that grows by one sample in each pass.
struct Render {
    pipelines: Vec<(ComputePipeline, [u32; 2])>,
    group: BindGroup,
    image: Buffer,
    passes: u32,
    seconds: f64,
}

impl<'a> Tracer<'a> {
    fn new(
        engine: &'a Engine,
        lights: &DeviceLights,
        words: lightbvh::TreeWords,
        listed: &[[u32; 3]],
    ) -> Self {
        let device = &engine.device;
        let buffers = |types: &[wgpu::BufferBindingType]| {
            let entry = |(binding, &ty)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            };
            let entries: Vec<_> = (0..).zip(types).map(entry).collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: None,
                entries: &entries,
            })
        };
        let [read, write] = [true, false].map(|read_only| wgpu::BufferBindingType::Storage { read_only });
        let tree = buffers(&[read, read, read, read, wgpu::BufferBindingType::Uniform]);
        let own = buffers(&[read, read, write, write]);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&tree), Some(&own)],
            immediate_size: 4,
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 48,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        engine.queue.write_buffer(&uniform, 0, bytemuck::bytes_of(&words));
        let named = |name| lights.named(name).expect("a buffer of the tree");
        let heights: Vec<f32> = (0..u32::from(CELLS) * u32::from(CELLS))
            .map(|cell| 1.5 + 4.5 * unit(cell, 9) * unit(cell, 10))
            .collect();
        let text = format!("{}{}", functions::WGSL, include_str!("path.wgsl"));
        Self {
            engine,
            module: device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("path"),
                source: wgpu::ShaderSource::Wgsl(text.into()),
            }),
            layout,
            lights: group(
                engine,
                &tree,
                &[
                    named("nodes"),
                    named("instances"),
                    named("trails"),
                    named("lights"),
                    &uniform,
                ],
            ),
            own,
            heights: engine.stored(bytemuck::cast_slice(&heights)),
            listed: engine.stored(bytemuck::cast_slice(listed)),
            tiles: engine.storage(u64::from(TILE_LIGHTS) * BYTES_OF_TILE_LIGHT),
        }
    }

    /// An empty image that the entry points make, each over so many workgroups.
    fn render(&self, entries: &[(&str, [u32; 2])], method: u32, candidates: u32) -> Render {
        let constants = [
            ("METHOD", f64::from(method)),
            ("CANDIDATES", f64::from(candidates)),
        ];
        let pipeline = |&(entry, groups): &(&str, [u32; 2])| {
            let pipeline = self
                .engine
                .device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: Some(&self.layout),
                    module: &self.module,
                    entry_point: Some(entry),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        ..Default::default()
                    },
                    cache: None,
                });
            (pipeline, groups)
        };
        let image = self.engine.storage(u64::from(SIZE[0] * SIZE[1]) * 16);
        Render {
            pipelines: entries.iter().map(pipeline).collect(),
            group: group(
                self.engine,
                &self.own,
                &[&self.heights, &self.listed, &self.tiles, &image],
            ),
            image,
            passes: 0,
            seconds: 0.0,
        }
    }

    /// Adds a sample to each pixel. All samples of a frame number are alike.
    fn pass(&self, render: &mut Render, frame: u32) -> Result<()> {
        let start = Instant::now();
        let mut encoder = self.engine.device.create_command_encoder(&Default::default());
        // The last one makes the image; tiles serve eight passes, for at this size they would take most of the time.
        let skipped = if render.passes % 8 == 0 {
            0
        } else {
            render.pipelines.len() - 1
        };
        for (pipeline, [x, y]) in &render.pipelines[skipped..] {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.lights, &[]);
            pass.set_bind_group(1, &render.group, &[]);
            pass.set_immediates(0, &frame.to_le_bytes());
            pass.dispatch_workgroups(*x, *y, 1);
        }
        self.engine.queue.submit([encoder.finish()]);
        self.engine.device.poll(wgpu::PollType::wait_indefinitely())?;
        render.passes += 1;
        render.seconds += start.elapsed().as_secs_f64();
        Ok(())
    }

    /// The mean of the image's samples, and an empty image again.
    fn take(&self, render: &mut Render) -> Result<Vec<[f32; 4]>> {
        let sums = self.engine.read(&render.image)?;
        let mean = |sum: &[f32; 4]| sum.map(|part| part / render.passes as f32);
        let image = bytemuck::cast_slice::<u8, [f32; 4]>(&sums)
            .iter()
            .map(mean)
            .collect();
        let mut encoder = self.engine.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&render.image, 0, None);
        self.engine.queue.submit([encoder.finish()]);
        (render.passes, render.seconds) = (0, 0.0);
        Ok(image)
    }
}

fn group(engine: &Engine, layout: &wgpu::BindGroupLayout, buffers: &[&Buffer]) -> BindGroup {
    let resources = buffers.iter().map(|buffer| buffer.as_entire_binding());
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    engine.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}

/// Mean squared error of the image, and relative to the squared reference and a hundredth of its squared mean.
fn errors(image: &[[f32; 4]], reference: &[[f32; 4]]) -> [f64; 2] {
    let values = |image: &[[f32; 4]]| -> Vec<f64> {
        image
            .iter()
            .flat_map(|own| [own[0], own[1], own[2]])
            .map(f64::from)
            .collect()
    };
    let (image, reference) = (values(image), values(reference));
    let count = reference.len() as f64;
    let least = 0.01 * (reference.iter().sum::<f64>() / count).powi(2);
    let squares = image
        .iter()
        .zip(&reference)
        .map(|(a, b)| ((a - b).powi(2), b * b + least));
    squares.fold([0.0, 0.0], |sum, (square, scale)| {
        [sum[0] + square / count, sum[1] + square / scale / count]
    })
}

/// The lamps that the camera sees: radiance, and how much of a pixel they cover. Farther ones are drawn first.
fn lamps_of(mut lights: Vec<EmissiveTriangle>, behind: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f32; 3], b: [f32; 3]| [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i]);
    let unit = |a: [f32; 3]| a.map(|part| part / dot(a, a).sqrt());
    let right = unit(cross(FORWARD, [0.0, 1.0, 0.0]));
    let axes = [right, unit(cross(right, FORWARD)), unit(FORWARD)];
    let seen = |p: [f32; 3]| axes.map(|axis| dot(axis, [0, 1, 2].map(|k| p[k] - EYE[k])));
    lights.sort_by(|a, b| seen(b.p[0])[2].total_cmp(&seen(a.p[0])[2]));
    let [width, height] = SIZE.map(|side| side as f32);
    let mut image = vec![[0.0; 4]; behind.len()];
    for own in lights {
        let corners = own.p.map(seen);
        let depth = corners[0][2];
        let [a, b, c] =
            corners.map(|[x, y, z]| [(0.5 + x / z / 1.3) * width, (0.5 - y / z / 0.975) * height]);
        let inside = |p: [f32; 2]| {
            [(a, b), (b, c), (c, a)]
                .iter()
                .all(|(u, v)| (v[0] - u[0]) * (p[1] - u[1]) < (v[1] - u[1]) * (p[0] - u[0]))
        };
        let range = |k: usize, end: f32| {
            let least = a[k].min(b[k]).min(c[k]).clamp(0.0, end) as u32;
            least..a[k].max(b[k]).max(c[k]).clamp(0.0, end).ceil() as u32
        };
        if depth < 0.1 {
            continue;
        }
        for (y, x) in range(1, height).flat_map(|y| range(0, width).map(move |x| (y, x))) {
            let at = (y * SIZE[0] + x) as usize;
            let part = |k: u16| (f32::from(k) + 0.5) / 8.0;
            let hits = (0..64)
                .filter(|k| inside([x as f32 + part(k % 8), y as f32 + part(k / 8)]))
                .count();
            if depth < behind[at][3] {
                let covered = hits as f32 / 64.0;
                let brightest = own.radiance.iter().fold(0.0_f32, |a, &b| a.max(b));
                let [red, green, blue] = own.radiance.map(|part| 6.0 * part / brightest);
                let light = [red, green, blue, 1.0];
                image[at] = std::array::from_fn(|k| image[at][k] * (1.0 - covered) + light[k] * covered);
            }
        }
    }
    image
}

/// Writes images side by side, with the lamps before them, in sRGB.
fn write(path: &std::path::Path, images: &[&[[f32; 4]]], lamps: &[[f32; 4]]) -> Result<()> {
    let [width, height] = SIZE;
    let mut picture = image::RgbImage::new(width * images.len() as u32, height);
    for (x, y, own) in picture.enumerate_pixels_mut() {
        let pixel = (y * width + x % width) as usize;
        let (behind, lamp) = (images[(x / width) as usize][pixel], lamps[pixel]);
        own.0 = [0, 1, 2].map(|k| {
            let light = 0.5 * (behind[k] * (1.0 - lamp[3]) + lamp[k]);
            // K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016.
            let shown = (light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14);
            (255.0 * shown.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8
        });
    }
    Ok(picture.save(path)?)
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
    let numbers: Vec<f64> = arguments
        .map(|own| own.parse())
        .collect::<std::result::Result<_, _>>()?;
    let number = |k: usize, usual| numbers.get(k).copied().unwrap_or(usual);
    let (seconds, turns, seconds_of_reference) = (number(0, 10.0), number(1, 3.0) as u32, number(2, 120.0));
    let engine = &engine::engines()
        .into_iter()
        .next()
        .ok_or("path_wgpu: no Vulkan adapter with immediates")?;

    // The lamps, and 30 frames of their way.
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lamp())?;
    let add = |k| Edit::AddInstance {
        mesh,
        transform: place(k, 0.0),
        radiance: radiance(k),
        mask: u32::MAX,
    };
    let lamps: Vec<InstanceId> = bvh.apply((0..LAMPS).map(add).collect())?.instances;
    let mut lights = DeviceLights::new(engine)?;
    bvh.refit();
    let mut words = lights.update(engine, &bvh);
    let mut times = Vec::new();
    for frame in 1..=30_u16 {
        let start = Instant::now();
        let edit = |(k, &instance)| Edit::SetTransform {
            instance,
            transform: place(k, f32::from(frame) / 30.0),
        };
        bvh.apply((0..).zip(&lamps).map(edit).collect())?;
        bvh.refit();
        words = lights.update(engine, &bvh);
        engine.device.poll(wgpu::PollType::wait_indefinitely())?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let listed = listed(&bvh);
    println!(
        "{}; {} lights; a frame's edits and refit: {:.1} ms\n",
        engine.name,
        listed.len(),
        median(times)
    );

    let tracer = Tracer::new(engine, &lights, words, &listed);
    let blocks = SIZE.map(|side| side / 8);
    let mut renders: Vec<Render> = METHODS
        .iter()
        .map(|&(_, method, candidates)| {
            let entries = [("presample", [TILE_LIGHTS / 64, 1]), ("path", blocks)];
            tracer.render(&entries[usize::from(method != 1)..], method, candidates)
        })
        .collect();
    // Methods take turns, pass by pass, so that what else the machine does slows all alike.
    let mut frame = 0;
    let mut until = |renders: &mut [Render], seconds: f64| -> Result<()> {
        while let Some(next) = renders
            .iter_mut()
            .filter(|own| own.seconds < seconds)
            .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
        {
            frame += 1;
            tracer.pass(next, frame)?;
        }
        Ok(())
    };
    // Drivers compile in the first pass.
    until(&mut renders, 1e-9)?;
    for render in &mut renders {
        tracer.take(render)?;
    }

    // The reference is the mean of two images; a quarter of their difference squared is its own error.
    until(&mut renders[3..], seconds_of_reference / 2.0)?;
    let halves = [tracer.take(&mut renders[3])?, tracer.take(&mut renders[4])?];
    let mean = |(a, b): (&[f32; 4], &[f32; 4])| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
    let reference: Vec<[f32; 4]> = halves[0].iter().zip(&halves[1]).map(mean).collect();
    let [mse, relative] = errors(&halves[0], &halves[1]).map(|error| error / 4.0);
    println!("error of the reference: MSE {mse:.2e}, relMSE {relative:.4}\n");

    let mut results = vec![Vec::new(); METHODS.len()];
    let mut images = Vec::new();
    for _ in 0..turns {
        until(&mut renders, seconds)?;
        images.clear();
        for (render, results) in renders.iter_mut().zip(&mut results) {
            let (passes, spent) = (render.passes, render.seconds);
            images.push(tracer.take(render)?);
            let [mse, relative] = errors(images.last().expect("an image"), &reference);
            results.push([f64::from(passes), spent, mse, relative]);
        }
    }
    println!(
        "| {seconds} s of each | samples of a pixel | ms of one | MSE | relMSE |\n|---|---|---|---|---|"
    );
    for ((name, ..), results) in METHODS.iter().zip(&results) {
        let of = |value: fn(&[f64; 4]) -> f64| median(results.iter().map(value).collect());
        let (passes, milliseconds) = (of(|own| own[0]), of(|own| own[1] / own[0] * 1e3));
        let (mse, relative) = (of(|own| own[2]), of(|own| own[3]));
        println!("| {name} | {passes} | {milliseconds:.0} | {mse:.2e} | {relative:.4} |");
    }
    let seen = lamps_of(bvh.view().world_lights(), &reference);
    let folder = std::path::Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    write(&folder.join("reference.png"), &[&reference], &seen)?;
    write(
        &folder.join("functions.png"),
        &[&images[0], &images[2], &images[4]],
        &seen,
    )
}
