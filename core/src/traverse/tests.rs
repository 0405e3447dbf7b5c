//! Walks over nodes made by hand, whose weights are the numbers in them.

extern crate std;

use core::cell::Cell;
use core::marker::PhantomData;

use super::*;
use crate::choose::{FULL, choose};
use crate::importance::{Defensive, ImportanceModel, Space};
use crate::instance::Instance;
use crate::node::{MomentNode, kind};
use crate::point::ShadingPoint;
use crate::trail::{BitTrail, max_levels};
use crate::tree::{INVALID, LightTree, Links};

type Node = MomentNode<4>;

/// Words of a node: rows of kinds and links, and one that takes the weights.
type Words = [[u32; 4]; 6];
const KIND: usize = 1;
const WEIGHT: usize = 2;
const LINK: usize = 5;

std::thread_local! {
    static NODES: Cell<u32> = const { Cell::new(0) };
}

/// The weights as they are in the words; counts its calls.
struct Flux;

impl ImportanceModel<Node, 4> for Flux {
    fn weights_in(node: &Node, _: &ShadingPoint, _: Space) -> [f32; 4] {
        let calls = NODES.get() + 1;
        NODES.set(calls);
        assert!(calls < 1000, "the walk does not end");
        let words: Words = bytemuck::cast(*node);
        words[WEIGHT].map(f32::from_bits)
    }
}

const POINT: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0; 3],
};

/// A node of (weight, kind, link).
fn node(children: &[(f32, u32, u32)]) -> Node {
    let mut words = Words::default();
    for (slot, &(weight, kind, link)) in children.iter().enumerate() {
        words[WEIGHT][slot] = weight.to_bits();
        words[LINK][slot] = link;
        words[KIND][slot] = kind;
    }
    bytemuck::cast(words)
}

fn tree<'a>(
    nodes: &'a [Node],
    instances: &'a [Instance],
    trails: &'a [u32],
    depth: u32,
) -> LightTree<'a, Node, Flux, 4> {
    LightTree {
        nodes,
        top: nodes,
        first: 0,
        root: 0,
        instances,
        trails,
        links: Links::default(),
        trail_words: 2,
        live: instances.len() as u32,
        lights: (trails.len() / 2) as u32,
        depth,
        importance: PhantomData,
    }
}

/// Nodes that one call evaluates.
fn nodes_of<R>(call: impl FnOnce() -> R) -> u32 {
    NODES.set(0);
    call();
    NODES.get()
}

/// Light `k` is a child of level `k`, beside a next level of nearly no weight: each has one number in 2^22 of those that lead
/// to its parent, down to a probability that is never drawn but is not zero.
#[test]
fn probabilities_are_products_of_shares_down_to_the_least() {
    const LEVELS: u32 = 7;
    let nodes: std::vec::Vec<Node> = (0..LEVELS)
        .map(|level| {
            let next = if level + 1 < LEVELS {
                kind::INNER
            } else {
                kind::EMPTY
            };
            let weight = if level + 1 < LEVELS { 1e-30 } else { 0.0 };
            node(&[(weight, next, level + 1), (1.0, kind::LIGHT, level)])
        })
        .collect();
    let mut trails = std::vec::Vec::new();
    for level in 0..LEVELS {
        let mut trail = BitTrail::default();
        for above in 0..level {
            trail = trail.with::<4>(above, 0);
        }
        let own = trail.with::<4>(level, 1);
        trails.extend([own.low, own.high]);
    }
    let tree = tree(&nodes, &[], &trails, LEVELS);
    for light in 0..LEVELS {
        let expected = 2f64.powi(-22 * light as i32).max(2f64.powi(-98));
        let found = f64::from(tree.pmf(&POINT, light, INVALID));
        // All but one of the numbers, where there is a next level.
        assert!(
            (expected * (1.0 - 2f64.powi(-21))..=expected).contains(&found),
            "{light}: {found:e}, expected {expected:e}"
        );
    }
}

/// Hostile words may give weights of any sign, whose shares are longer than the range: such a child is not entered.
#[test]
fn shares_longer_than_the_range_lead_nowhere() {
    let nodes = [node(&[
        (1.0, kind::LIGHT, 0),
        (-1.5, kind::LIGHT, 1),
        (1.0, kind::LIGHT, 2),
    ])];
    let tree = tree(&nodes, &[], &[0, 0, 1, 0, 2, 0], 1);
    for light in 0..3 {
        let pmf = tree.pmf(&POINT, light, INVALID);
        assert!((0.0..=1.0).contains(&pmf), "{light}: {pmf}");
        assert!(light != 0 || pmf == 0.0, "{pmf}");
    }
    for number in 0..64u32 {
        let sampled = tree.sample(&POINT, Random64::from(number << 26));
        assert!((0.0..=1.0).contains(&sampled.pmf), "{}", sampled.pmf);
    }
}

/// Nodes linked in a ring, in a tree that says it is as deep as can be: the levels of a trail end the walk, in either tree.
#[test]
fn rings_end_with_the_levels_of_a_trail() {
    let levels = max_levels(4);
    let top = [node(&[(1.0, kind::INNER, 0)])];
    let ring = tree(&top, &[], &[0, 0], u32::MAX);
    let number = Random64::from(0u32);
    assert_eq!(nodes_of(|| ring.sample(&POINT, number)), levels);
    assert_eq!(nodes_of(|| ring.pmf(&POINT, 0, INVALID)), levels);

    let below = [node(&[(1.0, kind::MESH, 0)]), node(&[(1.0, kind::INNER, 1)])];
    let instance = Instance {
        root: 1,
        count: 1,
        ..Instance::IDENTITY
    };
    let instances = [instance];
    let ring = tree(&below, &instances, &[0, 0], u32::MAX);
    assert_eq!(nodes_of(|| ring.sample(&POINT, number)), 1 + levels);
    assert_eq!(nodes_of(|| ring.pmf(&POINT, 0, 0)), 1 + levels);
}

