//! The scenes of lone edits.

use std::time::{Duration, Instant};

use lightbvh::bvh::{InstanceId, MeshId};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, Transform};
use lightbvh_gpu::{Frame, Mirror};

use crate::backend::Bvh;

/// Density of the instances: one in so many cubic metres, at any number of them.
const ROOM: f32 = 8.0;
/// Meshes that most instances share, and triangles of each.
const MESHES: u32 = 16;
const TRIANGLES: u32 = 2;
/// Triangles of the mesh that has one instance alone.
const LONE: u32 = 100;
/// Lamps beside the one large mesh.
const BESIDE: u32 = 1000;
/// Longest edge of a triangle, metres.
const EDGE: f32 = 0.2;

const WITHIN: &str = "the scene is made within the domain";

/// A still scene, a device's mirror of it, and random numbers.
pub(super) struct Scene {
    pub bvh: Bvh,
    mirror: Mirror,
    pub meshes: Vec<MeshId>,
    /// Any order.
    pub instances: Vec<InstanceId>,
    /// A mesh of one instance, and its triangles as they are.
    pub lone: MeshId,
    pub triangles: Vec<EmissiveTriangle>,
    /// The triangles as they were at first.
    rest: Vec<EmissiveTriangle>,
    /// Side of the box that all lies in, metres.
    pub side: f32,
    turn: u32,
}

/// What a frame cost.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub time: Duration,
    /// Nodes and roots that its refit computed.
    pub nodes: usize,
    /// What a device copies and reads: written ranges, and the lists of its dispatches.
    pub bytes: u64,
}

impl Scene {
    /// So many instances anywhere in a box, one of them of a mesh of its own.
    pub fn of_instances(count: u32) -> Self {
        let side = (count as f32 * ROOM).cbrt();
        Self::new(count - 1, side, LONE, 1.0)
    }

    /// A mesh that fills a box among some lamps.
    pub fn of_mesh(triangles: u32) -> Self {
        let side = (triangles as f32 * ROOM).cbrt();
        Self::new(BESIDE, side, triangles, side)
    }

    /// So many instances of one mesh among some lamps.
    pub fn of_users(count: u32) -> Self {
        let side = (count as f32 * ROOM).cbrt();
        let mut scene = Self::new(BESIDE, side, LONE, 1.0);
        let add = (1..count).map(|_| Edit::AddInstance {
            mesh: scene.lone,
            transform: scene.anywhere(),
            radiance: 1.0,
        });
        let add: Vec<Edit> = add.collect();
        scene
            .instances
            .extend(scene.bvh.apply(add).expect(WITHIN).instances);
        scene.bvh.refit();
        scene.mirror.frame(&mut scene.bvh);
        scene
    }

    fn new(count: u32, side: f32, triangles: u32, size: f32) -> Self {
        let mut bvh: Bvh = lightbvh::Bvh::default();
        let lone: Vec<_> = (0..triangles).map(|k| triangle(k ^ 0x5eed, size)).collect();
        let shared = (0..MESHES).map(|mesh| Edit::AddMesh {
            triangles: (0..TRIANGLES)
                .map(|k| triangle(mesh * TRIANGLES + k, 0.5))
                .collect(),
        });
        let own = Edit::AddMesh {
            triangles: lone.clone(),
        };
        let meshes = bvh.apply(shared.chain([own]).collect()).expect(WITHIN).meshes;
        let (&own, shared) = meshes.split_last().expect("meshes were added");
        let mut scene = Self {
            bvh,
            mirror: Mirror::default(),
            meshes: shared.to_vec(),
            instances: Vec::new(),
            lone: own,
            triangles: lone.clone(),
            rest: lone,
            side,
            turn: 0,
        };
        let add = (0..count)
            .map(|_| scene.new_instance())
            .chain([Edit::AddInstance {
                mesh: own,
                transform: Transform::at([0.5 * side; 3]),
                radiance: 1.0,
            }]);
        let add: Vec<Edit> = add.collect();
        scene.instances = scene.bvh.apply(add).expect(WITHIN).instances;
        // The lone mesh's instance stays.
        scene.instances.pop();
        scene.bvh.refit();
        scene.mirror.frame(&mut scene.bvh);
        scene
    }

