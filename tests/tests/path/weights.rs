//! The two ways to find a light share it exactly.

use glam::Vec3;
use lightbvh::light::mis_weight;
use lightbvh::{ShadingPoint, exact};
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::pixel::encounter;
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_tests::generate::Random;
use lightbvh_tests::world::{World, glossy, light, matte};

#[test]
fn the_weights_of_both_ways_sum_to_one() {
    let mut random = Random::new(1);
    let mut draw = || exact::pow2(random.below(252) as i32 - 125) * (1.0 + random.unit());
    for i in 0..1_000_000 {
        let a = draw();
        let b = if i % 2 == 0 {
            draw()
        } else {
            a * (0.5 + draw().fract())
        };
        let (wa, wb) = (mis_weight(a, b), mis_weight(b, a));
        // Three roundings of 2^-25 each: of the sum below, which both share, and of the two quotients.
        let sum = f64::from(wa) + f64::from(wb);
        assert!((sum - 1.0).abs() <= 3.0 * 2f64.powi(-25), "{a} {b}: {sum}");
        assert!((0.0..=1.0).contains(&wa));
        let expected = {
            let r = f64::from(b) / f64::from(a);
            1.0 / (1.0 + r * r)
        };
        assert!((f64::from(wa) - expected).abs() <= 2f64.powi(-22), "{a} {b}");
    }
    for x in [exact::pow2(-100), 1.0, exact::pow2(104)] {
        assert_eq!((mis_weight(x, 0.0), mis_weight(0.0, x)), (1.0, 1.0));
        assert_eq!(mis_weight(x, x), 0.5);
    }
    assert_eq!(mis_weight(0.0, 0.0), 1.0);
}

/// What is found at a sampled point of a light, and what a ray in that direction finds, have the same two densities.
#[test]
fn both_ways_tell_the_same_densities() {
    let mut random = Random::new(2);
    let mut met = 0;
    for i in 0..50_000_u32 {
        let mut vertex = |y: f32| [random.between(-1.0, 1.0), y, random.between(-1.0, 1.0)];
        let y = 0.5 + (i % 7) as f32;
        let lamp = light([vertex(y), vertex(y + 0.3), vertex(y + 0.1)], 1.0, 0, i & 1);
        let world = World::new(vec![lamp], &[], matte(0.5));
        let material = glossy(random.unit(), random.unit(), i % 12);
        let point = ShadingPoint {
            p: [random.between(-0.5, 0.5), 0.0, random.between(-0.5, 0.5)],
            n: [0.0, 1.0, 0.0],
        };
        let mut wo = random.direction();
        wo[1] = wo[1].abs();
        let wo = Vec3::from(wo);
        let pmf = exact::pow2(-(random.below(20) as i32)) * (0.5 + 0.5 * random.unit());
        let uv = [random.unit(), random.unit()];
        let connection = lamp.connect(point, wo, material, pmf, uv);
        if connection.contribution.x > 0.0 {
            let d = connection.direction;
            let ray = Ray::new(point.position(), d.normalize(), FAR);
            let other = encounter(&world.scene(), &ray, Vec3::ZERO);
            // At the rim of the triangle rounding may carry the ray past it.
            if other.light == 0 {
                met += 1;
                let m = Vec3::from(lamp.p[1]) - Vec3::from(lamp.p[0]);
                let m = m.cross(Vec3::from(lamp.p[2]) - Vec3::from(lamp.p[0])).normalize();
                let cosine = f64::from(m.dot(ray.direction).abs());
                let by_light = f64::from(lamp.density(ray.direction * other.distance, pmf));
                let scattering = material.scatter(Vec3::Y, ray.direction, wo);
                // The ends of both rays differ by the offset off the light, 2^-18 of the coordinates, which at a cosine
                // is that much further along; the rest is rounding of a few 2^-24.
                let size = f64::from(y + 1.0) * 2f64.powi(-18);
                let tilt = (size + 2f64.powi(-21)) / f64::from(d.length()) / cosine;
                let light_error = 4.0 * tilt + 2f64.powi(-16);
                let ratio = by_light / f64::from(connection.density);
                assert!((ratio - 1.0).abs() <= light_error, "{ratio} {light_error}");
                // pmf |d|^2 / (A cos), in f64 from the triangle itself.
                let [p0, p1, p2] = lamp.p.map(|v| Vec3::from(v).as_dvec3());
                let d64 = d.as_dvec3();
                let facing = (p1 - p0).cross(p2 - p0).dot(d64.normalize()).abs() / 2.0;
                let expected = f64::from(pmf) * d64.length_squared() / facing;
                let ratio = f64::from(connection.density) / expected;
                assert!((ratio - 1.0).abs() <= light_error, "{ratio} {light_error}");
                let k = f64::from(1_u32 << material.exponent_log2);
                let half = (ray.direction + wo).normalize().dot(Vec3::Y);
                let gloss_error = 2.0 * k * tilt / f64::from(half) + 4.0 * tilt / f64::from(ray.direction.y);
                let ratio = f64::from(scattering.density) / f64::from(connection.scattering_density);
                if gloss_error < 0.1 {
                    assert!(
                        (ratio - 1.0).abs() <= 2.0 * gloss_error + 2f64.powi(-16),
                        "{ratio} {gloss_error}"
                    );
                    // A weight moves by at most half the relative error of the ratio of its densities.
                    let sum = mis_weight(connection.density, connection.scattering_density)
                        + mis_weight(scattering.density, by_light as f32);
                    let error = light_error + 2.0 * gloss_error + 2f64.powi(-15);
                    assert!((f64::from(sum) - 1.0).abs() <= error, "{sum} {error}");
                }
            }
        }
    }
    assert!(met > 15_000, "{met}");
}
