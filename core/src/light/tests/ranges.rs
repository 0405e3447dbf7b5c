//! How far points and spots reach.

use super::*;

/// A range leaves 1 − (d / range)⁴ of a light, nothing from there on, and all of it where there is none; an instance leaves it
/// as it is.
#[test]
fn ranges_are_a_window() {
    let free = PointLight {
        p: [1.0, 2.0, -1.0],
        intensity: [1.0, 2.0, 4.0],
        ..PointLight::DARK
    };
    let turned = Transform {
        columns: [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]],
        translation: [1.0, 2.0, 5.0],
    }
    .instance(0.5);
    for range in [exact::pow2(-20), 0.3, 8.0, 5000.0, exact::pow2(40)] {
        let bounded = PointLight { range, ..free }.checked().expect("a range");
        let cone = SpotLight {
            range,
            ..spot(0.9, 0.5)
        };
        assert_eq!(PointLight::try_from(AnyLight::from(bounded)), Ok(bounded));
        assert_eq!(SpotLight::try_from(AnyLight::from(cone)), Ok(cone));
        assert_eq!(bounded.in_world(&turned, 1).range, range);
        assert_eq!(cone.in_world(&turned, 1).range, range);
        for share in [0.0_f32, 1e-12, 0.25, 0.5, 0.9, 0.999, 1.001, 1.5, 3.0, 1e9, 1e30] {
            let d = share * range;
            if d > exact::pow2(41) {
                continue;
            }
            for axis in [[1.0, 0.0, 0.0], [0.0, -0.6, 0.8], [0.36, 0.48, -0.8]] {
                let from = Vec3::from(free.p) + Vec3::from(axis) * d;
                // As far as it is, coordinates rounded.
                let away = minus(wide(from), free.p.map(f64::from));
                let q = (dot(away, away).sqrt() / f64::from(range)).min(1.0);
                let left = 1.0 - q.powi(4);
                assert_eq!(free.point_for(from, [0.5; 2]).radiance, free.intensity);
                let found = bounded.point_for(from, [0.5; 2]).radiance;
                let in_cone = cone.point_for(from, [0.5; 2]).radiance;
                let whole = spot(0.9, 0.5).point_for(from, [0.5; 2]).radiance;
                for k in 0..3 {
                    let off = f64::from(found[k] / free.intensity[k]) - left;
                    assert!(off.abs() < 2e-6, "{range} {d}: off by {off}");
                    let off = f64::from(in_cone[k]) - left * f64::from(whole[k]);
                    assert!(
                        off.abs() < 1e-5 * f64::from(SHINE[k]),
                        "{range} {d}: off by {off}"
                    );
                }
            }
        }
    }
    for range in [-1.0, f32::NAN, f32::INFINITY, exact::pow2(-21), exact::pow2(41)] {
        let wrong = PointLight { range, ..free }.checked();
        assert!(format!("{}", wrong.expect_err("no range")).starts_with("the range of a light is"));
    }
    let zero = PointLight { range: -0.0, ..free }.checked().expect("none");
    assert_eq!(zero.range.to_bits(), 0);
}

/// Near the edge of a cone a spot of the least intensity sent subnormal light, which devices flush and the CPU does not.
#[test]
fn no_spot_sends_subnormal_light() {
    let mut least_seen = f32::MAX;
    for (intensity, range) in [MIN_RADIANCE, 3.0 * MIN_RADIANCE, 1.0]
        .into_iter()
        .flat_map(|i| [(i, 0.0), (i, 4.0)])
    {
        let spot = SpotLight {
            p: [0.0; 3],
            axis: [0.0, 0.0, -1.0],
            intensity: [intensity, 0.0, 2.0 * intensity],
            range,
            ..spot(0.9, 0.5)
        };
        for k in 0..4000 {
            // cos 60 degrees is the edge; distances up to the range and beyond.
            let inside = k as f32 / 4000.0;
            let cos = 0.5 + 0.4 * (inside * inside) * (inside * inside);
            let d = 1.0 + 3.0 * (k % 7) as f32 / 6.0;
            let from = Vec3::new(d * exact::sqrt(1.0 - cos * cos), 0.0, -d * cos);
            for channel in spot.point_for(from, [0.5; 2]).radiance {
                assert!(channel == 0.0 || channel >= MIN_RADIANCE, "{channel:e} at {cos}");
                if channel > 0.0 {
                    least_seen = exact::min(least_seen, channel);
                }
            }
        }
    }
    assert!(least_seen < 2.0 * MIN_RADIANCE, "{least_seen:e}");
}
