//! Lights are added, removed and moved in every frame while ReSTIR reuses samples over frames and pixels, and trees are built in
//! the background: no reservoir ever points at another light than the one that was chosen.
//!
//! A sample keeps its two numbers in the unit square as long as it is handed on. So what a reservoir's light was when it was
//! chosen, instance and triangle, is kept beside those, and must be what its number says in each later frame.

use std::collections::HashMap;
use std::sync::Arc;

use lightbvh::bvh::Swap;
use lightbvh::{
    Edit, EmissiveTriangle, InstanceId, LightBvh, Lights, MeshId, Rebuilder, RebuilderParams, Transform,
};
use lightbvh_host::backend::{
    Backend, Combination, CpuBackend, DeviceBackend, Follow, Integrator, LightRemap, Restir, RestirFrame,
    RestirOptions, Sampler, SceneArrays,
};
use lightbvh_host::render::{RayBvh, View, camera};
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::restir::PixelReservoir;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::{Random, small_triangles};

const SIZE: (u32, u32) = (32, 18);
const LAMPS: usize = 24;

/// When numbers of lights that are no more become free.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Taken {
    /// After the frame was resampled: until then none is another light's.
    After,
    /// Before the frame's new lights come, which get them; the remap says so.
    Before,
    /// The same, and nobody says so.
    BeforeUntold,
}

/// An instance and a triangle of its mesh.
type Light = (InstanceId, u32);

/// What a sample's number says now.
fn named(bvh: &LightBvh, light: u32, instance: u32) -> Option<Light> {
    let id = bvh.instance_id(instance)?;
    let own = bvh.lights_of(id)?;
    own.contains(&light).then(|| (id, light - own.start))
}

/// What the reservoirs of the last frame meant when their samples were chosen.
#[derive(Default)]
struct Ledger {
    chosen: HashMap<[u32; 2], Light>,
    /// Samples handed on from frame to frame so far, and those of them whose light moved in that frame.
    reused: usize,
    /// Samples of lights that went.
    gone: usize,
    /// Samples that name another light than was chosen, or none.
    wrong: usize,
}

impl Ledger {
    /// After the frame's edits: samples of the frame before whose lights are no more.
    fn count_gone(&mut self, bvh: &LightBvh) {
        let gone = |(id, _): &&Light| bvh.lights_of(*id).is_none();
        self.gone += self.chosen.values().filter(gone).count();
    }

    /// After the frame.
    fn take(&mut self, bvh: &LightBvh, reservoirs: &[PixelReservoir]) {
        let before = std::mem::take(&mut self.chosen);
        for pixel in reservoirs.iter().filter(|pixel| pixel.reservoir.weight > 0.0) {
            let sample = pixel.reservoir.sample;
            let key = sample.uv.map(f32::to_bits);
            let Some(now) = named(bvh, sample.light, sample.instance) else {
                self.wrong += 1;
                continue;
            };
            if let Some(&then) = before.get(&key) {
                self.reused += 1;
                self.wrong += usize::from(then != now);
            }
            self.chosen.insert(key, now);
        }
    }
}

/// Lamps over a floor.
struct World {
    bvh: LightBvh,
    rebuilder: Rebuilder,
    meshes: Vec<MeshId>,
    lamps: Vec<InstanceId>,
    random: Random,
}

impl World {
    fn new(seed: u32) -> Self {
        let mut bvh = LightBvh::default();
        let meshes = [1, 2, 2, 5].map(|count| bvh.add_mesh(lights(count)).expect("within the domain"));
        let mut world = Self {
            bvh,
            rebuilder: Rebuilder::new(RebuilderParams {
                swap: Swap::Deterministic,
                idle: 0.0,
                ..RebuilderParams::default()
            }),
            meshes: meshes.into(),
            lamps: Vec::new(),
            random: Random::new(seed),
        };
        world.add(LAMPS);
        world.bvh.refit();
        world
    }

    fn below(&mut self, count: usize) -> usize {
        self.random.below(count as u32) as usize
    }

    fn place(&mut self) -> Transform {
        let [x, y, z] = [0; 3].map(|_| self.random.unit());
        Transform::at([12.0 * x - 6.0, 1.5 + 1.5 * y, 5.0 - 12.0 * z])
    }

