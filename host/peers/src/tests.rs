//! Both importances against their sources' formulas, with the departures that they state.

#[path = "../../../core/src/kit/numbers.rs"]
#[allow(dead_code, reason = "shared with the tests of core")]
mod numbers;
mod published;

use glam::Vec3;
use lightbvh::ShadingPoint;
use lightbvh::importance::ImportanceModel;
use lightbvh::node::{BoundsNode, CompactNode, LightBounds};
use numbers::{Random, Wide, dot, minus, wide};
use published::Seen;

use crate::{Falcor, Pbrt};

/// A light straight above the point, or anywhere about a point in a volume, that shines everywhere: its cosines are 1.
fn known(point: &ShadingPoint, distance: f32) -> LightBounds {
    let n = point.normal();
    let up = if n == Vec3::ZERO { Vec3::Z } else { n };
    let at = point.position() + up * distance;
    LightBounds {
        min: at,
        max: at,
        axis: -up,
        cos_theta_o: -1.0,
        phi: 1.0,
    }
}

/// A set of lights, and a point near it or far off, on a surface or in a volume.
fn sight(random: &mut Random) -> (LightBounds, ShadingPoint) {
    let size = random.power(-20, 20);
    let distance = size * random.power(-3, 6);
    let (center, extent) = (random.vector() * size, (random.vector() + 1.0) * (0.5 * size));
    let theta_o = [0.0, 2.5, 2.5, core::f64::consts::PI][random.below(4) as usize] * f64::from(random.unit());
    let n = match random.below(4) {
        0 => Vec3::ZERO,
        _ => random.direction(),
    };
    let bounds = LightBounds {
        min: center - extent,
        max: center + extent,
        axis: random.direction(),
        cos_theta_o: theta_o.cos() as f32,
        phi: random.power(-10, 10),
    };
    let point = ShadingPoint {
        p: (center + random.direction() * distance).to_array(),
        n: n.to_array(),
    };
    (bounds, point)
}

/// The least product of cosines.
const FLOOR: f64 = 1.0 / 1024.0;
/// Absolute error of a bounded cosine: rough roots and a rough reciprocal, each some 7·10^-4, in a sum of four products; and what
/// a compact layout decodes as the sine of θ_o, another 0.002 off.
const COSINE: f64 = 8e-3;
/// Relative error of two weights' quotient: a rough reciprocal in each.
const ROUGH: f64 = 2.0 * 3e-3;

/// Whether rounding decides: on the sphere around the box, and where a cone is just as wide as it must be for one of the steps.
fn at_a_step(seen: &Seen) -> bool {
    (seen.d() / seen.r() - 1.0).abs() < 1e-3 || (seen.theta_o.cos()).abs() < 1e-5
}

/// Weight of the first child over that of a light straight above the point that shines everywhere, whose cosines are 1.
fn weight<N: BoundsNode<2>, I: ImportanceModel<N, 2>>(node: &N, point: &ShadingPoint) -> f64 {
    let [found, one] = I::weights(node, point).map(f64::from);
    found / one
}

/// Weights over `count` sights, against Φ · cosines / `squared`.
fn check<N: BoundsNode<2>, I: ImportanceModel<N, 2>>(
    seed: u32,
    cosines: fn(&Seen) -> [f64; 2],
    squared: fn(&Seen) -> f64,
) {
    let random = &mut Random(seed);
    let (mut between, mut floored, mut near) = (0, 0, 0);
    for _ in 0..40_000 {
        let (bounds, point) = sight(random);
        // pbrt's clamp has a unit: the light that is known is as far as the other.
        let distance = minus(wide((bounds.min + bounds.max) * 0.5), wide(point.position()));
        let distance = dot(distance, distance).sqrt() as f32;
        let mut node = N::EMPTY;
        node.set_summaries(&[bounds, known(&point, distance)]);
        let [seen, above] = [0, 1].map(|slot| Seen::of(&node.cluster(slot), &point));
        if at_a_step(&seen) {
            continue;
        }
        let [emitted, incident] = cosines(&seen);
        let scale = f64::from(node.cluster(0).phi) / squared(&seen) * squared(&above);
        let [least, most] = [-COSINE, COSINE].map(|e| {
            let both = (emitted + e).clamp(0.0, 1.0) * (incident + e).clamp(0.0, 1.0);
            both.max(FLOOR) * scale
        });
        let found = weight::<N, I>(&node, &point);
        assert!(
            (least * (1.0 - ROUGH)..=most * (1.0 + ROUGH)).contains(&found),
            "{} {found}, expected {least} to {most}: {bounds:?} at {point:?}",
            N::NAME
        );
        between += u32::from((0.05..0.95).contains(&(emitted * incident)));
        floored += u32::from(emitted * incident < 0.5 * FLOOR);
        near += u32::from(squared(&seen) > seen.d().powi(2) * (1.0 + 1e-6));
    }
    assert!(
        between > 500 && floored > 500 && near > 500,
        "{between} {floored} {near}"
    );
}

#[test]
fn weights_of_pbrt_are_its_formula() {
    check::<CompactNode<2>, Pbrt>(2, Seen::pbrt, Seen::pbrt_squared);
}

#[test]
fn weights_of_falcor_are_its_formula() {
    check::<CompactNode<2>, Falcor>(4, Seen::falcor, Seen::falcor_squared);
}
