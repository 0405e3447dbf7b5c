//! What is chosen has the probability that is told, by every measure there is.

extern crate std;

use std::vec::Vec;

use super::environment::start_of;
use super::*;
use crate::exact::hash;
use crate::kit::Random;

/// Of directions and of places there is one each.
#[test]
fn places_and_directions_undo_each_other() {
    let n = 257;
    for k in 0..n * n {
        let place = [k % n, k / n].map(|x| (x as f32 + 0.5) * 2.0 / n as f32 - 1.0);
        let d = direction_at(place);
        let length: f64 = d.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
        assert!((length - 1.0).abs() < 1e-6, "{length}");
        let again = place_of(d);
        assert!(
            (0..2).all(|k| crate::exact::abs(again[k] - place[k]) < 1e-6),
            "{place:?} {again:?}"
        );
        let longer = place_of(d.map(|x| x * 1e9));
        assert!((0..2).all(|k| crate::exact::abs(longer[k] - place[k]) < 1e-6));
    }
    assert_eq!(direction_at([0.0, 0.0]), [0.0, 1.0, 0.0]);
    assert_eq!(direction_at([1.0, 1.0]), [0.0, -1.0, 0.0]);
    assert_eq!(direction_at([0.0, -1.0]), [0.0, 0.0, -1.0]);
}

/// A receiver in a volume has no cosine.
#[test]
fn suns_light_volumes_fully() {
    let sun = DistantLight {
        direction: [0.0, 1.0, 0.0],
        irradiance: [2.0, 3.0, 4.0],
    };
    let at = |n| sun.irradiance_at(&crate::ShadingPoint { p: [0.0; 3], n });
    assert_eq!(at([0.0; 3]), sun.irradiance);
    assert_eq!(at([0.0, -1.0, 0.0]), [0.0; 3]);
    assert_eq!(at([0.6, 0.8, 0.0]), [2.0, 3.0, 4.0].map(|x: f32| x * 0.8));
}

/// The mean, and the probability of a cap, are those of integrals over the sphere, which know nothing of octahedra.
#[test]
fn weights_are_integrals_over_the_sphere() {
    // The mean of y² over a sphere is a third.
    let bands = Environment::from_fn(64, |[_, y, _]| [1.0 + 3.0 * y * y; 3]).expect("a map");
    let mean = f64::from(bands.mean_luminance());
    assert!((mean - 2.0).abs() < 2e-3, "{mean}");
    // What lies above y = 0.9 is a twentieth of the sphere, and so is what lies beyond x = 0.9.
    let even = Environment::from_fn(256, |_| [1.0; 3]).expect("a map");
    let map = even.map();
    for axis in 0..3 {
        let mut share = 0.0_f64;
        let n = 1024;
        for k in 0..n * n {
            // Sixteen places in each texel.
            let place = [k % n, k / n].map(|x| (x as f32 + 0.5) * 2.0 / n as f32 - 1.0);
            let d = direction_at(place);
            // Alike all around.
            let of_all = f64::from(map.density(d)) * 4.0 * core::f64::consts::PI;
            assert!((of_all - 1.0).abs() < 0.02, "{of_all} at {d:?}");
            if d[axis] > 0.9 {
                share += f64::from(map.pmf(map.texel_of(d))) / 16.0;
            }
        }
        assert!((share - 0.05).abs() < 2e-4, "axis {axis}: {share}");
    }
}

fn sky(size: u32) -> Environment {
    Environment::from_fn(size, |[x, y, z]| {
        let sun = if x * 0.6 + y * 0.8 > 0.99 { 1e4 } else { 0.0 };
        let dark = if z > 0.7 { 0.0 } else { 1.0 };
        [
            0.1 * dark + sun,
            dark * crate::exact::max(y, 0.0) + sun,
            0.3 * dark + sun,
        ]
    })
    .expect("a sky")
}

/// Exhaustive: each texel is chosen by exactly as many numbers as its pmf says.
#[test]
fn each_texel_has_its_share_of_the_numbers() {
    let sky = sky(16);
    let map = sky.map();
    assert_eq!(map.counts[0], 1 << 31);
    // Where its numbers begin is the sum of those before it.
    let texels = &map.counts[start_of(map.levels) as usize..];
    let mut before = 0_u32;
    for (texel, &count) in (0..).zip(texels) {
        assert_eq!(map.pmf(texel), count as f32 / (1_u32 << 31) as f32);
        if count == 0 {
            assert_eq!(map.radiance[texel as usize], [0.0; 3]);
            continue;
        }
        for number in [before, before + count / 2, before + count - 1] {
            let sampled = map.sample(u64::from(number) << 33, [0.5, 0.5]);
            assert_eq!((sampled.texel, sampled.pmf), (texel, map.pmf(texel)));
        }
        before += count;
    }
    assert_eq!(before, 1 << 31);
}

/// What a sample says of its direction is what anyone finds who comes from there.
#[test]
fn samples_and_queries_agree() {
    for size in [1, 2, 32, 256] {
        let sky = sky(size);
        for k in 0..20_000 {
            let uv = [hash(k), hash(k ^ 0x5555)].map(crate::exact::unit_f32);
            let sampled = sky.map().sample(hash(k ^ 0x1234), uv);
            // At the border of two texels rounding may name the other.
            let texel = sky.map().texel_of(sampled.direction);
            if texel == sampled.texel {
                assert_eq!(
                    sampled.density.to_bits(),
                    sky.map().density(sampled.direction).to_bits()
                );
                assert_eq!(sampled.radiance, sky.map().radiance(sampled.direction));
            } else {
                assert!(uv.iter().any(|x| !(0.001..0.999).contains(x)), "{uv:?} of {size}");
            }
        }
    }
}

