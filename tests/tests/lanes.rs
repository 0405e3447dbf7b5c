//! The CPU's wide and parallel refit against the shared functions that it calls: every word, whatever the inputs, the order
//! and the number of threads.

use lightbvh::lanes;
use lightbvh::refit::{self, BlasRoot};
use lightbvh::{
    CompactNode, Edit, EmissiveTriangle, FullNode, Instance, LightBounds, LightNode, MeshLeaf, MeshLight,
    Scene,
};
use lightbvh_tests::edits::add_mesh;
use lightbvh_tests::generate::{self, Random, any_bounds, extreme_triangle};
use lightbvh_tests::placing;
use proptest::prelude::*;

/// Nodes with any children, bounds of the whole domain, and links a little beyond `links`.
fn nodes<N: LightNode<W>, const W: usize>(random: &mut Random, count: u32, links: u32) -> Vec<N> {
    // Cones and boxes take long to draw; all nodes choose from these.
    let drawn: Vec<LightBounds> = (0..256).map(|_| any_bounds(random)).collect();
    (0..count)
        .map(|_| {
            let mut node = N::EMPTY;
            for slot in 0..W {
                node.set_child(slot, random.below(4), random.below(links + links / 16 + 1));
                let mut bounds = drawn[random.below(256) as usize];
                if random.below(16) == 0 {
                    bounds.phi = 0.0;
                }
                node.set_bounds(slot, &bounds);
            }
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

/// Instances as a scene places them, and ones that lead nowhere.
fn instances(random: &mut Random) -> Vec<Instance> {
    let mut scene = Scene::<CompactNode<2>, 2>::default();
    let triangles = generate::small_triangles(4, 4, 1.0, 0.3, true, random.bits());
    let mesh = add_mesh(&mut scene, triangles);
    let add = (0..64)
        .map(|_| {
            let exponent = random.below(30) as i32 - 5;
            let kind = placing::kind(random);
            let transform = placing::transform(random, kind, lightbvh::exact::pow2(exponent));
            let radiance = if random.below(8) == 0 {
                0.0
            } else {
                generate::log_uniform(random, -50, 50)
            };
            Edit::AddInstance {
                mesh,
                transform,
                radiance,
            }
        })
        .collect();
    scene.update(add).expect("instances");
    let mut instances = scene.instances().to_vec();
    for instance in &mut instances {
        instance.blas = random.below(70);
    }
    instances
}

fn check<N: LightNode<W>, const W: usize>(seed: u32, count: u32) {
    let random = &mut Random::new(seed);
    let triangles: Vec<EmissiveTriangle> = (0..200).map(|_| extreme_triangle(random)).collect();
    let leaves: Vec<N> = nodes(random, count, 200);
    let list = list(random, count);
    let expected = one_by_one(&leaves, &list, |nodes, i| refit::leaves(nodes, &triangles, i));
    let found = words(&leaves, |nodes| lanes::leaves(nodes, &triangles, &list));
    assert!(expected == found, "leaves");

    // The children are other nodes than those of the list, as in a tree.
    let mut both: Vec<N> = nodes(random, 2 * count, 0);
    for node in &mut both[..count as usize] {
        for slot in 0..W {
            node.relink(slot, count + random.below(count + count / 16 + 1));
        }
    }
    let expected = one_by_one(&both, &list, refit::level);
    let found = words(&both, |nodes| lanes::level(nodes, &list));
    assert!(expected == found, "level");

    let roots: Vec<BlasRoot> = (0..64).map(|i| BlasRoot::new(i, &any_bounds(random))).collect();
    let meshes = instances(random);
    let top: Vec<N> = nodes(random, count, meshes.len() as u32);
    let expected = one_by_one(&top, &list, |nodes, i| {
        refit::mesh_leaves(nodes, &meshes, &roots, i)
    });
    let found = words(&top, |nodes| lanes::mesh_leaves(nodes, &meshes, &roots, &list));
    assert!(expected == found, "instances");
    let meshes: Vec<MeshLight> = (0..70).map(|i| MeshLight::world(0, i)).collect();
    let expected = one_by_one(&top, &list, |nodes, i| {
        refit::mesh_leaves(nodes, &meshes, &roots, i)
    });
    let found = words(&top, |nodes| lanes::mesh_leaves(nodes, &meshes, &roots, &list));
    assert!(expected == found, "mesh lights");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn lanes_are_the_shared_functions(seed: u32, count in 1..90u32) {
        check::<CompactNode<2>, 2>(seed, count);
        check::<CompactNode<4>, 4>(seed, count);
        check::<CompactNode<8>, 8>(seed, count);
        check::<CompactNode<16>, 16>(seed, count);
        check::<FullNode<2>, 2>(seed, count);
        check::<FullNode<4>, 4>(seed, count);
    }
}

/// Enough nodes that they are shared out, and not a multiple of any block.
#[test]
fn threads_do_not_show() {
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| check::<CompactNode<4>, 4>(7, 40_001));
    }
}
