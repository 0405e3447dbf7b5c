//! Refit and validation: the same summaries whatever way they are come by, and no wrong word unnoticed.

use lightbvh::{
    BuildParams, Bvh, EmissiveTriangle, Heuristic, Instance, LightNode, Lights, Summary, bvh, exact, refit,
};
use lightbvh_host::backend::nodes_in_use;
use lightbvh_tests::each_node;
use lightbvh_tests::generate::{self, Random, split};
use lightbvh_tests::oracle::built;
use proptest::prelude::*;

fn words<T: bytemuck::Pod>(values: &[T]) -> Vec<u32> {
    bytemuck::cast_slice(values).to_vec()
}

/// The lights a while later: moved, some faded, some dark, some lit.
fn moved(lights: &Lights, random: &mut Random) -> Lights {
    let triangles = lights.triangles().iter().map(|t| {
        let by = [0; 3].map(|_| random.between(-5.0, 5.0));
        let fade = [0.0, 0.5, 1.0, exact::pow2(30)][random.below(4) as usize];
        EmissiveTriangle {
            p: t.p.map(|v| [v[0] + by[0], v[1] + by[1], v[2] * by[2]]),
            radiance: t
                .radiance
                .map(|x| if x == 0.0 { by[0].abs() + 1.0 } else { x * fade }),
            ..*t
        }
    });
    Lights::new(triangles.collect()).expect("the same mesh lights")
}

/// Nodes of bottom levels, then those of the top level.
fn all_nodes<N: LightNode<W>, const W: usize>(bvh: &Bvh<N, (), W>) -> Vec<N> {
    [bvh.nodes(), bvh.top_nodes()].concat()
}

/// Refit of nodes without summaries, those of each pass in another order, each pass reading only what the pass before it wrote.
fn refitted_in_another_order<N: LightNode<W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    random: &mut Random,
) -> Vec<N> {
    let first = bvh.nodes().len() as u32;
    let mut nodes = all_nodes(bvh);
    for node in &mut nodes {
        node.set_summaries(&[N::Summary::EMPTY; W]);
    }
    let mut pass = |nodes: &mut Vec<N>, list: &[u32], first: u32, body: &dyn Fn(&[N], u32) -> N| {
        let mut order = list.to_vec();
        for i in (1..order.len()).rev() {
            order.swap(i, random.below(i as u32 + 1) as usize);
        }
        let before = nodes.clone();
        for i in order {
            nodes[(first + i) as usize] = body(&before, first + i);
        }
    };
    let plan = bvh.plan_of_everything();
    for range in plan.bottom.ranges() {
        pass(&mut nodes, &plan.bottom.nodes()[range], 0, &|n, i| {
            refit::bottom(n, lights.triangles(), i)
        });
    }
    let roots: Vec<_> = bvh
        .roots()
        .iter()
        .map(|root| refit::root(&nodes, root.node))
        .collect();
    for range in plan.top.ranges() {
        pass(&mut nodes, &plan.top.nodes()[range], first, &|n, i| {
            refit::top(n, first, bvh.instances(), &roots, i)
        });
    }
    nodes
}

