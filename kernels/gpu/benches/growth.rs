//! How the calls of a frame grow: time (median, and 99.9 %) and bytes that a mirror copies, from 10³ to 10⁶ instances or triangles.
//!
//! `cargo bench -p lightbvh-gpu --bench growth [-- LARGEST]`

use std::hint::black_box;
use std::time::{Duration, Instant};

use lightbvh::bvh::{InstanceId, MeshId};
use lightbvh::{
    BuildParams, Edit, EmissiveTriangle, LightBvh, Lights, Random64, Rebuilder, ShadingPoint, Transform,
};
use lightbvh_gpu::Mirror;

/// Longest time spent on one row.
const PATIENCE: Duration = Duration::from_secs(2);

/// What calls are asked of.
struct Scene {
    size: u32,
    bvh: LightBvh,
    mesh: MeshId,
    triangles: u32,
    instances: Vec<InstanceId>,
    rebuilder: Rebuilder,
    mirror: Mirror,
    /// The mesh that was added last.
    last: Option<MeshId>,
    turn: u32,
}

impl Scene {
    /// So many instances of one mesh of so many triangles.
    fn new(instances: u32, triangles: u32) -> Self {
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(lamps(triangles, 0)).expect("a mesh");
        let all = (0..instances).map(|k| Edit::AddInstance {
            mesh,
            transform: at(k),
            radiance: 1.0,
        });
        let instances = bvh.apply(all.collect()).expect("instances").instances;
        bvh.refit();
        Self {
            size: triangles.max(instances.len() as u32),
            bvh,
            mesh,
            triangles,
            instances,
            rebuilder: Rebuilder::default(),
            mirror: Mirror::default(),
            last: None,
            turn: 0,
        }
    }

    /// Another number every turn.
    fn random(&mut self) -> u32 {
        self.turn += 1;
        self.turn.wrapping_mul(0x9e37_79b9)
    }

    fn point(&mut self) -> (ShadingPoint, Random64) {
        let p = [0; 3].map(|_| (self.random() >> 16) as f32 * (1.0 / 64.0));
        let n = [0.0, 1.0, 0.0];
        (ShadingPoint { p, n }, Random64::from(self.random()))
    }

    /// Moves one instance.
    fn moves(&mut self) {
        let one = self.random() as usize % self.instances.len();
        let place = at(self.turn);
        self.bvh
            .set_transform(self.instances[one], place)
            .expect("its own");
    }

    fn adds(&mut self) {
        let added = self.bvh.add_instance(self.mesh, Transform::IDENTITY);
        self.instances.push(added.expect("one more"));
    }

    fn removes(&mut self) {
        let one = self.random() as usize % self.instances.len();
        let gone = self.instances.swap_remove(one);
        self.bvh.remove_instance(gone).expect("its own");
    }

    fn deforms(&mut self) {
        let triangles = lamps(self.triangles, self.turn);
        self.turn += 1;
        self.bvh.set_triangles(self.mesh, triangles).expect("as many");
    }

    fn settled(&mut self) {
        self.bvh.refit();
        self.mirror.frame(&self.bvh);
    }

    /// One row: `prepare` comes before each call and is not measured.
    fn row<T, U>(
        &mut self,
        what: &str,
        mut prepare: impl FnMut(&mut Self) -> T,
        mut call: impl FnMut(&mut Self, T) -> U,
    ) {
        let (mut times, mut copied) = (Vec::new(), Vec::new());
        let began = Instant::now();
        while times.len() < 4 || (times.len() < 10_000 && began.elapsed() < PATIENCE) {
            let input = prepare(self);
            let start = Instant::now();
            let output = black_box(call(self, input));
            times.push(start.elapsed().as_nanos() as f64 * 1e-3);
            drop(output);
            let frame = self.mirror.frame(&self.bvh);
            copied.push(frame.staged_bytes() as f64);
        }
        let calls = times.len();
        let [times, copied] = [times, copied].map(|mut values| {
            values.sort_by(f64::total_cmp);
            [0.5, 0.999].map(|share| values[((values.len() - 1) as f64 * share).ceil() as usize])
        });
        println!(
            "| {what} | {} | {calls} | {:.1} | {:.1} | {:.0} | {:.0} |",
            self.size, times[0], times[1], copied[0], copied[1]
        );
    }

