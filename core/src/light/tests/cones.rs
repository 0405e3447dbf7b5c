//! Points and spots: intensity by direction, flux, mean direction.

use super::*;

#[test]
fn points_send_their_intensity() {
    let point = PointLight {
        p: [1.0, 2.0, -1.0],
        intensity: SHINE,
        range: 0.0,
        mesh: 0,
    };
    let bounds = point.bounds();
    assert_eq!((bounds.phi, bounds.cos_theta_o), (point.moments().phi, -1.0));
    close("flux", f64::from(bounds.phi), 4.0 * PI * luminance(), 1e-5);
    for receiver in receivers() {
        let d = minus([1.0, 2.0, -1.0], receiver.p.map(f64::from));
        let (squared, n) = (dot(d, d), receiver.n.map(f64::from));
        let w = times(d, 1.0 / squared.sqrt());
        let incident = if dot(n, n) == 0.0 { 1.0 } else { dot(n, w).max(0.0) };
        let plain = luminance() * incident / squared;
        close("point", estimated(&point, &receiver), plain, 1e-4);
    }
}

/// Cones have their intensity on the axis and the falloff of their own cosines about it, down to the narrowest.
#[test]
fn spots_send_what_their_cone_says() {
    let random = &mut Random(1);
    for degrees in [0.1_f64, 0.2, 0.5, 1.0, 5.0, 40.0, 90.0, 170.0] {
        for sharp in [0.0, 0.8, 1.0] {
            let (outer, inner) = (degrees.to_radians(), (degrees * sharp).to_radians());
            for _ in 0..200 {
                let axis = normalize(wide(random.vector()));
                let own = SpotLight {
                    p: [0.0; 3],
                    intensity: [1.0; 3],
                    axis: narrow(axis).to_array(),
                    cos_inner: inner.cos() as f32,
                    cos_outer: exact::min(outer.cos() as f32, 1.0 - exact::pow2(-20)),
                    ..SpotLight::DARK
                };
                let light = Transform::IDENTITY.place(&own.checked().expect("a sound spot"), 0);
                let (a, b) = (f64::from(light.cos_inner), f64::from(light.cos_outer));
                let fall = (a - b).max(2.0_f64.powi(-20));
                for off in [0.0, 0.3, 0.7, 0.95, 1.3] {
                    // A direction so far off the axis, in units of the cone.
                    let across = normalize([axis[1] - axis[2], axis[2] - axis[0], axis[0] - axis[1]]);
                    let (sin, cos) = (outer * off).sin_cos();
                    let to = narrow([0, 1, 2].map(|k| (axis[k] * cos + across[k] * sin) * 3.0));
                    let apart = minus(normalize(light.axis.map(f64::from)), normalize(wide(to)));
                    let linear = ((1.0 - b) - 0.5 * dot(apart, apart)) / fall;
                    let found = f64::from(light.point_for(to, [0.5; 2]).radiance[0]);
                    assert!(
                        (found - linear.clamp(0.0, 1.0).powi(2)).abs() < 2e-3,
                        "{degrees} degrees, {sharp}, at {off}: {found}, {linear}"
                    );
                }
            }
        }
    }
}

/// An axis that is not quite of length 1 becomes so.
#[test]
fn axes_are_brought_to_length_one() {
    for length in [0.9963_f32, 1.0037] {
        let own = SpotLight {
            axis: [0.0, length, 0.0],
            ..spot(0.9999, 0.9998)
        };
        let own = own.checked().expect("within the tolerance");
        assert_eq!(own.axis, [0.0, 1.0, 0.0]);
        assert_eq!(own.checked().expect("sound"), own);
    }
}

/// Flux and mean direction of spots over the sphere.
#[test]
fn spots_have_the_flux_and_the_mean_direction_of_their_falloff() {
    for [inner, outer] in [
        [0.9, 0.5],
        [1.0, -0.5],
        [0.2, 0.2],
        [-0.9, -1.0],
        [1.0, 0.999],
        [0.999_99, 0.999_98],
        [1.0, -1.0],
    ] {
        let own = spot(inner, outer);
        let (a, b) = (f64::from(inner), f64::from(outer));
        let (mut whole, mut first) = (0.0, 0.0);
        // From the outer cosine on, in even steps of it.
        let n = 200_000;
        for k in 0..n {
            let c = b + (1.0 - b) * (f64::from(k) + 0.5) / f64::from(n);
            let falloff = ((c - b) / (a - b).max(2.0_f64.powi(-20))).clamp(0.0, 1.0).powi(2);
            whole += falloff * (1.0 - b) / f64::from(n);
            first += falloff * c * (1.0 - b) / f64::from(n);
        }
        let found = own.moments();
        let what = format!("spot {inner} {outer}");
        // Narrow ones count as their root mean square.
        let flux = 2.0 * PI * whole;
        close(
            &what,
            f64::from(found.phi),
            luminance() * flux.max((flux * PI).sqrt()),
            1e-3,
        );
        let bounds = own.bounds();
        assert_eq!(found.phi, bounds.phi);
        // Half the sphere about a normal along the axis holds all of it, or it may go anywhere.
        assert_eq!(bounds.cos_theta_o, if outer >= 0.0 { 1.0 } else { -1.0 });
        let length = f64::from(length_squared(found.m)).sqrt();
        close(&what, length, (1.5 * first / whole).clamp(0.0, 1.0), 1e-3);
    }
}

/// Angles of the domain give cones of the domain; others, such as degrees, and those in the wrong order give none.
#[test]
fn cones_are_made_of_angles() {
    let made = spot(0.9, 0.5).with_cone(0.3, 1.1);
    close("inner", f64::from(made.cos_inner), 0.3_f64.cos(), 1e-6);
    close("outer", f64::from(made.cos_outer), 1.1_f64.cos(), 1e-6);
    let pi = core::f32::consts::PI;
    let angles = [0.0, 1.0e-9, 0.01, 0.5, 0.7, 1.6, 3.0, pi];
    for (i, &inner) in angles.iter().enumerate() {
        for (k, &outer) in angles.iter().enumerate() {
            let checked = spot(0.9, 0.5).with_cone(inner, outer).checked();
            // The narrowest cone is wider than the two least angles.
            assert_eq!(checked.is_ok(), i <= k.max(1), "{inner} {outer}: {checked:?}");
        }
    }
    for wrong in [-1.0, 3.2, 4.0, 30.0, f32::INFINITY, f32::NAN] {
        for (inner, outer, part) in [
            (0.0, wrong, "outer"),
            (wrong, 1.0, "inner"),
            (wrong, wrong, "outer"),
        ] {
            let refused = spot(0.9, 0.5).with_cone(inner, outer).checked();
            let message = std::format!("{}", refused.expect_err("no angle"));
            assert!(message.contains(part) && message.contains("radians"), "{message}");
        }
    }
}

/// Axes that almost lie along each other have a normal that rounding turns.
#[test]
fn cones_of_flat_lights_hold_their_normals() {
    let mut random = Random(3);
    for k in 0..1000 {
        let a = random.vector();
        let half = [a, a * random.signed() + random.vector() * exact::pow2(-(k % 13))].map(|v| v.to_array());
        let bounds = RectangleLight { half, ..rectangle(0) }.bounds();
        let normal = normalize(cross(half[0].map(f64::from), half[1].map(f64::from)));
        let cosine = dot(normalize(wide(bounds.axis)), normal);
        assert!(cosine >= f64::from(bounds.cos_theta_o), "{half:?}: {cosine}");
    }
}
