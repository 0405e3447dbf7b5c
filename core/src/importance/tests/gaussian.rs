//! Spherical Gaussians against the published formula in `f64`.

use core::f64::consts::PI;

use glam::Vec3;

use super::{Random, Wide, dot, minus, times, wide};
use crate::importance::gaussian::{clamped_cosine, exp_minus, less_exp_over};
use crate::importance::{ImportanceModel, SphericalGaussian};
use crate::node::{FullMomentNode, LeanMomentNode, MomentLayout, MomentNode, Node, kind};
use crate::point::ShadingPoint;
use crate::{LightMoments, exact};

/// By its series, whose terms are positive; beyond 6 there is nothing left.
fn erfc(x: f64) -> f64 {
    if x < 0.0 {
        return 2.0 - erfc(-x);
    }
    if x > 6.0 {
        return 0.0;
    }
    let (mut term, mut sum) = (x, x);
    for k in 1..200 {
        term *= 2.0 * x * x / f64::from(2 * k + 1);
        sum += term;
    }
    1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum
}

/// The supplement's listings 5 to 7.
fn integral(cosine: f64, s: f64) -> f64 {
    let ratio = 0.5 * ((s + 2.736_083_161_127_256) * s + 17.021_297_781_741_875)
        / (((s + 4.010_082_672_851_042) * s + 15.219_156_263_147_21) * s + 76.087_896_272_360_74);
    let t = s * ratio.sqrt();
    let tz = t * cosine;
    let share = 0.5 * (cosine * erfc(-tz) + erfc(t))
        - 0.5 / PI.sqrt() * (-tz * tz).exp() * (t * t * (cosine * cosine - 1.0)).exp_m1() / t;
    let e = (-s).exp();
    // Their limit where both differences cancel.
    let (lower, upper) = if s < 1e-3 {
        (e * (0.5 - s / 3.0), 0.5 - s / 6.0)
    } else {
        (
            e * (-(-s).exp_m1() - s * e) / (s * s),
            ((-s).exp_m1() + s) / (s * s),
        )
    };
    2.0 * (lower + (upper - lower) * share.clamp(0.0, 1.0))
}

/// The formula, over Φ, where no floor counts; and d² + σ².
fn published(lights: &LightMoments, point: &ShadingPoint) -> (f64, f64) {
    let x = minus(wide(lights.c), wide(point.position()));
    let d2 = dot(x, x);
    let (across, along) = (f64::from(lights.across), f64::from(lights.along));
    let variance = (across * across + along * along / 2.0).max(d2 * 2f64.powi(-31));
    let m = wide(lights.m);
    let length = dot(m, m).sqrt() * 2.0 / 3.0;
    // Words of a packed mean normal may be a little longer than 1.
    let squared = (length * length).min(4.0 / 9.0);
    let kappa = length * (3.0 - squared) / (1.0 - squared);
    let axis = if length > 0.0 {
        times(m, -1.0 / dot(m, m).sqrt())
    } else {
        [0.0; 3]
    };
    let lambda = d2 / variance;
    let direction = times(x, 1.0 / d2.sqrt());
    let product: Wide = [0, 1, 2].map(|k| axis[k] * kappa + direction[k] * lambda);
    let sharpness = dot(product, product).sqrt();
    let apart = minus(axis, direction);
    // Where the lights shine alike in all directions there is no axis to be apart from.
    let below = if length > 0.0 {
        -kappa * lambda * dot(apart, apart) / (sharpness + kappa + lambda)
    } else {
        0.0
    };
    let over = |x: f64| if x > 1e-12 { -(-x).exp_m1() / x } else { 1.0 };
    let received = if point.n == [0.0; 3] {
        4.0 * over(2.0 * sharpness)
    } else {
        let cosine = dot(wide(point.normal()), product) / sharpness;
        integral(cosine.clamp(-1.0, 1.0), sharpness)
    };
    let value = below.exp() * received / (variance * over(2.0 * kappa));
    (value, d2 + variance)
}

