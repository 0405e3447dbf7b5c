//! Any words in the arrays of a light tree: sampling, pmf and refit return, within a number of steps known beforehand.

use std::cell::Cell;

use lightbvh::importance::{Cluster, Importance};
use lightbvh::node::kind;
use lightbvh::trail::max_levels;
use lightbvh::{
    CompactNode, EmissiveTriangle, Eq4, FullNode, INVALID, ImportanceModel, LightBounds, LightNode,
    LightTree, Lights, LightsError, MeshLight, Receiver, refit, traverse,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle};
use proptest::prelude::*;

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

/// [`Eq4`] that counts how often it is asked.
struct Counting;

impl ImportanceModel for Counting {
    fn importance<R: Receiver>(cluster: &Cluster, point: &R) -> Importance {
        CALLS.set(CALLS.get() + 1);
        Eq4::importance(cluster, point)
    }
}

/// Most importances that a call may ask for: two ways down; then for the heir and for adopted masses, each of the
/// neighbours of a way, at most four times the slots that two levels of nodes have, a search of all nodes and a way up, on which
/// each node may be walked to from the root.
fn bound(nodes: usize, width: usize) -> u64 {
    let (n, w) = (nodes as u64, width as u64);
    let levels = u64::from(2 * max_levels(width));
    let neighbours = 2 * 2 * w * levels;
    w * (2 * levels + neighbours * (n * levels + levels * (1 + levels)))
}

/// Samples and evaluates pmfs; returns the greatest number of importances of one call.
fn walk<N: LightNode<W>, const W: usize>(tree: &LightTree<'_, N>, random: &mut Random, calls: u32) -> u64 {
    let most = bound(tree.nodes.len(), W);
    let mut greatest = 0;
    let mut counted = |pmf: f32| {
        let calls = CALLS.take();
        assert!(calls <= most, "{calls} importances, at most {most}");
        // Infinite words may make it NaN; a renderer's test for a positive pmf then drops the sample.
        assert!(pmf >= 0.0 || pmf.is_nan(), "pmf {pmf}");
        greatest = greatest.max(calls);
    };
    CALLS.set(0);
    for _ in 0..calls {
        let point = generate::point(random, 4.0);
        let sampled = traverse::sample::<N, Counting, _, W>(tree, &point, random.bits());
        counted(sampled.pmf);
        for light in [sampled.light, random.below(16), random.bits()] {
            for mesh in [INVALID, random.below(4), random.bits()] {
                counted(traverse::pmf::<N, Counting, _, W>(tree, &point, light, mesh));
            }
        }
    }
    greatest
}

/// All refit passes over all nodes.
fn refit_all<N: LightNode<W>, const W: usize>(nodes: &[N], meshes: &[MeshLight], random: &mut Random) {
    let triangles: Vec<_> = (0..4).map(|_| extreme_triangle(random)).collect();
    let roots: Vec<refit::BlasRoot> = (0..random.below(4))
        .map(|_| bytemuck::cast::<[u32; 13], _>(std::array::from_fn(|_| random.bits())))
        .collect();
    for i in 0..nodes.len() as u32 {
        let results = [
            refit::leaves(nodes, &triangles, i),
            refit::level(nodes, i),
            refit::mesh_leaves(nodes, meshes, &roots, i),
        ];
        for node in results {
            for slot in 0..W {
                assert_eq!(node.kind(slot), nodes[i as usize].kind(slot));
                assert_eq!(node.link(slot), nodes[i as usize].link(slot));
            }
        }
    }
}

/// A link that may lead anywhere, mostly to something.
fn link(random: &mut Random, count: u32) -> u32 {
    match random.below(8) {
        0 => random.bits(),
        1 => INVALID,
        _ => random.below(count),
    }
}

/// Nodes of random words, or of sound bounds with random links and kinds.
fn hostile_nodes<N: LightNode<W>, const W: usize>(random: &mut Random, count: u32) -> Vec<N> {
    let sound = random.below(3);
    (0..count)
        .map(|_| {
            let words: Vec<u32> = (0..size_of::<N>() / 4).map(|_| random.bits()).collect();
            let mut node = if sound == 0 {
                bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words))
            } else {
                N::EMPTY
            };
            for slot in 0..W {
                if sound > 0 || random.below(2) == 0 {
                    // In every third tree there is no light to end at.
                    let to = if sound == 1 { kind::INNER } else { random.below(5) };
                    node.set_child(slot, to, link(random, count));
                    let mut bounds = LightBounds::of_triangle(&extreme_triangle(random));
                    if random.below(8) == 0 {
                        let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, f32::MAX];
                        let mut odd = || odd[random.below(6) as usize];
                        (bounds.min.x, bounds.max.y, bounds.axis.z) = (odd(), odd(), odd());
                        (bounds.cos_theta_o, bounds.phi) = (odd(), odd());
                    }
                    node.set_bounds(slot, &bounds);
                }
            }
            node
        })
        .collect()
}

