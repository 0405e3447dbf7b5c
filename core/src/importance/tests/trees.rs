//! Each importance over whole trees, against all lights one by one.

extern crate std;

use std::vec::Vec;

use super::Random;
#[cfg(feature = "std")]
use crate::importance::NativeMath;
use crate::importance::{Eq4, Flux, FluxOverDistance, ImportanceModel, Moments};
use crate::kit::scenes::sent;
use crate::node::{CompactNode, LightNode, MomentNode};
use crate::{BuildParams, Bvh, EmissiveTriangle, INVALID, Lights, ShadingPoint, Summary};

/// 40 triangles in four meshes, two-sided and dark ones among them, as far as 100 times their size from each other or all at
/// one place.
fn scene(random: &mut Random) -> Lights {
    let spread = random.power(-3, 7);
    let triangle = |k: u32| {
        let at = random.vector() * spread;
        let corner = |random: &mut Random| (at + random.vector() * 0.5).to_array();
        EmissiveTriangle {
            p: [at.to_array(), corner(random), corner(random)],
            radiance: [random.power(-8, 8) * f32::from(u8::from(k % 7 != 3)); 3],
            mesh: k / 10,
            flags: u32::from(k % 5 == 2) * EmissiveTriangle::TWO_SIDED,
        }
    };
    Lights::new((0..40).map(triangle).collect()).expect("within the domain")
}

fn point(random: &mut Random, lights: &Lights) -> ShadingPoint {
    let at = lights.triangles()[random.below(40) as usize].p[0];
    let p = [0, 1, 2].map(|k| at[k] + random.signed() * random.power(-10, 6));
    let n = if random.below(4) == 0 {
        [0.0; 3]
    } else {
        random.direction().to_array()
    };
    ShadingPoint { p, n }
}

/// Numbers at equal distances, of which each light has as many as its pmf says, but for two.
const NUMBERS: u32 = 1 << 13;

/// Probabilities sum to one, each light with flux has one, samples come with them, and the mean of what samples say is what all
/// lights send.
fn check<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(seed: u32) {
    let random = &mut Random(seed);
    let mut tight = 0;
    for turn in 0..12 {
        let lights = scene(random);
        let two = turn % 2 == 0;
        let bvh = if two {
            Bvh::<N, I, W>::two_level(&lights, &BuildParams::default())
        } else {
            Bvh::<N, I, W>::single_level(&lights, &BuildParams::default())
        };
        for _ in 0..4 {
            let point = point(random, &lights);
            let pmfs: Vec<f32> = (0..)
                .zip(lights.triangles())
                .map(|(light, triangle)| {
                    let instance = if two { triangle.mesh } else { INVALID };
                    let pmf = bvh.pmf(&point, light, instance);
                    let shines = N::Summary::of_triangle(triangle).phi() > 0.0;
                    assert_eq!(pmf > 0.0, shines, "{} light {light} at {point:?}", N::NAME);
                    pmf
                })
                .collect();
            let sum: f64 = pmfs.iter().copied().map(f64::from).sum();
            assert!((sum - 1.0).abs() < 1e-5, "{sum} at {point:?}");
            let (mut estimate, mut expected, mut tolerance) = (0.0, 0.0, 0.0);
            for number in 0..NUMBERS {
                let bits = (u64::from(number) << 51) + (1 << 50);
                let sampled = bvh.sample(&point, bits);
                let light = sampled.light as usize;
                assert_eq!(sampled.pmf.to_bits(), pmfs[light].to_bits(), "light {light}");
                let f = sent(&lights.triangles()[light], &point);
                estimate += f / f64::from(sampled.pmf) / f64::from(NUMBERS);
            }
            for (triangle, &pmf) in lights.triangles().iter().zip(&pmfs) {
                let f = sent(triangle, &point);
                expected += f;
                if pmf > 0.0 {
                    tolerance += 2.0 * f / f64::from(pmf) / f64::from(NUMBERS);
                }
            }
            assert!(
                (estimate - expected).abs() <= tolerance + 1e-5 * expected,
                "{} {estimate}, expected {expected} within {tolerance} at {point:?}",
                N::NAME
            );
            tight += u32::from(expected > 0.0 && tolerance < 0.1 * expected);
        }
    }
    assert!(tight > 24, "{} {tight} of 48 say anything", N::NAME);
}

#[test]
fn each_importance_is_unbiased() {
    check::<CompactNode<4>, Eq4, 4>(1);
    check::<CompactNode<4>, Flux, 4>(2);
    check::<MomentNode<8>, Flux, 8>(3);
    check::<MomentNode<8>, FluxOverDistance, 8>(4);
    check::<MomentNode<8>, Moments, 8>(5);
}

#[test]
#[cfg(feature = "std")]
fn native_operations_are_unbiased() {
    check::<MomentNode<8>, Moments<NativeMath>, 8>(15);
}
