//! Random edits of scenes, and a model of what the scene should hold after them: as small as tests of the thread that rebuilds
//! need. All kinds of edits against all invariants are the fuzz target `edits`.

use std::collections::BTreeMap;

use lightbvh::{Bvh, Edit, EmissiveTriangle, InstanceId, LightNode, MeshId, Transform};

use crate::generate::{self, Random};
use crate::placing;

/// What the scene should hold.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Triangles in the mesh's own space.
    pub meshes: BTreeMap<MeshId, Vec<EmissiveTriangle>>,
    /// Mesh, place, and factor on its radiance.
    pub instances: BTreeMap<InstanceId, (MeshId, Transform, f32)>,
}

/// A new mesh of `scene`.
///
/// # Panics
/// Where the scene refuses it.
pub fn add_mesh<N: LightNode<W>, const W: usize>(
    scene: &mut Bvh<N, (), W>,
    triangles: Vec<EmissiveTriangle>,
) -> MeshId {
    let add = Edit::AddMesh { triangles };
    scene.apply(vec![add]).expect("a mesh").meshes[0]
}

/// A new instance of `mesh`, as bright as the mesh itself.
///
/// # Panics
/// Where the scene refuses it.
pub fn add_instance<N: LightNode<W>, const W: usize>(
    scene: &mut Bvh<N, (), W>,
    mesh: MeshId,
    transform: Transform,
) -> InstanceId {
    let add = Edit::AddInstance {
        mesh,
        transform,
        radiance: 1.0,
    };
    scene.apply(vec![add]).expect("an instance").instances[0]
}

/// A mesh of up to twelve triangles around its origin.
pub fn mesh(random: &mut Random) -> Vec<EmissiveTriangle> {
    let count = 1 + random.below(12);
    let two_sided = random.below(3) == 0;
    generate::small_triangles(count, count, 2.0, 0.4, two_sided, random.bits())
        .into_iter()
        .map(|mut triangle| {
            // Around the mesh's origin.
            triangle.p = triangle.p.map(|p| p.map(|x| x - 1.0));
            triangle
        })
        .collect()
}

fn factor(random: &mut Random) -> f32 {
    [0.0, 1.0, 0.25, 1000.0][random.below(4) as usize]
}

fn pick<K: Copy + Ord, V>(random: &mut Random, map: &BTreeMap<K, V>) -> Option<K> {
    let count = map.len() as u32;
    (count > 0).then(|| {
        *map.keys()
            .nth(random.below(count) as usize)
            .expect("below the count")
    })
}

/// Does a batch of random edits to the model and to the scene.
///
/// # Panics
/// Where the scene refuses them.
pub fn edits<N: LightNode<W>, const W: usize>(
    random: &mut Random,
    model: &mut Model,
    scene: &mut Bvh<N, (), W>,
    reach: f32,
) {
    let mut batch = Vec::new();
    for _ in 0..random.below(6) {
        let (instance, mesh_id) = (pick(random, &model.instances), pick(random, &model.meshes));
        match (random.below(9), instance, mesh_id) {
            (0, ..) => batch.push(Edit::AddMesh {
                triangles: mesh(random),
            }),
            (1 | 2, _, Some(mesh)) => {
                let kind = placing::kind(random);
                batch.push(Edit::AddInstance {
                    mesh,
                    transform: placing::transform(random, kind, reach),
                    radiance: factor(random),
                });
            }
            (3 | 4, Some(instance), _) => {
                let kind = placing::kind(random);
                let transform = placing::transform(random, kind, reach);
                model.instances.get_mut(&instance).expect("it is there").1 = transform;
                batch.push(Edit::SetTransform { instance, transform });
            }
            (5, Some(instance), _) => {
                let radiance = factor(random);
                model.instances.get_mut(&instance).expect("it is there").2 = radiance;
                batch.push(Edit::SetRadiance { instance, radiance });
            }
            (6, _, Some(mesh)) => {
                let mut triangles = model.meshes[&mesh].clone();
                for triangle in &mut triangles {
                    let by = random.between(-0.3, 0.3);
                    triangle.p = triangle.p.map(|p| [p[0] + by, p[1] * 1.1, p[2]]);
                    triangle.radiance = [random.below(2) as f32 * 3.0; 3];
                }
                model.meshes.insert(mesh, triangles.clone());
                batch.push(Edit::SetTriangles { mesh, triangles });
            }
            (8, _, Some(mesh)) => {
                let all = model.meshes.get_mut(&mesh).expect("it is there");
                let first = random.below(all.len() as u32);
                let some = &mut all[first as usize..];
                let count = 1 + random.below(some.len().min(3) as u32) as usize;
                for triangle in &mut some[..count] {
                    let by = random.between(-0.5, 0.5);
                    triangle.p = triangle.p.map(|p| [p[0], p[1] + by, p[2]]);
                }
                let triangles = some[..count].to_vec();
                batch.push(Edit::SetTriangleRange {
                    mesh,
                    first,
                    triangles,
                });
            }
            (7, Some(instance), Some(mesh)) => {
                if random.below(2) == 0 {
                    model.instances.remove(&instance);
                    batch.push(Edit::RemoveInstance(instance));
                } else if model.instances.values().all(|&(of, ..)| of != mesh)
                    && !batch
                        .iter()
                        .any(|edit| matches!(edit, Edit::AddInstance { mesh: of, .. } if *of == mesh))
                {
                    model.meshes.remove(&mesh);
                    batch.push(Edit::RemoveMesh(mesh));
                }
            }
            _ => {}
        }
    }
    let updated = scene.apply(batch.clone()).expect("sound edits");
    let (mut meshes, mut instances) = (updated.meshes.into_iter(), updated.instances.into_iter());
    for edit in batch {
        match edit {
            Edit::AddMesh { triangles } => {
                model.meshes.insert(meshes.next().expect("an id each"), triangles);
            }
            Edit::AddInstance {
                mesh,
                transform,
                radiance,
            } => {
                let id = instances.next().expect("an id each");
                model.instances.insert(id, (mesh, transform, radiance));
            }
            _ => {}
        }
    }
}