fn check<N: LightNode<W>, const W: usize>(seed: u32) {
    let random = &mut Random::new(seed);
    let count = 1 + random.below(10);
    let nodes = hostile_nodes::<N, W>(random, count);
    let meshes: Vec<_> = (0..random.below(4))
        .map(|_| MeshLight {
            root: link(random, count),
            trail: [random.bits(), random.bits()],
            blas: random.bits(),
        })
        .collect();
    let trails: Vec<u32> = (0..random.below(16)).map(|_| random.bits()).collect();
    let trail_words = [1, 2, 0, random.bits()][random.below(4) as usize];
    let tree = LightTree {
        nodes: &nodes,
        root: link(random, count),
        meshes: &meshes,
        trails: &trails,
        trail_words,
    };
    walk::<N, W>(&tree, random, 4);
    refit_all(&nodes, &meshes, random);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_words(seed: u32) {
        check::<CompactNode<2>, 2>(seed);
        check::<FullNode<2>, 2>(seed ^ 1);
        check::<CompactNode<4>, 4>(seed ^ 2);
    }

    #[test]
    fn random_words_in_wide_nodes(seed: u32) {
        if seed.is_multiple_of(8) {
            check::<CompactNode<16>, 16>(seed ^ 3);
        }
        check::<FullNode<8>, 8>(seed ^ 4);
    }
}

/// A light that shines everywhere, as bounds of a child.
fn everywhere() -> LightBounds {
    LightBounds {
        cos_theta_o: -1.0,
        phi: 1.0,
        ..LightBounds::EMPTY
    }
}

fn node<const W: usize>(children: [(u32, u32); W]) -> CompactNode<W> {
    let mut node = CompactNode::EMPTY;
    for (slot, (to, link)) in children.into_iter().enumerate() {
        node.set_child(slot, to, link);
        node.set_bounds(slot, &everywhere());
    }
    node
}

#[test]
fn cycles_end() {
    use kind::{INNER, LIGHT, MESH};
    let to_root = MeshLight {
        root: 0,
        trail: [0; 2],
        blas: 0,
    };
    let (all_left, meshes, trails) = ([to_root; 3], [to_root; 1], [0x5555_5555; 8]);
    let cycles: [(&str, Vec<CompactNode<2>>); 8] = [
        ("a node of itself", vec![node([(INNER, 0), (INNER, 0)])]),
        (
            "two nodes of each other",
            vec![node([(INNER, 1), (INNER, 1)]), node([(INNER, 0), (INNER, 0)])],
        ),
        (
            "a cycle with a way out",
            vec![node([(INNER, 1), (LIGHT, 3)]), node([(INNER, 0), (INNER, 0)])],
        ),
        ("links out of range", vec![node([(INNER, 7), (INNER, u32::MAX)])]),
        ("a mesh light of itself", vec![node([(MESH, 0), (MESH, 0)])]),
        ("mesh lights out of range", vec![node([(MESH, 9), (INNER, 0)])]),
        (
            "a mesh light below a mesh light",
            vec![node([(MESH, 0), (LIGHT, 1)])],
        ),
        (
            "a triangle beyond all triangles",
            vec![node([(LIGHT, u32::MAX - 1), (LIGHT, 1 << 31)])],
        ),
    ];
    let mut random = Random::new(8);
    for (name, nodes) in &cycles {
        for meshes in [&all_left[..], &meshes, &[]] {
            for trail_words in [1, 2] {
                let tree = LightTree {
                    nodes,
                    root: 0,
                    meshes,
                    trails: &trails,
                    trail_words,
                };
                let calls = walk::<_, 2>(&tree, &mut random, 20);
                // Far below the bound: a search visits few nodes so often.
                assert!(calls < 1 << 20, "{name}: {calls}");
            }
        }
    }
}

/// What a cycle costs in a tree of a thousand nodes, measured against the bound that is linear in their number.
#[test]
fn large_cycles_end() {
    let mut random = Random::new(9);
    let count = 1000;
    let nodes: Vec<_> = (0..count)
        .map(|_| {
            node([
                (kind::INNER, random.below(count)),
                (kind::INNER, random.below(count)),
            ])
        })
        .collect();
    let tree = LightTree {
        nodes: &nodes,
        root: 0,
        meshes: &[],
        trails: &[0; 4],
        trail_words: 1,
    };
    let calls = walk::<_, 2>(&tree, &mut random, 6);
    assert!(calls > 1000, "only {calls}: nothing was searched");
    println!("{calls} importances, at most {}", bound(nodes.len(), 2));
}

/// Before the first mesh light there is none that a triangle could go on with, not even by a number that wraps; found by the
/// fuzz target `build_validate`.
#[test]
fn a_first_triangle_of_no_mesh_light_is_refused() {
    let triangle = |mesh| EmissiveTriangle {
        p: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        radiance: [1.0; 3],
        mesh,
        flags: 0,
    };
    for mesh in [1, 2, u32::MAX - 1, u32::MAX] {
        let error = Lights::new(vec![triangle(mesh)]).expect_err("no such mesh light");
        let expected = LightsError::Order {
            index: 0,
            expected: 0,
            found: mesh,
        };
        assert_eq!(error, expected);
    }
    let error = Lights::new(vec![triangle(u32::MAX), triangle(0)]).expect_err("no such mesh light");
    assert!(matches!(error, LightsError::Order { index: 0, .. }), "{error}");
}
