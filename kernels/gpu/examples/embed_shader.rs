//! A compute shader of one's own samples the lights on the engine's own Vulkan device; every word is compared with the CPU.
//!
//! The shader is the crate `kernels/examples/embed_shader`, which says how its module is built.
//!
//! `cargo run --release -p lightbvh-gpu --example embed_shader -- target/embed_shader/direct.spv`

#[path = "common/mod.rs"]
mod common;
/// What the shader computes, as it stands in the shader's crate.
#[path = "../../examples/embed_shader/src/direct.rs"]
mod direct;

use std::process::ExitCode;
use std::rc::Rc;

use bytemuck::cast_slice;
use common::Result;
use common::buffer::Buffer;
use common::gpu::Gpu;
use common::pipeline::Pipeline;
use common::words::compare;
use common::world::{World, points};
use direct::direct_light;
use lightbvh::ShadingPoint;
use lightbvh_gpu::spirv::{Interface, words};
use lightbvh_gpu::{Buffer as Array, Mirror};

/// The shader's bindings in the order of its parameters.
const BINDINGS: [&str; 6] = ["nodes", "instances", "trails", "triangles", "points", "results"];
const POINTS: u32 = 4096;
const SAMPLES: u32 = 16;

/// A street as it is after ten frames.
fn street() -> Result<World> {
    let mut world = World::new()?;
    for frame in 0..10 {
        world.step(frame)?;
        world.bvh.refit();
    }
    Ok(world)
}

/// Lights the points on the device. Returns the bytes of the results.
fn on_device(gpu: &Rc<Gpu>, module: &[u32], world: &World, points: &[ShadingPoint]) -> Result<Vec<u8>> {
    let bvh = &world.bvh;
    let interface = Interface::read(module)?;
    if interface.buffers.len() != BINDINGS.len() {
        return Err("this is another shader's module; build it again".into());
    }
    let shader = Pipeline::new(
        gpu,
        module,
        &interface.entry_point,
        BINDINGS,
        interface.push_constants,
        interface.workgroup[0],
    )?;
    // The lights stand still here, so all arrays are copied once. `embed_ash` shows lights that move.
    // The first frame of a mirror copies all arrays.
    let frame = Mirror::default().frame(bvh);
    let mut bytes = [const { Vec::new() }; Array::ALL.len()];
    for (array, size) in &frame.resizes {
        bytes[*array as usize].resize(*size as usize, 0);
    }
    for copy in &frame.copies {
        let to = copy.bytes.start as usize..copy.bytes.end as usize;
        bytes[copy.buffer as usize][to].copy_from_slice(copy.source(bvh));
    }
    let arrays = bytes.iter().map(|bytes| Buffer::staged(gpu, bytes));
    let arrays: Vec<Buffer> = arrays.collect::<Result<_>>()?;
    let asked = Buffer::staged(gpu, cast_slice(points))?;
    let results = Buffer::storage(gpu, size_of::<[f32; 3]>() as u64 * points.len() as u64)?;
    let back = Buffer::staging(gpu, results.bytes)?;
    shader.bind(|name| match (Array::named(name), name) {
        (Some(array), _) => &arrays[array as usize],
        (None, "points") => &asked,
        (None, _) => &results,
    });
    let mut push = vec![points.len() as u32, SAMPLES];
    push.extend(bytemuck::cast::<_, [u32; 9]>(frame.words));
    gpu.run(|commands| {
        shader.dispatch(commands, &push, points.len() as u32);
        gpu.barrier(commands);
        results.copy_to(commands, 0, &back, 0, results.bytes);
        gpu.barrier(commands);
    })?;
    back.read()
}

fn run(path: &str) -> Result<()> {
    let bytes = std::fs::read(path).map_err(|error| format!("{path}: {error}"))?;
    let module = words(&bytes);
    let world = street()?;
    let (points, _): (Vec<_>, Vec<_>) = points(0, POINTS).into_iter().unzip();
    let (tree, triangles) = (world.bvh.tree(), world.bvh.triangles());
    let cpu: Vec<[f32; 3]> = (0..)
        .zip(&points)
        .map(|(seed, point)| direct_light(&tree, triangles, point, SAMPLES, seed))
        .collect();
    let lit = cpu.iter().filter(|light| light[0] > 0.0).count();
    for gpu in Gpu::all()? {
        let device = on_device(&gpu, &module, &world, &points)?;
        let words = compare("point", &cpu, &device).map_err(|error| format!("{}: {error}", gpu.name))?;
        println!(
            "{}: {POINTS} points, {lit} lit, {words} words compared, none different",
            gpu.name
        );
    }
    Ok(())
}

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!(
            "embed_shader: give the module; kernels/examples/embed_shader/src/lib.rs says how it is built"
        );
        return ExitCode::from(2);
    };
    match run(&path) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("embed_shader: {error}");
            ExitCode::FAILURE
        }
    }
}
