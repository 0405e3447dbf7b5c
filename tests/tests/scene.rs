//! Scenes under random edits: every invariant after every frame, against a scene built from scratch, and against the maps of the
//! lights in f64.

use lightbvh::bvh::{RebuildParams, Rebuilt};
use lightbvh::{
    Bvh, EmissiveTriangle, INVALID, ImportanceModel, InstanceId, LightNode, ShadingPoint, Summary,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::edits::{Model, edits};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{assert_mapped, assert_sum_is_one};
use proptest::prelude::*;

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

/// Every light that shines in its mesh and is not turned off has a probability, under any map, wherever the point is; they sum to
/// one, and samples come with them. `ids` are the instances of the model in `scene`.
fn check_sampling<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    model: &Model,
    scene: &Bvh<N, (), W>,
    ids: &[InstanceId],
    random: &mut Random,
    reach: f32,
) {
    let world = scene.world_lights();
    let used: Vec<_> = world
        .iter()
        .copied()
        .filter(|light| light.mesh != INVALID)
        .collect();
    for point in points(random, &used, reach) {
        let mut pmfs = vec![0.0; scene.light_end() as usize];
        let mut any = false;
        for (&id, (mesh, _, radiance)) in ids.iter().zip(model.instances.values()) {
            let lights = scene.lights_of(id).expect("it is there");
            for (light, local) in lights.zip(&model.meshes[mesh]) {
                let pmf = scene.by::<I>().pmf(&point, light, id.index());
                let shines = *radiance > 0.0 && N::Summary::of_triangle(local).phi() > 0.0;
                assert_eq!(
                    pmf > 0.0,
                    shines || I::UNIFORM_HALVINGS > 0,
                    "{} {W}: light {light} at {point:?}: {:?}",
                    N::NAME,
                    scene.instances()[id.index() as usize]
                );
                any |= shines;
                pmfs[light as usize] = pmf;
            }
        }
        if any {
            assert_sum_is_one::<N, I, W>(pmfs.iter().copied(), &point);
        }
        for _ in 0..16 {
            let sampled = scene.by::<I>().sample(&point, random.bits());
            assert!(!any || sampled.light != INVALID, "no light at {point:?}");
            let expected = pmfs.get(sampled.light as usize).copied().unwrap_or(0.0);
            assert_eq!(sampled.pmf.to_bits(), expected.to_bits(), "{point:?}");
        }
    }
}

fn check_lights<N: LightNode<W>, const W: usize>(model: &Model, scene: &Bvh<N, (), W>) {
    for (&id, (mesh, transform, radiance)) in &model.instances {
        let lights = scene.lights_of(id).expect("it is there");
        assert_eq!(lights.len(), model.meshes[mesh].len());
        for (light, local) in lights.zip(&model.meshes[mesh]) {
            let found = scene.triangle(light, id.index()).expect("one of its lights");
            assert_mapped(transform, local, &found);
            let shine = local.radiance.map(|x| x * radiance);
            assert!(found.radiance == shine || found.radiance == [0.0; 3], "{found:?}");
            assert_eq!(found.mesh, id.index());
        }
    }
}

fn check<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(seed: u32, reach: f32) {
    let random = &mut Random::new(seed);
    let (mut scene, mut model) = (Bvh::<N, (), W>::default(), Model::default());
    let mut flying: Option<(u32, Rebuilt<N, W>)> = None;
    for _ in 0..12 {
        // A rebuild that ends some frames after it began, before or after the edits of its last frame.
        let due = flying.take_if(|(frames, _)| {
            *frames = frames.saturating_sub(1);
            *frames == 0
        });
        let before = random.below(2) == 0;
        let (early, late) = if before { (due, None) } else { (None, due) };
        if let Some((_, rebuilt)) = early {
            scene.install(rebuilt).expect("its own");
        }
        edits(random, &mut model, &mut scene, reach);
        if let Some((_, rebuilt)) = late {
            scene.install(rebuilt).expect("its own");
        }
        scene.refit();
        let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
        assert_eq!(stats.instances as usize, model.instances.len());
        assert_eq!(stats.lights as usize, scene.light_count());
        assert_eq!(
            stats.blases as usize,
            model.meshes.len(),
            "one bottom level serves all"
        );
        assert!(stats.depth <= scene.depth());
        check_lights(&model, &scene);
        if flying.is_none() && random.below(2) == 0 {
            let params = RebuildParams {
                top: if random.below(4) != 0 { 1.0 } else { f64::INFINITY },
                drift: 1.0001,
            };
            flying = Some((1 + random.below(3), scene.rebuild(&params).run()));
        }
    }
    let ids: Vec<InstanceId> = model.instances.keys().copied().collect();
    check_sampling::<N, I, W>(&model, &scene, &ids, random, reach);

    let (scratch, added) = model.from_scratch();
    let stats = scratch
        .validate()
        .unwrap_or_else(|violation| panic!("{violation}"));
    assert_eq!(stats.lights as usize, scene.light_count());
    check_sampling::<N, I, W>(&model, &scratch, &added, random, reach);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn edits_leave_a_valid_scene(seed: u32) {
        each_layout!(check(seed, 10.0));
    }

    #[test]
    fn far_from_the_origin(seed: u32, exponent in 2..24) {
        each_layout!(check(seed, 2f32.powi(exponent)));
    }
}
