//! Plans of a refit without levels: each task once, and the words of the level-by-level passes whoever comes last.

use lightbvh::climb::{self, Plan};
use lightbvh::{BuildParams, CompactNode, FullNode, INVALID, LightBvh, LightNode, Lights};
use lightbvh_tests::generate::{self, Random, moved};
use proptest::prelude::*;

fn words<T: bytemuck::Pod>(values: &[T]) -> &[u32] {
    bytemuck::cast_slice(values)
}

/// A refit of the whole tree, all invocations interleaved at random.
fn interleaved<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    random: &mut Random,
) -> Vec<N> {
    let tree = bvh.tree();
    let mut nodes = tree.nodes.to_vec();
    let end = nodes.len() as u32;
    let split = if bvh.is_two_level() { tree.root } else { end };
    let parents = climb::parents::<N, W>(&nodes);
    let mut roots = bvh.roots().to_vec();
    for (range, levels) in [(0..split, bvh.bottom_levels()), (split..end, bvh.top_levels())] {
        let is_top = range.start > 0;
        let (mut leaves, mut inner): (Vec<u32>, _) = (range.collect(), levels.nodes().to_vec());
        let (leaf_count, inner_count) = (leaves.len(), inner.len());
        // In any order, and some twice.
        for list in [&mut leaves, &mut inner] {
            list.extend_from_within(..list.len() / 3);
            for i in (1..list.len()).rev() {
                list.swap(i, random.below(i as u32 + 1) as usize);
            }
        }
        let mut plan = Plan::default();
        let starts = plan.add(&parents, leaves, inner);
        assert_eq!(starts as usize, plan.starts.len());
        assert_eq!((plan.leaves.len(), plan.steps.len()), (leaf_count, inner_count));
        if is_top {
            for root in &mut roots {
                *root = lightbvh::refit::root(&nodes, root.node);
            }
        }
        let mut arrived = vec![0; plan.steps.len()];
        let mut climbers = plan.starts.clone();
        let (mut refitted, mut merged) = (0, 0);
        while !climbers.is_empty() {
            let who = random.below(climbers.len() as u32) as usize;
            let at = climbers[who];
            if at.first < at.end {
                let node = plan.leaves[at.first as usize];
                nodes[node as usize] = if is_top {
                    lightbvh::refit::mesh_leaves(&nodes, tree.meshes, &roots, node)
                } else {
                    lightbvh::refit::leaves(&nodes, lights.triangles(), node)
                };
                refitted += 1;
                climbers[who].first += 1;
                continue;
            }
            let mut next = INVALID;
            if at.step != INVALID {
                let step = plan.steps[at.step as usize];
                nodes[step.node as usize] = lightbvh::refit::level(&nodes, step.node);
                merged += 1;
                if step.parent != INVALID {
                    arrived[step.parent as usize] += 1;
                    if arrived[step.parent as usize] == plan.steps[step.parent as usize].children {
                        next = step.parent;
                    }
                }
            }
            climbers[who].step = next;
            if next == INVALID {
                climbers.swap_remove(who);
            }
        }
        assert_eq!((refitted, merged), (leaf_count, inner_count), "every node once");
    }
    nodes
}

fn check<N: LightNode<W>, const W: usize>(lights: &Lights, two: bool, random: &mut Random) {
    let params = BuildParams::default();
    let mut bvh = if two {
        LightBvh::<N, W>::two_level(lights, &params)
    } else {
        LightBvh::<N, W>::single_level(lights, &params)
    };
    let later = moved(lights, random.bits());
    let climbed = interleaved(&bvh, &later, random);
    bvh.refit(&later);
    assert_eq!(words(&climbed), words(bvh.nodes()), "{} {W}", N::NAME);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_order_of_arrival_gives_the_words_of_the_levels(lights in generate::lights(120), seed: u32, two: bool) {
        let random = &mut Random::new(seed);
        check::<CompactNode<2>, 2>(&lights, two, random);
        check::<CompactNode<4>, 4>(&lights, two, random);
        check::<CompactNode<16>, 16>(&lights, two, random);
        check::<FullNode<2>, 2>(&lights, two, random);
        check::<FullNode<8>, 8>(&lights, two, random);
    }

    /// Any lists over any forest: each task once, each step waits for those that come, and each leaf's climb passes its node.
    #[test]
    fn plans_hold_what_is_listed(above in prop::collection::vec(any::<u32>(), 1..60), leaves in prop::collection::vec(0..70u32, 0..60), inner in prop::collection::vec(0..60u32, 0..60)) {
        let parents: Vec<u32> = (0..).zip(&above).map(|(i, up)| if i == 0 || up % 7 == 0 { INVALID } else { up % i }).collect();
        let mut plan = Plan::default();
        plan.add(&[INVALID], vec![0], vec![0]);
        let before = plan.clone();
        let starts = plan.add(&parents, leaves.clone(), inner.clone()) as usize;
        prop_assert_eq!(plan.starts.len(), 1 + starts);
        prop_assert_eq!((&plan.starts[..1], &plan.leaves[..1], &plan.steps[..1]), (&before.starts[..], &before.leaves[..], &before.steps[..]));
        let sorted = |mut list: Vec<u32>| { list.sort_unstable(); list.dedup(); list };
        prop_assert_eq!(plan.leaves.len(), 1 + sorted(leaves.clone()).len());
        prop_assert_eq!(sorted(plan.leaves[1..].to_vec()), sorted(leaves));
        let steps: Vec<u32> = plan.steps[1..].iter().map(|step| step.node).collect();
        prop_assert_eq!(&steps, &sorted(inner));
        for (i, step) in (1u32..).zip(&plan.steps[1..]) {
            let up = parents.get(step.node as usize).and_then(|up| steps.binary_search(up).ok());
            prop_assert_eq!(step.parent, up.map_or(INVALID, |up| up as u32 + 1));
            let children = plan.steps[1..].iter().filter(|other| other.parent == i).count();
            prop_assert_eq!(step.children as usize, children);
            let begin = plan.starts[1..].iter().filter(|start| start.step == i).count();
            prop_assert_eq!(begin, usize::from(children == 0), "a climb from each that waits for none");
        }
        for start in &plan.starts[1..] {
            let mut way = Vec::new();
            let mut at = start.step;
            while at != INVALID {
                way.push(plan.steps[at as usize].node);
                at = plan.steps[at as usize].parent;
            }
            for &node in &plan.leaves[start.first as usize..start.end as usize] {
                let up = parents.get(node as usize).copied().unwrap_or(INVALID);
                let meets = steps.binary_search(&node).is_ok() || steps.binary_search(&up).is_ok();
                prop_assert_eq!(meets, way.contains(&node) || way.contains(&up));
                prop_assert!(meets || start.step == INVALID);
            }
        }
    }
}