    /// A number from 0 to below `count`, at least 1.
    pub fn below(&mut self, count: u32) -> u32 {
        self.turn += 1;
        hash(self.turn ^ 0x10e5) % count
    }

    /// From 0 to below 1.
    pub fn unit(&mut self) -> f32 {
        self.turn += 1;
        unit_f32(hash(self.turn ^ 0x10e5))
    }

    /// One of the instances.
    pub fn some(&mut self) -> InstanceId {
        let index = self.below(self.instances.len() as u32);
        self.instances[index as usize]
    }

    /// Takes one of the instances off the list.
    pub fn one_less(&mut self) -> InstanceId {
        let index = self.below(self.instances.len() as u32);
        self.instances.swap_remove(index as usize)
    }

    /// An instance of one of the shared meshes, anywhere.
    pub fn new_instance(&mut self) -> Edit {
        let mesh = self.below(MESHES);
        Edit::AddInstance {
            mesh: self.meshes[mesh as usize],
            transform: self.anywhere(),
            radiance: 1.0,
        }
    }

    /// Any place in the box, turned about an axis.
    pub fn anywhere(&mut self) -> Transform {
        let place = std::array::from_fn(|_| self.side * self.unit());
        self.turned(place)
    }

    /// A place within a tenth of a metre of where an instance is, and turned.
    pub fn near(&mut self, instance: InstanceId) -> Transform {
        let lights = self.bvh.lights_of(instance).expect("it is there");
        let light = self
            .bvh
            .triangle(lights.start, instance.index())
            .expect("one of its lights");
        let place = light.p[0].map(|x| x + 0.1 * (self.unit() - 0.5));
        self.turned(place)
    }

    fn turned(&mut self, place: [f32; 3]) -> Transform {
        let (s, c) = libm::sincosf(std::f32::consts::TAU * self.unit());
        Transform {
            columns: [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
            translation: place,
        }
    }

    /// Moves triangles of the lone mesh by up to `step` metres from where they were at first.
    pub fn shake(&mut self, range: std::ops::Range<usize>, step: f32) {
        for k in range {
            let by: [f32; 3] = std::array::from_fn(|_| step * (self.unit() - 0.5));
            let moved = self.rest[k]
                .p
                .map(|p| std::array::from_fn(|axis| p[axis] + by[axis]));
            self.triangles[k].p = moved;
        }
    }

    /// A frame of `change` and the refit after it; then what a device must copy for it.
    pub fn frame(&mut self, change: impl FnOnce(&mut Bvh)) -> Sample {
        let began = Instant::now();
        change(&mut self.bvh);
        self.bvh.refit();
        let time = began.elapsed();
        let nodes = self.bvh.work().computed();
        Sample {
            time,
            nodes,
            bytes: self.bytes(),
        }
    }

    /// Bytes that bring a device from the frame before to this one.
    pub fn bytes(&mut self) -> u64 {
        let Frame { copies, refit, .. } = self.mirror.frame(&mut self.bvh);
        let copied = copies.iter().map(|copy| copy.bytes.end - copy.bytes.start);
        copied.sum::<u64>() + size_of_val(&*refit.list) as u64
    }
}

/// A triangle anywhere in a cube of so many metres about the origin.
fn triangle(k: u32, size: f32) -> EmissiveTriangle {
    let draw = |i: u32| unit_f32(hash(hash(k).wrapping_add(i)));
    let corner: [f32; 3] = std::array::from_fn(|i| (draw(i as u32) - 0.5) * size);
    let vertex = |v: usize| {
        let mut p = corner;
        p[v] += EDGE * (0.5 + 0.5 * draw(3 + v as u32));
        p
    };
    EmissiveTriangle {
        p: [vertex(0), vertex(1), vertex(2)],
        radiance: [0.1 + draw(9); 3],
        mesh: 0,
        flags: 0,
    }
}
