//! Trees as deep as trails are long, and flux over forty powers of two.

use lightbvh::trail::max_levels;
use lightbvh::{
    BuildParams, Bvh, CompactNode, EmissiveTriangle, Eq4, Heuristic, INVALID, ImportanceModel, LightNode,
    Lights, ShadingPoint, Transform, exact,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::edits::{add_instance, add_mesh};
use lightbvh_tests::generate::{self, Random, split};
use lightbvh_tests::oracle::{all_pmfs, assert_frequencies, assert_sum_is_one};

fn triangle(corner: [f32; 3], size: f32, radiance: f32, mesh: u32) -> EmissiveTriangle {
    let [x, y, z] = corner;
    EmissiveTriangle {
        p: [corner, [x, y + size, z], [x, y, z + size]],
        radiance: [radiance; 3],
        mesh,
        flags: 1,
    }
}

/// `count` lights, each at half the distance from the origin of the one before, in meshes of `per_mesh`.
pub fn shrinking(count: u32, per_mesh: u32, brighter: bool) -> Lights {
    let light = |i: u32| {
        let x = exact::pow2(38 - i as i32);
        // Radiance as the inverse square of the size gives all the same flux, or each twice that of the one before.
        let flux = if brighter { exact::pow2(i as i32 - 60) } else { 1.0 };
        let size = if i > 120 { 0.0 } else { x * 0.125 };
        triangle([x, 0.0, 0.0], size.max(exact::pow2(-40)), flux, i / per_mesh)
    };
    Lights::new((0..count).map(light).collect()).expect("within the domain")
}

/// Boxes one within the other: triangles around the origin, each half as large as the one before.
fn nested(count: u32) -> Lights {
    let light = |i: u32| {
        let s = exact::pow2(38 - i as i32);
        let mut t = triangle([-s; 3], 3.0 * s, 1.0, i);
        t.p[1][0] = s;
        t
    };
    Lights::new((0..count).map(light).collect()).expect("within the domain")
}

/// Mesh lights at halving distances along x, the triangles of each at halving distances along y: deep in both levels.
fn deep_in_both(meshes: u32, triangles: u32) -> Lights {
    let light = |i: u32| {
        let (m, t) = (i / triangles, i % triangles);
        let (x, y) = (exact::pow2(20 - m as i32), exact::pow2(20 - t as i32));
        triangle([x, y, 0.0], y * 0.125, 1.0, m)
    };
    Lights::new((0..meshes * triangles).map(light).collect()).expect("within the domain")
}

/// Points near the origin, at every distance from it.
fn point(random: &mut Random) -> ShadingPoint {
    let d = exact::pow2(38 - random.below(100) as i32);
    ShadingPoint {
        p: random.direction().map(|x| x * d),
        n: [0.0; 3],
    }
}

/// A valid tree within the levels of a trail, whose pmfs sum to one and are those of its samples.
fn check<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    seed: u32,
) {
    bvh.validate().unwrap_or_else(|v| panic!("{v}"));
    let levels = if bvh.is_single_level() { 1 } else { 2 };
    assert!(bvh.depth() <= levels * max_levels(W), "depth {}", bvh.depth());
    let random = &mut Random::new(seed);
    for _ in 0..12 {
        let point = point(random);
        let pmfs = all_pmfs::<N, I, W>(bvh, lights, &point);
        assert_sum_is_one::<N, I, W>(pmfs.iter().copied(), &point);
        assert!(pmfs.iter().all(|&p| p > 0.0), "a starved light at {point:?}");
        for _ in 0..64 {
            let sampled = bvh.by::<I>().sample(&point, random.bits());
            assert_ne!(sampled.light, INVALID);
            assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
        }
    }
}

fn every_layout<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &Lights,
    params: &BuildParams,
    deepest: &mut u32,
) {
    let one = Bvh::<N, (), W>::single_level(lights, params);
    check::<N, I, W>(&one, lights, 1);
    check::<N, I, W>(&Bvh::two_level(lights, params), lights, 2);
    *deepest = one.depth().max(*deepest);
}

fn every_tree(lights: &Lights, least_depth: u32) {
    for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
        let mut deepest = 0;
        for buckets in [2, 16] {
            let params = split(heuristic, buckets);
            each_layout!(every_layout(lights, &params, &mut deepest));
        }
        assert!(deepest >= least_depth, "{heuristic:?}: only {deepest} levels");
    }
}

