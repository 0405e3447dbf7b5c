//! Exact arithmetic, and the summaries and unions that are made of it.

use glam::Vec3;
use lightbvh::cone::{Cone, normalized};
use lightbvh::summary::Lanes;
use lightbvh::{LightBounds, LightMoments, Summary, exact};
use lightbvh_tests::generate::{self, Random, extreme_triangle};

use super::digest::Digest;

#[test]
fn bounds_and_unions() {
    let mut random = Random::new(37);
    let mut digest = Digest::new();
    for _ in 0..20_000 {
        let [a, b] = [0; 2].map(|_| LightBounds::of_triangle(&extreme_triangle(&mut random)));
        digest.summary(&a);
        let both = a.merge(&b);
        digest.summary(&both);
        let third = LightBounds::of_triangle(&extreme_triangle(&mut random));
        digest.summary(&third.merge(&both));
        digest.summary(&both.merge(&third));
        let mut cone = || Cone {
            axis: normalized(Vec3::from(random.direction())),
            cos_theta_o: match random.below(4) {
                0 => 1.0,
                1 => 1.0 - generate::log_uniform(&mut random, -24, -2),
                2 => generate::log_uniform(&mut random, -24, -2) - 1.0,
                _ => random.between(-1.0, 1.0),
            },
        };
        let (one, other) = (cone(), cone());
        let near = Cone {
            axis: normalized(one.axis + other.axis * exact::pow2(-12)),
            ..other
        };
        for union in [
            one.union(a.cone()),
            one.union(other),
            one.union(near),
            near.union(one),
        ] {
            digest.vector(union.axis);
            digest.float(union.cos_theta_o);
        }
    }
    digest.is(0x2a97_3490_f7dc_0e0a, "bounds");
}

#[test]
fn moments_and_merges() {
    let mut random = Random::new(39);
    let mut digest = Digest::new();
    for i in 0..5000 {
        let scale = exact::pow2(random.below(60) as i32 - 30);
        let children: [LightMoments; 8] = if i % 3 == 0 {
            std::array::from_fn(|_| LightMoments::of_triangle(&extreme_triangle(&mut random)))
        } else {
            let near = generate::small_triangles(8, 8, 4.0, 1.0, i % 2 == 0, i);
            std::array::from_fn(|slot| {
                let mut triangle = near[slot];
                triangle.p = triangle.p.map(|p| p.map(|x| x * scale));
                triangle.flags = u32::from(slot % 4 == 3);
                LightMoments::of_triangle(&triangle)
            })
        };
        children.iter().for_each(|child| digest.summary(child));
        let pairs: [LightMoments; 4] = std::array::from_fn(|k| {
            LightMoments::merged(&Lanes::of(&[children[2 * k], children[2 * k + 1]]))
        });
        pairs.iter().for_each(|pair| digest.summary(pair));
        digest.summary(&LightMoments::merged(&Lanes::of(&pairs)));
        digest.summary(&LightMoments::merged(&Lanes::of(&children)));
    }
    digest.is(0xa352_e857_ad16_f9d6, "moments");
}

#[test]
fn arithmetic() {
    let mut random = Random::new(41);
    let mut digest = Digest::new();
    for _ in 0..200_000 {
        let x = generate::log_uniform(&mut random, -60, 60);
        let y = generate::log_uniform(&mut random, -60, 60);
        for value in [
            exact::div(x, y),
            exact::div_emulated(x, y),
            exact::div_emulated(x, x * 4.0),
            exact::div_emulated(-x, x.next_up()),
            exact::sqrt(x),
            exact::sqrt_emulated(x),
            exact::recip(x),
            exact::recip_rough(x),
            exact::rsqrt(x),
            exact::rsqrt_rough(x),
            exact::significand(x),
            exact::pow2(exact::exponent(x)),
            exact::unit_f32(exact::hash(x.to_bits())),
        ] {
            digest.float(value);
        }
    }
    digest.is(0x6b77_41b8_c5eb_1e06, "arithmetic");
}
