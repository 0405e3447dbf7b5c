//! Irradiance of lights with a size against integrals over them, and the points that are drawn on them.

use super::*;

fn check_irradiance<L: Light>(name: &str, light: &L, pieces: &[(Wide, Wide, f64)], is_two_sided: bool) {
    let mut lit = 0;
    for receiver in receivers() {
        let expected = integrated(pieces, is_two_sided, &receiver);
        let found = estimated(light, &receiver);
        let least = luminance() * 1e-6;
        assert!(
            (found - expected).abs() <= 0.01 * expected + least,
            "{name} at {receiver:?}: {found:e}, expected {expected:e}"
        );
        lit += u32::from(expected > least);
    }
    assert!(lit >= 4, "{name}: {lit} receivers are lit");
}

#[test]
fn flat_lights_send_what_integrals_over_them_give() {
    for flags in [0, TWO_SIDED] {
        let (own, round) = (rectangle(flags), disc(flags));
        let both = flags == TWO_SIDED;
        check_irradiance("rectangle", &own, &flat_pieces(own.p, own.half, false), both);
        check_irradiance("disc", &round, &flat_pieces(round.p, round.half, true), both);
    }
}

#[test]
fn spheres_send_what_integrals_over_them_give() {
    check_irradiance("sphere", &sphere(), &sphere_pieces(&sphere()), false);
    // From within none is seen.
    let inside = ShadingPoint {
        p: [1.0, 2.25, -1.0],
        n: [0.0; 3],
    };
    assert_eq!(estimated(&sphere(), &inside), 0.0);
}

/// The cap that is seen from distance d has the area 2 π R² (1 - R / d), all of which is as likely.
#[test]
fn points_of_spheres_have_the_density_of_their_cap() {
    let radius = f64::from(sphere().radius);
    for away in [0.8, 1.0, 3.0, 100.0, 1e6] {
        let from = Vec3::new(1.0, 2.0 + away, -1.0);
        // As far as it is in the sphere's own numbers.
        let distance = f64::from(from.y) - 2.0;
        let expected = 1.0 / (core::f64::consts::TAU * radius * radius * (1.0 - radius / distance));
        for uv in [[0.0, 0.0], [0.5, 0.3], [0.99, 0.9]] {
            let found = f64::from(sphere().point_for(from, uv).density);
            assert!(
                (found / expected - 1.0).abs() < 2e-6,
                "{away}: {found}, expected {expected}"
            );
        }
    }
}

/// A sphere's size does not ask how bright its instance is; of an uneven map it is the mean's.
#[test]
fn spheres_are_scaled_by_the_mean_area() {
    for [x, y, z] in [[3.0_f32, 3.0, 3.0], [1.0, 10.0, 10.0], [2.0, 3.0, 7.0]] {
        let transform = Transform {
            columns: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]],
            translation: [1.0, 2.0, 3.0],
        };
        let squares: f64 = [x * y, y * z, z * x]
            .map(|area| f64::from(area).powi(2))
            .iter()
            .sum();
        let expected = (squares / 3.0).sqrt().sqrt() * f64::from(sphere().radius);
        for radiance in [0.0, 1e-20, 1.0, 1e20] {
            let found = sphere().in_world(&transform.instance(radiance), 4).radius;
            close("radius", f64::from(found), expected, 1e-6);
        }
    }
}
