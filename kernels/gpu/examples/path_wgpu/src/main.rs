//! A path tracer on wgpu that calls the functions for shaders: a city at night, 1,024 moving lamps of 10,240 triangles.
//!
//! `cargo run --manifest-path kernels/gpu/examples/path_wgpu/Cargo.toml -- <folder> [<seconds>]`
//!
//! Each method renders the same frame for that long, once in each turn, on the first Vulkan adapter. The table has the medians
//! of the errors, the picture in the folder shows uniform choice, tiles of 32 candidates, and `lightbvh_sample`. The path tracer
//! is `path.wgsl`, `tracer.rs` and `scene.rs`; the device and the lights on it are those of `embed_wgpu`.

// Only the CPU places lamps and draws the picture, so any function does.
#![allow(clippy::disallowed_methods)]

#[path = "../../embed_wgpu/src/engine.rs"]
mod engine;
#[path = "../../embed_wgpu/src/lights.rs"]
mod lights;
mod picture;
mod scene;
mod tracer;

use std::path::Path;
use std::time::Instant;

use lightbvh::{Edit, LightBvh};
use lights::DeviceLights;
use tracer::{Image, Render};

/// What the program fails with: a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const TURNS: u32 = 3;

/// Name, `METHOD`, and `CANDIDATES`.
const METHODS: [(&str, u32, u32); 5] = [
    ("uniform", 0, 1),
    ("presampled tiles, 8 candidates", 1, 8),
    ("presampled tiles, 32 candidates", 1, 32),
    ("`lightbvh_sample`", 2, 1),
    ("`lightbvh_sample`, 8 candidates", 2, 8),
];

/// Mean squared error of the image, and relative to the squared reference and a hundredth of its squared mean.
fn errors(image: &Image, reference: &Image) -> [f64; 2] {
    let count = 3.0 * reference.len() as f64;
    let mean = reference
        .iter()
        .flat_map(|own| &own[..3])
        .map(|&own| f64::from(own))
        .sum::<f64>()
        / count;
    let (mut absolute, mut relative) = (0.0, 0.0);
    let pairs = image
        .iter()
        .zip(reference)
        .flat_map(|(a, b)| a[..3].iter().zip(&b[..3]));
    for (a, b) in pairs.map(|(&a, &b)| (f64::from(a), f64::from(b))) {
        absolute += (a - b).powi(2) / count;
        relative += (a - b).powi(2) / (b * b + 0.01 * mean * mean) / count;
    }
    [absolute, relative]
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

    // The lamps, and one second of their motion.
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
    bvh.refit();
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
    let methods = METHODS.map(|(_, method, candidates)| [method, candidates]);
    let mut renders = tracer::renders(engine, &lights, words, &listed, &methods);
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
    picture::write(&folder.join("reference.png"), &[&reference])?;
    picture::write(
        &folder.join("functions.png"),
        &[&images[0], &images[2], &images[3]],
    )
}
