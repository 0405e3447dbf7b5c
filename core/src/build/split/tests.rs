//! Costs and chosen splits against Eq. 2 and Eq. 3 of the paper in `f64`.

mod reference;

extern crate std;

use std::vec::Vec;

use super::split;
use crate::LightBounds;
use crate::build::cost::{Heuristic, Scales};
use crate::build::primitive::{Group, Primitive};
use crate::build::{BuildParams, MAX_BUCKETS};
use crate::exact::{self, pow2};
use crate::kit::Random;

impl Random {
    fn triple(&mut self) -> [f32; 3] {
        [self.unit(), self.unit(), self.unit()]
    }
}

/// What the lights of a set have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Any boxes, any cones.
    Any,
    /// Normals by octant, so that orientation tells sides apart.
    Turned,
    /// In a box a hundred times as long as it is high.
    Flat,
    /// In a box a thousand times as long as it is broad and high.
    Thin,
    /// On a line: no group has an area.
    Line,
    /// A few lights have nearly all the flux.
    Dim,
    /// None has any flux.
    Dark,
}

const KINDS: [Kind; 7] = [
    Kind::Any,
    Kind::Turned,
    Kind::Flat,
    Kind::Thin,
    Kind::Line,
    Kind::Dim,
    Kind::Dark,
];

fn light(random: &mut Random, kind: Kind) -> LightBounds {
    let sides: [f32; 3] = match kind {
        Kind::Flat => [10.0, 5.0, 0.1],
        Kind::Thin => [10.0, 0.01, 0.005],
        Kind::Line => [0.0, 10.0, 0.0],
        _ => [10.0, 8.0, 6.0],
    };
    let (at, size) = (random.triple(), random.triple());
    let min = [0, 1, 2].map(|k| (at[k] - 0.5) * sides[k]);
    let max = [0, 1, 2].map(|k| min[k] + 0.15 * size[k] * sides[k]);
    let axis = random.triple();
    let toward = |k: usize| {
        if kind == Kind::Turned {
            (at[k] - 0.5) + 0.2 * (axis[k] - 0.5)
        } else {
            axis[k] - 0.5
        }
    };
    let cos_theta_o = match random.below(3) {
        0 => 0.7 + 0.3 * random.unit(),
        1 if kind == Kind::Any => 2.0 * random.unit() - 1.0,
        _ => 1.0,
    };
    let axis = glam::Vec3::new(toward(0), toward(1), toward(2));
    let phi = match kind {
        Kind::Dim => pow2(-(random.below(20) as i32)),
        Kind::Dark => 0.0,
        _ => 0.1 + random.unit(),
    };
    LightBounds {
        min: min.into(),
        max: max.into(),
        axis: crate::cone::normalized(axis),
        cos_theta_o,
        phi,
    }
}

fn primitives(random: &mut Random, kind: Kind, count: u32) -> Vec<Primitive> {
    (0..count)
        .map(|i| Primitive::new(i, &light(random, kind)))
        .collect()
}

/// Relative error of the cone's cosine: a rough root.
const ROOT: f64 = 6.7e-4;
/// Relative error of a cost apart from that: the rough root of the sine, the polynomial of the arc cosine.
const ROUGH: f64 = 1e-3;

#[test]
fn costs_are_those_of_the_paper() {
    let random = &mut Random(1);
    for i in 0..7000 {
        let kind = KINDS[i % 7];
        let primitives = primitives(random, kind, 12);
        let count = 1 + random.below(8) as usize;
        let (node, part) = (Group::of(&primitives), Group::of(&primitives[..count]));
        let scales = Scales::of(&node);
        for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
            let found = f64::from(scales.cost(heuristic, &part));
            let [least, most] = [ROOT, -ROOT].map(|off| reference::cost(heuristic, &part, &node, off));
            assert!(
                (least * (1.0 - ROUGH)..=most * (1.0 + ROUGH)).contains(&found),
                "{kind:?} {heuristic:?}: {found}, expected {least} to {most}"
            );
            for axis in 0..3 {
                let found = f64::from(scales.regularization(heuristic, &node, axis));
                let expected = reference::regularization(heuristic, &node, axis);
                assert!(
                    (found / expected - 1.0).abs() < 1e-5,
                    "{kind:?} {heuristic:?}: {found}, expected {expected}"
                );
            }
        }
    }
}

