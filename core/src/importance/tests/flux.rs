//! Φ and Φ/(d² + σ²) on each kind of layout.

use glam::Vec3;

use super::{Random, dot, minus, wide};
use crate::importance::{Flux, FluxOverDistance, ImportanceModel};
use crate::node::{CompactNode, LightNode, MomentNode};
use crate::point::ShadingPoint;
use crate::{LightBounds, LightMoments, Summary};

/// Two reciprocals, each within 3·10^-3.
const ROUGH: f64 = 6.1e-3;

/// A point about which the sets lie, from well inside them to far off.
fn point(random: &mut Random, size: f32) -> ShadingPoint {
    let distance = size * random.power(-4, 4);
    ShadingPoint {
        p: (random.direction() * distance).to_array(),
        n: random.direction().to_array(),
    }
}

#[track_caller]
fn alike<const W: usize>(found: [f32; W], expected: [f64; W], name: &str) {
    for slot in 1..W {
        let ratio = f64::from(found[slot]) / f64::from(found[0]) / (expected[slot] / expected[0]);
        assert!((ratio - 1.0).abs() < ROUGH, "{name}: child {slot} off by {ratio}");
    }
}

/// `spread` is the variance of positions as the summary's own words have it.
fn check<N: LightNode<4>>(
    random: &mut Random,
    sets: &[N::Summary; 4],
    size: f32,
    of: impl Fn(&N::Summary) -> (f32, Vec3, f64),
) {
    let node: N = crate::kit::node(sets);
    let point = point(random, size);
    let expected = [0, 1, 2, 3].map(|slot| {
        let (phi, center, spread) = of(&node.summary(slot));
        let away = minus(wide(center), wide(point.position()));
        f64::from(phi) / (dot(away, away) + spread)
    });
    alike(FluxOverDistance::weights(&node, &point), expected, N::NAME);
    // Flux alone, whatever the point.
    let expected = [0, 1, 2, 3].map(|slot| f64::from(node.summary(slot).phi()));
    let found = Flux::weights(&node, &point);
    for slot in 0..4 {
        let ratio = f64::from(found[slot]) / f64::from(found[0]);
        assert!(
            (ratio / (expected[slot] / expected[0]) - 1.0).abs() < 1e-6,
            "{}",
            N::NAME
        );
    }
}

#[test]
fn flux_and_distance_of_bounds() {
    let random = &mut Random(1);
    for _ in 0..4000 {
        let size = random.power(-20, 20);
        let sets = [0; 4].map(|_| {
            let (center, extent) = (random.vector() * size, random.extents(size));
            LightBounds {
                min: center - extent,
                max: center + extent,
                axis: random.direction(),
                cos_theta_o: 0.5,
                phi: random.power(-5, 5),
            }
        });
        // Of points spread evenly over a box of sides s the variance is |s|²/12.
        let of = |b: &LightBounds| {
            let sides = minus(wide(b.max), wide(b.min));
            (b.phi, (b.min + b.max) * 0.5, dot(sides, sides) / 12.0)
        };
        check::<CompactNode<4>>(random, &sets, size, of);
    }
}

#[test]
fn flux_and_distance_of_moments() {
    let random = &mut Random(2);
    for _ in 0..4000 {
        let size = random.power(-20, 20);
        let sets = [0; 4].map(|_| LightMoments {
            phi: random.power(-5, 5),
            c: random.vector() * size,
            across: random.unit() * size,
            along: random.unit() * size,
            m: random.vector() * 0.57,
            h: random.extents(size),
        });
        // Two axes across the normal, one along it.
        let of = |s: &LightMoments| {
            let (across, along) = (f64::from(s.across), f64::from(s.along));
            (s.phi, s.c, 2.0 * across.powi(2) + along.powi(2))
        };
        check::<MomentNode<4>>(random, &sets, size, of);
    }
}
