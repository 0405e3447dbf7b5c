//! How every call of a BVH grows: time (median, and 99.9 %), bytes allocated, and bytes that a device's mirror copies, from 10³ to 10⁶
//! instances or triangles.
//!
//! `cargo run --release -p lightbvh --example growth [-- LARGEST]` (8 min; 1 min up to 100000)

use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use lightbvh::bvh::{InstanceId, MeshId, RebuildParams};
use lightbvh::node::MomentNode;
use lightbvh::refit::Instance;
use lightbvh::{
    BuildParams, Edit, EmissiveTriangle, LightBvh, Lights, Random64, Rebuilder, ShadingPoint, Transform,
};

/// The system's allocator, counting the bytes asked for.
struct Counting;

static ALLOCATED: AtomicU64 = AtomicU64::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATED.fetch_add(layout.size() as u64, Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Longest time spent on one row.
const PATIENCE: Duration = Duration::from_secs(2);

/// What one call is asked of, and with.
struct Scene {
    bvh: LightBvh,
    mesh: MeshId,
    triangles: Vec<EmissiveTriangle>,
    instances: Vec<InstanceId>,
    rebuilder: Rebuilder<MomentNode<8>, 8>,
    /// A mesh that was added.
    last: Option<MeshId>,
    turn: u32,
}

impl Scene {
    /// So many instances of one mesh of so many triangles.
    fn new(instances: u32, triangles: u32) -> Self {
        let triangles: Vec<_> = (0..triangles).map(|k| lamp(k, 0)).collect();
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(triangles.clone()).expect("a mesh");
        let all = (0..instances).map(|k| Edit::AddInstance {
            mesh,
            transform: at(k),
            radiance: 1.0,
        });
        let instances = bvh.apply(all.collect()).expect("instances").instances;
        bvh.refit();
        bvh.plan();
        bvh.refit();
        Self {
            bvh,
            mesh,
            triangles,
            instances,
            rebuilder: Rebuilder::default(),
            last: None,
            turn: 0,
        }
    }

    /// Another number every turn.
    fn random(&mut self) -> u32 {
        self.turn += 1;
        self.turn.wrapping_mul(0x9e37_79b9)
    }

    fn some(&mut self) -> InstanceId {
        let random = self.random() as usize;
        self.instances[random % self.instances.len()]
    }

    /// Adds an instance.
    fn one_more(&mut self) {
        let added = self.bvh.add_instance(self.mesh, Transform::IDENTITY);
        self.instances.push(added.expect("one more"));
    }

    /// Any instance, which the caller takes out of the BVH.
    fn one_less(&mut self) -> InstanceId {
        let random = self.random() as usize;
        let count = self.instances.len();
        self.instances.swap_remove(random % count)
    }

    fn point(&mut self) -> ShadingPoint {
        let [x, y, z] = [0; 3].map(|_| (self.random() >> 16) as f32 * (1.0 / 64.0));
        ShadingPoint {
            p: [x, y, z],
            n: [0.0, 1.0, 0.0],
        }
    }
}

fn lamp(k: u32, shift: u32) -> EmissiveTriangle {
    let [x, y, z] = [37, 101, 13].map(|factor| (k.wrapping_mul(factor).wrapping_add(shift) % 1009) as f32);
    EmissiveTriangle {
        p: [[x, y, z], [x + 0.5, y, z], [x, y + 0.5, z + 0.1]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

fn at(k: u32) -> Transform {
    Transform::at([(k % 1000) as f32, (k / 1000 % 100) as f32, (k / 100_000) as f32])
}

/// Bytes that a mirror of the arrays copies for what changed since the last call.
fn mirrored(bvh: &mut LightBvh) -> usize {
    let plan = bvh.plan();
    let parts = [
        (&plan.written_nodes, size_of::<MomentNode<8>>()),
        (&plan.written_triangles, size_of::<EmissiveTriangle>()),
        (&plan.written_trails, size_of::<u32>()),
        (&plan.written_instances, size_of::<Instance>()),
    ];
    let of = |(ranges, size): (&Vec<Range<u32>>, usize)| {
        ranges.iter().map(|range| range.len() * size).sum::<usize>()
    };
    parts.into_iter().map(of).sum()
}

/// One row: `prepare` comes before each call and is not measured.
fn row<T, U>(
    scene: &mut Scene,
    what: &str,
    size: u32,
    mut prepare: impl FnMut(&mut Scene) -> T,
    mut call: impl FnMut(&mut Scene, T) -> U,
) {
    let mut times = Vec::with_capacity(10_000);
    let (mut allocated, mut copied) = (Vec::with_capacity(10_000), Vec::with_capacity(10_000));
    let began = Instant::now();
    while times.len() < 4 || (times.len() < 10_000 && began.elapsed() < PATIENCE) {
        let input = prepare(scene);
        let before = ALLOCATED.load(Relaxed);
        let start = Instant::now();
        let output = black_box(call(scene, input));
        times.push(start.elapsed().as_nanos() as f64 * 1e-3);
        allocated.push((ALLOCATED.load(Relaxed) - before) as f64);
        drop(output);
        copied.push(mirrored(&mut scene.bvh) as f64);
    }
    let calls = times.len();
    let [times, allocated, copied] = [times, allocated, copied].map(|mut values| {
        values.sort_by(f64::total_cmp);
        [0.5, 0.999].map(|share| values[((values.len() - 1) as f64 * share).ceil() as usize])
    });
    println!(
        "| {what} | {size} | {calls} | {:.1} | {:.1} | {:.0} | {:.0} | {:.0} | {:.0} |",
        times[0], times[1], allocated[0], allocated[1], copied[0], copied[1]
    );
}

fn nothing(_: &mut Scene) {}

/// The mesh that was added last is taken out.
fn gone(scene: &mut Scene) {
    if let Some(last) = scene.last.take() {
        scene.bvh.remove_mesh(last).expect("its own");
    }
}

/// What is asked of any BVH.
fn queries(scene: &mut Scene, size: u32) {
    row(
        scene,
        "sample",
        size,
        |scene| (scene.point(), Random64::from(scene.random())),
        |scene, (point, random)| scene.bvh.sample(&point, random),
    );
    row(
        scene,
        "pmf",
        size,
        |scene| {
            let (point, random) = (scene.point(), scene.random());
            (point, scene.bvh.sample(&point, Random64::from(random)))
        },
        |scene, (point, at)| scene.bvh.pmf(&point, at.light, at.instance),
    );
    row(
        scene,
        "triangle, instance_id, lights_of",
        size,
        |scene| {
            let (point, random) = (scene.point(), scene.random());
            scene.bvh.sample(&point, Random64::from(random))
        },
        |scene, at| {
            let id = scene.bvh.instance_id(at.instance).expect("sampled");
            (scene.bvh.triangle(at.light, at.instance), scene.bvh.lights_of(id))
        },
    );
}

/// What works on all of it, by its name.
fn wholes(scene: &mut Scene, size: u32) {
    row(scene, "clone", size, nothing, |scene, ()| scene.bvh.clone());
    row(scene, "validate", size, nothing, |scene, ()| {
        scene.bvh.validate().is_ok()
    });
    row(scene, "to_words", size, nothing, |scene, ()| scene.bvh.to_words());
    let words = scene.bvh.to_words();
    row(scene, "from_words", size, nothing, |_, ()| {
        LightBvh::from_words(&words)
    });
    let all = scene.bvh.world_lights();
    let lights = Lights::new(all.clone()).expect("lights");
    row(
        scene,
        "Lights::new",
        size,
        |_| all.clone(),
        |_, all| Lights::new(all).is_ok(),
    );
    let params = BuildParams::default();
    row(scene, "single_level", size, nothing, |_, ()| {
        LightBvh::single_level(&lights, &params)
    });
    row(scene, "two_level", size, nothing, |_, ()| {
        LightBvh::two_level(&lights, &params)
    });
    let mut same = LightBvh::single_level(&lights, &params);
    row(scene, "follow", size, nothing, |_, ()| {
        same.follow(&lights).is_ok()
    });
    row(scene, "world_lights", size, nothing, |scene, ()| {
        scene.bvh.world_lights()
    });
    row(scene, "plan_of_everything", size, nothing, |scene, ()| {
        scene.bvh.plan_of_everything()
    });
}

/// Frames in which one of many instances changes.
fn instances(size: u32) {
    println!(
        "\n| one of many instances | instances | calls | µs | 99.9 % | bytes allocated | 99.9 % | bytes for a mirror | 99.9 % |\n|---|---|---|---|---|---|---|---|---|"
    );
    let scene = &mut Scene::new(size, 2);
    queries(scene, size);
    row(
        scene,
        "set_transform",
        size,
        |scene| (scene.some(), at(scene.turn)),
        |scene, (id, to)| scene.bvh.set_transform(id, to),
    );
    row(scene, "set_radiance", size, Scene::some, |scene, id| {
        scene.bvh.set_radiance(id, 2.0)
    });
    scene.bvh.refit();
    let moved = |scene: &mut Scene| {
        scene.bvh.refit();
        scene.bvh.plan();
        let id = scene.some();
        scene.bvh.set_transform(id, at(scene.turn)).expect("its own");
    };
    row(scene, "refit after one moved", size, moved, |scene, ()| {
        scene.bvh.refit()
    });
    row(scene, "plan after one moved", size, moved, |scene, ()| {
        scene.bvh.plan().computed()
    });
    row(scene, "remove_instance", size, Scene::one_more, |scene, ()| {
        let id = scene.one_less();
        scene.bvh.remove_instance(id)
    });
    let removed = |scene: &mut Scene| {
        let id = scene.one_less();
        scene.bvh.remove_instance(id).expect("its own");
    };
    row(scene, "take_removed_lights", size, nothing, |scene, ()| {
        scene.bvh.take_removed_lights()
    });
    row(scene, "add_instance", size, removed, |scene, ()| scene.one_more());
    let refitted = |scene: &mut Scene| {
        removed(scene);
        scene.bvh.refit();
    };
    row(
        scene,
        "add_instance after a refit",
        size,
        refitted,
        |scene, ()| scene.one_more(),
    );
    row(
        scene,
        "refit after one came and one went",
        size,
        |scene| {
            refitted(scene);
            scene.one_more();
        },
        |scene, ()| scene.bvh.refit(),
    );
    let other = |scene: &mut Scene| scene.last = scene.bvh.add_mesh(vec![lamp(7, 0)]).ok();
    row(scene, "add_mesh, of one triangle", size, gone, |scene, ()| {
        other(scene)
    });
    row(
        scene,
        "set_triangles, of one",
        size,
        |_| vec![lamp(8, 0)],
        |scene, triangles| {
            let mesh = scene.last.expect("added");
            scene.bvh.set_triangles(mesh, triangles)
        },
    );
    row(scene, "remove_mesh, of one triangle", size, other, |scene, ()| {
        gone(scene)
    });
    let scene = &mut Scene::new(size, 2);
    wholes(scene, size);
    let all = |scene: &mut Scene| -> Vec<Edit> {
        let turn = scene.random();
        let ids = scene.instances.iter().copied().zip(turn % 1000..);
        ids.map(|(instance, k)| Edit::SetTransform {
            instance,
            transform: at(k),
        })
        .collect()
    };
    row(scene, "apply, all move", size, all, |scene, edits| {
        scene.bvh.apply(edits).expect("its own")
    });
    row(
        scene,
        "refit after all moved",
        size,
        |scene| {
            let edits = all(scene);
            scene.bvh.apply(edits).expect("its own");
        },
        |scene, ()| scene.bvh.refit(),
    );
    let top = RebuildParams {
        top: true,
        drift: f64::INFINITY,
    };
    row(scene, "rebuild: its copy", size, nothing, |scene, ()| {
        scene.bvh.rebuild(&top)
    });
    row(
        scene,
        "rebuild: run",
        size,
        |scene| scene.bvh.rebuild(&top),
        |_, job| job.run(),
    );
    row(
        scene,
        "install",
        size,
        |scene| {
            scene.bvh.refit();
            scene.bvh.rebuild(&top).run()
        },
        |scene, rebuilt| scene.bvh.install(rebuilt).expect("its own"),
    );
    row(
        scene,
        "refit after install",
        size,
        |scene| {
            let rebuilt = scene.bvh.rebuild(&top).run();
            scene.bvh.install(rebuilt).expect("its own");
        },
        |scene, ()| scene.bvh.refit(),
    );
    row(
        scene,
        "begin_frame, refit, end_frame; one moves",
        size,
        |scene| (scene.some(), at(scene.turn)),
        |scene, (id, to)| {
            scene.rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
            scene.bvh.set_transform(id, to).expect("its own");
            scene.bvh.refit();
            scene.rebuilder.end_frame(&scene.bvh);
        },
    );
}

/// Frames in which one mesh deforms.
fn triangles(size: u32) {
    println!(
        "\n| one mesh | triangles | calls | µs | 99.9 % | bytes allocated | 99.9 % | bytes for a mirror | 99.9 % |\n|---|---|---|---|---|---|---|---|---|"
    );
    let scene = &mut Scene::new(1, size);
    queries(scene, size);
    wholes(scene, size);
    let deformed = |scene: &mut Scene| -> Vec<EmissiveTriangle> {
        let shift = scene.random();
        (0..scene.triangles.len() as u32)
            .map(|k| lamp(k, shift % 16))
            .collect()
    };
    row(scene, "set_triangles", size, deformed, |scene, triangles| {
        scene.bvh.set_triangles(scene.mesh, triangles)
    });
    let set = |scene: &mut Scene| {
        scene.bvh.refit();
        scene.bvh.plan();
        let triangles = deformed(scene);
        scene.bvh.set_triangles(scene.mesh, triangles).expect("as many");
    };
    row(scene, "refit after it deformed", size, set, |scene, ()| {
        scene.bvh.refit()
    });
    row(scene, "plan after it deformed", size, set, |scene, ()| {
        scene.bvh.plan().computed()
    });
    row(
        scene,
        "add_mesh",
        size,
        |scene| {
            gone(scene);
            scene.triangles.clone()
        },
        |scene, triangles| scene.last = scene.bvh.add_mesh(triangles).ok(),
    );
    row(
        scene,
        "remove_mesh",
        size,
        |scene| {
            gone(scene);
            scene.last = scene.bvh.add_mesh(scene.triangles.clone()).ok();
        },
        |scene, ()| gone(scene),
    );
    row(
        scene,
        "install of the mesh built anew",
        size,
        |scene| {
            scene.bvh.refit();
            let triangles = deformed(scene);
            scene.bvh.set_triangles(scene.mesh, triangles).expect("as many");
            scene.bvh.refit();
            scene
                .bvh
                .rebuild(&RebuildParams {
                    top: false,
                    drift: 0.0,
                })
                .run()
        },
        |scene, rebuilt| scene.bvh.install(rebuilt).expect("its own"),
    );
}

fn main() {
    let largest = std::env::args()
        .nth(1)
        .map_or(1_000_000, |text| text.parse().expect("a number"));
    for size in [1000, 10_000, 100_000, 1_000_000]
        .into_iter()
        .filter(|&size| size <= largest)
    {
        instances(size);
        triangles(size);
    }
}
