//! Scenes under random edits: every invariant after every frame, against a scene built from scratch, and against the
//! geometry of the lights in the world.

use std::collections::BTreeMap;

use lightbvh::scene::{RebuildParams, Rebuilt};
use lightbvh::{
    BuildParams, CompactNode, EmissiveTriangle, Eq4, INVALID, InstanceId, Scene, ShadingPoint, Transform,
};
use lightbvh_tests::edits::{Model, edits};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{can_contribute, sum_tolerance};
use proptest::prelude::*;

type Tree = Scene<CompactNode<4>, 4>;

/// What rounding of the input may decide, as a part of the distance.
const MARGIN: f64 = 1e-6;

/// Points in the world, on and about the lights.
fn points(random: &mut Random, lights: &[EmissiveTriangle], reach: f32) -> Vec<ShadingPoint> {
    (0..6)
        .map(|i| {
            let mut point = generate::point(random, reach);
            if i % 2 == 0 && !lights.is_empty() {
                let near = lights[random.below(lights.len() as u32) as usize].p[0];
                let by = random.direction();
                let distance = generate::log_uniform(random, -10, 3);
                point.p = std::array::from_fn(|k| near[k] + by[k] * distance);
            }
            point
        })
        .collect()
}

/// Probabilities of all lights of all instances at a point, with the light's number.
fn pmfs(scene: &Tree, ids: &[InstanceId], point: &ShadingPoint) -> BTreeMap<u32, f32> {
    ids.iter()
        .flat_map(|&id| {
            scene
                .lights_of(id)
                .expect("it is there")
                .map(move |light| (light, id))
        })
        .map(|(light, id)| (light, scene.pmf::<Eq4>(point, light, id)))
        .collect()
}

fn check_sampling(scene: &Tree, ids: &[InstanceId], random: &mut Random, reach: f32) {
    let depth = scene.validate().expect("valid").depth;
    let world = scene.world_lights();
    let used: Vec<_> = world
        .iter()
        .copied()
        .filter(|light| light.mesh != INVALID)
        .collect();
    for point in points(random, &used, reach) {
        let pmfs = pmfs(scene, ids, &point);
        let sum: f64 = pmfs.values().map(|&p| f64::from(p)).sum();
        let reachable = pmfs.values().any(|&p| p > 0.0);
        assert!(pmfs.values().all(|p| p.is_finite() && *p >= 0.0));
        if reachable {
            assert!(
                (sum - 1.0).abs() <= sum_tolerance(depth),
                "sum {sum} at {point:?}"
            );
        }
        for (&light, &pmf) in &pmfs {
            let triangle = &world[light as usize];
            assert!(
                pmf > 0.0 || !can_contribute(triangle, &point, MARGIN),
                "no probability for light {light}, {triangle:?}, at {point:?}: {:?}",
                scene.instances()[triangle.mesh as usize]
            );
        }
        for _ in 0..16 {
            let sampled = scene.sample::<Eq4>(&point, random.bits());
            if reachable {
                assert!(sampled.light != INVALID, "a light can be reached at {point:?}");
                assert_eq!(sampled.pmf.to_bits(), pmfs[&sampled.light].to_bits(), "{point:?}");
            } else {
                assert_eq!(sampled.light, INVALID);
            }
        }
    }
}

/// A light by the exact map in f64, as long as its own instance's map may be off.
fn exact(triangle: &EmissiveTriangle, transform: &Transform, mirrored: bool) -> [[f64; 3]; 3] {
    let [a, b, c] = triangle.p.map(|p| {
        std::array::from_fn(|row| {
            (0..3)
                .map(|k| f64::from(transform.columns[k][row]) * f64::from(p[k]))
                .sum::<f64>()
                + f64::from(transform.translation[row])
        })
    });
    if mirrored { [a, c, b] } else { [a, b, c] }
}

fn check_lights(model: &Model, scene: &Tree, reach: f32) {
    for (&id, (mesh, transform, radiance)) in &model.instances {
        let lights = scene.lights_of(id).expect("it is there");
        assert_eq!(lights.len(), model.meshes[mesh].len());
        let [x, y, z] = transform.columns.map(|c| glam::DVec3::from(c.map(f64::from)));
        let mirrored = x.cross(y).dot(z) < 0.0;
        for (light, local) in lights.zip(&model.meshes[mesh]) {
            let found = scene.light(light, id).expect("one of its lights");
            let expected = exact(local, transform, mirrored);
            for (e, f) in expected.iter().flatten().zip(found.p.iter().flatten()) {
                assert!(
                    (e - f64::from(*f)).abs() <= f64::from(reach + 8.0) * 2f64.powi(-20),
                    "{e} {f}"
                );
            }
            let shine = local.radiance.map(|x| x * radiance);
            assert!(found.radiance == shine || found.radiance == [0.0; 3], "{found:?}");
            assert_eq!(found.mesh, id.index());
        }
    }
}

fn check(seed: u32, reach: f32) {
    let random = &mut Random::new(seed);
    let (mut scene, mut model) = (Tree::new(BuildParams::default()), Model::default());
    let mut flying: Option<(u32, Rebuilt<CompactNode<4>, 4>)> = None;
    for _ in 0..12 {
        // A rebuild that ends some frames after it began, before or after the edits of its last frame.
        let due = flying.take_if(|(frames, _)| {
            *frames = frames.saturating_sub(1);
            *frames == 0
        });
        let before = random.below(2) == 0;
        let (early, late) = if before { (due, None) } else { (None, due) };
        if let Some((_, rebuilt)) = early {
            scene.adopt(rebuilt);
        }
        edits(random, &mut model, &mut scene, reach);
        if let Some((_, rebuilt)) = late {
            scene.adopt(rebuilt);
        }
        scene.refit();
        let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
        assert_eq!(stats.instances as usize, model.instances.len());
        assert_eq!(stats.lights as usize, scene.light_count());
        check_lights(&model, &scene, reach);
        if flying.is_none() && random.below(2) == 0 {
            let params = RebuildParams {
                top: random.below(4) != 0,
                drift: 1.0001,
            };
            flying = Some((1 + random.below(3), scene.rebuild(&params).run()));
        }
    }
    let ids: Vec<InstanceId> = model.instances.keys().copied().collect();
    check_sampling(&scene, &ids, random, reach);

    let (scratch, added) = model.from_scratch();
    let stats = scratch
        .validate()
        .unwrap_or_else(|violation| panic!("{violation}"));
    assert_eq!(stats.lights as usize, scene.light_count());
    check_sampling(&scratch, &added, random, reach);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn edits_leave_a_valid_scene(seed: u32) {
        check(seed, 10.0);
    }

    #[test]
    fn far_from_the_origin(seed: u32, exponent in 2..24) {
        check(seed, 2f32.powi(exponent));
    }
}
