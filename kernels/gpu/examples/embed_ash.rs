//! Moving lights on the engine's own Vulkan device: twenty frames, every word compared with the CPU.
//!
//! `cargo run --release -p lightbvh-gpu --example embed_ash [-- target/embed_shader/direct.spv]`
//!
//! The argument is the module of a compute shader of one's own, which then lights points with the same arrays: the crate
//! `kernels/examples/embed_shader` says how it is built.
//!
//! The folder `common` is the engine: it opens the device, owns buffers and pipelines, and knows nothing of lights. This file
//! is what an engine adds for lightbvh. Each frame it copies what the edits changed, dispatches the refit, and samples.

#[path = "common/mod.rs"]
mod common;
/// What the shader computes, as the shader's crate has it.
#[path = "common/direct.rs"]
mod direct;

use std::process::ExitCode;
use std::rc::Rc;

use ash::vk;
use bytemuck::cast_slice;
use common::Result;
use common::buffer::Buffer;
use common::gpu::Gpu;
use common::pipeline::Pipeline;
use common::words::compare;
use common::world::{World, points};
use direct::direct_light;
use lightbvh::node::DefaultNode;
use lightbvh::{LightBvh, Random64, SampledLight, ShadingPoint};
use lightbvh_gpu::spirv;
use lightbvh_gpu::{Buffer as Array, Frame, MOMENTS, Mirror, Pass, Query, query_push, self_test};

const FRAMES: u16 = 20;
const QUERIES: u32 = 10_000;
/// Bindings of the shader of one's own, in the order of its parameters; how many points it lights, by how many samples each.
const BINDINGS: [&str; 6] = ["nodes", "instances", "trails", "triangles", "points", "results"];
const POINTS: u32 = 4096;
const SAMPLES: u32 = 16;

/// What an engine keeps for the lights of one scene.
struct DeviceLights {
    gpu: Rc<Gpu>,
    /// Knows which bytes the device holds.
    mirror: Mirror,
    /// One for each of `Array::ALL`.
    arrays: Vec<Buffer>,
    refits: Vec<(Pass, Pipeline)>,
    sample: Pipeline,
}

/// What one frame gave, copied back to be compared.
struct Results {
    nodes: Vec<u8>,
    samples: Vec<u8>,
}

impl DeviceLights {
    fn new(gpu: &Rc<Gpu>) -> Result<Self> {
        Ok(Self {
            gpu: Rc::clone(gpu),
            mirror: Mirror::default(),
            arrays: Array::ALL
                .iter()
                .map(|_| Buffer::storage(gpu, 0))
                .collect::<Result<_>>()?,
            refits: Pass::ALL
                .into_iter()
                .map(|pass| Ok((pass, kernel(gpu, MOMENTS.refit(pass))?)))
                .collect::<Result<_>>()?,
            sample: kernel(gpu, MOMENTS.sample)?,
        })
    }

    /// Updates the device to the light BVH, and samples there.
    fn frame(&mut self, bvh: &LightBvh, queries: &[Query]) -> Result<Results> {
        let frame = self.mirror.frame(bvh);
        self.grow(&frame)?;
        // The bytes of all copies, one after another.
        let staging: Vec<u8> = frame
            .copies
            .iter()
            .flat_map(|copy| copy.source(bvh))
            .copied()
            .collect();
        let staging = Buffer::staged(&self.gpu, &staging)?;
        let list = Buffer::staged(&self.gpu, cast_slice(&frame.refit.list))?;
        let children = Buffer::storage(&self.gpu, frame.refit.children)?;
        let asked = Buffer::staged(&self.gpu, cast_slice(queries))?;
        let answers = Buffer::storage(&self.gpu, size_of::<SampledLight>() as u64 * queries.len() as u64)?;

        // Bindings have names. Those that `Array::named` does not know are this frame's.
        let named = |name: &str| match (Array::named(name), name) {
            (Some(array), _) => &self.arrays[array as usize],
            (None, "list") => &list,
            (None, "children") => &children,
            (None, "queries") => &asked,
            (None, "results") => &answers,
            (None, other) => panic!("no kernel here has a binding {other}"),
        };
        for (_, pipeline) in &self.refits {
            pipeline.bind(named);
        }
        self.sample.bind(named);

        let nodes = &self.arrays[Array::Nodes as usize];
        let nodes_back = Buffer::staging(&self.gpu, nodes.bytes)?;
        let answers_back = Buffer::staging(&self.gpu, answers.bytes)?;
        let push = query_push(queries.len() as u32, frame.words);
        let gpu = &self.gpu;
        gpu.run(|commands| {
            // After the frame before, and the growth.
            gpu.barrier(commands);
            // One command for each array, of as many regions as there are.
            for (array, regions) in frame.regions(0) {
                let regions: Vec<_> = regions
                    .iter()
                    .map(|region| vk::BufferCopy {
                        src_offset: region.from,
                        dst_offset: region.to,
                        size: region.bytes,
                    })
                    .collect();
                staging.copy_regions(commands, &self.arrays[array as usize], &regions);
            }
            gpu.barrier(commands);
            for dispatch in &frame.refit.dispatches {
                self.refit(dispatch.pass)
                    .dispatch(commands, &dispatch.push(), dispatch.count);
                // The next dispatch reads what this one wrote.
                gpu.barrier(commands);
            }
            self.sample.dispatch(commands, &push, queries.len() as u32);
            gpu.barrier(commands);
            nodes.copy_to(commands, 0, &nodes_back, 0, nodes.bytes);
            answers.copy_to(commands, 0, &answers_back, 0, answers.bytes);
            gpu.barrier(commands);
        })?;
        Ok(Results {
            nodes: nodes_back.read()?,
            samples: answers_back.read()?,
        })
    }

