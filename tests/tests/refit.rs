//! Refit and validation: the same summaries whatever way they are come by, and no wrong word unnoticed.

use lightbvh::node::kind;
use lightbvh::validate::What;
use lightbvh::{
    BuildParams, Bvh, CompactNode, EmissiveTriangle, FullNode, Heuristic, Instance, LightNode, Lights, Node,
    Summary, bvh, exact, refit,
};
use lightbvh_tests::each_node;
use lightbvh_tests::generate::{self, Random, split};
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
    let mut later = lights.clone();
    later.update(triangles.collect()).expect("the same mesh lights");
    later
}

/// The summary of node `index` and all below it from the lights alone, written into `out`: depth first, where refit goes
/// level by level.
fn recomputed<N: LightNode<W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    index: u32,
    out: &mut [N],
) -> N::Summary {
    let tree = bvh.tree();
    let old = tree.nodes[index as usize];
    let mut node = N::EMPTY;
    let mut children = [N::Summary::EMPTY; W];
    for (slot, child) in children.iter_mut().enumerate() {
        let (to, link) = (old.kind(slot), old.link(slot));
        node.set_child(slot, to, link);
        *child = match to {
            kind::EMPTY => continue,
            kind::LIGHT => N::Summary::of_triangle(&lights.triangles()[link as usize]),
            kind::MESH => {
                let instance = &tree.instances[link as usize];
                if instance.is_part() {
                    // The root above the parts, which no leaf leads to.
                    recomputed(bvh, lights, tree.instances[instance.part as usize].root, out);
                }
                recomputed(bvh, lights, instance.root, out).to_world::<lightbvh::EmissiveTriangle>(instance)
            }
            _ => recomputed(bvh, lights, link, out),
        };
    }
    node.set_summaries(&children);
    out[index as usize] = node;
    // What a parent is told is what is stored, rounding included.
    node.merged()
}

/// Refit with the nodes of each pass in another order, and each pass reading only what the pass before it wrote.
fn refitted_in_another_order<N: LightNode<W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    random: &mut Random,
) -> Vec<N> {
    let tree = bvh.tree();
    let mut nodes = tree.nodes.to_vec();
    let mut pass = |nodes: &mut Vec<N>, list: &[u32], body: &dyn Fn(&[N], u32) -> N| {
        let mut order = list.to_vec();
        for i in (1..order.len()).rev() {
            order.swap(i, random.below(i as u32 + 1) as usize);
        }
        let before = nodes.clone();
        for i in order {
            nodes[i as usize] = body(&before, i);
        }
    };
    let plan = bvh.plan_of_everything();
    for range in plan.bottom.ranges() {
        pass(&mut nodes, &plan.bottom.nodes()[range], &|n, i| {
            refit::bottom(n, lights.triangles(), i)
        });
    }
    let roots: Vec<_> = bvh
        .roots()
        .iter()
        .map(|root| refit::root(&nodes, root.node))
        .collect();
    for range in plan.top.ranges() {
        pass(&mut nodes, &plan.top.nodes()[range], &|n, i| {
            refit::top(n, tree.instances, &roots, i)
        });
    }
    nodes
}

