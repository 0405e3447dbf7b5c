//! Random scenes, and checks of their samples.

use crate::model::Model;
use alloc::vec::Vec;

use super::{Random, narrow, normalize, wide};
use crate::bvh::{Bvh, Edit};
use crate::exact::hash;
use crate::importance::ImportanceModel;
use crate::light::{AnyLight, EmissiveTriangle, SpotLight};
use crate::node::Node;
use crate::{InstanceId, SampledLight, ShadingPoint, Transform};

/// A light for random meshes, within 10 m of their origins.
pub trait Lamp: Sized {
    fn any(random: &mut Random) -> Self;
}

impl Lamp for EmissiveTriangle {
    fn any(random: &mut Random) -> Self {
        let at = random.vector() * 9.0;
        let [b, c] = [0; 2].map(|_| at + random.vector());
        Self {
            p: [at, b, c].map(|v| v.to_array()),
            radiance: [random.unit(), 1.0, 2.0],
            mesh: 0,
            flags: random.below(2) * Self::TWO_SIDED,
        }
    }
}

impl Lamp for AnyLight {
    fn any(random: &mut Random) -> Self {
        if random.below(3) == 0 {
            return EmissiveTriangle::any(random).into();
        }
        // About the same direction, so that nodes keep beams.
        let axis = [0.1 * random.signed(), -1.0, 0.1 * random.signed()];
        SpotLight {
            p: (random.vector() * 9.0).to_array(),
            intensity: [1.0; 3],
            axis: narrow(normalize(wide(axis.into()))).to_array(),
            cos_inner: 0.9,
            cos_outer: 0.8,
            range: 25.0,
            mesh: 0,
        }
        .into()
    }
}

/// `count` lights.
pub fn lamps<L: Lamp>(random: &mut Random, count: u32) -> Vec<L> {
    (0..count).map(|_| L::any(random)).collect()
}

/// `count` lights, one so far from the others that it is a child of their tree's root.
pub fn with_one_far(random: &mut Random, count: u32) -> Vec<EmissiveTriangle> {
    let mut all: Vec<EmissiveTriangle> = lamps(random, count);
    all[0].p = all[0].p.map(|v| v.map(|x| x + 9000.0));
    all
}

/// Any place, one of four mirrored, sheared or without volume.
pub fn placed(random: &mut Random, reach: f32) -> Transform {
    let mut transform = Transform::at((random.vector() * reach).to_array());
    match random.below(8) {
        0 => transform.columns[0][1] = random.signed(),
        1 => transform.columns[2] = [0.0, 0.0, -1.0],
        2 => transform.columns[1] = [0.0; 3],
        _ => {}
    }
    transform
}

pub fn moved<L>(instance: InstanceId, at: [f32; 3]) -> Edit<L> {
    let transform = Transform::at(at);
    Edit::SetTransform { instance, transform }
}

/// `count` instances of a mesh, refitted.
pub fn scattered<M: Model<W>, const W: usize>(
    mesh: Vec<M::Light>,
    count: u32,
    mut place: impl FnMut(u32) -> [f32; 3],
) -> (Bvh<M, W>, Vec<InstanceId>) {
    let mut bvh = Bvh::default();
    let mesh = bvh.add_mesh(mesh).expect("lights");
    let add = |k| Edit::AddInstance {
        mesh,
        transform: Transform::at(place(k)),
        radiance: [1.0; 3],
        mask: u32::MAX,
    };
    let added = bvh.apply((0..count).map(add).collect()).expect("a mesh");
    bvh.refit();
    (bvh, added.instances)
}

/// The ids of all instances.
pub fn instances<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>) -> Vec<InstanceId> {
    bvh.view().instance_ids().collect()
}

/// All lights, each with its instance.
pub fn lights<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>) -> Vec<(u32, u32)> {
    let all = instances(bvh).into_iter();
    all.flat_map(|id| {
        bvh.view()
            .lights_of(id)
            .unwrap_or(0..0)
            .map(move |light| (light, id.index()))
    })
    .collect()
}

