extern crate std;

use crate::node::{LightNode, Node};
use std::vec::Vec;

use super::bins::{Measure, bins_for};
use super::frame::Frame;
use super::*;
use crate::build::MAX_BUCKETS;
use crate::exact::{hash, pow2, unit_f32};
use crate::node::{CompactNode, kind};
use crate::trail::{BitTrail, max_levels};

fn unit(seed: u32) -> f32 {
    unit_f32(hash(seed))
}

fn random(count: u32) -> Vec<WardPrimitive> {
    let of = |i: u32| WardPrimitive {
        c: [
            unit(8 * i) * 50.0,
            unit(8 * i + 1) * 100.0 - 30.0,
            unit(8 * i + 2),
        ],
        phi: unit(8 * i + 3) * 10.0,
        index: i,
    };
    (0..count).map(of).collect()
}

/// Distributions that are hard on a builder, each with its name.
fn hostile(count: u32) -> Vec<(&'static str, Vec<WardPrimitive>)> {
    let with = |f: &dyn Fn(u32, &mut WardPrimitive)| {
        let mut all = random(count);
        for (i, p) in (0..).zip(&mut all) {
            f(i, p);
        }
        all
    };
    let sign = |i: u32| if hash(i) & 1 == 0 { 1.0 } else { -1.0 };
    std::vec![
        ("random", random(count)),
        ("one point", with(&|_, p| p.c = [3.0, -7.0, 11.0])),
        ("a line", with(&|_, p| p.c = [p.c[0], 5.0, -1.0])),
        ("two points", with(&|i, p| p.c = [sign(i) * pow2(40); 3])),
        (
            "exponential",
            with(&|i, p| p.c = [pow2((i % 140) as i32 - 100), 0.0, 0.0])
        ),
        (
            "extremes",
            with(&|i, p| {
                let size = pow2((hash(i) % 141) as i32 - 100);
                p.c = [sign(i) * size, sign(i + 1) * pow2(40), sign(i + 2) * pow2(-100)];
                p.phi = pow2((hash(i + 3) % 227) as i32 - 100);
            })
        ),
        ("dark", with(&|_, p| p.phi = 0.0)),
        (
            "one bright",
            with(&|i, p| p.phi = if i == count / 3 { pow2(126) } else { 0.0 })
        ),
        (
            "nearly one point",
            with(&|i, p| p.c = [pow2(-100) * (1.0 + pow2(-23) * (i % 3) as f32); 3])
        ),
        ("all as bright as can be", with(&|_, p| p.phi = pow2(126))),
    ]
}

const PRESETS: [BuildParams; 2] = [
    BuildParams::BALANCED,
    BuildParams {
        buckets: MAX_BUCKETS,
        ..BuildParams::BALANCED
    },
];

type Built<const W: usize> = Topology<CompactNode<W>>;

fn built<const W: usize>(primitives: &[WardPrimitive], params: &BuildParams) -> Built<W>
where
    CompactNode<W>: LightNode<W>,
{
    build_ward::<_, W>(&mut primitives.to_vec(), kind::LIGHT, params)
}

/// Every light is a leaf once and found by its trail; nodes are in depth-first order.
fn check<const W: usize>(name: &str, count: usize, tree: &Built<W>)
where
    CompactNode<W>: LightNode<W>,
{
    let mut trails = std::vec![None; count];
    for &(light, trail) in &tree.trails {
        assert_eq!(
            trails[light as usize].replace(trail),
            None,
            "{name}: light {light} twice"
        );
    }
    assert_eq!(tree.trails.len(), count, "{name}");
    assert!(tree.depth <= max_levels(W), "{name}: depth {}", tree.depth);

    let mut in_order = Vec::new();
    let mut stack = std::vec![(0u32, 0u32, BitTrail::default())];
    let (mut seen, mut depth) = (0, 0);
    while let Some((node, level, trail)) = stack.pop() {
        assert_eq!(node, seen, "{name}");
        seen += 1;
        depth = depth.max(level + 1);
        let children = &tree.nodes[node as usize];
        let filled = (0..W).filter(|&slot| children.kind(slot) != kind::EMPTY).count();
        assert!(
            filled >= 2 || count == 1,
            "{name}: node {node} has {filled} children"
        );
        for slot in (0..W).rev() {
            let own = trail.with::<W>(level, slot as u32);
            match children.kind(slot) {
                kind::LIGHT => in_order.push((children.link(slot), own)),
                kind::INNER => stack.push((children.link(slot), level + 1, own)),
                _ => assert!(slot >= filled, "{name}: node {node} has a gap at {slot}"),
            }
        }
    }
    assert_eq!((seen as usize, depth), (tree.nodes.len(), tree.depth), "{name}");
    for (light, trail) in in_order {
        assert_eq!(trails[light as usize], Some(trail), "{name}: light {light}");
    }
}

