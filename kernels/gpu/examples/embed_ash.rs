//! Moving lights on the engine's own Vulkan device: twenty frames, every word compared with the CPU.
//!
//! `cargo run --release -p lightbvh-gpu --example embed_ash [-- target/embed_shader/direct.spv [target/glossy/sample.spv]]`
//!
//! The first argument is the module of a compute shader of one's own, which then lights points with the same arrays: the crate
//! `kernels/examples/embed_shader` says how it is built. The second is the kernel `sample` for another receiver: `build-kernels --model
//! '(MomentNode<8>, Glossy<DefaultImportance>)' --width 8 --receiver GlossyPoint --out target/glossy`.
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

use bytemuck::{Pod, Zeroable, cast_slice, pod_read_unaligned};
use common::Result;
use common::buffer::Buffer;
use common::commands::{read, run};
use common::gpu::Gpu;
use common::pipeline::Pipeline;
use common::words::compare;
use common::world::{World, points};
use direct::direct_light;
use lightbvh::importance::{DefaultImportance, Glossy, GlossyPoint};
use lightbvh::node::DefaultNode;
use lightbvh::{LightBvh, LightTree, Random64, SampledLight, TreeWords};
use lightbvh_gpu::spirv;
use lightbvh_gpu::{DeviceBuffer, MOMENTS, Mirror, Pass, Query, Step, query_push, self_test};

const FRAMES: u16 = 20;
const QUERIES: u32 = 10_000;
/// Bindings of the shader of one's own, in the order of its parameters; how many points it lights, by how many samples each.
const BINDINGS: [&str; 6] = ["nodes", "instances", "trails", "lights", "points", "results"];
const POINTS: u32 = 4096;
const SAMPLES: u32 = 16;
/// Bindings of the kernel for another receiver.
const SAMPLE_BINDINGS: [&str; 5] = ["nodes", "instances", "trails", "queries", "results"];

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

/// Runs all frames on one device, then a shader of one's own and the kernel for glossy points. Returns how many words were compared.
fn frames(gpu: &Rc<Gpu>, [shader, glossy]: [Option<&[u32]>; 2]) -> Result<u64> {
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
    if let Some(module) = glossy {
        words += glossy_points(gpu, &lights, lights.mirror.words(&world.bvh), module)?;
    }
    Ok(words)
}

/// A glossy point, and the number of its walk.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GlossyQuery {
    receiver: GlossyPoint,
    words: [u32; 2],
}

/// The nodes of `LightBvh` serve receivers that it does not take: the importance alone is another one.
fn glossy_points(gpu: &Rc<Gpu>, lights: &DeviceLights, tree: TreeWords, module: &[u32]) -> Result<u64> {
    let asked: Vec<(GlossyPoint, Random64)> = points(0, QUERIES)
        .into_iter()
        .map(|(point, random)| {
            let glossy = GlossyPoint {
                point,
                mirror: point.n,
                diffuse: 0.25,
                specular: 0.5,
                exponent: 40.0,
            };
            (glossy, Random64::from(random))
        })
        .collect();
    let queries: Vec<GlossyQuery> = asked
        .iter()
        .map(|&(receiver, random)| GlossyQuery {
            receiver,
            words: [random.high, random.low],
        })
        .collect();
    let samples = ask(
        gpu,
        lights,
        &Pipeline::new(gpu, module, SAMPLE_BINDINGS)?,
        (cast_slice(&queries), QUERIES),
        &query_push(QUERIES, tree),
        size_of::<SampledLight>() as u32,
    )?;
    let [nodes, instances, trails] = ["nodes", "instances", "trails"].map(|name| lights.named(name));
    let held = |buffer: Option<&Buffer>| read(gpu, buffer.ok_or("an array is not on the device")?);
    let (nodes, instances, trails) = (held(nodes)?, held(instances)?, held(trails)?);
    let nodes: Vec<DefaultNode> = elements(&nodes);
    let (instances, trails) = (elements(&instances), elements(&trails));
    let tree: LightTree<'_, DefaultNode, Glossy<DefaultImportance>, 8> =
        tree.tree(&nodes, &instances, &trails);
    let expected: Vec<SampledLight> = asked
        .iter()
        .map(|(receiver, random)| tree.sample(receiver, *random))
        .collect();
    compare("glossy point", &expected, &samples)
}

fn elements<T: Pod>(bytes: &[u8]) -> Vec<T> {
    bytes
        .chunks_exact(size_of::<T>())
        .map(pod_read_unaligned)
        .collect()
}

/// On each device; `files` are those of modules.
fn on_all(files: [Option<String>; 2]) -> Result<()> {
    let module = |path: String| {
        let bytes = std::fs::read(&path).map_err(|error| format!("{path}: {error}"))?;
        Ok::<_, String>(spirv::words(&bytes))
    };
    let [shader, glossy] = files.map(|path| path.map(module).transpose());
    let modules = [shader?, glossy?];
    for gpu in Gpu::all()? {
        let words = frames(&gpu, modules.each_ref().map(Option::as_deref))
            .map_err(|error| format!("{}: {error}", gpu.name))?;
        println!(
            "{}: {FRAMES} frames, {words} words compared, none different",
            gpu.name
        );
    }
    Ok(())
}

fn main() -> ExitCode {
    match on_all([1, 2].map(|at| std::env::args().nth(at))) {
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
        _ => on_all([None, None]).expect("equal words"),
    }
}
