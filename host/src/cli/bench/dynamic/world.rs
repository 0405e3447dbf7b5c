//! The scenes that `bench --dynamic` moves.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, InstanceId, Lights, MeshId, Transform};

use crate::backend::Bvh;

/// Side of the box that instances lie in, metres.
const SIDE: f32 = 100.0;
/// Greatest edge of a triangle, metres.
const EDGE: f32 = 0.1;
/// Different meshes.
const MESHES: u32 = 16;
/// Turn and step of an instance in a frame, rad and metres.
const TURN: f32 = 0.05;
const STEP: f32 = 0.1;

/// What changes in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub(super) enum Change {
    /// Instances move rigidly.
    Move,
    /// Instances change their brightness.
    Shine,
    /// A mesh gets other vertices.
    Deform,
}

/// A scene and what is in it.
pub(super) struct World {
    pub scene: Bvh,
    meshes: Vec<MeshId>,
    instances: Vec<InstanceId>,
    /// Triangles of a mesh.
    per_mesh: u32,
    /// Side of the box that the triangles of a mesh lie in, metres.
    side: f32,
}

impl World {
    /// Instances anywhere in the box, of meshes a metre wide.
    pub fn of_instances(instances: u32, per_mesh: u32) -> Self {
        Self::new(instances, per_mesh, 1.0)
    }

    /// One mesh that fills the box.
    pub fn of_one_mesh(triangles: u32) -> Self {
        Self::new(1, triangles, SIDE)
    }

    fn new(count: u32, per_mesh: u32, side: f32) -> Self {
        let mut world = Self {
            scene: lightbvh::Bvh::default(),
            meshes: Vec::new(),
            instances: Vec::new(),
            per_mesh,
            side,
        };
        let meshes = (0..count.min(MESHES)).map(|mesh| Edit::AddMesh {
            triangles: world.mesh(mesh, 0),
        });
        let meshes: Vec<Edit> = meshes.collect();
        let within = "the scene is made within the domain";
        world.meshes = world.scene.apply(meshes).expect(within).meshes;
        let add = (0..count).map(|i| Edit::AddInstance {
            mesh: world.meshes[(i % MESHES) as usize],
            transform: transform(i, 0),
            radiance: 1.0,
        });
        let add: Vec<Edit> = add.collect();
        world.instances = world.scene.apply(add).expect(within).instances;
        world.scene.refit();
        world
    }

    pub fn instance_count(&self) -> u32 {
        self.instances.len() as u32
    }

    /// The lights in the world.
    pub fn lights(&self) -> Lights {
        Lights::new(self.scene.world_lights()).expect("the scene is within the domain")
    }

    /// The edits of `frame`: `changed` instances spread evenly, or the mesh.
    pub fn edits(&self, change: Change, changed: u32, frame: u32) -> Vec<Edit> {
        let count = self.instance_count();
        let spread = |k: u32| (u64::from(k) * u64::from(count) / u64::from(changed.max(1))) as u32;
        match change {
            Change::Move => (0..changed)
                .map(|k| Edit::SetTransform {
                    instance: self.instances[spread(k) as usize],
                    transform: transform(spread(k), frame + 1),
                })
                .collect(),
            Change::Shine => (0..changed)
                .map(|k| Edit::SetRadiance {
                    instance: self.instances[spread(k) as usize],
                    radiance: 1.0 + unit_f32(hash(k ^ hash(frame))),
                })
                .collect(),
            Change::Deform => vec![Edit::SetTriangles {
                mesh: self.meshes[0],
                triangles: self.mesh(0, frame + 1),
            }],
        }
    }

    /// The triangles of a mesh, each moved by another step in each frame.
    fn mesh(&self, mesh: u32, frame: u32) -> Vec<EmissiveTriangle> {
        (0..self.per_mesh)
            .map(|i| {
                let draw = |k: u32| unit_f32(hash(hash(i ^ hash(mesh)).wrapping_add(k)));
                let sway = STEP * unit_f32(hash(frame ^ hash(i)));
                let corner: [f32; 3] = std::array::from_fn(|k| (draw(k as u32) - 0.5) * self.side + sway);
                // One vertex along each axis: no slivers, whose normals no rounding of a wide mesh would leave.
                let vertex = |v: usize| {
                    let mut p = corner;
                    p[v] += EDGE
                        * (0.5 + 0.5 * draw(3 + v as u32))
                        * if draw(6 + v as u32) < 0.5 { -1.0 } else { 1.0 };
                    p
                };
                EmissiveTriangle {
                    p: [vertex(0), vertex(1), vertex(2)],
                    radiance: std::array::from_fn(|k| 0.1 + draw(12 + k as u32)),
                    mesh: 0,
                    flags: 0,
                }
            })
            .collect()
    }
}

/// Where an instance is in a frame: turned about two axes.
fn transform(instance: u32, frame: u32) -> Transform {
    let draw = |k: u32| unit_f32(hash(hash(instance).wrapping_add(k)));
    let angle = |k: u32| libm::sincosf(std::f32::consts::TAU * draw(k) + TURN * frame as f32);
    let ((s, c), (t, d)) = (angle(0), angle(1));
    let path = STEP * (frame % 64) as f32;
    Transform {
        columns: [[c, s, 0.0], [-s * d, c * d, t], [s * t, -c * t, d]],
        translation: std::array::from_fn(|k| SIDE * draw(2 + k as u32) + path),
    }
}