#[test]
fn curves_are_within_their_errors() {
    let random = &mut Random(1);
    for i in 0..40_000 {
        let x = if i < 1000 {
            i as f32 * 0.1
        } else {
            random.power(-30, 7)
        };
        let wide = f64::from(x).min(80.0);
        let found = f64::from(exp_minus(x));
        assert!((found / (-wide).exp() - 1.0).abs() < 1e-5, "e^-{x} {found}");
        let found = f64::from(less_exp_over(x));
        let expected = -(-f64::from(x)).exp_m1() / f64::from(x);
        assert!(
            i == 0 || (found / expected - 1.0).abs() < 2e-5,
            "{x}: {found} {expected}"
        );
        let (cosine, sharpness) = (random.signed(), random.power(-20, 32));
        let found = f64::from(clamped_cosine(cosine, sharpness));
        let expected = integral(cosine.into(), sharpness.into());
        // The share is off by 3e-5, of what is at most 2 / (1 + Λ/2).
        let error = 1e-4 / (1.0 + 0.5 * f64::from(sharpness)) + 1e-4 * expected;
        assert!(
            (found - expected).abs() < error + 1.0 / 1024.0 * f64::from(sharpness < 0.01),
            "{cosine} {sharpness}: {found} {expected}"
        );
    }
    assert_eq!(exp_minus(0.0), exp_minus(-1.0));
}

/// A light straight above the point, not broad, that shines everywhere.
fn known(point: &ShadingPoint, distance: f32) -> LightMoments {
    let up = if point.n == [0.0; 3] {
        Vec3::X
    } else {
        point.normal()
    };
    LightMoments {
        phi: 1.0,
        c: point.position() + up * distance,
        across: 1e-3 * distance,
        along: 0.0,
        m: Vec3::ZERO,
        h: Vec3::ZERO,
    }
}

fn set(random: &mut Random, point: &ShadingPoint, size: f32) -> LightMoments {
    LightMoments {
        phi: random.power(-6, 6),
        c: point.position() + random.direction() * (size * random.power(-5, 6)),
        across: (0.02 + random.unit()) * size,
        along: random.unit() * random.unit() * size * 2.0,
        m: match random.below(4) {
            0 => random.direction(),
            1 => Vec3::ZERO,
            _ => random.vector() * 0.57,
        },
        h: random.extents(size * 3.0),
    }
}

/// Weights are those of the words as they are read, within a hundredth.
fn check<N: MomentLayout<4>>(seed: u32) {
    let random = &mut Random(seed);
    let (mut low, mut near, mut away, mut volume) = (0, 0, 0, 0);
    for _ in 0..20_000 {
        let scale = random.power(-20, 20);
        let point = ShadingPoint {
            p: (random.vector() * scale).to_array(),
            n: if random.below(8) == 0 {
                [0.0; 3]
            } else {
                random.direction().to_array()
            },
        };
        let size = scale * random.power(-3, 3);
        let mut sets = [known(&point, size); 4];
        for set_of in &mut sets[1..] {
            *set_of = set(random, &point, size);
        }
        let mut node = N::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
        let weights = SphericalGaussian::weights(&node, &point).map(f64::from);
        let of = |slot: usize| {
            let lights = node.summary(slot);
            let (value, squared) = published(&lights, &point);
            (lights, value, squared)
        };
        let (first, one, _) = of(0);
        for (slot, weight) in weights.iter().enumerate().skip(1) {
            let (lights, value, squared) = of(slot);
            // Where the share of the upper hemisphere is small, its error of 3e-5 of all that a product can be counts.
            let floor = 2f64.powi(-8) / squared;
            let error = 0.01 * value + 4e-3 * floor;
            let found = weight / weights[0] * one * f64::from(first.phi) / f64::from(lights.phi);
            let [least, most] = [value - error, value + error].map(|v| v.max(floor));
            assert!(
                (least * 0.99..=most * 1.01).contains(&found),
                "{} {found}, expected {value} or {floor}: {lights:?} at {point:?}",
                N::NAME
            );
            low += u32::from(value < 0.5 * floor);
            near += u32::from(squared < 3.0 * f64::from(lights.across).powi(2));
            let x = lights.c - point.position();
            away += u32::from(
                crate::vector::dot(x, lights.m) > 0.1 * exact::sqrt(crate::vector::length_squared(x)),
            );
            volume += u32::from(point.n == [0.0; 3]);
        }
    }
    for seen in [low, near, away, volume] {
        assert!(seen > 500, "{low} {near} {away} {volume}");
    }
}