/// Edits of every kind, of meshes of at most `most` lights. Now and then one of them is refused. Equal scenes get equal ones.
pub fn edits<M: Model<W>, const W: usize>(
    random: &mut Random,
    bvh: &Bvh<M, W>,
    count: u32,
    most: u32,
) -> Vec<Edit<M::Light>>
where
    M::Light: Lamp,
{
    let mut meshes: Vec<_> = bvh.view().mesh_ids().collect();
    let mut all = instances(bvh);
    let mut out = Vec::new();
    for _ in 0..count {
        let at = random.below(meshes.len().max(1) as u32) as usize;
        let on = random.below(all.len().max(1) as u32) as usize;
        let (mesh, instance) = (meshes.get(at).copied(), all.get(on).copied());
        out.push(match (random.below(15), mesh, instance) {
            (0..=2, Some(mesh), _) => Edit::AddInstance {
                mesh,
                transform: placed(random, 50.0),
                radiance: [[0.0; 3], [1.0; 3], [0.0, 8.0, 1.0]][random.below(3) as usize],
                mask: 1 << random.below(20),
            },
            (3 | 4, _, Some(instance)) => Edit::SetTransform {
                instance,
                transform: placed(random, 50.0),
            },
            (5, _, Some(instance)) => Edit::SetRadiance {
                instance,
                radiance: [[0.0; 3], [1.0; 3], [100.0, 0.0, 2.0]][random.below(3) as usize],
            },
            (13, ..) => Edit::AddLight {
                light: M::Light::any(random),
                mask: 1 << random.below(20),
            },
            (12, _, Some(instance)) if bvh.view().is_light(instance) => Edit::SetLight {
                instance,
                light: M::Light::any(random),
            },
            (11, _, Some(instance)) => Edit::SetMask {
                instance,
                mask: 1 << random.below(20),
            },
            (6, Some(mesh), _) => {
                let end = bvh.view().mesh_lights(mesh).map_or(1, <[_]>::len) as u32;
                let first = random.below(end);
                let count = 1 + random.below((end - first).min(3));
                Edit::SetLightRange {
                    mesh,
                    first,
                    lights: lamps(random, count),
                }
            }
            (7, Some(mesh), _) => Edit::SetLights {
                mesh,
                lights: lamps(random, bvh.view().mesh_lights(mesh).map_or(1, <[_]>::len) as u32),
            },
            (8 | 9, _, Some(_)) => Edit::RemoveInstance(all.swap_remove(on)),
            (10, Some(mesh), _)
                if random.below(20) == 0 || !all.iter().any(|&own| bvh.view().mesh_of(own) == Some(mesh)) =>
            {
                Edit::RemoveMesh(meshes.swap_remove(at))
            }
            _ => {
                let count = 1 + random.below(most);
                Edit::AddMesh {
                    lights: lamps(random, count),
                }
            }
        });
    }
    out
}

/// Kinds and links alone, without what a refit computes.
pub fn bare<N: Node<W>, const W: usize>(node: &N) -> N {
    let mut bare = N::EMPTY;
    (0..W).for_each(|slot| bare.set_child(slot, node.kind(slot), node.link(slot)));
    bare
}

/// Points among the lights, half of them facing up.
pub fn points(count: u32) -> Vec<ShadingPoint> {
    let random = &mut Random(77);
    let point = |k| ShadingPoint {
        p: (random.vector() * 30.0).to_array(),
        n: [0.0, if k % 2 == 0 { 1.0 } else { -1.0 }, 0.0],
    };
    (0..count).map(point).collect()
}

/// A number of a sample; every second one is below the share of uniform choice.
pub fn number(k: u32) -> u32 {
    hash(k) >> if k % 2 == 0 { 0 } else { 8 }
}

/// Checks that samples name existing lights, with the bits of their pmfs. Returns them.
pub fn sound_samples<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>) -> Vec<SampledLight>
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    let mut all = Vec::new();
    for (k, point) in (0..).zip(points(16)) {
        let sampled = bvh.tree().sample(&point, number(k));
        if sampled != SampledLight::NONE {
            let pmf = bvh.tree().pmf(&point, sampled.light, sampled.instance);
            assert_eq!(pmf.to_bits(), sampled.pmf.to_bits(), "{sampled:?}");
            assert!(
                bvh.view().light(sampled.light, sampled.instance).is_some(),
                "{sampled:?}"
            );
        }
        all.push(sampled);
    }
    all
}

/// Checks a refitted BVH: it is valid, samples are sound, and probabilities sum to one if a light has flux.
pub fn sound<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>)
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    bvh.view().validate().expect("valid");
    sound_samples(bvh);
    if crate::Summary::phi(&bvh.view().summary()) == 0.0 {
        return;
    }
    for point in points(2) {
        let pmfs = lights(bvh)
            .into_iter()
            .map(|(light, own)| bvh.tree().pmf(&point, light, own));
        let sum: f64 = pmfs.map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum} at {point:?}");
    }
}