fn check<N: LightNode<W>, const W: usize>(
    lights: &Lights,
    params: &BuildParams,
    two: bool,
    random: &mut Random,
) {
    let mut bvh = built::<N, W>(lights, params, two);
    let again = built::<N, W>(lights, params, two);
    let parts = |bvh: &Bvh<N, (), W>| {
        let (tree, links) = (bvh.tree(), bvh.tree().links);
        (
            words(&all_nodes(bvh)),
            words(tree.instances),
            [tree.trails, links.above, links.places, links.parts].concat(),
            tree.root,
            tree.trail_words,
        )
    };
    let first = parts(&bvh);
    assert_eq!(first, parts(&again), "a build is not deterministic");
    let plans = [&bvh, &again].map(Bvh::plan_of_everything);
    assert_eq!(
        (&plans[0].bottom, &plans[0].top),
        (&plans[1].bottom, &plans[1].top)
    );

    let stats = bvh.validate().unwrap_or_else(|v| panic!("{} {W}: {v}", N::NAME));
    let meshes = if two { lights.mesh_count() } else { 1 };
    assert_eq!((stats.instances, stats.blases), (meshes as u32, meshes as u32));
    assert_eq!(stats.lights as usize, lights.triangles().len());
    assert_eq!(stats.depth, bvh.depth());

    bvh.follow(lights).expect("as many lights");
    assert_eq!(first, parts(&bvh), "refit of unchanged lights changes a word");

    let later = moved(lights, random);
    bvh.follow(&later).expect("as many lights");
    bvh.validate().unwrap_or_else(|v| panic!("after refit: {v}"));
    let shuffled = refitted_in_another_order(&bvh, &later, random);
    for node in nodes_in_use(&bvh) {
        let node = node as usize;
        let [found, shuffled] = [&all_nodes(&bvh), &shuffled].map(|all| words(&all[node..=node]));
        assert_eq!(found, shuffled, "the order within a pass shows: {node}");
    }

    // The top level may differ: instances that moved far were inserted elsewhere.
    bvh.follow(lights).expect("as many lights");
    assert_eq!(words(again.nodes()), words(bvh.nodes()), "there and back");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_way_to_the_same_summaries(lights in generate::lights(150), seed: u32, sah: bool, two: bool, buckets in 2..=32u32) {
        let random = &mut Random::new(seed);
        let heuristic = if sah { Heuristic::Sah } else { Heuristic::Saoh };
        let params = split(heuristic, buckets);
        each_node!(check(&lights, &params, two, random));
    }
}

/// Every word in use of every array of a small BVH, each of its bits turned, and all of them: not one goes unnoticed. (None is
/// harmless: links, kinds and trails are held against the one walk that reaches everything once, all other words against what
/// refit writes.)
fn no_wrong_word_goes_unnoticed<N: LightNode<W>, const W: usize>(two: bool, seed: u32) {
    let triangles = generate::small_triangles(11, 4, 10.0, 1.0, true, seed);
    let lights = Lights::new(triangles).expect("lights");
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    bvh.validate().expect("valid as built");
    type Part<N> = fn(bvh::Parts<'_, N>) -> &mut [u32];
    let arrays: [(&str, Part<N>); 6] = [
        ("instances", |p| {
            bytemuck::cast_slice_mut::<Instance, u32>(p.instances)
        }),
        ("trails", |p| p.trails),
        ("nodes", |p| bytemuck::cast_slice_mut(p.nodes)),
        ("top level", |p| bytemuck::cast_slice_mut(p.top)),
        ("places of nodes", |p| p.above),
        ("places of instances", |p| p.places),
    ];
    let used = bvh.plan_of_everything();
    let words = size_of::<N>() / 4;
    for (name, array) in arrays.into_iter().take(if two { 6 } else { 3 }) {
        let mut wrong = bvh.clone();
        for i in 0..array(wrong.parts_mut()).len() {
            if name == "nodes" && !used.bottom.nodes().contains(&((i / words) as u32)) {
                continue;
            }
            for mask in (0..32).map(|b| 1_u32 << b).chain([u32::MAX]) {
                array(wrong.parts_mut())[i] ^= mask;
                assert!(
                    wrong.validate().is_err(),
                    "{} {W}, two levels {two}: word {i} of the {name} with bits {mask:#x} turned",
                    N::NAME
                );
                array(wrong.parts_mut())[i] ^= mask;
            }
        }
        wrong.validate().expect("all put back");
    }
}

#[test]
fn every_bit_counts() {
    each_node!(no_wrong_word_goes_unnoticed(false, 1));
    each_node!(no_wrong_word_goes_unnoticed(true, 2));
}