fn sound<const W: usize>()
where
    CompactNode<W>: LightNode<W>,
{
    // Work grows with the number of lights, not with its square, which would take minutes.
    let most = if W == 8 { 60_000 } else { 9000 };
    for count in [1, 2, 3, W as u32, W as u32 + 1, 40, 700, most] {
        for (name, primitives) in hostile(count) {
            for params in PRESETS {
                check::<W>(name, count as usize, &built::<W>(&primitives, &params));
            }
        }
    }
}

#[test]
fn every_light_is_a_leaf_once() {
    sound::<2>();
    sound::<4>();
    sound::<8>();
    sound::<16>();
}

fn same<const W: usize>(a: &Built<W>, b: &Built<W>) -> bool
where
    CompactNode<W>: LightNode<W>,
{
    bytemuck::cast_slice::<_, u8>(&a.nodes) == bytemuck::cast_slice::<_, u8>(&b.nodes)
        && a.trails == b.trails
        && a.depth == b.depth
}

/// A word for the whole tree, whatever the layout of its nodes.
fn digest(tree: &Built<8>) -> u32 {
    let children =
        |node: &CompactNode<8>| core::array::from_fn::<_, 8, _>(|i| node.kind(i) ^ node.link(i) << 2);
    let links = tree.nodes.iter().flat_map(children);
    let trails = tree
        .trails
        .iter()
        .flat_map(|&(light, trail)| [light, trail.low, trail.high]);
    links.chain(trails).fold(0, |digest, word| hash(digest ^ word))
}

/// Another builder has others.
#[test]
fn words_of_trees_are_known() {
    let digests = PRESETS.map(|params| digest(&built::<8>(&random(100_000), &params)));
    assert_eq!(digests, [0x586d_26a8, 0x7420_890a]);
}

#[test]
fn scaling_by_powers_of_two_changes_nothing() {
    for (name, primitives) in hostile(3000) {
        if name == "extremes" || name == "nearly one point" || name == "two points" || name == "exponential" {
            continue;
        }
        let has_flux = |p: &WardPrimitive| p.phi > 0.0 && p.phi < pow2(100);
        for (space, flux) in [(20, 0), (-30, 0), (0, 20), (0, -40), (13, -7)] {
            let mut scaled = primitives.clone();
            for p in &mut scaled {
                p.c = p.c.map(|x| x * pow2(space));
                p.phi *= if has_flux(p) { pow2(flux) } else { 1.0 };
            }
            for params in PRESETS {
                let trees = [&primitives, &scaled].map(|all| built::<8>(all, &params));
                assert!(same(&trees[0], &trees[1]), "{name}, 2^{space} m, 2^{flux} W");
            }
        }
    }
}

/// Σ Φ·|x − c|² of some lights.
fn cost(lights: &[&WardPrimitive]) -> f64 {
    let total: f64 = lights.iter().map(|p| f64::from(p.phi)).sum();
    let mut cost = 0.0;
    for axis in 0..3 {
        let x = |p: &WardPrimitive| f64::from(p.c[axis]);
        let mean = lights.iter().map(|p| f64::from(p.phi) * x(p)).sum::<f64>() / total;
        cost += lights
            .iter()
            .map(|p| f64::from(p.phi) * (x(p) - mean) * (x(p) - mean))
            .sum::<f64>();
    }
    cost
}

#[test]
fn the_first_split_is_the_best_of_all_planes() {
    for seed in 0..60 {
        let all: Vec<_> = random(20 + 10 * seed).split_off(10);
        let extent = Extent::of(&all);
        let params = BuildParams::BALANCED;
        let bins = bins_for(all.len(), &params);
        assert_eq!(bins, if all.len() < 256 { 8 } else { 16 });
        let frame = Frame::of(&extent, bins).expect("an extent");
        let mut least = f64::MAX;
        for axis in 0..3 {
            for bin in 1..bins {
                let is_right = |p: &&WardPrimitive| frame.along(axis).bin_of(p.c[axis]) >= bin as u32;
                let (right, left): (Vec<_>, Vec<_>) = all.iter().partition(is_right);
                if !left.is_empty() && !right.is_empty() {
                    let both = cost(&left) + cost(&right);
                    least = if both < least { both } else { least };
                }
            }
        }
        let measure = Measure::of(&all, &extent, &params);
        let plane = measure.plane.expect("a plane");
        let (right, left): (Vec<_>, Vec<_>) = all.iter().partition(|p| plane.is_right(p));
        let whole: Vec<_> = all.iter().collect();
        let found = cost(&left) + cost(&right);
        assert!(found <= least * (1.0 + 1e-5), "{seed}: {found}, least {least}");
        assert!(
            (measure.cost - cost(&whole)).abs() < 1e-4 * cost(&whole),
            "{seed}"
        );
    }
}

/// If leaf nodes are meant to be full, 0.8 of the slots and more are filled.
#[test]
fn nodes_are_filled() {
    for (name, primitives) in hostile(20_000) {
        let tree = built::<8>(&primitives, &BuildParams::BALANCED);
        let children = primitives.len() + tree.nodes.len() - 1;
        let fill = children as f64 / (8 * tree.nodes.len()) as f64;
        assert!(fill > 0.8, "{name}: {fill}");
    }
}
