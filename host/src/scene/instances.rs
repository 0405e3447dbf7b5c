//! The lights of a scene as meshes and instances: what a light BVH that follows moving lights is told.

use std::collections::BTreeMap;

use lightbvh::light::TWO_SIDED;
use lightbvh::{BuildParams, Edit, EditError, EmissiveTriangle, InstanceId, LightNode, MeshId};

use super::animate::world_transforms;
use super::frame::{FRAMES_PER_SECOND, emits};
use super::model::Scene;
use super::transform::Affine;

/// The mesh lights of a scene as instances of meshes, followed from frame to frame. Instances come in the order of
/// [`Frame::mesh_lights`](super::Frame::mesh_lights), and their lights are numbered as [`Frame::emissive`](super::Frame::emissive).
#[derive(Clone, Debug)]
pub struct Instances {
    /// The node that each instance follows.
    nodes: Vec<u32>,
    ids: Vec<InstanceId>,
    last: Vec<Affine>,
}

impl Instances {
    /// A light BVH over the lights of `scene` at `frame`, refitted, and what follows them.
    ///
    /// # Errors
    /// [`EditError`] for lights outside the domain.
    pub fn new<N: LightNode<W>, I, const W: usize>(
        scene: &Scene,
        frame: u32,
        params: BuildParams,
    ) -> Result<(lightbvh::Bvh<N, I, W>, Self), EditError> {
        let data = scene.data();
        let world = world_at(scene, frame);
        let mut lights = lightbvh::Bvh::new(params);
        let mut meshes: BTreeMap<(u32, usize), MeshId> = BTreeMap::new();
        let mut add = Vec::new();
        let mut nodes: Vec<u32> = Vec::new();
        for (index, (node, place)) in (0..).zip(data.nodes.iter().zip(&world)) {
            let Some(mesh) = node.mesh else { continue };
            for (primitive, triangles) in emissive_of(scene, mesh).into_iter().enumerate() {
                if triangles.is_empty() {
                    continue;
                }
                let id = match meshes.get(&(mesh, primitive)) {
                    Some(id) => *id,
                    None => {
                        let id = lights.apply(vec![Edit::AddMesh { triangles }])?.meshes[0];
                        meshes.insert((mesh, primitive), id);
                        id
                    }
                };
                nodes.push(index);
                add.push(Edit::AddInstance {
                    mesh: id,
                    transform: transform(place),
                    radiance: 1.0,
                });
            }
        }
        let ids = lights.apply(add)?.instances;
        lights.refit();
        let last = nodes.iter().map(|&node| world[node as usize]).collect();
        Ok((lights, Self { nodes, ids, last }))
    }

    /// The edits from the last frame asked for to this one: the instances that moved.
    pub fn edits(&mut self, scene: &Scene, frame: u32) -> Vec<Edit> {
        let world = world_at(scene, frame);
        let mut edits = Vec::new();
        for ((&node, &instance), last) in self.nodes.iter().zip(&self.ids).zip(&mut self.last) {
            let now = world[node as usize];
            if now != *last {
                *last = now;
                edits.push(Edit::SetTransform {
                    instance,
                    transform: transform(&now),
                });
            }
        }
        edits
    }
}

fn world_at(scene: &Scene, frame: u32) -> Vec<Affine> {
    world_transforms(scene.data(), f64::from(frame) / f64::from(FRAMES_PER_SECOND))
}

/// Rounded to what a light BVH is told.
fn transform(place: &Affine) -> lightbvh::Transform {
    let [a, b, c, t] = place.columns.map(|column| column.map(|x| x as f32));
    lightbvh::Transform {
        columns: [a, b, c],
        translation: t,
    }
}

/// The emissive triangles of each primitive of a mesh, in the mesh's space.
fn emissive_of(scene: &Scene, mesh: u32) -> Vec<Vec<EmissiveTriangle>> {
    let data = scene.data();
    let primitives = &data.meshes[mesh as usize].primitives;
    let of = |primitive: &super::Primitive| {
        let material = &data.materials[primitive.material as usize];
        let flags = if material.double_sided { TWO_SIDED } else { 0 };
        let triangles = primitive.triangles.iter().enumerate();
        triangles
            .map(|(index, corners)| EmissiveTriangle {
                p: corners.map(|vertex| primitive.positions[vertex as usize]),
                radiance: primitive.triangle_radiance(index, material.radiance),
                mesh: 0,
                flags,
            })
            .filter(|triangle| emits(triangle.radiance))
            .collect()
    };
    primitives.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::BUILT_IN;
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
            moved > 0 && moved < instances.ids.len(),
            "{moved} of {}",
            instances.ids.len()
        );
    }
}