    fn add(&mut self, count: usize) {
        let edits = (0..count).map(|_| {
            let mesh = self.below(self.meshes.len());
            Edit::AddInstance {
                mesh: self.meshes[mesh],
                transform: self.place(),
                radiance: 1.0,
            }
        });
        let edits = edits.collect();
        let added = self.bvh.apply(edits).expect("within the domain");
        self.lamps.extend(added.instances);
    }

    /// Two lamps go, six move, two come; returns what became of the numbers of lights, where it is told.
    fn frame(&mut self, taken: Taken) -> Option<LightRemap> {
        self.rebuilder.begin_frame(&mut self.bvh).expect("no panic");
        let then = self.bvh.light_end();
        for _ in 0..2 {
            let at = self.below(self.lamps.len());
            let gone = self.lamps.swap_remove(at);
            self.bvh.remove_instance(gone).expect("it is there");
        }
        for _ in 0..6 {
            let (at, place) = (self.below(self.lamps.len()), self.place());
            self.bvh.set_transform(self.lamps[at], place).expect("a place");
        }
        if taken == Taken::After {
            self.add(2);
            return None;
        }
        let removed = self.bvh.take_removed_lights();
        self.add(2);
        (taken == Taken::Before).then(|| LightRemap::after(&self.bvh, then, &removed))
    }
}

/// Bright ones.
fn lights(count: u32) -> Vec<EmissiveTriangle> {
    let mut triangles = small_triangles(count, count, 0.5, 0.5, false, count);
    for triangle in &mut triangles {
        triangle.radiance = [20.0; 3];
        // They shine both ways.
        triangle.flags = 1;
    }
    triangles
}

/// A floor under the lights, which can be seen too.
fn arrays(bvh: &LightBvh) -> SceneArrays {
    let lights = bvh.world_lights();
    let floor = [
        [[-9.0, 0.0, 6.0], [9.0, 0.0, 6.0], [9.0, 0.0, -9.0]],
        [[-9.0, 0.0, 6.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]],
    ];
    let floor = floor.map(|p| SurfaceTriangle {
        p,
        material: 0,
        light: NONE,
        instance: NONE,
    });
    let shining = (0..).zip(&lights).filter(|(_, light)| light.mesh != NONE);
    let shining = shining.map(|(light, triangle)| SurfaceTriangle {
        p: triangle.p,
        material: 0,
        light,
        instance: triangle.mesh,
    });
    let surfaces: Vec<_> = floor.into_iter().chain(shining).collect();
    let view = View {
        eye: [0.0, 4.0, 9.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.94, -0.34],
        forward: [0.0, -0.34, -0.94],
        yfov: 1.0,
    };
    let material = Material {
        albedo: [0.7, 0.6, 0.5],
        specular: 0.1,
        exponent_log2: 3,
    };
    // Listed lights are of mesh lights in a row, which nobody asks for: numbers and instances are the light BVH's.
    let mut listed = lights.clone();
    for (index, light) in listed.iter_mut().enumerate() {
        light.mesh = index as u32;
    }
    SceneArrays::new(
        RayBvh::build(&surfaces).expect("within the grid"),
        vec![material],
        Lights::new(listed).expect("within the domain"),
        camera(&view, SIZE.0, SIZE.1),
    )
}

fn frame<'a>(scene: &'a Arc<SceneArrays>, number: u32, remap: Option<&'a LightRemap>) -> RestirFrame<'a> {
    RestirFrame {
        scene,
        width: SIZE.0,
        height: SIZE.1,
        seed: 0x51 + 131 * number,
        jitter: 0,
        background: [0.0; 3],
        remap,
    }
}

fn options(combination: Combination) -> RestirOptions {
    RestirOptions {
        candidates: 4,
        radius: 5,
        ..RestirOptions::new(Sampler::TwoLevel, combination)
    }
}

/// Frames on the CPU alone.
fn on_the_cpu(combination: Combination, taken: Taken, seed: u32) -> Ledger {
    let mut world = World::new(seed);
    let mut restir = Restir::new(options(combination));
    let mut ledger = Ledger::default();
    for number in 0..60 {
        let remap = if number > 0 { world.frame(taken) } else { None };
        world.bvh.refit();
        world.rebuilder.end_frame(&world.bvh);
        ledger.count_gone(&world.bvh);
        let scene = Arc::new(arrays(&world.bvh));
        let mut cpu = CpuBackend::<Standard, 8>::new(world.bvh.clone());
        cpu.restir(&mut restir, &frame(&scene, number, remap.as_ref()))
            .expect("a frame");
        let (_, reservoirs) = restir.state().expect("a state");
        ledger.take(&world.bvh, &reservoirs);
        world.bvh.take_removed_lights();
    }
    ledger
}

