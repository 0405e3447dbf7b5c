//! Random edits, and the same ones of another light BVH.

use alloc::vec::Vec;

use crate::bvh::{Bvh, Edit};
use crate::exact::{hash, max, pow2, unit_f32};
use crate::node::LightNode;
use crate::{EmissiveTriangle, InstanceId, Lights, MeshId, ShadingPoint, Transform};

pub(super) struct Random(pub u32);

impl Random {
    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        hash(self.0)
    }

    pub fn below(&mut self, end: u32) -> u32 {
        self.bits() % end
    }

    pub fn signed(&mut self) -> f32 {
        2.0 * unit_f32(self.bits()) - 1.0
    }

    fn vector(&mut self, reach: f32) -> [f32; 3] {
        [
            self.signed() * reach,
            self.signed() * reach,
            self.signed() * reach,
        ]
    }
}

fn triangle(random: &mut Random, mesh: u32) -> EmissiveTriangle {
    let at = random.vector(5.0);
    let corner = |random: &mut Random| {
        let by = random.vector(0.5);
        [at[0] + by[0], at[1] + by[1], at[2] + by[2]]
    };
    EmissiveTriangle {
        p: [at, corner(random), corner(random)],
        radiance: [random.signed() + 1.1; 3],
        mesh,
        flags: random.below(2),
    }
}

/// Triangles of several mesh lights.
pub(super) fn lights(seed: u32, count: u32) -> Lights {
    let random = &mut Random(seed);
    let triangles = (0..count).map(|k| triangle(random, k * 7 / count)).collect();
    Lights::new(triangles).expect("within the domain")
}

/// Triangles of which each is at half the distance of the one before: deep trees.
pub(super) fn shrinking(count: i32) -> Lights {
    let light = |k: i32| {
        let x = pow2(38 - k);
        let size = max(x * 0.125, pow2(-40));
        EmissiveTriangle {
            p: [[x, 0.0, 0.0], [x, size, 0.0], [x, 0.0, size]],
            radiance: [1.0; 3],
            mesh: 0,
            flags: 1,
        }
    };
    Lights::new((0..count).map(light).collect()).expect("within the domain")
}

pub(super) fn points() -> Vec<ShadingPoint> {
    let random = &mut Random(77);
    let point = |_| ShadingPoint {
        p: random.vector(8.0),
        n: [0.0, if random.below(2) == 0 { 1.0 } else { -1.0 }, 0.0],
    };
    (0..12).map(point).collect()
}

fn transform(random: &mut Random) -> Transform {
    let mut transform = Transform::at(random.vector(6.0));
    match random.below(4) {
        0 => transform.columns[0][1] = random.signed(),
        1 => transform.columns[2] = [0.0, 0.0, -1.0],
        2 => transform.columns[1] = [0.0; 3],
        _ => {}
    }
    transform
}

fn instances<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> Vec<InstanceId> {
    (0..bvh.instances().len() as u32)
        .filter_map(|k| bvh.instance_id(k))
        .collect()
}

fn meshes<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> Vec<MeshId> {
    (0..bvh.roots().len() as u32)
        .filter_map(|k| bvh.mesh_id(k))
        .collect()
}

/// A few edits, some of which may be refused.
pub(super) fn batch<N: LightNode<W>, I, const W: usize>(
    random: &mut Random,
    bvh: &Bvh<N, I, W>,
) -> Vec<Edit> {
    let (meshes, instances) = (meshes(bvh), instances(bvh));
    let mut edits = Vec::new();
    for _ in 0..random.below(7) {
        let (at, on) = (random.bits() as usize, random.bits() as usize);
        let mesh = (!meshes.is_empty()).then(|| meshes[at % meshes.len()]);
        let instance = (!instances.is_empty()).then(|| instances[on % instances.len()]);
        edits.push(match (random.below(9), mesh, instance) {
            (1..=3, Some(mesh), _) => Edit::AddInstance {
                mesh,
                transform: transform(random),
                radiance: [0.0, 1.0, 8.0][random.below(3) as usize],
            },
            (4 | 5, _, Some(instance)) => Edit::SetTransform {
                instance,
                transform: transform(random),
            },
            (6, Some(mesh), _) if at % 2 == 1 => {
                let count = bvh.mesh_len(mesh) as u32;
                let first = random.below(count);
                let more = 1 + random.below((count - first).min(3));
                Edit::SetTriangleRange {
                    mesh,
                    first,
                    triangles: (0..more).map(|_| triangle(random, 0)).collect(),
                }
            }
            (6, Some(mesh), _) => Edit::SetTriangles {
                mesh,
                triangles: {
                    let blas = bvh.blases[bvh.meshes[mesh.index() as usize].blas as usize]
                        .triangles
                        .len();
                    (0..blas).map(|_| triangle(random, 0)).collect()
                },
            },
            (7, _, Some(instance)) => Edit::RemoveInstance(instance),
            (8, Some(mesh), _) => Edit::RemoveMesh(mesh),
            _ => {
                let count = 1 + random.below(30);
                Edit::AddMesh {
                    triangles: (0..count).map(|_| triangle(random, 0)).collect(),
                }
            }
        });
    }
    edits
}

/// The edit of `to` that is `edit` of `from`.
pub(super) fn renamed<N: LightNode<W>, I, const W: usize>(
    edit: &Edit,
    from: &Bvh<N, I, W>,
    to: &Bvh<N, I, W>,
) -> Edit {
    let as_mesh = |id: MeshId| to.mesh_id(id.index()).expect("it is there");
    let as_instance = |id: InstanceId| {
        assert_eq!(from.instance_id(id.index()), Some(id));
        to.instance_id(id.index()).expect("it is there")
    };
    let mut edit = edit.clone();
    match &mut edit {
        Edit::AddInstance { mesh, .. }
        | Edit::SetTriangles { mesh, .. }
        | Edit::SetTriangleRange { mesh, .. }
        | Edit::RemoveMesh(mesh) => {
            *mesh = as_mesh(*mesh);
        }
        Edit::SetTransform { instance, .. }
        | Edit::SetRadiance { instance, .. }
        | Edit::RemoveInstance(instance) => *instance = as_instance(*instance),
        Edit::AddMesh { .. } => {}
    }
    edit
}
