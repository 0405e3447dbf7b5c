//! Eq. 4 of the paper, by angles, with the departures that [`Eq4`] states, of clusters that are not rounded. What compact nodes make of
//! clusters is in `tests/tests/encoding.rs`.

mod formula;

use core::f64::consts::PI;

use glam::Vec3;

use formula::{FLOOR, HORIZON, Lights, SLACK};

use super::{Random, minus, narrow, normalize, times, wide};
use crate::importance::{Cluster, Eq4};
use crate::point::ShadingPoint;
use crate::vector::{cross, length_squared, max3};
use crate::{LightBounds, Summary, exact};

/// Relative error of a weight: of a rough reciprocal, and of a rough root in the receiver's cosine.
const ROUGH: f64 = 3e-3 + 7e-4;

/// The bounds as the importance reads them from a node that quantises nothing.
fn cluster(bounds: &LightBounds) -> Cluster {
    let center = bounds.center();
    // Halves that reach both corners from the rounded centre.
    let extent = max3(bounds.max - center, center - bounds.min) * (1.0 + exact::pow2(-20));
    let cosine = bounds.cos_theta_o;
    Cluster {
        center,
        extent,
        radius_squared: length_squared(extent),
        axis: bounds.axis,
        cos_theta_o: cosine,
        sin_theta_o: exact::sqrt(exact::max(1.0 - cosine * cosine, 0.0)),
        phi: bounds.phi,
    }
}

fn weight(bounds: &LightBounds, point: &ShadingPoint) -> f64 {
    let scaled = Eq4::scaled(&cluster(bounds), point);
    f64::from(scaled.significand) * 2.0_f64.powi(scaled.exponent)
}

/// A set of lights, and a point near it or far off, above the horizon, below it, or in a volume.
fn sight(random: &mut Random) -> (LightBounds, ShadingPoint) {
    let size = random.power(-20, 20);
    let distance = size * random.power(-3, 6);
    let center = random.vector() * size;
    let away = random.direction();
    let extent = random.extents(size);
    let theta_o = [0.0, 2.5, 2.5, PI as f32][random.below(4) as usize] * random.unit();
    let n = match random.below(4) {
        0 => Vec3::ZERO,
        1 => {
            // About as high above the horizon as the box.
            let across = normalize(wide(cross(away, random.direction())));
            let tilt = f64::from(random.unit() - 0.5) * f64::from(size / distance);
            narrow(normalize(minus(across, times(wide(away), tilt))))
        }
        _ => random.direction(),
    };
    let bounds = LightBounds {
        min: center - extent,
        max: center + extent,
        axis: random.direction(),
        cos_theta_o: f64::from(theta_o).cos() as f32,
        phi: random.power(-10, 10),
    };
    let point = ShadingPoint {
        p: (center + away * distance).to_array(),
        n: n.to_array(),
    };
    (bounds, point)
}

/// Absolute error of the emitters' cosine: rough roots and a rough reciprocal, each some 7·10^-4, in a sum of four products.
const EMITTED: f64 = 6e-3;

#[test]
fn weights_are_those_of_eq_4() {
    let random = &mut Random(1);
    let (mut cosines, mut below, mut behind) = (0, 0, 0);
    for _ in 0..40_000 {
        let (bounds, point) = sight(random);
        let (lights, n) = (Lights::of(&bounds, &point), wide(point.normal()));
        if lights.at_a_step(n, EMITTED) {
            continue;
        }
        let found = weight(&bounds, &point);
        let [least, most] = [-EMITTED, EMITTED].map(|e| lights.factor(n, e) * lights.over_distance());
        assert!(
            (least * (1.0 - ROUGH)..=most * (1.0 + ROUGH)).contains(&found),
            "{found}, expected {least} to {most}: {bounds:?} at {point:?}"
        );
        cosines += u32::from((0.05..0.95).contains(&lights.factor(n, 0.0)));
        below += u32::from(lights.incident(n) == 0.0);
        behind += u32::from(lights.emitted() < 0.0);
    }
    for seen in [cosines, below, behind] {
        assert!(seen > 500, "{cosines} {below} {behind}");
    }
}

/// Point lights of one direction have no angle to subtract, so that the error of the roots is relative: slack and floor, which
/// are smaller than that of a wide cone, show.
#[test]
fn slack_and_floor_are_those_stated() {
    let random = &mut Random(3);
    // Three roots more, in the emitters' cosine.
    let error = 3.0 * 7e-4 + ROUGH;
    for _ in 0..10_000 {
        let size = random.power(-20, 20);
        let distance = size * random.power(-3, 6);
        let mut cosine = |least: i32| {
            let small = random.power(least, 0) * if random.below(3) == 0 { -0.5 } else { 0.5 };
            f64::from(exact::clamp(small, -0.01, 1.0))
        };
        let received = cosine(-24);
        let emitted = cosine(if received < SLACK { -2 } else { -16 });
        // The light is in the direction z as seen from the point.
        let slanted = |cosine: f64| narrow([(1.0 - cosine * cosine).sqrt(), 0.0, cosine]);
        let at = Vec3::new(0.0, 0.0, distance);
        let bounds = LightBounds {
            min: at,
            max: at,
            axis: -slanted(emitted),
            cos_theta_o: 1.0,
            phi: random.power(-10, 10),
        };
        let point = ShadingPoint {
            p: [0.0; 3],
            n: slanted(received).to_array(),
        };
        let incident = if received < -HORIZON {
            0.0
        } else {
            received.max(SLACK)
        };
        if (received + HORIZON).abs() < 1e-7 || (emitted + SLACK).abs() < 1e-7 {
            continue;
        }
        let reach = (emitted + SLACK).max(0.0);
        let expected = (incident * reach).max(FLOOR) * f64::from(bounds.phi) / f64::from(distance).powi(2);
        let found = weight(&bounds, &point);
        assert!(
            (found / expected - 1.0).abs() < error,
            "{found}, expected {expected}: cosines {received} {emitted}"
        );
    }
}
