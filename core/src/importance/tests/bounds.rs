//! The importances of pbrt-v4, Falcor and Cycles against their sources' formulas, with the departures that they state.

mod published;

use core::f64::consts::PI;

use glam::Vec3;
use published::Seen;

use super::eq4::{known, sight};
use super::{Random, dot, minus, wide};
use crate::importance::sight::Sight;
use crate::importance::{Cycles, Falcor, ImportanceModel, Pbrt};
use crate::node::{BoundsNode, CompactNode, FullNode, Node};
use crate::point::ShadingPoint;
use crate::{LightBounds, exact};

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
    check::<FullNode<2>, Pbrt>(1, Seen::pbrt, Seen::pbrt_squared);
    check::<CompactNode<2>, Pbrt>(2, Seen::pbrt, Seen::pbrt_squared);
}

#[test]
fn weights_of_falcor_are_its_formula() {
    check::<FullNode<2>, Falcor>(3, Seen::falcor, Seen::falcor_squared);
    check::<CompactNode<2>, Falcor>(4, Seen::falcor, Seen::falcor_squared);
}

/// The cone around the box's corners, and both products of cosines, on each layout.
#[test]
fn cycles_bounds_are_its_formula() {
    fn check<N: BoundsNode<2>>(seed: u32) {
        let random = &mut Random(seed);
        let (mut some, mut both, mut within, mut wide) = (0, 0, 0, 0);
        for _ in 0..40_000 {
            let (bounds, point) = sight(random);
            let mut node = N::EMPTY;
            node.set_summaries(&[bounds; 2]);
            let cluster = node.cluster(0);
            let seen = Seen::of(&cluster, &point);
            let surface = (0..3).any(|k| (seen.v[k].abs() / seen.half[k] - 1.0).abs() < 1e-4);
            let theta_u = seen.cycles_theta_u();
            let turned = (seen.theta() - seen.theta_o - theta_u).max(0.0);
            let beyond = (turned.cos() - seen.cos_theta_e).abs() < COSINE;
            let horizon = !seen.volume() && seen.height().abs() < 1e-5;
            if surface || beyond || horizon {
                continue;
            }
            let sight = Sight::of_corners(&cluster, &point);
            assert_eq!(sight.inside, theta_u == PI, "{cluster:?} at {point:?}");
            if !sight.inside {
                let found = f64::from(sight.sine).atan2(f64::from(sight.cosine));
                assert!(
                    (found - theta_u).abs() < 2e-3,
                    "{found}, expected {theta_u}: {cluster:?} at {point:?}"
                );
            }
            let [most, least] = seen.cycles(theta_u);
            let (found_most, found_least) = sight.extremes(&cluster, point.normal());
            // Both bounds are products of two cosines.
            let error = 2.0 * COSINE;
            assert!(
                (f64::from(found_most) - most).abs() < error
                    && (f64::from(found_least) - least).abs() < error,
                "{found_most} {found_least}, expected {most} {least}: {cluster:?} at {point:?}"
            );
            some += u32::from((0.05..0.95).contains(&most));
            both += u32::from(least > 0.05 && most - least > 0.05);
            within += u32::from(sight.inside);
            wide += u32::from(theta_u > 0.6 * PI && !sight.inside);
        }
        for count in [some, both, within, wide] {
            assert!(count > 300, "{some} {both} {within} {wide}");
        }
    }
    check::<FullNode<2>>(5);
    check::<CompactNode<2>>(6);
}

/// Half of the choices by the greatest importance, half by the least; where there is none, alike among those that have a
/// greatest one.
#[test]
fn cycles_averages_two_probabilities() {
    let random = &mut Random(7);
    let (mut by_least, mut alike) = (0, 0);
    for _ in 0..20_000 {
        let (first, point) = sight(random);
        let size = exact::max((first.max - first.min).max_element(), 1e-3);
        let sets = [0; 4].map(|k| {
            let (other, _) = sight(random);
            let center = (first.min + first.max) * 0.5 + random.vector() * size * 2.0;
            let half = random.extents(size) * if k == 0 { 1.0 } else { 0.1 };
            LightBounds {
                min: center - half,
                max: center + half,
                phi: if random.below(8) == 0 { 0.0 } else { other.phi },
                cos_theta_o: if random.below(2) == 0 {
                    1.0
                } else {
                    other.cos_theta_o
                },
                ..other
            }
        });
        let mut node = FullNode::<4>::EMPTY;
        node.set_summaries(&sets);
        let clusters = [0, 1, 2, 3].map(|slot| BoundsNode::<4>::cluster(&node, slot));
        let (mut greatest, mut least, mut alive) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for (slot, cluster) in clusters.iter().enumerate() {
            let (most, fewest) = Sight::of_corners(cluster, &point).extremes(cluster, point.normal());
            let seen = Seen::of(cluster, &point);
            let flux = f64::from(cluster.phi) / seen.d().max(0.5 * seen.r()).powi(2);
            greatest[slot] = flux * f64::from(most).max(FLOOR);
            least[slot] = flux * f64::from(fewest);
            alive[slot] = f64::from(u8::from(most > 0.0 && cluster.phi > 0.0));
        }
        let share = |of: &[f64; 4], slot: usize| of[slot] / of.iter().sum::<f64>().max(1e-300);
        let any = least.iter().sum::<f64>() > 0.0;
        let second = if any { least } else { alive };
        let found = Cycles::weights(&node, &point).map(f64::from);
        for slot in 0..4 {
            let expected = share(&greatest, slot) + share(&second, slot);
            assert!(
                (found[slot] - expected).abs() < 2.0 * ROUGH * expected + 1e-17,
                "{found:?}, {slot} expected {expected}: {clusters:?} at {point:?}"
            );
        }
        by_least += u32::from(any);
        alike += u32::from(!any && alive.iter().sum::<f64>() > 1.0);
    }
    assert!(by_least > 500 && alike > 500, "{by_least} {alike}");
}