fn built<N: LightNode<W>, const W: usize>(lights: &Lights, params: &BuildParams, two: bool) -> Bvh<N, (), W> {
    if two {
        Bvh::two_level(lights, params)
    } else {
        Bvh::single_level(lights, params)
    }
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
        let tree = bvh.tree();
        (
            words(tree.nodes),
            words(tree.instances),
            tree.trails.to_vec(),
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
    let mut expected = bvh.nodes().to_vec();
    let summary = recomputed(&bvh, &later, bvh.tree().root, &mut expected);
    assert_eq!(
        words(bvh.nodes()),
        words(&expected),
        "refit is not what the lights give"
    );
    assert_eq!(bvh.summary(), summary);
    bvh.validate().unwrap_or_else(|v| panic!("after refit: {v}"));
    let mut stale = again;
    let shuffled = refitted_in_another_order(&stale, &later, random);
    assert_eq!(
        words(bvh.nodes()),
        words(&shuffled),
        "the order within a pass shows"
    );
    stale.parts_mut().nodes.copy_from_slice(&shuffled);

    stale.follow(lights).expect("as many lights");
    assert_eq!(first.0, words(stale.nodes()), "there and back");
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

/// Every word of every array of a small BVH, each of its bits turned, and all of them: not one goes unnoticed. (None is
/// harmless: links, kinds, trails and lists are held against the one walk that reaches everything once, all other words
/// against what refit writes.)
fn no_wrong_word_goes_unnoticed<N: LightNode<W>, const W: usize>(two: bool, seed: u32) {
    let triangles = generate::small_triangles(11, 4, 10.0, 1.0, true, seed);
    let lights = Lights::new(triangles).expect("lights");
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    bvh.validate().expect("valid as built");
    type Part<N> = fn(bvh::Parts<'_, N>) -> &mut [u32];
    let arrays: [(&str, Part<N>); 5] = [
        ("nodes", |p| bytemuck::cast_slice_mut(p.nodes)),
        ("instances", |p| {
            bytemuck::cast_slice_mut::<Instance, u32>(p.instances)
        }),
        ("trails", |p| p.trails),
        ("bottom levels", |p| p.bottom),
        ("top levels", |p| p.top),
    ];
    for (name, array) in arrays {
        let mut wrong = bvh.clone();
        for i in 0..array(wrong.parts_mut()).len() {
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

/// In the lists of levels nodes may change places within a level, which changes nothing, but not between levels.
#[test]
fn levels_are_lists_without_order() {
    let lights = Lights::new(generate::small_triangles(60, 30, 10.0, 1.0, true, 8)).expect("lights");
    let bvh = Bvh::<CompactNode<2>, (), 2>::single_level(&lights, &BuildParams::default());
    let ranges: Vec<_> = bvh.plan_of_everything().bottom.ranges().collect();
    assert!(ranges.len() > 3);
    for (a, first) in ranges.iter().enumerate() {
        for (b, second) in ranges.iter().enumerate() {
            let mut wrong = bvh.clone();
            wrong.parts_mut().bottom.swap(first.start, second.end - 1);
            assert_eq!(wrong.validate().is_ok(), a == b, "{a} {b}");
        }
    }
}

/// Words at random, and nodes swapped and copied: a violation, never a panic.
#[test]
fn hostile_arrays_are_refused() {
    let mut random = Random::new(5);
    let lights = Lights::new(generate::small_triangles(40, 7, 10.0, 1.0, true, 6)).expect("lights");
    for two in [false, true] {
        let bvh = built::<CompactNode<2>, 2>(&lights, &BuildParams::default(), two);
        for _ in 0..20_000 {
            let mut wrong = bvh.clone();
            let parts = wrong.parts_mut();
            let count = parts.nodes.len() as u32;
            for _ in 0..=random.below(3) {
                let (i, j) = (random.below(count) as usize, random.below(count) as usize);
                match random.below(6) {
                    0 => parts.nodes.swap(i, j),
                    1 => parts.nodes[i] = parts.nodes[j],
                    2 => {
                        let to = random.below(4);
                        let link = [random.bits(), random.below(count), i as u32][random.below(3) as usize];
                        parts.nodes[i].set_child(random.below(2) as usize, to, link);
                    }
                    3 => {
                        bytemuck::cast_slice_mut::<_, u32>(parts.nodes)[random.below(count * 14) as usize] =
                            random.bits()
                    }
                    4 => parts.trails[random.below(40) as usize] = random.bits(),
                    _ if two => {
                        let m = random.below(parts.instances.len() as u32) as usize;
                        parts.instances[m].root = random.below(count + 2);
                    }
                    _ => parts.bottom[0] = random.bits(),
                }
            }
            let same = words(wrong.nodes()) == words(bvh.nodes())
                && words(wrong.tree().instances) == words(bvh.tree().instances)
                && wrong.tree().trails == bvh.tree().trails
                && wrong.plan_of_everything().bottom == bvh.plan_of_everything().bottom;
            let result = wrong.validate();
            assert_eq!(result.is_ok(), same, "{result:?}");
        }
    }
}

#[test]
fn violations_say_where_and_what() {
    let lights = Lights::new(generate::small_triangles(8, 4, 10.0, 1.0, true, 7)).expect("lights");
    let bvh = Bvh::<FullNode<2>, (), 2>::two_level(&lights, &BuildParams::default());
    let root = bvh.tree().root;

    let mut wrong = bvh.clone();
    wrong.parts_mut().nodes[root as usize].set_child(1, kind::INNER, 999);
    let v = wrong.validate().expect_err("a link out of range");
    assert_eq!((v.node, v.slot, v.what, v.found), (root, 1, What::Link, 999));
    assert_eq!(
        v.to_string(),
        format!(
            "node {root}, slot 1, link: expected {}, found 999",
            bvh.nodes().len() - 1
        )
    );

    let mut wrong = bvh.clone();
    wrong.parts_mut().nodes[root as usize].set_child(0, kind::INNER, root);
    let v = wrong.validate().expect_err("a cycle");
    assert_eq!((v.node, v.what, v.expected, v.found), (root, What::Reached, 1, 2));

    let mut wrong = bvh.clone();
    let first = bvh.roots()[0].node;
    let mut children = [0, 1].map(|slot| wrong.nodes()[first as usize].summary(slot));
    let flux = children[0].phi;
    children[0].phi = f32::NAN;
    wrong.parts_mut().nodes[first as usize].set_summaries(&children);
    let v = wrong.validate().expect_err("NaN");
    assert_eq!((v.node, v.slot, v.what), (first, 0, What::Bounds("flux")));
    assert_eq!(
        v.to_string(),
        format!("node {first}, slot 0, flux after a refit: expected {flux:e}, found NaN")
    );
}
