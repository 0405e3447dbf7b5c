//! Sampling against an exhaustive oracle: the probabilities of all lights, evaluated one by one.

use std::collections::HashMap;

use lightbvh::{
    BuildParams, CompactNode, EmissiveTriangle, Eq4, FullNode, Heuristic, INVALID, LightBvh, LightNode,
    Lights, ShadingPoint,
};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::statistics::{chi_squared, chi_squared_quantile};
use proptest::prelude::*;

/// Probability of every light at `point`.
fn all_pmfs<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    point: &ShadingPoint,
) -> Vec<f32> {
    (0..lights.triangles().len() as u32)
        .map(|i| bvh.pmf::<Eq4>(lights, point, i))
        .collect()
}

/// Whether light can arrive, in f64 and by geometry alone: some of the triangle is above the point's horizon, and the
/// point is on an emitting side. A relative margin leaves out what rounding of the input decides.
fn can_contribute(triangle: &EmissiveTriangle, point: &ShadingPoint) -> bool {
    let v = |k: usize| triangle.p[k].map(f64::from);
    let sub = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let (p, n) = (point.p.map(f64::from), point.n.map(f64::from));
    let normal = cross(sub(v(1), v(0)), sub(v(2), v(0)));
    let area = dot(normal, normal).sqrt();
    if area == 0.0 || triangle.luminance() == 0.0 {
        return false;
    }
    let distance = |k: usize| dot(sub(v(k), p), sub(v(k), p)).sqrt();
    let height = dot(normal, sub(p, v(0))) / area;
    let in_front = if triangle.is_two_sided() {
        height.abs()
    } else {
        height
    } > 1e-6 * distance(0);
    let volume = n == [0.0; 3];
    in_front && (volume || (0..3).any(|k| dot(n, sub(v(k), p)) > 1e-6 * distance(k)))
}

fn check<N: LightNode<W>, const W: usize>(bvh: &LightBvh<N, W>, lights: &Lights, random: &mut Random) {
    for _ in 0..8 {
        let point = generate::point(random, 10.0);
        let pmfs = all_pmfs(bvh, lights, &point);
        let sum: f64 = pmfs.iter().map(|&p| f64::from(p)).sum();
        let reachable = pmfs.iter().any(|&p| p > 0.0);
        assert!(pmfs.iter().all(|p| p.is_finite() && *p >= 0.0));
        // Every factor of every pmf is rounded by at most 2^-24, and adopted masses add as many roundings again.
        let tolerance = f64::from(bvh.depth() * 4 + 8) * 2f64.powi(-24);
        if reachable {
            assert!(
                (sum - 1.0).abs() <= tolerance,
                "sum {sum} of {} lights at {point:?}",
                pmfs.len()
            );
        }
        for (triangle, &pmf) in lights.triangles().iter().zip(&pmfs) {
            assert!(
                pmf > 0.0 || !can_contribute(triangle, &point),
                "no probability for {triangle:?} at {point:?}"
            );
        }
        for _ in 0..32 {
            let sampled = bvh.sample::<Eq4>(&point, random.bits());
            if reachable {
                assert!(
                    sampled.light != INVALID,
                    "a light can be reached at {point:?}, none was sampled"
                );
                let pmf = pmfs[sampled.light as usize];
                assert_eq!(
                    sampled.pmf.to_bits(),
                    pmf.to_bits(),
                    "light {} at {point:?}",
                    sampled.light
                );
            } else {
                assert_eq!(sampled.light, INVALID);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn two_level_compact(lights in generate::lights(200), seed: u32) {
        check(&LightBvh::<CompactNode<2>, 2>::two_level(&lights, &BuildParams::default()), &lights, &mut Random::new(seed));
    }

    #[test]
    fn single_level_compact(lights in generate::lights(200), seed: u32, sah: bool) {
        let heuristic = if sah { Heuristic::Sah } else { Heuristic::Saoh };
        let params = BuildParams { heuristic, ..BuildParams::default() };
        check(&LightBvh::<CompactNode<2>, 2>::single_level(&lights, &params), &lights, &mut Random::new(seed));
    }

    #[test]
    fn two_level_full(lights in generate::lights(120), seed: u32) {
        check(&LightBvh::<FullNode<2>, 2>::two_level(&lights, &BuildParams::default()), &lights, &mut Random::new(seed));
    }

    #[test]
    fn wider_nodes(lights in generate::lights(200), seed: u32) {
        let random = &mut Random::new(seed);
        check(&LightBvh::<CompactNode<4>, 4>::two_level(&lights, &BuildParams::default()), &lights, random);
        check(&LightBvh::<CompactNode<8>, 8>::single_level(&lights, &BuildParams::default()), &lights, random);
        check(&LightBvh::<CompactNode<16>, 16>::two_level(&lights, &BuildParams::default()), &lights, random);
    }
}

/// Frequencies of 10^5 samples per point match the evaluated probabilities (χ², tail 1e-6 for each of the tests).
#[test]
fn frequencies_match() {
    const SAMPLES: u32 = 100_000;
    let triangles = generate::small_triangles(300, 20, 10.0, 0.5, true, 7);
    let lights = Lights::new(triangles).expect("lights");
    let two = LightBvh::<CompactNode<2>, 2>::two_level(&lights, &BuildParams::default());
    let one = LightBvh::<CompactNode<2>, 2>::single_level(&lights, &BuildParams::default());
    let four = LightBvh::<CompactNode<4>, 4>::two_level(&lights, &BuildParams::default());
    let mut random = Random::new(99);
    for _ in 0..12 {
        let point = generate::point(&mut random, 10.0);
        frequencies_match_at(&two, &lights, &point, SAMPLES, &mut random);
        frequencies_match_at(&one, &lights, &point, SAMPLES, &mut random);
        frequencies_match_at(&four, &lights, &point, SAMPLES, &mut random);
    }
}

fn frequencies_match_at<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    point: &ShadingPoint,
    samples: u32,
    random: &mut Random,
) {
    let expected: Vec<f64> = all_pmfs(bvh, lights, point).into_iter().map(f64::from).collect();
    if expected.iter().all(|&p| p == 0.0) {
        return;
    }
    let mut counts = HashMap::<u32, u64>::new();
    for _ in 0..samples {
        *counts
            .entry(bvh.sample::<Eq4>(point, random.bits()).light)
            .or_default() += 1;
    }
    assert!(!counts.contains_key(&INVALID));
    let observed: Vec<u64> = (0..expected.len() as u32)
        .map(|i| counts.get(&i).copied().unwrap_or(0))
        .collect();
    let (statistic, degrees) = chi_squared(&observed, &expected);
    let threshold = chi_squared_quantile(degrees, 1e-6);
    assert!(
        statistic < threshold,
        "χ² {statistic} of {degrees} degrees, threshold {threshold}, at {point:?}"
    );
}
