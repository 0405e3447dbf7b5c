//! The lights of a scene as meshes and instances: what a light BVH that follows moving lights is told.

use std::collections::BTreeMap;

use lightbvh::light::TWO_SIDED;
use lightbvh::node::{Holds, Node as Layout};
use lightbvh::{BuildParams, Edit, EditError, EmissiveTriangle, InstanceId, MeshId};

use super::animate::Pose;
use super::deform::{deforms, is_skinned};
use super::frame::{FRAMES_PER_SECOND, emits, rounded};
use super::model::{Primitive, Scene, SceneData};
use super::scene_light::SceneLight;
use glam::DAffine3;

/// The mesh lights of a scene as instances of meshes, followed from frame to frame. Instances come in the order of
/// [`Frame::mesh_lights`](super::Frame::mesh_lights), and their lights are numbered as [`Frame::emissive`](super::Frame::emissive).
/// What bends has a mesh of its own, whose triangles are told anew in each frame where they have changed.
#[derive(Clone, Debug)]
pub struct Instances<L = EmissiveTriangle> {
    followed: Vec<Followed<L>>,
}

/// An instance, and what was last told of it.
#[derive(Clone, Debug)]
struct Followed<L> {
    carried: Carried,
    id: InstanceId,
    place: DAffine3,
    bent: Option<Bent<L>>,
}

/// What a node carries that is an instance.
#[derive(Clone, Copy, Debug)]
enum Carried {
    /// A primitive of the mesh of this node.
    Mesh(usize),
    /// This light by formula.
    Light(usize),
}

/// A primitive that bends.
#[derive(Clone, Debug)]
struct Bent<L> {
    primitive: usize,
    mesh: MeshId,
    triangles: Vec<L>,
}

impl<L: SceneLight> Instances<L> {
    /// A light BVH over the lights of `scene` at `frame`, refitted, and what follows them.
    ///
    /// # Errors
    /// [`EditError`] for lights outside the domain.
    pub fn new<N: Layout<W> + Holds<Light = L>, I, const W: usize>(
        scene: &Scene,
        frame: u32,
        params: BuildParams,
    ) -> Result<(lightbvh::Bvh<N, I, W>, Self), EditError> {
        let data = scene.data();
        let pose = pose_at(scene, frame);
        let mut lights = lightbvh::Bvh::new(params);
        let mut meshes: BTreeMap<(u32, usize), MeshId> = BTreeMap::new();
        let mut add = Vec::new();
        let mut followed: Vec<(Carried, DAffine3, Option<Bent<L>>)> = Vec::new();
        for (index, node) in data.nodes.iter().enumerate() {
            let Some(mesh) = node.mesh else { continue };
            for (number, primitive) in data.meshes[mesh as usize].primitives.iter().enumerate() {
                let bends = deforms(data, index, primitive);
                let shared = meshes.get(&(mesh, number)).filter(|_| !bends).copied();
                let (id, triangles) = match shared {
                    Some(id) => (id, Vec::new()),
                    None => {
                        let triangles = emissive_of(data, &pose, index, primitive);
                        if triangles.is_empty() {
                            continue;
                        }
                        let kept = if bends { triangles.clone() } else { Vec::new() };
                        (lights.apply(vec![Edit::AddMesh { triangles }])?.meshes[0], kept)
                    }
                };
                let bent = bends.then_some(Bent {
                    primitive: number,
                    mesh: id,
                    triangles,
                });
                if bent.is_none() {
                    meshes.insert((mesh, number), id);
                }
                let place = place(data, &pose, index, primitive);
                followed.push((Carried::Mesh(index), place, bent));
                add.push(Edit::AddInstance {
                    mesh: id,
                    transform: transform(&place),
                    radiance: 1.0,
                });
            }
        }
        for (number, own) in data.analytic.iter().enumerate() {
            let Some(light) = own.light().and_then(L::of_kind) else {
                continue;
            };
            let triangles = vec![light];
            let mesh = lights.apply(vec![Edit::AddMesh { triangles }])?.meshes[0];
            let place = pose.place_of(data, own);
            followed.push((Carried::Light(number), place, None));
            add.push(Edit::AddInstance {
                mesh,
                transform: transform(&place),
                radiance: 1.0,
            });
        }
        let ids = lights.apply(add)?.instances;
        lights.refit();
        let followed = followed.into_iter().zip(ids);
        let followed = followed.map(|((carried, place, bent), id)| Followed {
            carried,
            id,
            place,
            bent,
        });
        Ok((
            lights,
            Self {
                followed: followed.collect(),
            },
        ))
    }

