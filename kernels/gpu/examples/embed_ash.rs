//! Moving lights on the engine's own Vulkan device: twenty frames, every word compared with the CPU.
//!
//! `cargo run --release -p lightbvh-gpu --example embed_ash [-- target/embed_shader/direct.spv]`
//!
//! The argument is the module of a compute shader of one's own, which then lights points with the same arrays: the crate
//! `kernels/examples/embed_shader` says how it is built.
//!
//! The folder `common` is the engine: it opens the device, owns buffers and pipelines, and knows nothing of lights. This file
//! is what an engine adds for lightbvh: `DeviceLights`, which does the steps of each frame, and the queries.

#[path = "common/mod.rs"]
mod common;
/// What the shader computes, as the shader's crate has it.
#[path = "common/direct.rs"]
mod direct;

use std::collections::HashMap;
use std::process::ExitCode;
use std::rc::Rc;

use bytemuck::cast_slice;
use common::Result;
use common::buffer::Buffer;
use common::commands::{read, run};
use common::gpu::Gpu;
use common::pipeline::Pipeline;
use common::words::compare;
use common::world::{World, points};
use direct::direct_light;
use lightbvh::{LightBvh, SampledLight, TreeWords};
use lightbvh_gpu::spirv;
use lightbvh_gpu::{DeviceBuffer, MOMENTS, Mirror, Pass, Query, Step, query_push, self_test};

const FRAMES: u16 = 20;
const QUERIES: u32 = 10_000;
/// Bindings of the shader of one's own, in the order of its parameters; how many points it lights, by how many samples each.
const BINDINGS: [&str; 6] = ["nodes", "instances", "trails", "lights", "points", "results"];
const POINTS: u32 = 4096;
const SAMPLES: u32 = 16;

/// What an engine keeps for the lights of one scene.
struct DeviceLights {
    /// Knows what the device holds.
    mirror: Mirror,
    buffers: HashMap<DeviceBuffer, Buffer>,
    /// In the order of `Pass::ALL`.
    refits: Vec<Pipeline>,
}

impl DeviceLights {
    fn new(gpu: &Rc<Gpu>) -> Result<Self> {
        let refits = Pass::ALL.iter().map(|&pass| kernel(gpu, MOMENTS.refit(pass)));
        Ok(Self {
            mirror: Mirror::default(),
            buffers: HashMap::new(),
            refits: refits.collect::<Result<_>>()?,
        })
    }

    /// Updates the device to the light BVH. Returns the push constants of kernels that walk it.
    fn update(&mut self, gpu: &Rc<Gpu>, bvh: &LightBvh) -> Result<TreeWords> {
        let frame = self.mirror.frame(bvh);
        run(gpu, |commands| {
            for step in frame.steps() {
                match step {
                    Step::Resize { buffer, bytes } => {
                        self.buffers.insert(buffer, Buffer::storage(gpu, bytes)?);
                    }
                    Step::Upload { buffer, at, bytes } => {
                        commands.upload(&self.buffers[&buffer], at, bytes)?
                    }
                    Step::Dispatch { pass, push, count } => {
                        commands.dispatch(&self.refits[pass as usize], |name| self.named(name), &push, count);
                    }
                }
            }
            Ok(())
        })?;
        Ok(frame.words)
    }

    fn named(&self, binding: &str) -> Option<&Buffer> {
        DeviceBuffer::named(binding).and_then(|buffer| self.buffers.get(&buffer))
    }
}

/// The words of a kernel's results for `asked` elements of `queries`; `lights` are its other buffers.
fn ask(
    gpu: &Rc<Gpu>,
    lights: &DeviceLights,
    kernel: &Pipeline,
    asked: (&[u8], u32),
    push: &[u32],
    stride: u32,
) -> Result<Vec<u8>> {
    let (queries, count) = asked;
    let results = Buffer::storage(gpu, u64::from(stride) * u64::from(count))?;
    let queries = Buffer::staged(gpu, queries)?;
    run(gpu, |commands| {
        let named = |name: &str| match name {
            "results" => Some(&results),
            "queries" | "points" => Some(&queries),
            _ => lights.named(name),
        };
        commands.dispatch(kernel, named, push, count);
        Ok(())
    })?;
    read(gpu, &results)
}

/// A pipeline of a kernel, whose bindings have names.
fn kernel(gpu: &Rc<Gpu>, kernel: &lightbvh_gpu::Kernel) -> Result<Pipeline> {
    let names = kernel.bindings.iter().map(|binding| binding.name);
    Pipeline::new(gpu, &kernel.words(), names)
}

