//! Where an instance goes.

use super::super::cost::Cluster;
use super::super::insert::Step;
use super::*;
use crate::node::kind;
use crate::{EmissiveTriangle, FullMomentNode, Moments};

const LOW: glam::Vec3 = glam::Vec3::new(1.0, 1.0, 0.5);

type Own = Bvh<FullMomentNode<4>, Moments, 4>;

/// Meshes of three lamps, from 0.1 to 40 m wide, in a room of 20 m, all lower than wide: of what is higher than that along its
/// normal a node knows less than all.
fn scattered(seed: u32) -> Own {
    let random = &mut Random(seed);
    let mut scene = Own::default();
    for _ in 0..24 {
        let wide = (0.1 * 400.0_f64.powf(f64::from(random.unit()))) as f32;
        let lamps = [0; 3].map(|_| {
            let [x, y, z] = (random.vector() * wide * LOW).to_array();
            EmissiveTriangle {
                radiance: [0.1 + random.unit(); 3],
                ..triangle([[x, y, z], [x + 0.1, y, z], [x, y + 0.1, z]])
            }
        });
        let mesh = scene.add_mesh(lamps.to_vec()).expect("a mesh");
        let place = (random.vector() * 10.0 * LOW).to_array();
        scene.add_instance(mesh, Transform::at(place)).expect("one");
    }
    scene.refit();
    scene
}

/// The instances below a child.
fn below(scene: &Own, kind: u32, link: u32, found: &mut vec::Vec<Cluster>) {
    if kind == kind::INNER {
        let own = &scene.nodes[link as usize];
        (0..4).for_each(|slot| below(scene, own.kind(slot), own.link(slot), found));
    } else if kind != kind::EMPTY {
        found.push(Cluster::new(&scene.in_world(link), 1));
    }
}

/// Flux times variance of position of a set, by definition.
fn cost(set: &[Cluster]) -> f64 {
    let phi: f64 = set.iter().map(|own| own.phi).sum();
    let mean = [0, 1, 2].map(|k| set.iter().map(|own| own.phi * own.center[k]).sum::<f64>() / phi);
    let squared = |own: &Cluster| (0..3).map(|k| (own.center[k] - mean[k]).powi(2)).sum::<f64>();
    set.iter().map(|own| own.phi * (own.spread + squared(own))).sum()
}

/// What a tree costs is the sum, over the children of all nodes, of what the set below each costs. Of all that may be done in a
/// full node, a walk goes where that sum becomes the least, were the item to stay in the node that it enters.
#[test]
fn an_instance_goes_where_the_tree_costs_least() {
    let mut seen = [0; 3];
    for seed in 0..2000 {
        let mut scene = scattered(seed);
        let index = seed % 24;
        let item = scene.item_of(index);
        scene.remove_leaf(index);
        scene.refit();
        let node = scene.nodes[scene.top.root as usize];
        if (0..4).any(|slot| node.kind(slot) == kind::EMPTY) {
            continue;
        }
        let sets = [0, 1, 2, 3].map(|slot| {
            let mut set = vec![];
            below(&scene, node.kind(slot), node.link(slot), &mut set);
            set
        });
        let with = |a: &[Cluster], b: &[Cluster]| cost(&[a, b].concat());
        let own = [item.cluster];
        let added = |step: &Step| match *step {
            Step::Enter(slot) => with(&sets[slot], &own) - cost(&sets[slot]) + cost(&own),
            Step::Pair(slot) => with(&sets[slot], &own) + cost(&own),
            Step::Merge(a, b) => with(&sets[a], &sets[b]) + cost(&own),
            Step::Place(_) => f64::INFINITY,
        };
        let nodes = (0..4).filter(|&slot| node.kind(slot) == kind::INNER);
        let pairs = (0..4).flat_map(|a| (a + 1..4).map(move |b| Step::Merge(a, b)));
        let all = nodes.map(Step::Enter).chain((0..4).map(Step::Pair)).chain(pairs);
        let least = all.map(|step| added(&step)).fold(f64::INFINITY, f64::min);
        let chosen = scene.step(scene.top.root, 0, &item).expect("a place");
        assert!(
            added(&chosen) <= least * (1.0 + 1e-4),
            "{seed}: {chosen:?} costs {} of {least}",
            added(&chosen)
        );
        seen[match chosen {
            Step::Enter(_) => 0,
            Step::Pair(_) => 1,
            _ => 2,
        }] += 1;
    }
    assert!(seen.iter().all(|&count| count > 5), "{seen:?}");
}
