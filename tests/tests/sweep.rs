//! The CPU's parallel refit against the shared functions that it calls: every word, whatever the inputs, the order and the number
//! of threads.

use lightbvh::{
    BuildParams, Bvh, CompactNode, EmissiveTriangle, LightNode, Lights, MomentNode, Summary, refit, sweep,
};
use lightbvh_tests::each_node;
use lightbvh_tests::generate::{self, Random, extreme_triangle};
use proptest::prelude::*;

/// Nodes with any children, summaries of the whole domain, and links a little beyond `links`.
fn nodes<N: LightNode<W>, const W: usize>(random: &mut Random, count: u32, links: u32) -> Vec<N> {
    // Triangles take long to draw; all nodes choose from these.
    let drawn: Vec<N::Summary> = (0..256)
        .map(|_| N::Summary::of_triangle(&extreme_triangle(random)))
        .collect();
    (0..count)
        .map(|_| {
            let mut node = N::EMPTY;
            for slot in 0..W {
                node.set_child(slot, random.below(4), random.below(links + links / 16 + 1));
            }
            node.set_summaries(&std::array::from_fn(|_| drawn[random.below(256) as usize]));
            node
        })
        .collect()
}

/// Any order of some of the nodes.
fn list(random: &mut Random, count: u32) -> Vec<u32> {
    let mut list: Vec<u32> = (0..count).filter(|_| random.below(8) > 0).collect();
    for i in (1..list.len()).rev() {
        list.swap(i, random.below(i as u32 + 1) as usize);
    }
    list
}

fn one_by_one<N: LightNode<W>, const W: usize>(
    nodes: &[N],
    list: &[u32],
    node: impl Fn(&[N], u32) -> N,
) -> Vec<u32> {
    let mut out = nodes.to_vec();
    for &i in list {
        out[i as usize] = node(nodes, i);
    }
    bytemuck::cast_slice(&out).to_vec()
}

fn words<N: LightNode<W>, const W: usize>(nodes: &[N], pass: impl Fn(&mut [N])) -> Vec<u32> {
    let mut out = nodes.to_vec();
    pass(&mut out);
    bytemuck::cast_slice(&out).to_vec()
}

fn check<N: LightNode<W>, const W: usize>(seed: u32, count: u32) {
    let random = &mut Random::new(seed);
    let triangles: Vec<EmissiveTriangle> = (0..200).map(|_| extreme_triangle(random)).collect();
    // The children are other nodes than those of the list, as in a tree.
    let mut bottom: Vec<N> = nodes(random, 2 * count, 200);
    for node in &mut bottom[..count as usize] {
        for slot in 0..W {
            if node.kind(slot) == lightbvh::node::kind::INNER {
                node.relink(slot, count + random.below(count + count / 16 + 1));
            }
        }
    }
    let list = list(random, count);
    let expected = one_by_one(&bottom, &list, |nodes, i| refit::bottom(nodes, &triangles, i));
    let found = words(&bottom, |nodes| sweep::bottom(nodes, &triangles, &list));
    assert!(expected == found, "{} {W}", N::NAME);
}

/// All bottom levels of a tree, together and one by one, without summaries at first, against its levels one after the other.
fn check_trees<N: LightNode<W>, const W: usize>(count: u32) {
    let lights = Lights::new(generate::small_triangles(
        count,
        count / 3 + 1,
        10.0,
        0.1,
        false,
        9,
    ))
    .expect("lights");
    let triangles = lights.triangles();
    let bvh = Bvh::<N, (), W>::two_level(&lights, &BuildParams::default());
    let bare = |node: &N| {
        let mut bare = N::EMPTY;
        for slot in 0..W {
            bare.set_child(slot, node.kind(slot), node.link(slot));
        }
        bare
    };
    let plan = bvh.plan_of_everything();
    let bare: Vec<N> = bvh.nodes().iter().map(bare).collect();
    let mut expected = bare.clone();
    for range in plan.bottom.ranges() {
        for &index in &plan.bottom.nodes()[range] {
            expected[index as usize] = refit::bottom(&expected, triangles, index);
        }
    }
    let check = |how: &str, sweep: &dyn Fn(&mut [N])| {
        let mut found = bare.clone();
        sweep(&mut found);
        for &node in plan.bottom.nodes() {
            let node = node as usize;
            let [found, expected] = [&found, &expected].map(|all| bytemuck::bytes_of(&all[node]));
            assert!(found == expected, "{} {W}: {how}, node {node}", N::NAME);
        }
    };
    let roots: Vec<u32> = bvh.roots().iter().map(|root| root.node).collect();
    check("together", &|nodes| {
        sweep::bottom_sweep(nodes, 0, triangles, &roots);
    });
    check("apart", &|nodes| {
        for (k, &start) in roots.iter().enumerate() {
            let end = roots.get(k + 1).map_or(nodes.len(), |&next| next as usize);
            sweep::bottom_sweep(&mut nodes[start as usize..end], start, triangles, &[start]);
        }
    });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn sweeps_are_the_shared_functions(seed: u32, count in 1..90u32) {
        each_node!(check(seed, count));
    }
}

/// Enough nodes that they are shared out, and not a multiple of any block.
#[test]
fn threads_do_not_show() {
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            check::<CompactNode<4>, 4>(7, 40_001);
            // From one node on, and so many that subtrees of subtrees are shared out.
            for count in [1, 5, 40, 60_000] {
                check_trees::<CompactNode<2>, 2>(count);
                check_trees::<MomentNode<8>, 8>(count);
            }
        });
    }
}