/// Does the device calculate exactly? An engine asks once for each device and driver.
fn check(gpu: &Rc<Gpu>) -> Result<()> {
    let operands = Buffer::staged(gpu, self_test::operands())?;
    let answers = Buffer::storage(gpu, self_test::ANSWERS_BYTES as u64)?;
    let kernel = kernel(gpu, &self_test::SELF_TEST)?;
    run(gpu, |commands| {
        let named = |name: &str| Some(if name == "operands" { &operands } else { &answers });
        commands.dispatch(&kernel, named, &self_test::PUSH, self_test::INVOCATIONS);
        Ok(())
    })?;
    Ok(self_test::defect(&read(gpu, &answers)?).map_or(Ok(()), Err)?)
}

/// Runs all frames on one device, then a shader of one's own. Returns how many words were compared.
fn frames(gpu: &Rc<Gpu>, shader: Option<&[u32]>) -> Result<u64> {
    check(gpu)?;
    let mut world = World::new()?;
    let mut lights = DeviceLights::new(gpu)?;
    let sample = kernel(gpu, MOMENTS.sample)?;
    let mut words = 0;
    for frame in 0..FRAMES {
        world.step(frame)?;
        let tree = lights.update(gpu, &world.bvh)?;
        let asked = points(frame, QUERIES);
        let queries: Vec<Query> = asked
            .iter()
            .map(|&(point, random)| Query::sample(point, random))
            .collect();
        let push = query_push(QUERIES, tree);
        let samples = ask(
            gpu,
            &lights,
            &sample,
            (cast_slice(&queries), QUERIES),
            &push,
            size_of::<SampledLight>() as u32,
        )?;

        let used = lights.mirror.in_use(&world.bvh);
        for (buffer, held) in &lights.buffers {
            let held = read(gpu, held)?;
            for (_, at, cpu) in used.iter().filter(|(of, ..)| of == buffer) {
                if held[*at as usize..][..cpu.len()] != **cpu {
                    return Err(format!("{buffer:?} differs from byte {at} on").into());
                }
                words += cpu.len() as u64 / 4;
            }
        }
        let expected: Vec<SampledLight> = asked
            .iter()
            .map(|(point, random)| world.bvh.tree().sample(point, *random))
            .collect();
        words += compare("sample", &expected, &samples)?;
    }
    if let Some(module) = shader {
        let (points, _): (Vec<_>, Vec<_>) = points(0, POINTS).into_iter().unzip();
        let (tree, triangles) = (world.bvh.tree(), world.bvh.view().lights());
        let cpu: Vec<[f32; 3]> = (0..)
            .zip(&points)
            .map(|(seed, point)| direct_light(&tree, triangles, point, SAMPLES, seed))
            .collect();
        let mut push = vec![POINTS, SAMPLES];
        push.extend(bytemuck::cast::<_, [u32; 9]>(lights.mirror.words(&world.bvh)));
        let shader = Pipeline::new(gpu, module, BINDINGS)?;
        let device = ask(
            gpu,
            &lights,
            &shader,
            (cast_slice(&points), POINTS),
            &push,
            size_of::<[f32; 3]>() as u32,
        )?;
        words += compare("point", &cpu, &device)?;
    }
    Ok(words)
}

/// On each device; `shader` is the file of a module.
fn on_all(shader: Option<String>) -> Result<()> {
    let bytes = shader.map(|path| std::fs::read(&path).map_err(|error| format!("{path}: {error}")));
    let module = bytes.transpose()?.map(|bytes| spirv::words(&bytes));
    for gpu in Gpu::all()? {
        let words = frames(&gpu, module.as_deref()).map_err(|error| format!("{}: {error}", gpu.name))?;
        println!(
            "{}: {FRAMES} frames, {words} words compared, none different",
            gpu.name
        );
    }
    Ok(())
}

fn main() -> ExitCode {
    match on_all(std::env::args().nth(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("embed_ash: {error}");
            ExitCode::FAILURE
        }
    }
}

/// `cargo test` runs this too. Without a device it passes, unless LIGHTBVH_REQUIRE_VULKAN is set.
#[test]
fn every_word_agrees() {
    match Gpu::all() {
        Err(error) if std::env::var_os("LIGHTBVH_REQUIRE_VULKAN").is_none() => println!("skipped: {error}"),
        _ => on_all(None).expect("equal words"),
    }
}
