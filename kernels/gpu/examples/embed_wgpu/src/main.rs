//! Moving lights on wgpu: twenty frames, every word compared with the CPU.
//!
//! `cargo run --manifest-path kernels/gpu/examples/embed_wgpu/Cargo.toml`
//!
//! A module reaches the driver by one of two roads. Each is tried on each Vulkan adapter.
//! - **Passthrough** (`Features::PASSTHROUGH_SHADERS`): the driver gets the words of lightbvh, and with them `NoContraction` on
//!   each operation. The bits are those of the CPU on a device that calculates exactly. The program fails if one differs.
//! - **Translated** by naga, the only road in a browser: naga drops `NoContraction`, and equal bits are not promised. Measured with
//!   wgpu 30 on llvmpipe and SwiftShader: all words of nodes are equal; 1 probability in 6 differs, small ones by up to 0.5 %; 2
//!   samples of 200,000 are other lights. The program says how many words differ, and goes on. If the CPU must know what the device
//!   chose, take its word for it: copy its samples back instead of computing them again.
//!
//! wgpu opens devices without `vulkanMemoryModel`, so `without_vulkan_memory_model` changes the modules. Kernels take push
//! constants, which wgpu calls immediates (`Features::IMMEDIATES`).

mod engine;
mod lights;
#[path = "../../common/world.rs"]
mod world;

use std::process::ExitCode;

use engine::{Engine, Road};
use lightbvh::SampledLight;
use lightbvh_gpu::{MOMENTS, Query, query_push};
use lights::DeviceLights;
use world::{World, points};

/// What the program fails with: a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const FRAMES: u16 = 20;
const QUERIES: u32 = 10_000;

/// Runs all frames. Returns how many words were compared, and how many of them differ.
fn run(engine: &Engine) -> Result<(u64, u64)> {
    let mut world = World::new()?;
    let mut lights = DeviceLights::new(engine)?;
    let sample = engine.pipeline(MOMENTS.sample)?;
    let (mut all, mut different) = (0, 0);
    for frame in 0..FRAMES {
        world.step(frame)?;
        let tree = lights.update(engine, &world.bvh);
        let asked = points(frame, QUERIES);
        let queries: Vec<Query> = asked
            .iter()
            .map(|&(point, random)| Query::sample(point, random))
            .collect();
        let queries = engine.stored(bytemuck::cast_slice(&queries));
        let results = engine.storage(size_of::<SampledLight>() as u64 * u64::from(QUERIES));
        let mut encoder = engine.device.create_command_encoder(&Default::default());
        let named = |name: &str| match name {
            "queries" => Some(&queries),
            "results" => Some(&results),
            _ => lights.named(name),
        };
        engine.dispatch(&mut encoder, &sample, named, &query_push(QUERIES, tree), QUERIES);
        engine.queue.submit([encoder.finish()]);

        let used = lights.mirror.in_use(&world.bvh);
        for (buffer, held) in &lights.buffers {
            let held = engine.read(held)?;
            for (_, at, cpu) in used.iter().filter(|(of, ..)| of == buffer) {
                all += cpu.len() as u64 / 4;
                different += differing(cpu, &held[*at as usize..][..cpu.len()]);
            }
        }
        let samples: Vec<SampledLight> = asked
            .iter()
            .map(|(point, random)| world.bvh.tree().sample(point, *random))
            .collect();
        let device = engine.read(&results)?;
        all += size_of_val(&*samples) as u64 / 4;
        different += differing(&samples, &device);
    }
    match (engine.road, different) {
        (Road::Passthrough, 1..) => Err(format!("{different} of {all} words differ").into()),
        _ => Ok((all, different)),
    }
}

/// How many words differ.
fn differing<T: bytemuck::Pod>(cpu: &[T], device: &[u8]) -> u64 {
    let cpu = bytemuck::cast_slice::<T, u8>(cpu).chunks(4);
    cpu.zip(device.chunks(4)).filter(|(a, b)| a != b).count() as u64
}

fn main() -> ExitCode {
    let mut code = ExitCode::SUCCESS;
    let engines = engine::engines();
    if engines.is_empty() {
        eprintln!(
            "embed_wgpu: no Vulkan adapter with immediates; install mesa-vulkan-drivers for one in software"
        );
        code = ExitCode::FAILURE;
    }
    for engine in engines {
        let what = format!("{}, {:?}", engine.name, engine.road);
        match run(&engine) {
            Ok((all, 0)) => println!("{what}: {FRAMES} frames, {all} words compared, none different"),
            Ok((all, some)) => println!("{what}: {FRAMES} frames, {all} words compared, {some} different"),
            Err(error) => {
                eprintln!("embed_wgpu: {what}: {error}");
                code = ExitCode::FAILURE;
            }
        }
    }
    code
}
