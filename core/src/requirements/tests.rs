//! Counts of scenes and their models, against the rules written out once more.

extern crate std;

use std::string::ToString;
use std::vec::Vec;

use super::{Declared, Layout, Model, Requirements, TransformKind, Updates};
use crate::bvh::LightBvh;
use crate::kit::Random;
use crate::kit::scenes::{instances, lamps};
use crate::{EmissiveTriangle, Transform};

/// Maps of each kind; the third mirrors.
fn maps() -> [Transform; 5] {
    let at = Transform::at([1.0, 2.0, 3.0]);
    let of = |x: f32, y: f32, z: f32| Transform {
        columns: [[0.0, x, 0.0], [-y, 0.0, 0.0], [0.0, 0.0, z]],
        ..at
    };
    [
        Transform::IDENTITY,
        at,
        of(1.0, -1.0, 1.0),
        of(2.0, 2.0, 2.0),
        of(1.0, 1.000_01, 1.0),
    ]
}

#[test]
fn transforms_are_of_their_kind() {
    use TransformKind as K;
    let kinds = [K::Identity, K::Translation, K::Rigid, K::Uniform, K::NonUniform];
    assert_eq!(maps().map(|map| TransformKind::of(&map)), kinds);
    let columns = |scale: f32, shear: f32| Transform {
        columns: [[scale, 0.0, 0.0], [shear, scale, 0.0], [0.0, 0.0, scale]],
        ..maps()[1]
    };
    assert_eq!(TransformKind::of(&columns(1.0e-9, 0.0)), K::Uniform);
    for (scale, shear) in [(2.0, 0.001), (0.0, 0.0)] {
        assert_eq!(TransformKind::of(&columns(scale, shear)), K::NonUniform);
    }
}

/// Scenes with meshes that are shared, dark or removed again, under random declarations.
#[test]
fn counts_are_those_of_the_scene_and_models_no_larger_than_they_need() {
    let mut seen = [0; 6];
    for seed in 0..500 {
        let random = &mut Random(seed * 131);
        let mut bvh = LightBvh::default();
        let (two_sided, mut one_sided) = (random.below(2) == 0, 0);
        let (mut users, mut kinds, mut dimmed, mut dark) = ([0; 2], [0; 5], 0, 0);
        let meshes = 1 + random.below(2) as usize;
        for user in &mut users[..meshes] {
            let mut mesh: Vec<EmissiveTriangle> = lamps(random, 3);
            mesh.iter_mut()
                .filter(|_| two_sided)
                .for_each(|own| own.flags = EmissiveTriangle::TWO_SIDED);
            mesh[0].radiance = [0.0; 3];
            one_sided += mesh.iter().filter(|own| !own.is_two_sided()).count();
            let mesh = bvh.add_mesh(mesh).expect("in the domain");
            for _ in 0..random.below(3) {
                let (kind, radiance) = (
                    random.below(5) as usize,
                    [1.0, 0.5, 0.0][random.below(3) as usize],
                );
                let added = bvh.add_instance(mesh, maps()[kind]).expect("an instance");
                bvh.set_radiance(added, radiance).expect("a factor");
                if random.below(4) == 0 {
                    bvh.remove_instance(added).expect("it is there");
                    continue;
                }
                (*user, kinds[kind]) = (*user + 1, kinds[kind] + 1);
                dimmed += usize::from(radiance != 1.0);
                dark += if radiance == 0.0 { 3 } else { 1 };
            }
        }
        let mut coin = || random.below(4) == 0;
        let d = Declared {
            transforms: coin(),
            radiance: coin(),
            triangles: coin(),
            instances: coin(),
            meshes: coin(),
            pmf: coin(),
        };
        bvh.refit();
        let found = Requirements::of(&bvh, d);
        let placed = instances(&bvh).len();
        assert_eq!(
            (found.meshes, found.instances, found.lights),
            (meshes, placed, 3 * placed)
        );
        assert_eq!((found.triangles, found.one_sided), (3 * meshes, one_sided));
        assert_eq!(
            (found.transforms, found.dimmed, found.dark),
            (kinds, dimmed, dark)
        );
        let shared = users[0].max(users[1]);
        assert_eq!(found.most_instances, shared);

        let single = shared < 2
            && !(d.transforms || d.radiance || d.instances || d.meshes)
            && (!d.triangles || meshes.max(placed) < 2);
        let expected = Model {
            layout: [Layout::Moments, Layout::TwoSidedMoments][usize::from(one_sided == 0 && !d.meshes)],
            single_level: single,
            uniform_halvings: if d.pmf { 6 } else { 0 },
            trails: d.pmf,
            updates: match (d.triangles || d.meshes, d.transforms || d.radiance || d.instances) {
                (true, _) => Updates::Meshes,
                (false, true) => Updates::Instances,
                (false, false) => Updates::Nothing,
            },
            width: 8,
        };
        let model = found.model();
        assert_eq!(model, expected);
        seen[model.updates as usize] += 1;
        seen[3] += usize::from(d.pmf);
        seen[4] += usize::from(expected.layout == Layout::TwoSidedMoments);
        seen[5] += usize::from(single);
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
    assert_eq!(
        Model::DEFAULT.to_string(),
        "Bvh<MomentNode<8>, Defensive<Moments, 6>, 8>, two levels"
    );
}