#[test]
fn halving_distances() {
    every_tree(&shrinking(78, 1, false), 33);
    every_tree(&shrinking(78, 78, false), 33);
    every_tree(&shrinking(78, 9, true), 0);
}

/// More halvings than a trail has levels: the builder must make the parts equal before it runs out of them.
#[test]
fn more_halvings_than_levels() {
    let lights = shrinking(130, 130, false);
    for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
        let params = split(heuristic, 2);
        let bvh = Bvh::<CompactNode<2>, (), 2>::single_level(&lights, &params);
        assert!((33..=64).contains(&bvh.depth()), "depth {}", bvh.depth());
        bvh.validate().unwrap_or_else(|v| panic!("{v}"));
        let wide = Bvh::<CompactNode<16>, (), 16>::single_level(&lights, &params);
        assert!(wide.depth() <= max_levels(16));
        wide.validate().unwrap_or_else(|v| panic!("{v}"));
    }
}

#[test]
fn nested_boxes() {
    every_tree(&nested(70), 4);
}

#[test]
fn deep_in_both_levels() {
    let lights = deep_in_both(48, 48);
    let params = split(Heuristic::Sah, 2);
    let bvh = Bvh::<CompactNode<2>, (), 2>::two_level(&lights, &params);
    assert!(bvh.depth() > 2 * 33, "only {} levels", bvh.depth());
    assert_eq!(bvh.tree().trail_words, 2);
    check::<_, Eq4, 2>(&bvh, &lights, 1);
    assert_frequencies::<_, Eq4, _>(
        &bvh,
        &lights,
        &ShadingPoint {
            p: [0.0, 0.0, -1.0],
            n: [0.0; 3],
        },
        100_000,
        2,
    );
}

/// Deep in a chain the random number must not run dry: the lights near the point are drawn as often as they should be.
#[test]
fn frequencies_below_32_levels() {
    let lights = shrinking(78, 78, false);
    let params = split(Heuristic::Sah, 2);
    let bvh = Bvh::<CompactNode<2>, (), 2>::single_level(&lights, &params);
    assert!(bvh.depth() > 33);
    // About as far from the origin as the sixtieth light: it and its neighbours are drawn most.
    let d = exact::pow2(38 - 60);
    let observed = assert_frequencies::<_, Eq4, _>(
        &bvh,
        &lights,
        &ShadingPoint {
            p: [0.0, d, d],
            n: [0.0; 3],
        },
        200_000,
        3,
    );
    assert!(
        observed.iter().filter(|&&count| count > 100).count() >= 3,
        "{observed:?}"
    );
}

/// One light among 64 shines 2^k times as bright as the others.
#[test]
fn one_light_outshines_all() {
    for k in [0, 4, 8, 12, 40, 90] {
        let light = |i: u32| {
            let radiance = exact::pow2(if i == 20 { k } else { 0 });
            triangle([i as f32, 2.0, 0.0], 0.5, radiance, i / 8)
        };
        let lights = Lights::new((0..64).map(light).collect()).expect("within the domain");
        let point = ShadingPoint {
            p: [30.0, 0.0, 0.0],
            n: [0.0, 1.0, 0.0],
        };
        let params = BuildParams::default();
        let (two, one, wide) = (
            Bvh::<CompactNode<2>, (), 2>::two_level(&lights, &params),
            Bvh::<CompactNode<2>, (), 2>::single_level(&lights, &params),
            Bvh::<CompactNode<4>, (), 4>::two_level(&lights, &params),
        );
        let samples = if k == 12 { 1u32 << 20 } else { 100_000 };
        let observed = [
            assert_frequencies::<_, Eq4, _>(&two, &lights, &point, samples, 1),
            assert_frequencies::<_, Eq4, _>(&one, &lights, &point, samples, 2),
            assert_frequencies::<_, Eq4, _>(&wide, &lights, &point, samples, 3),
        ];
        let pmfs = all_pmfs::<_, Eq4, 2>(&two, &lights, &point);
        assert!(pmfs.iter().all(|&p| p > 0.0), "a starved light: {pmfs:?}");
        for (observed, depth) in observed.into_iter().zip([two.depth(), one.depth(), wide.depth()]) {
            let others = observed.iter().sum::<u64>() - observed[20];
            if k < 13 {
                assert!(others > 0, "{k}");
            } else if k > 20 {
                // Beside the bright one the others of a node have one number each of at least 2^21, and the last of them the
                // 2^-15 that is not shared out by weight. Six standard deviations of a Poisson variable, and as much again.
                let share = f64::from(depth) * (2f64.powi(-15) + 3.0 * 2f64.powi(-21));
                let mean = share * f64::from(samples);
                let most = mean + 6.0 * mean.sqrt() + 6.0;
                assert!((others as f64) < most, "{k}: {others}, at most {most}");
            }
        }
        // Seen from behind, where no bound says that the bright light contributes, it is not lost, and neither are the others.
        let turned = lights
            .triangles()
            .iter()
            .enumerate()
            .map(|(i, t)| EmissiveTriangle {
                flags: u32::from(i != 20),
                ..*t
            });
        let turned = Lights::new(turned.collect()).expect("within the domain");
        let behind = ShadingPoint {
            p: [0.0; 3],
            n: [0.0; 3],
        };
        let bvh = Bvh::<CompactNode<2>, (), 2>::two_level(&turned, &params);
        assert_frequencies::<_, Eq4, _>(&bvh, &turned, &behind, 100_000, 4);
        let pmfs = all_pmfs::<_, Eq4, 2>(&bvh, &turned, &behind);
        assert!(pmfs.iter().all(|&p| p > 0.0), "a starved light: {pmfs:?}");
    }
}