    /// What is asked of any BVH.
    fn queries(&mut self) {
        self.row("sample", Self::point, |scene, (point, random)| {
            scene.bvh.sample(&point, random)
        });
        self.row(
            "pmf",
            |scene| {
                let (point, random) = scene.point();
                (point, scene.bvh.sample(&point, random))
            },
            |scene, (point, at)| scene.bvh.pmf(&point, at.light, at.instance),
        );
    }
}

fn lamps(count: u32, shift: u32) -> Vec<EmissiveTriangle> {
    let lamp = |k: u32| {
        let [x, y, z] =
            [37, 101, 13].map(|factor| (k.wrapping_mul(factor).wrapping_add(shift % 16) % 1009) as f32);
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.5, y, z], [x, y + 0.5, z + 0.1]],
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        }
    };
    (0..count).map(lamp).collect()
}

fn at(k: u32) -> Transform {
    Transform::at([(k % 1000) as f32, (k / 1000 % 100) as f32, (k / 100_000) as f32])
}

fn head(what: &str, of: &str) {
    println!(
        "\n| {what} | {of} | calls | µs | 99.9 % | bytes for a mirror | 99.9 % |\n|---|---|---|---|---|---|---|"
    );
}

/// Frames in which one of many instances changes.
fn instances(size: u32) {
    head("one of many instances", "instances");
    let scene = &mut Scene::new(size, 2);
    scene.queries();
    scene.row("set_transform", Scene::settled, |scene, ()| scene.moves());
    let moved = |scene: &mut Scene| {
        scene.settled();
        scene.moves();
    };
    scene.row("refit after one moved", moved, |scene, ()| scene.bvh.refit());
    scene.row("remove_instance", Scene::adds, |scene, ()| scene.removes());
    scene.row("add_instance", Scene::removes, |scene, ()| scene.adds());
    scene.row(
        "refit after one came and one went",
        |scene| {
            scene.settled();
            scene.removes();
            scene.adds();
        },
        |scene, ()| scene.bvh.refit(),
    );
    scene.row("rebuild", Scene::settled, |scene, ()| scene.bvh.rebuild());
    scene.row(
        "begin_frame, refit, end_frame; one moves",
        |_| (),
        |scene, ()| {
            scene.rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
            scene.moves();
            scene.bvh.refit();
            scene.rebuilder.end_frame(&scene.bvh);
        },
    );
}

/// Frames in which one mesh deforms.
fn triangles(size: u32) {
    head("one mesh", "triangles");
    let scene = &mut Scene::new(1, size);
    scene.queries();
    scene.row("set_triangles", Scene::settled, |scene, ()| scene.deforms());
    scene.row("refit after it deformed", Scene::deforms, |scene, ()| {
        scene.bvh.refit()
    });
    scene.row(
        "add_mesh",
        |scene| {
            if let Some(last) = scene.last.take() {
                scene.bvh.remove_mesh(last).expect("its own");
            }
            lamps(scene.triangles, 0)
        },
        |scene, triangles| scene.last = scene.bvh.add_mesh(triangles).ok(),
    );
    let lights = Lights::new(scene.bvh.world_lights()).expect("lights");
    let params = BuildParams::default();
    scene.row(
        "single_level",
        |_| (),
        |_, ()| LightBvh::single_level(&lights, &params),
    );
}

fn main() {
    // Cargo says `--bench` too.
    let largest = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with('-'))
        .map_or(1_000_000, |text| text.parse().expect("a number"));
    for size in [1000, 10_000, 100_000, 1_000_000] {
        if size <= largest {
            instances(size);
            triangles(size);
        }
    }
}
