//! Light bounds against f64: of triangles, of merges, of cones. What they must contain they contain.

use glam::Vec3;
use lightbvh::device::bounds::{MAX_PHI, MIN_PHI};
use lightbvh::device::cone::Cone;
use lightbvh::{EmissiveTriangle, LightBounds};
use lightbvh_tests::generate::{Random, any_bounds, extreme_triangle};
use lightbvh_tests::oracle::{Triangle, assert_cone_contains, box_contains, half_angle};
use rayon::prelude::*;
use std::f64::consts::PI;

const ULP: f64 = 1.0 / 16_777_216.0;

fn of_triangle_contains_it(light: &EmissiveTriangle) {
    let bounds = LightBounds::of_triangle(light);
    for v in light.p {
        let v = Vec3::from(v);
        assert!(
            bounds.min.cmple(v).all() && v.cmple(bounds.max).all(),
            "{bounds:?} {light:?}"
        );
    }
    let luminance = (0..3)
        .map(|c| [0.2126, 0.7152, 0.0722][c] * f64::from(light.radiance[c]))
        .sum::<f64>();
    let triangle = Triangle::new(light);
    let longest = (0..3)
        .map(|k| (triangle.p[k] - triangle.p[(k + 1) % 3]).length())
        .fold(0.0, f64::max);
    if luminance == 0.0 || longest == 0.0 {
        assert_eq!(bounds.phi, 0.0, "{light:?}");
        return;
    }
    // Edges are off by 2^-24 each, the products and their difference by as much again: together less than 8 units of
    // 2^-24 of |e1| |e2|, which the condition relates to the normal. Normalisation and flux add fewer than 8 each.
    let error = 8.0 * ULP * triangle.condition;
    // Below 2^-100 of the longest edge squared an area counts as none, from 2^-96 on certainly not.
    if triangle.normal.length() > 2f64.powi(-96) * longest * longest && error < 0.25 {
        let off = lightbvh_tests::oracle::angle(bounds.axis.as_dvec3(), triangle.normal);
        assert!(
            off <= error + 8.0 * ULP,
            "axis off by {off}, at most {error}: {light:?}"
        );
        assert!((bounds.axis.as_dvec3().length() - 1.0).abs() < 4.0 * ULP);
        let faces = if light.is_two_sided() { 2.0 } else { 1.0 };
        let phi = (PI * triangle.area() * luminance * faces).clamp(f64::from(MIN_PHI), f64::from(MAX_PHI));
        let relative = (f64::from(bounds.phi) / phi - 1.0).abs();
        assert!(
            relative <= error + 16.0 * ULP,
            "flux {} of {phi}: {light:?}",
            bounds.phi
        );
        // The cone is opened by the error, except below what a cosine near 1 resolves.
        let open = half_angle(bounds.cos_theta_o);
        assert!(
            off <= open + 2f64.powi(-11),
            "axis off by {off}, cone {open}: {light:?}"
        );
        assert!(open <= 2.0 * error + 2f64.powi(-11) || open == PI && (error > 0.12 || light.is_two_sided()));
        assert!(!light.is_two_sided() || open == PI);
    }
}

fn merge_contains_its_parts(a: &LightBounds, b: &LightBounds) {
    let both = a.merge(b);
    for part in [a, b] {
        if part.phi > 0.0 {
            assert!(box_contains(&both, part), "{part:?} {both:?}");
            assert_cone_contains(both.cone(), part.cone(), "merge");
        }
    }
    let sum = f64::from(a.phi) + f64::from(b.phi);
    assert!((f64::from(both.phi) - sum).abs() <= ULP * sum);
}

#[test]
fn triangles_and_merges() {
    (0..256).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed);
        for _ in 0..256 {
            of_triangle_contains_it(&extreme_triangle(random));
            merge_contains_its_parts(&any_bounds(random), &any_bounds(random));
        }
    });
}

/// Every pair of cones of a grid of half-angles, at every angle of it apart, exactly parallel and opposite axes in it.
#[test]
fn unions_over_a_grid() {
    let mut angles: Vec<f64> = (0..=24).map(|i| PI * f64::from(i) / 24.0).collect();
    for tiny in [
        2f64.powi(-21),
        2f64.powi(-13),
        2f64.powi(-12),
        2f64.powi(-11),
        1e-3,
        0.01,
    ] {
        angles.extend([tiny, PI - tiny]);
    }
    let mut random = Random::new(1);
    let mut frames = vec![(Vec3::X, Vec3::Y), (Vec3::Z, Vec3::NEG_X)];
    for _ in 0..3 {
        let a = Vec3::from(random.direction());
        frames.push((a, a.any_orthonormal_vector()));
    }
    for (x, y) in frames {
        for &apart in &angles {
            let other = x.as_dvec3() * apart.cos() + y.as_dvec3() * apart.sin();
            let other = if apart == PI {
                -x
            } else {
                lightbvh::device::cone::normalized(other.as_vec3())
            };
            for &theta_a in &angles {
                for &theta_b in &angles {
                    let a = Cone {
                        axis: x,
                        cos_theta_o: theta_a.cos() as f32,
                    };
                    let b = Cone {
                        axis: other,
                        cos_theta_o: theta_b.cos() as f32,
                    };
                    let union = a.union(b);
                    assert_cone_contains(union, a, "union, first");
                    assert_cone_contains(union, b, "union, second");
                    // Smallest, but for the widening, rounding near 0 and π, and opposite axes, which give everything.
                    let (low, high) = (theta_a.max(theta_b), PI.min(0.5 * (theta_a + theta_b + apart)));
                    let found = half_angle(union.cos_theta_o);
                    let wide = low.max(high) + 3e-3;
                    let everything = apart > PI - 1e-5 || wide > PI - 3e-3;
                    assert!(
                        found <= wide || everything,
                        "{a:?} {b:?} {apart}: {found}, expected {wide}"
                    );
                }
            }
        }
    }
}