/// The box of a cone's normals: the farthest that a direction within θ_o of the axis reaches, either way.
#[test]
fn boxes_hold_the_normals_of_cones() {
    let random = &mut Random(3);
    for i in 0..7000 {
        let bounds = light(random, KINDS[i % 7]);
        let primitive = Primitive::new(0, &bounds);
        let theta_o = f64::from(bounds.cos_theta_o).acos();
        let reach = |a: f64| (a.clamp(-1.0, 1.0).acos() - theta_o).max(0.0).cos();
        for (k, a) in bounds.axis.to_array().map(f64::from).into_iter().enumerate() {
            let found = [primitive.low[4 + k], primitive.high[4 + k]].map(f64::from);
            let off = [found[0] + reach(-a), found[1] - reach(a)];
            assert!(off.iter().all(|off| off.abs() < 1e-3), "{bounds:?}: {off:?}");
        }
    }
}

/// Which primitives lie left of each plane between bins, and what it costs.
fn planes(all: &[Primitive], params: &BuildParams) -> Vec<(Vec<bool>, f32)> {
    let (node, bins) = (Group::of(all), all.len().min(params.buckets as usize));
    let scales = Scales::of(&node);
    let mut planes = Vec::new();
    for axis in 0..3 {
        let center = |p: &Primitive| f64::from(p.centroid(axis));
        let low = all.iter().map(center).fold(f64::INFINITY, f64::min);
        let high = all.iter().map(center).fold(f64::NEG_INFINITY, f64::max);
        for plane in 1..bins {
            // The last centre belongs to the last bin.
            let at = |p: &Primitive| (center(p) - low) / (high - low) * bins as f64 * (1.0 - 1e-6);
            let is_left = |p: &Primitive| at(p) < plane as f64;
            let (left, right): (Vec<Primitive>, Vec<_>) = all.iter().copied().partition(is_left);
            if !left.is_empty() && !right.is_empty() {
                let cost = |part: &[Primitive]| scales.cost(params.heuristic, &Group::of(part));
                let factor = scales.regularization(params.heuristic, &node, axis);
                let is_left = all.iter().map(is_left).collect();
                planes.push((is_left, (cost(&left) + cost(&right)) * factor));
            }
        }
    }
    planes
}

/// Up to 40 lights: the split is a plane between bins, and none of all planes on all axes costs less.
#[test]
fn the_first_split_is_the_cheapest_of_all_planes() {
    let random = &mut Random(2);
    let buckets = &mut [Group::EMPTY; MAX_BUCKETS as usize];
    for i in 0..4200 {
        let kind = KINDS[i % 7];
        let all = primitives(random, kind, 3 + i as u32 % 38);
        for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
            let (params, mut sorted) = (BuildParams::paper(heuristic), all.clone());
            let (middle, groups) = split(&mut sorted, &Group::of(&all), &params, buckets);
            let mut is_left = std::vec![false; all.len()];
            for p in &sorted[..middle] {
                is_left[p.index as usize] = true;
            }
            let planes = planes(&all, &params);
            let least_of = |all: &mut dyn Iterator<Item = &(Vec<bool>, f32)>| {
                all.map(|plane| plane.1).fold(f32::MAX, exact::min)
            };
            let least = least_of(&mut planes.iter());
            // Planes on several axes may part them alike.
            let found = least_of(&mut planes.iter().filter(|plane| plane.0 == is_left));
            assert!(
                found <= least * (1.0 + 1e-5),
                "{kind:?} {heuristic:?} {i}: {found}, least {least}"
            );
            // What the builder goes on with is what the parts are.
            let parts = [&sorted[..middle], &sorted[middle..]].map(Group::of);
            for (part, group) in parts.iter().zip(&groups.expect("the unions")) {
                let same_box = (part.low, part.high, part.count) == (group.low, group.high, group.count);
                let off = f64::from(part.phi) - f64::from(group.phi);
                assert!(same_box && off.abs() <= 1e-5 * f64::from(part.phi), "{i}");
            }
        }
    }
}
