//! What the paper's importance knows of points and spots.

use super::*;

/// The flux that bounds and moments tell, and where bounds say that light goes.
#[test]
fn bounds_of_points_and_spots_are_closed_forms() {
    let intensity = [3.0, 0.5, 7.0];
    let shine = 0.2126 * 3.0 + 0.7152 * 0.5 + 0.0722 * 7.0;
    let point = PointLight {
        p: [1.0, -2.0, 4.0],
        intensity,
        range: 0.0,
        mesh: 0,
    };
    let bounds = point.bounds();
    let near = |found: f32, expected: f64| (f64::from(found) / expected - 1.0).abs() < 1e-5;
    assert!(near(bounds.phi, 4.0 * PI * shine), "{}", bounds.phi);
    assert_eq!(point.moments().phi, bounds.phi);
    assert_eq!(bounds.cos_theta_o, -1.0);
    for (inner, outer) in [(0.95, 0.9), (1.0, 0.5), (0.2, 0.0), (0.0, -0.5), (-0.9, -1.0)] {
        let spot = SpotLight {
            p: point.p,
            intensity,
            axis: [0.0, 0.6, 0.8],
            cos_inner: inner,
            cos_outer: outer,
            ..spot(0.9, 0.5)
        }
        .checked()
        .expect("a spot");
        // The square of a ramp in the cosine, over all directions, by many slices.
        let (wide, narrow) = (f64::from(outer), f64::from(inner));
        let slices = 200_000;
        let sum: f64 = (0..slices)
            .map(|k| -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(slices))
            .map(|cos| ((cos - wide) / (narrow - wide)).clamp(0.0, 1.0).powi(2))
            .sum();
        let flux = 2.0 * PI * sum * 2.0 / f64::from(slices);
        let expected = flux.max((flux * PI).sqrt()) * shine;
        let bounds = spot.bounds();
        assert!(
            (f64::from(bounds.phi) / expected - 1.0).abs() < 2e-4,
            "{inner} {outer}: {}, expected {expected}",
            bounds.phi
        );
        assert_eq!(spot.moments().phi, bounds.phi);
        // Half the sphere about a normal along the axis holds all of it, or it may go anywhere.
        let expected = if outer >= 0.0 { 1.0 } else { -1.0 };
        assert_eq!(bounds.cos_theta_o, expected, "{outer}");
        assert_eq!(bounds.cos_theta_e, 0.0);
    }
}

/// Straight behind its axis a profile of all directions sent nothing, where the direction was a little longer than 1.
#[test]
fn profiles_of_all_directions_have_no_hole_behind_them() {
    let random = &mut Random(3);
    for _ in 0..20_000 {
        let axis = normalize(wide(random.vector()));
        let profile = ProfileLight {
            p: [0.0; 3],
            intensity: [1.0; 3],
            axis: axis.map(|x| x as f32),
            cos_outer: -1.0,
            ..ProfileLight::DARK
        };
        let far = 0.1 + 50.0 * f64::from(random.unit());
        let from = narrow(times(axis, -far));
        assert_eq!(
            profile.point_for(from, [0.5; 2]).radiance,
            [1.0; 3],
            "{axis:?} {far}"
        );
    }
}
