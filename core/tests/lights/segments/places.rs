//! Places that are drawn on a segment, and estimates over them.

use super::*;
use glam::Vec3;
use lightbvh::exact::{hash, pow2};
use lightbvh::importance::{RaySegment, Subtended};
use lightbvh::{Bvh, Defensive, MomentNode, Moments};

/// Steps even in `u` have that much of the density between them, and the density is nearly that of the angle.
#[test]
fn places_have_their_density() {
    const STEPS: u32 = 64;
    let random = &mut Random(5);
    let (mut least, mut most) = (1.0_f64, 1.0_f64);
    for trial in 0..400 {
        let scale = pow2((trial % 21) - 10);
        let segment = random.segment(scale, scale * pow2(trial % 7 - 3));
        let part = random.unit();
        let near = segment.at(part);
        // Some close by the segment.
        let center = if trial % 3 == 0 {
            let off = random.vector(scale * 1e-2);
            core::array::from_fn(|k| near[k] + off[k])
        } else {
            random.vector(scale)
        };
        let center = Vec3::from_array(center);
        let c = wide(center.to_array());
        let (from, to) = (wide(segment.from), wide(segment.to));
        let chord = minus(to, from);
        let len = length(chord);
        let d = length(cross(minus(c, from), chord)) / len;
        let [a, b] = [minus(from, c), minus(to, c)];
        let angle = length(cross(a, b)).atan2(dot(a, b));
        let foot = dot(minus(c, from), chord) / len;
        let angle_at = |part: f64| ((part * len - foot) / d).atan();
        let mut before = 0.0;
        for k in 1..=STEPS {
            let u = k as f32 / STEPS as f32;
            let sample = segment.sample(center, u.min(1.0 - pow2(-24)));
            assert!((0.0..=1.0).contains(&sample.part) && f64::from(sample.part) >= before);
            assert_eq!(
                sample.density.to_bits(),
                segment.density(center, sample.part).to_bits()
            );
            // Simpson's rule over the angle of the step, over which the density has hardly a slope.
            let end = f64::from(sample.part);
            let (first, last) = (angle_at(before), angle_at(end));
            let mut sum = 0.0;
            for piece in 0..64 {
                let [x, y] = [0, 1].map(|i| first + (last - first) * f64::from(piece + i) / 64.0);
                let at = |angle: f64| {
                    let tangent = angle.tan();
                    let part = ((tangent * d + foot) / len) as f32;
                    f64::from(segment.density(center, part)) * d * (1.0 + tangent * tangent)
                };
                sum += (at(x) + 4.0 * at(0.5 * (x + y)) + at(y)) * (y - x) / 6.0;
            }
            let found = sum * f64::from(STEPS);
            // Parts are numbers of 24 bits, and those between them are rounded.
            let rounding = 1e-6 / (end - before);
            assert!(
                (found - 1.0).abs() < 2e-3 + rounding,
                "{found} of step {k} in {segment:?} about {center}"
            );
            before = end;
            let place = minus(at(&segment, end), c);
            let exact = d / (angle * dot(place, place));
            if d > 1e-3 * f64::from(scale) {
                let ratio = f64::from(sample.density) / exact;
                least = least.min(ratio);
                most = most.max(ratio);
            }
        }
        assert_eq!(segment.sample(center, 0.0).part, 0.0);
    }
    println!("density over the equiangular one: {least:.4} to {most:.4}");
    // Θ/sin Θ and Θ/2 over tan Θ/2 of a quarter of a half turn are 1.111 and 0.948.
    assert!(least > 0.94 && most < 1.12, "{least} {most}");
    assert!(least < 0.96 && most > 1.1, "no angle is wide: {least} {most}");
}

/// The inverse square along segments, by 256 places each: no bias, and hardly any variance.
#[test]
fn distances_integrate_the_inverse_square() {
    let random = &mut Random(6);
    let mut spread = 0.0;
    for trial in 0..200 {
        let segment = random.segment(1.0, 4.0);
        let center = random.vector(1.0);
        let c = wide(center);
        let exact = mean_along(&segment, c, 20_000, |p| {
            let to = minus(p, c);
            1.0 / dot(to, to)
        }) * length(minus(wide(segment.to), wide(segment.from)));
        let (mut mean, mut square) = (0.0, 0.0);
        for k in 0..256 {
            let u = (k as f32 + 0.5) / 256.0;
            let sample = segment.sample(Vec3::from_array(center), u);
            let to = minus(at(&segment, f64::from(sample.part)), c);
            let f = 1.0 / dot(to, to) / f64::from(sample.density) / exact;
            mean += f / 256.0;
            square += f * f / 256.0;
        }
        // A stratified sum of a smooth function.
        assert!((mean - 1.0).abs() < 1e-3, "{mean} at {trial}");
        spread += (square - mean * mean) / 200.0;
    }
    println!("relative variance of 1/d² over the density: {spread:.5}");
    assert!(spread < 0.003, "{spread}");
}