#[test]
fn weights_are_the_published_ones() {
    check::<FullMomentNode<4>>(2);
    check::<MomentNode<4>>(3);
    check::<LeanMomentNode<4>>(4);
}

/// Many bright lights close together below the horizon, and a dim one above it among them: their mean is so far below that the
/// published integral is zero in `f32`, although one of them shines on the point.
#[test]
fn what_is_zero_as_published_keeps_a_weight() {
    let point = ShadingPoint {
        p: [0.0; 3],
        n: [0.0, 0.0, 1.0],
    };
    let lights = LightMoments {
        phi: 1000.0,
        c: Vec3::new(0.0, 0.0, -10.0),
        across: 0.5,
        along: 0.5,
        m: Vec3::ZERO,
        // As high as 10.5 above the centre.
        h: Vec3::new(0.5, 0.5, 10.5),
    };
    let (value, squared) = published(&lights, &point);
    assert_eq!(value as f32, 0.0);
    let mut node = FullMomentNode::<2>::EMPTY;
    for slot in 0..2 {
        node.set_child(slot, kind::LIGHT, slot as u32);
    }
    node.set_summaries(&[lights, known(&point, 10.0)]);
    let weights = SphericalGaussian::weights(&node, &point);
    let ratio = f64::from(weights[0] / weights[1]) / 1000.0;
    // The other's factor is 2.
    let expected = 2f64.powi(-8) / squared / (2.0 / 100.0);
    assert!(
        (ratio / expected - 1.0).abs() < 0.02,
        "{ratio}, expected {expected}"
    );
}

/// Positive where there is flux, zero elsewhere, at most 2^120, on any lengths.
#[test]
fn moments_of_any_size_have_sound_weights() {
    fn check<N: MomentLayout<4>>(random: &mut Random) {
        let size = random.power(-100, 40);
        let sets = [0; 4].map(|_| LightMoments {
            phi: [0.0, exact::pow2(-100), exact::pow2(120), 1.0][random.below(4) as usize],
            c: random.vector() * size * random.power(-4, 20),
            across: [0.0, random.unit(), 1.0][random.below(3) as usize] * size,
            along: [0.0, random.unit(), 1.0][random.below(3) as usize] * size,
            m: random.vector() * [0.0, 0.57][random.below(2) as usize],
            h: random.extents(size),
        });
        let mut node = N::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
        let p = match random.below(3) {
            0 => sets[0].c,
            1 => sets[0].c + random.direction() * random.power(-100, 60),
            _ => Vec3::ZERO,
        };
        let n = if random.below(3) == 0 {
            Vec3::ZERO
        } else {
            random.direction()
        };
        let point = ShadingPoint {
            p: p.to_array(),
            n: n.to_array(),
        };
        let weights = SphericalGaussian::weights(&node, &point);
        for slot in 0..4 {
            let sound = (0.0..=exact::pow2(120)).contains(&weights[slot])
                && (weights[slot] > 0.0) == (sets[slot].phi > 0.0);
            assert!(sound, "{} {weights:?}: {sets:?} at {point:?}", N::NAME);
        }
    }
    let random = &mut Random(5);
    for _ in 0..20_000 {
        check::<FullMomentNode<4>>(random);
        check::<MomentNode<4>>(random);
        check::<LeanMomentNode<4>>(random);
    }
}