#[test]
fn no_reservoir_points_at_another_light() {
    for combination in [Combination::Unbiased, Combination::Biased] {
        for taken in [Taken::After, Taken::Before] {
            let ledger = on_the_cpu(combination, taken, 3);
            let what = format!("{combination:?} {taken:?}");
            assert_eq!(ledger.wrong, 0, "{what}");
            // There was something to get wrong.
            assert!(ledger.reused > 5_000, "{what}: {}", ledger.reused);
            assert!(ledger.gone > 500, "{what}: {}", ledger.gone);
        }
    }
}

/// What the ledger is for: numbers given to other lights between two frames, and nobody told.
#[test]
fn a_number_that_is_anothers_is_found() {
    let ledger = on_the_cpu(Combination::Biased, Taken::BeforeUntold, 3);
    assert!(ledger.wrong > 20, "{} of {}", ledger.wrong, ledger.reused);
}

/// A device that follows by plans, beside the CPU: the same reservoirs, and the same paths over the same frames.
#[test]
fn no_reservoir_of_a_device_points_at_another_light() {
    for (combination, taken) in [
        (Combination::Unbiased, Taken::After),
        (Combination::Biased, Taken::Before),
    ] {
        on_each_device(Options::default(), |device| {
            let mut world = World::new(4);
            let mut cpu = CpuBackend::<Standard, 8>::new(world.bvh.clone());
            let mut other = DeviceBackend::<Standard, 8>::new(device, &world.bvh).expect("an upload");
            let mut on_cpu = Restir::new(options(combination));
            let mut on_device = Restir::new(options(combination));
            let mut ledger = Ledger::default();
            for number in 0..16 {
                let what = format!("{} {combination:?} {taken:?} frame {number}", device.name());
                let mut remap = None;
                if number > 0 {
                    remap = world.frame(taken);
                    world.bvh.refit();
                    other.follow(&world.bvh).expect("copies and a refit");
                    cpu.follow(&world.bvh).expect("a copy");
                    world.rebuilder.end_frame(&world.bvh);
                }
                ledger.count_gone(&world.bvh);
                let scene = Arc::new(arrays(&world.bvh));
                let frame = frame(&scene, number, remap.as_ref());
                let expected = cpu.restir(&mut on_cpu, &frame).expect("a frame").value;
                let found = other.restir(&mut on_device, &frame).expect("a frame").value;
                assert!(expected == found, "{what}");
                let (surfaces, reservoirs) = on_device.state().expect("a state");
                assert!(
                    (surfaces, reservoirs.clone()) == on_cpu.state().expect("a state"),
                    "{what}"
                );
                ledger.take(&world.bvh, &reservoirs);
                world.bvh.take_removed_lights();
                if number % 5 == 4 {
                    paths(&scene, &mut [&mut cpu, &mut other], &what);
                }
            }
            assert_eq!(ledger.wrong, 0, "{}", device.name());
            assert!(ledger.reused > 1_000 && ledger.gone > 100, "{}", device.name());
        });
    }
}

/// Paths by the frame's own light BVH: lights that rays meet are asked for by the names that the scene gives them.
fn paths(scene: &SceneArrays, backends: &mut [&mut dyn Backend; 2], what: &str) {
    let params = RenderParams {
        width: SIZE.0,
        height: SIZE.1,
        samples: 2,
        first: 0,
        all: 0,
        candidates: 1,
        scattered: 0,
        part: 0,
        parts: 1,
        seed: 7,
        jitter: 1,
        background: [0.0; 3],
    };
    let path = Integrator::Path { bounces: 2 };
    let [cpu, device] = backends.each_mut().map(|backend| {
        let image = backend.render(scene, &params, Sampler::TwoLevel, path);
        image.expect("an image").value
    });
    assert!(cpu == device, "{what}: paths");
    assert!(cpu.iter().any(|pixel| pixel[0] > 0.0), "{what}: nothing is lit");
}
