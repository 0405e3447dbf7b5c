//! Scenes, and the measure of one call.

use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use lightbvh::bvh::{InstanceId, MeshId};
use lightbvh::node::MomentNode;
use lightbvh::{Edit, EmissiveTriangle, LightBvh, Rebuilder, ShadingPoint, Transform};
use lightbvh_gpu::{Frame, Mirror};

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
pub struct Scene {
    pub bvh: LightBvh,
    pub mesh: MeshId,
    pub triangles: Vec<EmissiveTriangle>,
    pub instances: Vec<InstanceId>,
    pub rebuilder: Rebuilder<MomentNode<8>, 8>,
    /// What follows the BVH.
    pub mirror: Mirror,
    /// A mesh that was added.
    pub last: Option<MeshId>,
    pub turn: u32,
}

impl Scene {
    /// So many instances of one mesh of so many triangles.
    pub fn new(instances: u32, triangles: u32) -> Self {
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
        let mut mirror = Mirror::default();
        mirror.frame(&bvh);
        Self {
            bvh,
            mesh,
            triangles,
            instances,
            rebuilder: Rebuilder::default(),
            mirror,
            last: None,
            turn: 0,
        }
    }

    /// Another number every turn.
    pub fn random(&mut self) -> u32 {
        self.turn += 1;
        self.turn.wrapping_mul(0x9e37_79b9)
    }

    pub fn some(&mut self) -> InstanceId {
        let random = self.random() as usize;
        self.instances[random % self.instances.len()]
    }

    /// Adds an instance.
    pub fn one_more(&mut self) {
        let added = self.bvh.add_instance(self.mesh, Transform::IDENTITY);
        self.instances.push(added.expect("one more"));
    }

    /// Any instance, which the caller takes out of the BVH.
    pub fn one_less(&mut self) -> InstanceId {
        let random = self.random() as usize;
        let count = self.instances.len();
        self.instances.swap_remove(random % count)
    }

    pub fn point(&mut self) -> ShadingPoint {
        let [x, y, z] = [0; 3].map(|_| (self.random() >> 16) as f32 * (1.0 / 64.0));
        ShadingPoint {
            p: [x, y, z],
            n: [0.0, 1.0, 0.0],
        }
    }
}

pub fn lamp(k: u32, shift: u32) -> EmissiveTriangle {
    let [x, y, z] = [37, 101, 13].map(|factor| (k.wrapping_mul(factor).wrapping_add(shift) % 1009) as f32);
    EmissiveTriangle {
        p: [[x, y, z], [x + 0.5, y, z], [x, y + 0.5, z + 0.1]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

pub fn at(k: u32) -> Transform {
    Transform::at([(k % 1000) as f32, (k / 1000 % 100) as f32, (k / 100_000) as f32])
}

/// What a frame copies.
fn bytes(frame: &Frame) -> u64 {
    let each = frame.copies.iter();
    each.map(|copy| copy.bytes.end - copy.bytes.start).sum()
}

/// One row: `prepare` comes before each call and is not measured.
pub fn row<T, U>(
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
        copied.push(bytes(&scene.mirror.frame(&scene.bvh)) as f64);
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

pub fn nothing(_: &mut Scene) {}

/// The mesh that was added last is taken out.
pub fn gone(scene: &mut Scene) {
    if let Some(last) = scene.last.take() {
        scene.bvh.remove_mesh(last).expect("its own");
    }
}
