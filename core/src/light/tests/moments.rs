//! Moments of even points, and where instances put them.

use super::*;

/// Mean and variance of even points, from all sides; all of them in the box.
fn check_moments<L: Light>(name: &str, light: &L, pieces: &[(Wide, Wide, f64)], flux: f64) {
    let found = light.moments();
    close(name, f64::from(found.phi), flux, 1e-5);
    assert_eq!(found.phi, light.bounds().phi, "{name}");
    let size: f64 = pieces.iter().map(|piece| piece.2).sum();
    let mean = |k: usize| pieces.iter().map(|(at, _, own)| at[k] * own).sum::<f64>() / size;
    let center = [0, 1, 2].map(mean);
    let off = minus(center, wide(found.c));
    assert!(dot(off, off).sqrt() < 1e-4, "{name}: {center:?}, {found:?}");
    let variance: f64 = pieces
        .iter()
        .map(|(at, _, own)| {
            let d = minus(*at, center);
            dot(d, d) * own
        })
        .sum::<f64>()
        / size;
    // Flat lights of two sides have no direction along which they have none: all three axes count alike, as of triangles.
    let across = f64::from(found.across);
    let axes = if pieces[0].1 == pieces[1].1 && dot(pieces[0].1, pieces[0].1) > 0.0 {
        2.0
    } else {
        3.0
    };
    close(name, axes * across * across, variance, 4e-3);
    let is_directed = length_squared(found.m) > 0.0;
    assert_eq!(
        found.along,
        if is_directed { 0.0 } else { found.across },
        "{name}"
    );
    // The front is where the half axes turn left.
    assert!(
        !is_directed || dot(wide(found.m), pieces[0].1) > 1.0 - 1e-4,
        "{name}"
    );
    assert_eq!(light.bounds().cos_theta_o > 0.99, is_directed, "{name}");
    let mut most = [0.0_f64; 3];
    for (at, ..) in pieces {
        for k in 0..3 {
            most[k] = most[k].max((at[k] - center[k]).abs());
        }
    }
    for k in 0..3 {
        let h = f64::from([found.h.x, found.h.y, found.h.z][k]);
        assert!(
            h >= most[k] * (1.0 - 1e-6) && h <= most[k] * 1.06 + 1e-6,
            "{name}: {h}, {}",
            most[k]
        );
    }
    let bounds = light.bounds();
    for (at, ..) in pieces {
        for k in 0..3 {
            let [lo, hi] = [bounds.min, bounds.max].map(|v| f64::from([v.x, v.y, v.z][k]));
            assert!(lo - 1e-6 <= at[k] && at[k] <= hi + 1e-6, "{name}");
        }
    }
}

fn area(pieces: &[(Wide, Wide, f64)]) -> f64 {
    pieces.iter().map(|piece| piece.2).sum()
}

#[test]
fn moments_are_those_of_even_points() {
    for flags in [0, TWO_SIDED] {
        let sides = if flags == 0 { 1.0 } else { 2.0 };
        let own = rectangle(flags);
        let pieces = flat_pieces(own.p, own.half, false);
        check_moments(
            "rectangle",
            &own,
            &pieces,
            sides * PI * luminance() * area(&pieces),
        );
        let own = disc(flags);
        let pieces = flat_pieces(own.p, own.half, true);
        let expected = sides * PI * luminance() * PI;
        check_moments("disc", &own, &pieces, expected);
    }
    let own = sphere();
    let pieces = sphere_pieces(&own);
    check_moments("sphere", &own, &pieces, PI * luminance() * area(&pieces));
}

/// An instance keeps area lights where an affine map puts each of their points; a mirrored one keeps its front.
#[test]
fn instances_put_lights_where_the_map_puts_their_points() {
    let turned = Transform {
        columns: [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
        translation: [5.0, -3.0, 1.0],
    };
    let skewed = Transform {
        columns: [[1.0, 0.5, 0.0], [0.0, 2.0, 0.25], [0.5, 0.0, 1.5]],
        translation: [1.0, 1.0, 0.0],
    };
    let mirrored = Transform {
        columns: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };
    let near = |a: [f32; 3], b: [f32; 3]| {
        a.into_iter()
            .zip(b)
            .all(|(a, b)| exact::abs(a - b) < 2e-6 * (1.0 + exact::abs(a)))
    };
    for (name, map) in [("turned", turned), ("skewed", skewed), ("mirrored", mirrored)] {
        let instance = map.instance(0.5);
        let place = |p: [f32; 3]| instance.vertex(p);
        let flat = rectangle(0);
        let world = flat.in_world(&instance, 9);
        assert_eq!((world.mesh, world.radiance), (9, [1.0, 1.5, 2.5]), "{name}");
        let corner = |l: &RectangleLight, k: usize, s: f32| [0, 1, 2].map(|i| l.p[i] + s * l.half[k][i]);
        let swapped = usize::from(name == "mirrored");
        for k in 0..2 {
            let (own, there) = (place(corner(&flat, k, 1.0)), corner(&world, k ^ swapped, 1.0));
            assert!(near(own, there), "{name}: {own:?} {there:?}");
        }
    }
    // Lengths twice as great: the sphere has four times the area, a spot turns, a point has its intensity as before.
    let instance = turned.instance(0.5);
    let ball = sphere().in_world(&instance, 9);
    assert!(
        exact::abs(ball.radius - 1.5) < 1e-6 && near(ball.p, instance.vertex(sphere().p)),
        "{ball:?}"
    );
    let lamp = spot(0.9, 0.5).in_world(&instance, 9);
    assert!(near(lamp.axis, [0.8, 0.36, 0.48]), "{lamp:?}");
    assert_eq!(
        (lamp.intensity, lamp.cos_inner, lamp.cos_outer),
        ([1.0, 1.5, 2.5], 0.9, 0.5)
    );
}