#[test]
fn bad_input_is_refused_and_black_is_none() {
    for found in [0, 3, 4096, u32::MAX] {
        let error = Environment::from_fn(found, |_| [1.0; 3]).expect_err("no power of two");
        assert!(std::format!("{error}").starts_with("the size of an environment is "));
    }
    for value in [f32::NAN, -1.0, f32::INFINITY, 1e35] {
        let error = Environment::from_fn(4, |[x, ..]| if x > 0.5 { [1.0, value, 1.0] } else { [1.0; 3] });
        let error = std::format!("{}", error.expect_err("refused"));
        assert!(error.contains("environment is (1, "), "{error}");
    }
    let black = Environment::from_fn(8, |_| [0.0; 3]).expect("no light is no error");
    let sampled = black.map().sample(7_u32, [0.5; 2]);
    assert_eq!(
        (sampled.pmf, sampled.density, sampled.texel),
        (0.0, 0.0, u32::MAX)
    );
    let blue = Environment::from_fn(8, |_| [0.0, 0.0, 1e-29]).expect("hardly any");
    assert!(blue.map().sample(7_u32, [0.5; 2]).pmf > 0.0);
    for wrong in [[0.0; 3], [0.5, 0.0, 0.0], [f32::NAN, 1.0, 0.0]] {
        let sun = DistantLight {
            direction: wrong,
            irradiance: [1.0; 3],
        };
        let error = sun.checked().expect_err("no direction");
        assert!(std::format!("{error}").contains("the direction of a sun, is ("));
    }
    for value in [f32::NAN, -1.0, 1e35, 1e-38] {
        let sun = DistantLight {
            direction: [0.0, 1.0, 0.0],
            irradiance: [1.0, value, 1.0],
        };
        let error = sun.checked().expect_err("out of range");
        assert!(std::format!("{error}").starts_with("green of the "));
    }
}

/// Hostile words give some sample, or none; nothing panics or runs on.
#[test]
fn any_words_are_bounded() {
    for k in 0..2000_u32 {
        let counts: Vec<u32> = (0..hash(k) % 90)
            .map(|i| hash(i ^ (k << 8)) >> (hash(k ^ i) % 33).min(31))
            .collect();
        let radiance: Vec<[f32; 3]> = (0..hash(!k) % 70)
            .map(|i| [f32::from_bits(hash(i ^ k)); 3])
            .collect();
        let map = EnvironmentMap {
            levels: k % 4,
            counts: &counts,
            radiance: &radiance,
        };
        let sampled = map.sample(hash(k ^ 77), [0.1, 0.9]);
        assert!(sampled.texel == u32::MAX || sampled.texel < 1 << (2 * map.levels));
        let density = map.density([f32::from_bits(hash(k)), 0.3, f32::NAN]);
        let radiance = map.radiance([0.0; 3]);
        // Any numbers, as the words are.
        std::hint::black_box((density, radiance));
    }
}

/// Shares are exact: the numbers that lead to a source are those that its pmf says, and what is left of them is uniform.
#[test]
fn a_split_is_exact() {
    let random = &mut Random(3);
    for _ in 0..20 {
        let weights: [f32; 5] = core::array::from_fn(|k| {
            if k == 3 {
                0.0
            } else {
                (f64::from(random.unit()).powi(6)) as f32
            }
        });
        let split = Split::new(weights);
        let mut before = 0_u32;
        let mut all = 0.0;
        for index in 0..5 {
            let pmf = split.pmf(index);
            assert_eq!(pmf > 0.0, weights[index as usize] > 0.0);
            all += f64::from(pmf);
            let count = (pmf * (1 << 22) as f32) as u32;
            if count == 0 {
                continue;
            }
            for (number, part) in [
                (before, 0.0),
                (before + count / 2, 0.5),
                (before + count - 1, 1.0),
            ] {
                let share = split.choose(u64::from(number) << 42);
                assert_eq!((share.index, share.pmf), (index, pmf));
                let rest = f64::from(share.rest.high) / 4_294_967_296.0;
                assert!((rest - part).abs() <= 1.001 / f64::from(count), "{rest} {part}");
            }
            before += count;
        }
        assert_eq!((before, all), (1 << 22, 1.0));
    }
    let none = Split::new([0.0, f32::NAN, -1.0]).choose(5_u32);
    assert_eq!((none.index, none.pmf), (3, 0.0));
    assert_eq!(
        Split::new([f32::INFINITY, 1.0]).pmf(0) + Split::new([f32::INFINITY, 1.0]).pmf(1),
        1.0
    );
}

/// What is left over is the quotient in 128 bits, so as uniform as what was given.
#[test]
fn what_is_left_is_the_quotient() {
    let split = Split::new([1.0, 2.5, 0.3]);
    for k in 0..50_000_u32 {
        let bits = (u64::from(hash(k)) << 32) | u64::from(hash(!k));
        let share = split.choose(bits);
        let counts = [0, 1, 2].map(|index| (split.pmf(index) * (1 << 22) as f32) as u64);
        let before: u64 = counts[..share.index as usize].iter().sum();
        let within = u128::from(bits) - (u128::from(before) << 42);
        let quotient = (within << 21) / u128::from(counts[share.index as usize]);
        let found = (u64::from(share.rest.high) << 32) | u64::from(share.rest.low);
        assert_eq!(u128::from(found >> 1), quotient);
    }
}
