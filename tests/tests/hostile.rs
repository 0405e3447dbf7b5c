//! Cycles in the arrays of a light tree: no walk evaluates more nodes than the tree says it is deep, nor more than two trails have
//! levels. Random words in the arrays are the fuzz target `node_words`.

use std::cell::Cell;
use std::marker::PhantomData;

use glam::Vec3;
use lightbvh::node::kind;
use lightbvh::trail::max_levels;
use lightbvh::{
    EmissiveTriangle, INVALID, ImportanceModel, Instance, LightNode, LightTree, Lights, LightsError,
    Random64, SampledLight, ShadingPoint, Summary, TreeWords,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::generate::{self, Random};

thread_local! {
    static NODES: Cell<u32> = const { Cell::new(0) };
}

/// An importance that counts how many nodes it is asked about.
struct Counting<I>(PhantomData<I>);

impl<N, I: ImportanceModel<N, W>, const W: usize> ImportanceModel<N, W> for Counting<I> {
    const UNIFORM_HALVINGS: u32 = I::UNIFORM_HALVINGS;

    fn weights(node: &N, point: &ShadingPoint) -> [f32; W] {
        NODES.set(NODES.get() + 1);
        I::weights(node, point)
    }
}

/// Samples, one by one and at once, and evaluates pmfs; returns the greatest number of nodes of one call.
fn walk<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    random: &mut Random,
    calls: u32,
) -> u32 {
    let most = tree.depth.min(2 * max_levels(W));
    let mut greatest = 0;
    let mut counted = |pmf: f32| {
        let nodes = NODES.take();
        assert!(nodes <= most, "{nodes} nodes, at most {most}");
        assert!((0.0..=1.0).contains(&pmf), "pmf {pmf}");
        greatest = greatest.max(nodes);
    };
    NODES.set(0);
    for _ in 0..calls {
        let mut point = generate::point(random, 4.0);
        if random.below(4) == 0 {
            point = bytemuck::cast::<[u32; 6], _>(std::array::from_fn(|_| random.bits()));
        }
        let number = Random64 {
            high: random.bits(),
            low: random.bits(),
        };
        let sampled = tree.by::<Counting<I>>().sample(&point, number);
        counted(sampled.pmf);
        let mut many = [SampledLight::NONE; 3];
        tree.sample_batch(&[point; 3], &[number; 3], &mut many);
        assert!(
            many.iter()
                .all(|one| one.light == sampled.light && one.pmf.to_bits() == sampled.pmf.to_bits())
        );
        for light in [sampled.light, random.below(16), random.bits()] {
            for instance in [INVALID, random.below(4), random.bits()] {
                counted(tree.by::<Counting<I>>().pmf(&point, light, instance));
            }
        }
    }
    greatest
}

/// A light that shines everywhere.
fn everywhere() -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 1,
    }
}

/// A node with these children in its first slots, all with flux.
fn node<N: LightNode<W>, const W: usize>(children: [(u32, u32); 2]) -> N {
    let mut node = N::EMPTY;
    let mut summaries = [N::Summary::EMPTY; W];
    for (slot, (to, link)) in children.into_iter().enumerate() {
        node.set_child(slot, to, link);
        summaries[slot] = N::Summary::of_triangle(&everywhere());
    }
    node.set_summaries(&summaries);
    node
}

/// Links that lead in circles and elsewhere: a walk takes as many steps as there are, and no more than the tree is said to be
/// deep.
fn cycles_end<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>() {
    use kind::{INNER, LIGHT, MESH};
    let to_root = Instance {
        root: 0,
        ..Instance::IDENTITY
    };
    let (all, one, trails) = ([to_root; 3], [to_root; 1], [0x5555_5555; 8]);
    // And the greatest number of nodes on a way, in a tree of any depth.
    let (endless, levels) = (2 * max_levels(W), max_levels(W));
    type Children = [(u32, u32); 2];
    let cycles: [(&str, &[Children], u32); 8] = [
        ("a node of itself", &[[(INNER, 0), (INNER, 0)]], levels),
        (
            "two nodes of each other",
            &[[(INNER, 1), (INNER, 1)], [(INNER, 0), (INNER, 0)]],
            levels,
        ),
        (
            "a cycle with a way out",
            &[[(INNER, 1), (LIGHT, 3)], [(INNER, 0), (INNER, 0)]],
            levels,
        ),
        ("links out of range", &[[(INNER, 7), (INNER, u32::MAX)]], 2),
        ("an instance of itself", &[[(MESH, 0), (INNER, 0)]], endless),
        ("instances out of range", &[[(MESH, 9), (INNER, 0)]], levels),
        ("an instance below an instance", &[[(MESH, 0), (LIGHT, 1)]], 2),
        (
            "triangles beyond all triangles",
            &[[(LIGHT, u32::MAX - 1), (LIGHT, 1 << 31)]],
            1,
        ),
    ];
    let mut random = Random::new(8);
    for (name, children, longest) in cycles {
        let nodes: Vec<N> = children.iter().map(|&children| node::<N, W>(children)).collect();
        for instances in [&all[..], &one, &[]] {
            for depth in [0, 1, 2, 5, u32::MAX] {
                let words = TreeWords {
                    trail_words: 1 + depth % 2,
                    live: instances.len() as u32,
                    lights: 8,
                    depth,
                    ..TreeWords::default()
                };
                let tree: LightTree<'_, N, I, W> = words.tree(&nodes, instances, &trails);
                let steps = walk::<N, I, W>(&tree, &mut random, 60);
                assert!(steps <= longest, "{name}: {steps}");
                // That the bound is met, where no way out ends it: it is the depth that stops the walk.
                if name == "two nodes of each other" {
                    assert_eq!(steps, depth.min(levels), "{name}");
                }
            }
        }
    }
}

#[test]
fn cycles() {
    each_layout!(cycles_end());
}

/// Instances whose words are far out of their domain still bring a point somewhere, or at least panic nowhere.
#[test]
fn maps_of_any_words() {
    let mut random = Random::new(10);
    for _ in 0..20_000 {
        let instance: Instance = bytemuck::cast::<[u32; 31], _>(std::array::from_fn(|_| random.bits()));
        let point = generate::point(&mut random, 10.0);
        let local = instance.to_local(&point);
        // Bounded, or no number: never infinite.
        assert!(
            local.p.iter().all(|x| !x.is_infinite()),
            "{local:?} of {instance:?}"
        );
        let _ = instance.vertex(Vec3::ONE.to_array());
        let _ = instance.triangle(&everywhere(), 3);
        let _ = instance.light_of(random.bits());
        let _ = instance.triangle_of(random.bits());
    }
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