    /// The edits from the last frame asked for to this one: the instances that moved, and the meshes that bent.
    pub fn edits(&mut self, scene: &Scene, frame: u32) -> Vec<Edit<L>> {
        let data = scene.data();
        let pose = pose_at(scene, frame);
        let mut edits = Vec::new();
        for followed in &mut self.followed {
            let now = match followed.carried {
                Carried::Light(number) => pose.place_of(data, &data.analytic[number]),
                Carried::Mesh(node) => match (&mut followed.bent, data.nodes[node].mesh) {
                    (Some(bent), Some(mesh)) => {
                        let primitive = &data.meshes[mesh as usize].primitives[bent.primitive];
                        let triangles = emissive_of(data, &pose, node, primitive);
                        if triangles != bent.triangles {
                            bent.triangles.clone_from(&triangles);
                            let mesh = bent.mesh;
                            edits.push(Edit::SetTriangles { mesh, triangles });
                        }
                        place(data, &pose, node, primitive)
                    }
                    _ => pose.world[node],
                },
            };
            if now != followed.place {
                followed.place = now;
                edits.push(Edit::SetTransform {
                    instance: followed.id,
                    transform: transform(&now),
                });
            }
        }
        edits
    }

    /// The only instance of a mesh that bends.
    pub fn of_bent(&self, mesh: MeshId) -> Option<InstanceId> {
        let bends = |followed: &&Followed<L>| followed.bent.as_ref().is_some_and(|bent| bent.mesh == mesh);
        self.followed.iter().find(bends).map(|followed| followed.id)
    }
}

fn pose_at(scene: &Scene, frame: u32) -> Pose {
    Pose::at(scene.data(), f64::from(frame) / f64::from(FRAMES_PER_SECOND))
}

/// Where the mesh's space is; joints take vertices to the world by themselves.
fn place(data: &SceneData, pose: &Pose, node: usize, primitive: &Primitive) -> DAffine3 {
    if is_skinned(data, node, primitive) {
        DAffine3::IDENTITY
    } else {
        pose.world[node]
    }
}

/// Rounded to what a light BVH is told.
pub(super) fn transform(place: &DAffine3) -> lightbvh::Transform {
    let [a, b, c, t] = place.to_cols_array_2d().map(|column| column.map(|x| x as f32));
    lightbvh::Transform {
        columns: [a, b, c],
        translation: t,
    }
}

/// The emissive triangles of a primitive, in the space that [`place`] places.
fn emissive_of<L: SceneLight>(data: &SceneData, pose: &Pose, node: usize, primitive: &Primitive) -> Vec<L> {
    let material = &data.materials[primitive.material as usize];
    let lit = |index: usize| emits(primitive.triangle_radiance(index, material.radiance));
    if !(0..primitive.triangles.len()).any(lit) {
        return Vec::new();
    }
    let (points, mirrored) = if is_skinned(data, node, primitive) {
        let placed = pose.placed(data, node, primitive);
        (placed.points, placed.mirrored)
    } else {
        // A light BVH keeps the front of a mirrored instance in front.
        (pose.morphed(data, node, primitive), false)
    };
    let flags = if material.double_sided { TWO_SIDED } else { 0 };
    let triangles = primitive.triangles.iter().enumerate();
    let lit = triangles.filter(|&(index, _)| lit(index));
    lit.map(|(index, &[a, b, c])| {
        let corners = if mirrored { [a, c, b] } else { [a, b, c] };
        L::from(EmissiveTriangle {
            p: corners.map(|vertex| rounded(points[vertex as usize])),
            radiance: primitive.triangle_radiance(index, material.radiance),
            mesh: 0,
            flags,
        })
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BUILT_IN;
    use lightbvh_kernels::bvh::{Node, WIDTH};

    #[test]
    fn instances_stand_where_the_frame_has_its_lights() {
        for name in BUILT_IN {
            let scene = Scene::open(name).expect("built in");
            let (mut lights, mut instances) =
                Instances::new::<Node, (), WIDTH>(&scene, 3, BuildParams::default()).expect("sound");
            for frame in [3, 40] {
                lights.apply(instances.edits(&scene, frame)).expect("sound");
                lights.refit();
                lights
                    .validate()
                    .unwrap_or_else(|violation| panic!("{name}: {violation}"));
                let (expected, found) = (scene.frame(frame).emissive, lights.world_lights());
                assert_eq!(expected.len(), found.len(), "{name}");
                for (e, f) in expected.iter().zip(&found) {
                    assert_eq!((e.mesh, e.flags), (f.mesh, f.flags), "{name}");
                    assert!(f.radiance == e.radiance || f.radiance == [0.0; 3], "{name}");
                    for (a, b) in e.p.iter().flatten().zip(f.p.iter().flatten()) {
                        assert!((a - b).abs() <= 2e-6 * a.abs().max(8.0), "{name}: {e:?} {f:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_stands_still_is_not_edited() {
        let scene = Scene::open("street").expect("built in");
        let (_, mut instances) =
            Instances::new::<Node, (), WIDTH>(&scene, 7, BuildParams::default()).expect("sound");
        assert!(instances.edits(&scene, 7).is_empty());
        let moved = instances.edits(&scene, 8).len();
        assert!(
            moved > 0 && moved < instances.followed.len(),
            "{moved} of {}",
            instances.followed.len()
        );
    }
}
