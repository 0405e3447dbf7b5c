//! Counts of scenes and their models.

extern crate std;

use std::string::ToString;
use std::vec::Vec;

use super::{Choice, Declared, Layout, Requirements};
use crate::bvh::LightBvh;
use crate::kit::Random;
use crate::kit::scenes::lamps;
use crate::{EmissiveTriangle, Transform};

/// Two meshes of three lights each: two maps, three factors, one removed instance.
fn scene(flags: u32, instances: u32) -> LightBvh {
    let random = &mut Random(1);
    let mut bvh = LightBvh::default();
    let mut mesh = || {
        let mut mesh: Vec<EmissiveTriangle> = lamps(random, 3);
        mesh.iter_mut().for_each(|own| own.flags = flags);
        mesh
    };
    let meshes = [bvh.add_mesh(mesh()), bvh.add_mesh(mesh())].map(|mesh| mesh.expect("lights"));
    for k in 0..=instances {
        let at = Transform::at([if k % 5 == 0 { 0.0 } else { 1.0 }, 0.0, 0.0]);
        let own = bvh.add_instance(meshes[k as usize % 2], at).expect("a mesh");
        bvh.set_radiance(own, [[1.0, 0.5, 0.0][k as usize % 3]; 3])
            .expect("a factor");
        if k == instances {
            bvh.remove(own).expect("there");
        }
    }
    bvh
}

#[test]
fn counts_are_those_of_the_scene() {
    let found = Requirements::of(&scene(EmissiveTriangle::TWO_SIDED, 7), Declared::default());
    assert_eq!((found.meshes, found.instances, found.most_instances), (2, 7, 4));
    assert_eq!((found.triangles, found.lights, found.one_sided), (6, 21, 0));
    // Of two at the identity one is dimmed or off.
    assert_eq!(found.placed, 6);
    assert_eq!(Requirements::of(&scene(0, 2), Declared::default()).one_sided, 6);
}

#[test]
fn models_are_no_larger_than_scenes_need() {
    let still = Choice {
        layout: Layout::TwoSidedMoments,
        single_level: true,
    };
    let of = |instances, change: fn(&mut Declared)| {
        let mut declared = Declared::default();
        change(&mut declared);
        Requirements::of(&scene(EmissiveTriangle::TWO_SIDED, instances), declared).model()
    };
    let two_levels = Choice {
        single_level: false,
        ..still
    };
    let growing = Choice {
        layout: Layout::Moments,
        ..two_levels
    };
    assert_eq!(of(2, |_| {}), still);
    assert_eq!(of(3, |_| {}), two_levels);
    assert_eq!(of(2, |d| d.meshes = true), growing);
    for change in [
        |d: &mut Declared| d.transforms = true,
        |d: &mut Declared| d.radiance = true,
        |d: &mut Declared| d.instances = true,
        |d: &mut Declared| d.triangles = true,
    ] {
        assert_eq!(of(2, change), two_levels);
    }
    let one_sided = Requirements::of(&scene(0, 2), Declared::default()).model();
    assert_eq!(one_sided.layout, Layout::Moments);
    assert_eq!(
        Choice::DEFAULT.to_string(),
        "Bvh<(MomentNode<8>, DefaultImportance)>, two levels"
    );
}
