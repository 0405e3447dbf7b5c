//! Sampling against an exhaustive oracle: the probabilities of all lights, evaluated one by one.

use std::collections::HashMap;

use lightbvh::{
    BuildParams, CompactNode, Eq4, FullNode, Heuristic, INVALID, LightBvh, LightNode, Lights, ShadingPoint,
};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{all_pmfs, can_contribute, sum_tolerance};
use lightbvh_tests::statistics::{chi_squared, chi_squared_quantile};
use proptest::prelude::*;

/// What rounding of the input may decide, as a part of the distance.
const MARGIN: f64 = 1e-6;

fn check<N: LightNode<W>, const W: usize>(bvh: &LightBvh<N, W>, lights: &Lights, random: &mut Random) {
    for _ in 0..8 {
        let point = generate::point(random, 10.0);
        let pmfs = all_pmfs::<Eq4, N, W>(bvh, lights, &point);
        let sum: f64 = pmfs.iter().map(|&p| f64::from(p)).sum();
        let reachable = pmfs.iter().any(|&p| p > 0.0);
        assert!(pmfs.iter().all(|p| p.is_finite() && *p >= 0.0));
        let tolerance = sum_tolerance(bvh.depth());
        if reachable {
            assert!(
                (sum - 1.0).abs() <= tolerance,
                "sum {sum} of {} lights at {point:?}",
                pmfs.len()
            );
        }
        for (triangle, &pmf) in lights.triangles().iter().zip(&pmfs) {
            assert!(
                pmf > 0.0 || !can_contribute(triangle, &point, MARGIN),
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
    let expected: Vec<f64> = all_pmfs::<Eq4, N, W>(bvh, lights, point)
        .into_iter()
        .map(f64::from)
        .collect();
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