/// Candidates are the samples of their numbers, and each node that they share is evaluated once.
#[test]
fn candidates_are_samples_of_their_numbers() {
    let light = |weight: f32, light: u32| (weight, kind::LIGHT, light);
    let nodes = [
        node(&[(1.0, kind::INNER, 1), (6.0, kind::INNER, 2), light(1.0, 0)]),
        node(&[light(1.0, 1), light(2.0, 2)]),
        node(&[light(1.0, 3), (2.0, kind::INNER, 3)]),
        node(&[light(1.0, 4), light(3.0, 5), light(1e-20, 6), light(0.0, 7)]),
    ];
    let tree = tree(&nodes, &[], &[0; 16], 3);
    for seed in 0..200_u32 {
        let random = Random64::from(crate::exact::hash(seed));
        NODES.set(0);
        let many = tree.sample_many::<_, 16>(&POINT, random);
        for (k, found) in (0..).zip(many) {
            NODES.set(0);
            assert_eq!(found, tree.sample(&POINT, random.spaced(k, 16)), "{k} of {seed}");
        }
        // The four nodes, for all sixteen.
        assert_eq!(nodes_of(|| tree.sample_many::<_, 16>(&POINT, random)), 4);
        assert_eq!(
            tree.sample_many::<_, 1>(&POINT, random),
            [tree.sample(&POINT, random)]
        );
    }
    let random = Random64::from(7u32);
    let mut spaced = [SampledLight::NONE; 70];
    tree.sample_spaced(&POINT, random, 5, 90, &mut spaced);
    for (k, found) in (5..).zip(spaced) {
        assert_eq!(found, tree.sample(&POINT, random.spaced(k, 90)), "{k}");
    }
    // As many as the shortest of the lists.
    let mut sampled = [SampledLight::NONE; 20];
    tree.sample_batch(&[POINT; 9], &[random; 3], &mut sampled);
    assert_eq!(sampled[..3], [tree.sample(&POINT, random); 3]);
    assert_eq!(sampled[3..], [SampledLight::NONE; 17]);
    // Hostile words: weights of any sign, a ring.
    let nodes = [node(&[
        light(1.0, 0),
        (-1.5, kind::INNER, 0),
        light(1.0, 2),
        (f32::NAN, kind::INNER, 9),
    ])];
    let ring = LightTree {
        nodes: &nodes,
        depth: u32::MAX,
        ..tree
    };
    for seed in 0..200_u32 {
        let random = Random64::from(crate::exact::hash(seed));
        NODES.set(0);
        for (k, found) in (0..).zip(ring.sample_many::<_, 32>(&POINT, random)) {
            NODES.set(0);
            let expected = ring.sample(&POINT, random.spaced(k, 32));
            assert_eq!(
                (found.light, found.pmf.to_bits()),
                (expected.light, expected.pmf.to_bits())
            );
        }
    }
}

/// Shares are in proportion to weights, but for 2^-15 of the range, and end with it.
#[test]
fn shares_are_in_proportion() {
    let random = &mut crate::kit::Random(11);
    for round in 0..2000u32 {
        // Equal ones round up together.
        let weights: [f32; 16] =
            core::array::from_fn(|_| if round % 2 == 0 { 3.0 } else { random.unit() + 1e-3 });
        let range = FULL / 2 + 1 + random.below(FULL / 2);
        let sum: f32 = weights.iter().sum();
        let mut first = 0;
        for slot in 0..16 {
            let share = choose::<16>(|k| weights[k], range, 0, true, slot as u32);
            let wanted = weights[slot] / sum * range as f32;
            assert!(
                crate::exact::abs(share.count as f32 - wanted) < 160.0,
                "{slot} of {round}"
            );
            assert_eq!(share.first, first, "{slot} of {round}");
            first += share.count;
        }
        assert_eq!(first, range, "{round}");
    }
}

/// Lights of an instance times instances pass 2^32 in hostile words, and nearly in honest ones.
#[test]
fn uniform_probabilities_hold_for_any_counts() {
    let nodes = [node(&[(0.0, kind::EMPTY, 0)])];
    let instances = [Instance {
        first: 0,
        count: 1 << 20,
        ..Instance::IDENTITY
    }];
    let tree = LightTree::<Node, Defensive<Flux, 1>, 4> {
        nodes: &nodes,
        top: &nodes,
        first: 0,
        root: 0,
        instances: &instances,
        trails: &[],
        links: Links::default(),
        trail_words: 2,
        live: 1 << 16,
        lights: 0,
        depth: 1,
        importance: PhantomData,
    };
    assert_eq!(tree.pmf(&POINT, 5, 0), crate::exact::pow2(-37));
}

/// Hostile words: a mesh within a mesh is not entered.
#[test]
fn meshes_are_entered_from_the_top_level_alone() {
    let nodes = [node(&[(1.0, kind::MESH, 0)]), node(&[(1.0, kind::MESH, 0)])];
    let instances = [Instance {
        root: 1,
        count: 1,
        ..Instance::IDENTITY
    }];
    let ring = tree(&nodes, &instances, &[0, 0], u32::MAX);
    assert_eq!(nodes_of(|| ring.sample(&POINT, Random64::from(0u32))), 2);
    assert!(nodes_of(|| ring.pmf(&POINT, 0, 0)) <= max_levels(4) + 1);
}
