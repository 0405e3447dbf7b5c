//! Costs and chosen splits against Eq. 2 and Eq. 3 of the paper in `f64`.

mod reference;

extern crate std;

use std::vec::Vec;

use reference::{Exact, Light, least_cost};

use super::split;
use crate::LightBounds;
use crate::build::cost::{Heuristic, Scales};
use crate::build::primitive::{Group, Primitive};
use crate::build::{BuildParams, MAX_BUCKETS};
use crate::exact::pow2;
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

fn lights(random: &mut Random, kind: Kind, count: u32) -> (Vec<Primitive>, Vec<Light>) {
    let bounds: Vec<_> = (0..count).map(|_| light(random, kind)).collect();
    let primitives = (0..).zip(&bounds).map(|(i, b)| Primitive::new(i, b)).collect();
    (primitives, bounds.iter().map(Light::of).collect())
}

/// Relative error of the cone's cosine: a rough root.
const ROOT: f64 = 6.7e-4;
/// Relative error of a cost apart from that: the rough root of the sine, the polynomial of the arc cosine.
const ROUGH: f64 = 1e-3;
/// By how much a chosen split may cost more than the cheapest one. The cost of a narrow cone may be off by more, since an angle
/// near 0 hangs most on the error of its cosine; in these sets such cones decide nothing by so little.
const SLACK: f64 = 6e-3;

#[test]
fn costs_are_those_of_the_paper() {
    let random = &mut Random(1);
    for i in 0..7000 {
        let kind = KINDS[i % 7];
        let (primitives, lights) = lights(random, kind, 12);
        let count = 1 + random.below(8) as usize;
        let node = Exact::of(lights.iter());
        let group = Exact::of(lights[..count].iter());
        let scales = Scales::of(&Group::of(&primitives));
        let part = Group::of(&primitives[..count]);
        for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
            let found = f64::from(scales.cost(heuristic, &part));
            let [least, most] = [ROOT, -ROOT].map(|off| group.cost(heuristic, &node, off));
            assert!(
                (least * (1.0 - ROUGH)..=most * (1.0 + ROUGH)).contains(&found),
                "{kind:?} {heuristic:?}: {found}, expected {least} to {most}"
            );
            for axis in 0..3 {
                let found = scales.regularization(heuristic, &Group::of(&primitives), axis);
                let expected = node.regularization(heuristic, axis);
                assert!(
                    (f64::from(found) / expected - 1.0).abs() < 1e-5,
                    "{kind:?} {heuristic:?}: {found}, expected {expected}"
                );
            }
        }
    }
}

/// Up to 40 lights: the split is a plane between bins, and none of all planes on all axes costs less.
#[test]
fn the_first_split_is_the_cheapest_of_all_planes() {
    let random = &mut Random(2);
    let buckets = &mut [Group::EMPTY; MAX_BUCKETS as usize];
    for i in 0..4200 {
        let kind = KINDS[i % 7];
        let (mut primitives, lights) = lights(random, kind, 3 + i as u32 % 38);
        for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
            let params = BuildParams::paper(heuristic);
            let bins = lights.len().min(params.buckets as usize);
            let node = Group::of(&primitives);
            let (middle, groups) = split(&mut primitives, &node, &params, buckets);
            let mut is_left = std::vec![false; lights.len()];
            for p in &primitives[..middle] {
                is_left[p.index as usize] = true;
            }
            let least = least_cost(&lights, heuristic, bins, |_| true).expect("a plane");
            let found = least_cost(&lights, heuristic, bins, |left| left == is_left);
            let found = found.expect("a plane between bins");
            assert!(
                found <= least * (1.0 + SLACK),
                "{kind:?} {heuristic:?} {i}: {found}, least {least}"
            );
            // What the builder goes on with is what the parts are.
            let parts = [&primitives[..middle], &primitives[middle..]].map(Group::of);
            for (part, group) in parts.iter().zip(&groups.expect("the unions")) {
                let same_box = (part.low, part.high, part.count) == (group.low, group.high, group.count);
                let off = f64::from(part.phi) - f64::from(group.phi);
                assert!(same_box && off.abs() <= 1e-5 * f64::from(part.phi), "{i}");
            }
        }
    }
}