    /// Makes larger what became too small, and copies what it held.
    fn grow(&mut self, frame: &Frame) -> Result<()> {
        for &(array, bytes) in &frame.resizes {
            let held = &mut self.arrays[array as usize];
            if bytes > held.bytes {
                // Half as much again: most frames then need no new buffer.
                let new = Buffer::storage(&self.gpu, bytes + bytes / 8 * 4)?;
                self.gpu
                    .run(|commands| held.copy_to(commands, 0, &new, 0, held.bytes))?;
                *held = new;
            }
        }
        Ok(())
    }

    /// Lights points by a shader of one's own.
    fn light(&self, bvh: &LightBvh, module: &[u32], points: &[ShadingPoint]) -> Result<Vec<u8>> {
        let shader = Pipeline::new(&self.gpu, module, BINDINGS)?;
        let asked = Buffer::staged(&self.gpu, cast_slice(points))?;
        let results = Buffer::storage(&self.gpu, size_of::<[f32; 3]>() as u64 * points.len() as u64)?;
        let back = Buffer::staging(&self.gpu, results.bytes)?;
        shader.bind(|name| match (Array::named(name), name) {
            (Some(array), _) => &self.arrays[array as usize],
            (None, "points") => &asked,
            (None, _) => &results,
        });
        let mut push = vec![points.len() as u32, SAMPLES];
        push.extend(bytemuck::cast::<_, [u32; 9]>(self.mirror.words(bvh)));
        self.gpu.run(|commands| {
            shader.dispatch(commands, &push, points.len() as u32);
            self.gpu.barrier(commands);
            results.copy_to(commands, 0, &back, 0, results.bytes);
            self.gpu.barrier(commands);
        })?;
        back.read()
    }

    fn refit(&self, wanted: Pass) -> &Pipeline {
        let found = self.refits.iter().find(|(pass, _)| *pass == wanted);
        &found.expect("there is one for each pass").1
    }
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
    let back = Buffer::staging(gpu, answers.bytes)?;
    let kernel = kernel(gpu, &self_test::SELF_TEST)?;
    kernel.bind(|name| if name == "operands" { &operands } else { &answers });
    gpu.run(|commands| {
        kernel.dispatch(commands, &self_test::PUSH, self_test::INVOCATIONS);
        gpu.barrier(commands);
        answers.copy_to(commands, 0, &back, 0, answers.bytes);
        gpu.barrier(commands);
    })?;
    Ok(self_test::defect(&back.read()?).map_or(Ok(()), Err)?)
}

/// Runs all frames on one device, then a shader of one's own. Returns how many words were compared.
fn run(gpu: &Rc<Gpu>, shader: Option<&[u32]>) -> Result<u64> {
    check(gpu)?;
    let mut world = World::new()?;
    let mut lights = DeviceLights::new(gpu)?;
    let mut words = 0;
    for frame in 0..FRAMES {
        world.step(frame)?;
        let asked = points(frame, QUERIES);
        let queries: Vec<Query> = asked
            .iter()
            .map(|&(point, random)| Query::sample(point, random))
            .collect();
        let device = lights.frame(&world.bvh, &queries)?;

        let samples: Vec<SampledLight> = asked
            .iter()
            .map(|(point, random)| world.bvh.sample(point, Random64::from(*random)))
            .collect();
        words += compare("node", world.bvh.nodes(), &device.nodes)?;
        let top = lights.mirror.top::<DefaultNode>() as usize * size_of::<DefaultNode>();
        words += compare(
            "node of the top level",
            world.bvh.top_nodes(),
            &device.nodes[top..],
        )?;
        words += compare("sample", &samples, &device.samples)?;
    }
    if let Some(module) = shader {
        let (points, _): (Vec<_>, Vec<_>) = points(0, POINTS).into_iter().unzip();
        let (tree, triangles) = (world.bvh.tree(), world.bvh.triangles());
        let cpu: Vec<[f32; 3]> = (0..)
            .zip(&points)
            .map(|(seed, point)| direct_light(&tree, triangles, point, SAMPLES, seed))
            .collect();
        words += compare("point", &cpu, &lights.light(&world.bvh, module, &points)?)?;
    }
    Ok(words)
}

/// On each device; `shader` is the file of a module.
fn on_all(shader: Option<String>) -> Result<()> {
    let bytes = shader.map(|path| std::fs::read(&path).map_err(|error| format!("{path}: {error}")));
    let module = bytes.transpose()?.map(|bytes| spirv::words(&bytes));
    for gpu in Gpu::all()? {
        let words = run(&gpu, module.as_deref()).map_err(|error| format!("{}: {error}", gpu.name))?;
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