/// Flux over 2^200 drives the probabilities of dim lights far below what their shares of it are: a child has at least one of 2^21
/// numbers at each level, but below 2^-98 a probability counts as no less. They still sum to one.
#[test]
fn flux_over_sixty_decades() {
    fn summed<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(lights: &Lights) {
        let params = BuildParams::default();
        let random = &mut Random::new(1);
        for bvh in [
            Bvh::<N, (), W>::two_level(lights, &params),
            Bvh::single_level(lights, &params),
        ] {
            for _ in 0..40 {
                let point = generate::point(random, 1.0);
                let pmfs = all_pmfs::<N, I, W>(&bvh, lights, &point);
                assert_sum_is_one::<N, I, W>(pmfs.iter().copied(), &point);
                assert!(
                    pmfs.iter().all(|&p| p >= exact::pow2(-99)),
                    "{pmfs:?} at {point:?}"
                );
            }
        }
    }
    let mut triangles = generate::small_triangles(200, 8, 1.0, 0.04, false, 17);
    for (i, triangle) in (0..).zip(&mut triangles) {
        triangle.radiance = [10f32.powi(i * 60 / 199 - 30); 3];
    }
    let lights = Lights::new(triangles).expect("within the domain");
    each_layout!(summed(&lights));
}

/// A scene whose trails grow to two words when a deep mesh comes, while shallow ones are there already.
fn grown<N: LightNode<W>, const W: usize>()
where
    Eq4: ImportanceModel<N, W>,
{
    let mut scene = Bvh::<N, (), W>::new(split(Heuristic::Sah, 2));
    let mut random = Random::new(1);
    let mut instances = Vec::new();
    for (count, words) in [(5, 1), (60, 2), (7, 2)] {
        let triangles = match count {
            60 => shrinking(count, count, true).triangles().to_vec(),
            _ => generate::small_triangles(count, 100, 1.0, 0.1, false, 3),
        };
        let mesh = add_mesh(&mut scene, triangles);
        instances.push(add_instance(
            &mut scene,
            mesh,
            Transform::at([0.0, 0.0, count as f32]),
        ));
        scene.refit();
        let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
        assert_eq!(scene.tree().trail_words, words, "{} levels", stats.depth);
        assert_eq!(
            scene.tree().trails.len(),
            scene.triangles().len() * words as usize
        );
        for _ in 0..20 {
            let point = point(&mut random);
            let tree = scene.by::<Eq4>();
            let sampled = tree.sample(&point, random.bits());
            assert_eq!(
                tree.pmf(&point, sampled.light, sampled.instance).to_bits(),
                sampled.pmf.to_bits()
            );
            let mut pmfs = Vec::new();
            for &id in &instances {
                let lights = scene.lights_of(id).expect("there");
                pmfs.extend(lights.map(|light| tree.pmf(&point, light, id.index())));
            }
            assert_sum_is_one::<N, Eq4, W>(pmfs, &point);
        }
    }
}

#[test]
fn trails_grow_with_a_deep_mesh() {
    grown::<CompactNode<2>, 2>();
    grown::<CompactNode<4>, 4>();
}