/// Lights on the segment or at its ends, segments without length, great and small scales: places within, densities finite.
#[test]
fn places_of_degenerate_segments_are_sound() {
    let random = &mut Random(7);
    for exponent in [-100, -60, -20, 0, 30, 40] {
        let scale = pow2(exponent);
        for trial in 0..300 {
            let from = random.vector(scale);
            let to = if trial % 3 == 0 {
                from
            } else {
                random.vector(scale)
            };
            let segment = RaySegment { from, to };
            let part = random.unit();
            let center = match trial % 5 {
                0 => from,
                1 => to,
                2 => segment.at(part),
                3 => random.vector(pow2(40)),
                _ => random.vector(scale),
            };
            let u = random.unit();
            let sample = segment.sample(Vec3::from_array(center), u);
            assert!((0.0..=1.0).contains(&sample.part), "{sample:?}");
            assert!(
                sample.density.is_finite() && sample.density >= 0.0,
                "{sample:?} of {segment:?}"
            );
            if trial % 3 == 0 {
                assert_eq!(sample.density, 0.0);
            } else if exponent > -30 && trial % 5 != 3 {
                assert!(sample.density > 0.0, "{segment:?} about {center:?}");
            }
        }
    }
}

/// A light by the segment, a point on it, a distance for that point: the mean is the integral over all of them. Through
/// instances that turn, stretch and mirror.
#[test]
fn estimates_converge() {
    const SAMPLES: u32 = 60_000;
    let random = &mut Random(8);
    let bvh: Bvh<MomentNode<8>, Defensive<Subtended<Moments>, 6>, 8> = rooms(random, 40, 3);
    let world = bvh.world_lights();
    for long in [0.7, 5.0, 25.0] {
        let segment = random.segment(5.0, long).checked().expect("in the domain");
        let expected: f64 = world
            .iter()
            .map(|light| received::<16>(light, &segment, 48))
            .sum();
        let (mut mean, mut square) = (0.0, 0.0);
        for _ in 0..SAMPLES {
            random.0 = random.0.wrapping_add(1);
            let sampled = bvh.sample(&segment, hash(random.0));
            let pmf = bvh.tree().pmf(&segment, sampled.light, sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
            let light = bvh.triangle(sampled.light, sampled.instance).expect("a light");
            let on = light.point([random.unit(), random.unit()]);
            let along = segment.sample(Vec3::from_array(on.p), random.unit());
            let to = minus(at(&segment, f64::from(along.part)), wide(on.p));
            let d2 = dot(to, to);
            let cosine = dot(wide(on.normal), to) / d2.sqrt();
            let density = f64::from(pmf) * f64::from(on.density) * f64::from(along.density);
            let f = f64::from(on.radiance[0]) * kit::emitted(&light, cosine) / d2 / density;
            mean += f / f64::from(SAMPLES);
            square += f * f / f64::from(SAMPLES);
        }
        let deviation = ((square - mean * mean) / f64::from(SAMPLES)).sqrt();
        println!("{long} m: {mean:.5}, expected {expected:.5}, deviation {deviation:.5}");
        // The sum over all lights is one of pieces of them.
        assert!(
            (mean - expected).abs() < 5.0 * deviation + 0.01 * expected,
            "{mean}, expected {expected} within {deviation}"
        );
        assert!(
            deviation < 0.03 * expected,
            "nothing is tested: {deviation} of {expected}"
        );
    }
}

/// Masks and segments together.
#[test]
fn masks_go_with_it() {
    kit::masks_go_with::<Subtended<Moments>, _>(&mut Random(9), |random| random.segment(5.0, 4.0));
}

#[test]
fn segments_are_checked() {
    let tiny = f32::from_bits(1);
    let segment = RaySegment {
        from: [1.0, tiny, -0.0],
        to: [2.0, 3.0, 4.0],
    };
    let checked = segment.checked().expect("in the domain");
    assert_eq!(checked.from.map(f32::to_bits), [1.0_f32.to_bits(), 0, 0]);
    assert_eq!(checked.to, segment.to);
    for broken in [f32::NAN, f32::INFINITY, 2e12] {
        for end in 0..2 {
            let mut ends = [segment.from, segment.to];
            ends[end][1] = broken;
            let [from, to] = ends;
            assert!(RaySegment { from, to }.checked().is_err());
        }
    }
}
