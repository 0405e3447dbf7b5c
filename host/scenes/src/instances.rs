//! The lights of a scene as meshes and instances of a light BVH, and the edits that follow them.

use std::collections::BTreeMap;
use std::marker::PhantomData;

use glam::DAffine3;
use lightbvh::light::TWO_SIDED;
use lightbvh::tree::Model;
use lightbvh::{BuildParams, Edit, EditError, EmissiveTriangle, InstanceId, MeshId};

use super::animate::Pose;
use super::frame::FRAMES_PER_SECOND;
use super::model::{Primitive, SceneData, emits};
use super::scene::Scene;
use super::scene_light::SceneLight;
use super::transform::to_light_bvh;

/// The mesh lights of a scene as instances of meshes, followed from frame to frame. Instances come in the order of
/// [`Frame::mesh_lights`](super::Frame::mesh_lights), and their lights are numbered as [`Frame::emissive`](super::Frame::emissive).
#[derive(Clone, Debug)]
pub struct Instances<L = EmissiveTriangle> {
    followed: Vec<Followed>,
    of: PhantomData<L>,
}

/// An instance, and where it was last.
#[derive(Clone, Debug)]
struct Followed {
    source: Source,
    id: InstanceId,
    place: DAffine3,
}

/// Where the lights of an instance come from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// A node, and a primitive of its mesh.
    Primitive(usize, (u32, usize)),
    /// A light by formula.
    Light(usize),
}

impl<L: SceneLight> Instances<L> {
    /// A light BVH over the lights of `scene` at `frame`, refitted, and what follows them.
    ///
    /// # Errors
    /// [`EditError`] for lights outside the domain.
    pub fn new<M: Model<W, Light = L>, const W: usize>(
        scene: &Scene,
        frame: u32,
        params: BuildParams,
    ) -> Result<(lightbvh::Bvh<M, W>, Self), EditError> {
        let data = scene.data();
        let pose = pose_at(scene, frame);
        let mut lights = lightbvh::Bvh::new(params);
        let mut shared: BTreeMap<(u32, usize), MeshId> = BTreeMap::new();
        let (mut add, mut followed) = (Vec::new(), Vec::new());
        for source in sources(data) {
            let key = match source {
                Source::Primitive(_, key) => Some(key),
                Source::Light(_) => None,
            };
            let mesh = match key.and_then(|key| shared.get(&key)) {
                Some(&mesh) => mesh,
                None => {
                    let triangles: Vec<L> = source.lights(data);
                    if triangles.is_empty() {
                        continue;
                    }
                    let mesh = lights.apply(vec![Edit::AddMesh { lights: triangles }])?.meshes[0];
                    shared.extend(key.map(|key| (key, mesh)));
                    mesh
                }
            };
            let place = source.place(data, &pose);
            followed.push((source, place));
            add.push(Edit::AddInstance {
                mesh,
                transform: to_light_bvh(&place),
                radiance: [1.0; 3],
                mask: u32::MAX,
            });
        }
        let ids = lights.apply(add)?.instances;
        lights.refit();
        let followed = followed.into_iter().zip(ids);
        let followed = followed.map(|((source, place), id)| Followed { source, id, place });
        let (followed, of) = (followed.collect(), PhantomData);
        Ok((lights, Self { followed, of }))
    }

    /// The edits from the last frame asked for to this one: the instances that moved.
    pub fn edits(&mut self, scene: &Scene, frame: u32) -> Vec<Edit<L>> {
        let data = scene.data();
        let pose = pose_at(scene, frame);
        let mut edits = Vec::new();
        for followed in &mut self.followed {
            let now = followed.source.place(data, &pose);
            if now != followed.place {
                followed.place = now;
                edits.push(Edit::SetTransform {
                    instance: followed.id,
                    transform: to_light_bvh(&now),
                });
            }
        }
        edits
    }
}

fn pose_at(scene: &Scene, frame: u32) -> Pose {
    Pose::at(scene.data(), f64::from(frame) / f64::from(FRAMES_PER_SECOND))
}

/// In the order of a frame's mesh lights.
fn sources(data: &SceneData) -> impl Iterator<Item = Source> + '_ {
    let nodes = data.nodes.iter().enumerate();
    let primitives = nodes.flat_map(move |(index, node)| {
        node.mesh.into_iter().flat_map(move |mesh| {
            let count = data.meshes[mesh as usize].primitives.len();
            (0..count).map(move |primitive| Source::Primitive(index, (mesh, primitive)))
        })
    });
    primitives.chain((0..data.analytic.len()).map(Source::Light))
}

impl Source {
    /// Where the mesh's space is.
    fn place(self, data: &SceneData, pose: &Pose) -> DAffine3 {
        match self {
            Self::Light(number) => pose.place_of(&data.analytic[number]),
            Self::Primitive(node, _) => pose.world[node],
        }
    }

    /// The lights in the space that [`place`](Self::place) places.
    fn lights<L: SceneLight>(self, data: &SceneData) -> Vec<L> {
        match self {
            Self::Light(number) => L::of_kind(data.analytic[number].light()).into_iter().collect(),
            Self::Primitive(_, (mesh, primitive)) => {
                emissive_of(data, &data.meshes[mesh as usize].primitives[primitive])
            }
        }
    }
}

/// The emissive triangles of a primitive, in the node's space. A light BVH keeps the front of a mirrored instance in front.
fn emissive_of<L: SceneLight>(data: &SceneData, primitive: &Primitive) -> Vec<L> {
    let material = &data.materials[primitive.material as usize];
    let flags = if material.double_sided { TWO_SIDED } else { 0 };
    let lit = primitive
        .triangles
        .iter()
        .enumerate()
        .filter_map(|(index, corners)| {
            let radiance = primitive.triangle_radiance(index, material.radiance);
            let p = corners.map(|vertex| primitive.positions[vertex as usize]);
            emits(radiance).then_some(EmissiveTriangle {
                p,
                radiance,
                mesh: 0,
                flags,
            })
        });
    lit.map(L::from).collect()
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
                Instances::new::<(Node, ()), WIDTH>(&scene, 3, BuildParams::default()).expect("sound");
            for frame in [3, 40] {
                let edits = instances.edits(&scene, frame);
                let (moved, all) = (edits.len(), instances.followed.len());
                assert!(
                    moved < all && (moved > 0) == (frame == 40),
                    "{name}: {moved} of {all}"
                );
                lights.apply(edits).expect("sound");
                lights.refit();
                lights
                    .view()
                    .validate()
                    .unwrap_or_else(|violation| panic!("{name}: {violation}"));
                let (expected, found) = (scene.frame(frame).emissive, lights.view().world_lights());
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
}