/// The very centre of a box: its direction is that of a zero vector, and the published forms are no number, though lights of
/// the box may shine on the point. Here the weight is positive, as everywhere else with flux.
#[test]
fn the_centre_of_a_box_has_weight() {
    let half = Vec3::new(1.0, 2.0, 0.5);
    let lamps = LightBounds {
        min: -half,
        max: half,
        axis: Vec3::Z,
        cos_theta_o: 0.5,
        cos_theta_e: 0.0,
        phi: 3.0,
    };
    let point = ShadingPoint {
        p: [0.0; 3],
        n: [0.0, 1.0, 0.0],
    };
    let mut node = FullNode::<2>::EMPTY;
    node.set_summaries(&[lamps, known(&point, 1.0)]);
    let seen = Seen::of(&node.cluster(0), &point);
    assert!(seen.theta().is_nan() && seen.cos_theta_i().is_nan());
    for weights in [
        Pbrt::weights(&node, &point),
        Falcor::weights(&node, &point),
        Cycles::weights(&node, &point),
    ] {
        assert!(weights[0] >= 0.1 * weights[1] && weights[1] > 0.0, "{weights:?}");
    }
}

/// Positive where there is flux, zero elsewhere, at most 2^120: on lengths of 2^-60 to 2^60 m, flat and pointlike boxes, points
/// within them and on them, cones of a direction and of all.
#[test]
fn bounds_of_any_size_have_sound_weights() {
    fn check<N: BoundsNode<4>, I: ImportanceModel<N, 4>>(random: &mut Random) {
        let size = random.power(-60, 40);
        let sets = [0; 4].map(|_| {
            let center = random.vector() * size * random.power(-4, 20);
            let flat = |random: &mut Random| [0.0, 1.0, 1.0][random.below(3) as usize] * random.unit();
            let half = Vec3::new(flat(random), flat(random), flat(random)) * size;
            LightBounds {
                min: center - half,
                max: center + half,
                axis: random.direction(),
                cos_theta_o: [1.0, -1.0, 0.0, random.signed()][random.below(4) as usize],
                cos_theta_e: 0.0,
                phi: [0.0, exact::pow2(-100), exact::pow2(120), 1.0][random.below(4) as usize],
            }
        });
        let mut node = N::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, crate::node::kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
        let lights = sets[random.below(4) as usize];
        let center = (lights.min + lights.max) * 0.5;
        let p = match random.below(5) {
            0 => center,
            1 => lights.min,
            2 => center + random.vector() * size,
            3 => center + random.direction() * random.power(-100, 60),
            _ => Vec3::ZERO,
        };
        let n = if random.below(3) == 0 {
            Vec3::ZERO
        } else {
            random.direction()
        };
        let point = ShadingPoint {
            p: p.to_array(),
            n: n.to_array(),
        };
        let weights = I::weights(&node, &point);
        for slot in 0..4 {
            let shines = sets[slot].phi > 0.0;
            let sound = (0.0..=exact::pow2(120)).contains(&weights[slot]) && (weights[slot] > 0.0) == shines;
            assert!(sound, "{} {weights:?}: {sets:?} at {point:?}", N::NAME);
        }
    }
    let random = &mut Random(8);
    for _ in 0..20_000 {
        check::<FullNode<4>, Pbrt>(random);
        check::<CompactNode<4>, Pbrt>(random);
        check::<FullNode<4>, Falcor>(random);
        check::<CompactNode<4>, Falcor>(random);
        check::<FullNode<4>, Cycles>(random);
        check::<CompactNode<4>, Cycles>(random);
    }
}
