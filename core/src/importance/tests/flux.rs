//! Φ and Φ/(d² + σ²) on each kind of layout.

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
fn alike<const W: usize>(found: [f32; W], expected: [f64; W], most: f64, name: &str) {
    for slot in 1..W {
        let ratio = f64::from(found[slot]) / f64::from(found[0]) / (expected[slot] / expected[0]);
        assert!((ratio - 1.0).abs() < most, "{name}: child {slot} off by {ratio}");
    }
}

/// `spread` is the variance of positions by the words of a summary.
fn check<N: LightNode<4>>(set: impl Fn(&mut Random, f32) -> N::Summary, spread: impl Fn(&N::Summary) -> f64) {
    let random = &mut Random(1);
    for _ in 0..4000 {
        let size = random.power(-20, 20);
        let node: N = crate::kit::node(&[0; 4].map(|_| set(random, size)));
        let point = point(random, size);
        let sets = [0, 1, 2, 3].map(|slot| node.summary(slot));
        let phi = sets.map(|set| f64::from(set.phi()));
        let expected = [0, 1, 2, 3].map(|slot| {
            let away = minus(wide(sets[slot].center()), wide(point.position()));
            phi[slot] / (dot(away, away) + spread(&sets[slot]))
        });
        alike(FluxOverDistance::weights(&node, &point), expected, ROUGH, N::NAME);
        alike(Flux::weights(&node, &point), phi, 1e-6, N::NAME);
    }
}

/// Of points spread evenly over a box of sides s the variance is |s|²/12.
#[test]
fn flux_and_distance_of_bounds() {
    let set = |random: &mut Random, size: f32| {
        let (center, extent) = (random.vector() * size, random.extents(size));
        LightBounds {
            min: center - extent,
            max: center + extent,
            axis: random.direction(),
            cos_theta_o: 0.5,
            phi: random.power(-5, 5),
        }
    };
    check::<CompactNode<4>>(set, |b| {
        let sides = minus(wide(b.max), wide(b.min));
        dot(sides, sides) / 12.0
    });
}

/// Two axes across the normal, one along it.
#[test]
fn flux_and_distance_of_moments() {
    let set = |random: &mut Random, size: f32| LightMoments {
        phi: random.power(-5, 5),
        c: random.vector() * size,
        across: random.unit() * size,
        along: random.unit() * size,
        m: random.vector() * 0.57,
        h: random.extents(size),
    };
    check::<MomentNode<4>>(set, |s| {
        2.0 * f64::from(s.across).powi(2) + f64::from(s.along).powi(2)
    });
}
