//! Nodes child by child are nodes as a whole, to the bit, in every layout.

use alloc::vec;
use alloc::vec::Vec;

use bytemuck::cast_slice;

use super::*;
use crate::kit::{Random, narrow, normalize, wide};
use crate::light::{AnyLight, EmissiveTriangle, LinkedAny, LinkedTriangle, SpotLight, TWO_SIDED};
use crate::node::{
    CompactNode, FullMomentNode, FullNode, LeanMomentNode, LinkedMomentNode, LinkedSpotMomentNode, Lit,
    MomentNode, SpotMomentNode, TwoSidedMomentNode,
};
use crate::refit::{bottom, top};
use crate::{Bvh, Transform};

/// A light for the meshes here.
trait Lamp: Sized {
    fn any(random: &mut Random) -> Self;
}

impl Lamp for EmissiveTriangle {
    fn any(random: &mut Random) -> Self {
        let at = random.vector() * 9.0;
        let [b, c] = [0; 2].map(|_| at + random.vector());
        Self {
            p: [at, b, c].map(|v| v.to_array()),
            radiance: [random.unit(), 1.0, 2.0],
            mesh: 0,
            flags: if random.unit() < 0.5 { TWO_SIDED } else { 0 },
        }
    }
}

impl Lamp for AnyLight {
    fn any(random: &mut Random) -> Self {
        if random.unit() < 0.3 {
            return EmissiveTriangle::any(random).into();
        }
        SpotLight {
            p: (random.vector() * 9.0).to_array(),
            intensity: [1.0; 3],
            // About the same way, so that nodes keep beams.
            axis: normalized(Vec3::new(0.1 * random.signed(), -1.0, 0.1 * random.signed())),
            cos_inner: 0.9,
            cos_outer: 0.8,
            range: 0.0,
            mesh: 0,
        }
        .into()
    }
}

impl Lamp for LinkedTriangle {
    fn any(random: &mut Random) -> Self {
        Self {
            light: EmissiveTriangle::any(random),
            mask: 1 << (random.unit() * 20.0) as u32,
        }
    }
}

impl Lamp for LinkedAny {
    fn any(random: &mut Random) -> Self {
        Self {
            light: AnyLight::any(random),
            mask: 1 << (random.unit() * 20.0) as u32,
        }
    }
}

fn normalized(v: Vec3) -> [f32; 3] {
    narrow(normalize(wide(v))).to_array()
}

/// Two meshes, a small and a large one, each twice, one of the instances of the larger turned and scaled.
fn scene<N: Node<W>, const W: usize>(random: &mut Random) -> Bvh<N, (), W>
where
    N::Light: Lamp,
{
    let mut bvh = Bvh::default();
    for count in [3, 200] {
        let lights: Vec<N::Light> = (0..count).map(|_| N::Light::any(random)).collect();
        let mesh = bvh.add_mesh(lights).expect("lights");
        let maps = [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]].map(|x| Transform {
            columns: [x, [0.0, 1.0 + x[2] / 2.0, 0.0], [x[2] - 2.0 * x[0], 0.0, 0.0]],
            ..Transform::at((random.vector() * 50.0).to_array())
        });
        for transform in maps {
            bvh.add_instance(mesh, transform).expect("an instance");
        }
    }
    for _ in 0..40 {
        let mesh = bvh.add_mesh(vec![N::Light::any(random)]).expect("a light");
        let at = Transform::at((random.vector() * 50.0).to_array());
        bvh.add_instance(mesh, at).expect("an instance");
    }
    bvh.refit();
    bvh
}

/// The node of which each child is computed by itself, the last first, beside other nodes' children.
fn by_children<N: Node<W>, const W: usize, const ROWS: usize>(
    nodes: &[N],
    index: u32,
    child: impl Fn(usize) -> Child<N::Summary>,
) -> N {
    assert_eq!(child_rows::<N, W>(), ROWS);
    let mut children = [[[0xdead_beef; W]; ROWS]; 3];
    for slot in (0..W).rev() {
        child(slot).put(&mut children, 1, slot);
        child(slot).put(&mut children, 3, slot);
    }
    let untouched = |part: &Children<W, ROWS>| part.iter().flatten().all(|&word| word == 0xdead_beef);
    assert!(untouched(&children[0]) && untouched(&children[2]));
    let mut blank = nodes.to_vec();
    for slot in 0..W {
        let (to, link) = (blank[index as usize].kind(slot), blank[index as usize].link(slot));
        blank[index as usize].set_child(slot, to, link);
    }
    assert!(same(
        &assembled(&blank, index, &children, 3),
        &blank[index as usize]
    ));
    assembled(&blank, index, &children, 1)
}

fn same<N: Node<W>, const W: usize>(a: &N, b: &N) -> bool {
    cast_slice::<N, u32>(core::slice::from_ref(a)) == cast_slice::<N, u32>(core::slice::from_ref(b))
}

fn check<N: Node<W>, const W: usize, const ROWS: usize>()
where
    N::Light: Lamp,
{
    let bvh = scene::<N, W>(&mut Random(5));
    let (tree, plan) = (bvh.tree(), bvh.plan_of_everything());
    let (nodes, triangles, roots) = (tree.nodes, bvh.triangles(), bvh.roots());
    assert!(plan.bottom.nodes().len() > 20 && plan.top.nodes().len() > 4);
    for &index in plan.bottom.nodes() {
        let whole = bottom::<N, W>(nodes, triangles, index);
        let parts =
            by_children::<N, W, ROWS>(nodes, index, |slot| bottom_child(nodes, triangles, index, slot));
        assert!(same(&whole, &parts), "{} {W}: {index}", N::NAME);
    }
    for &index in plan.top.nodes() {
        let whole = top::<N, W>(nodes, tree.instances, roots, index);
        let parts = by_children::<N, W, ROWS>(nodes, index, |slot| {
            top_child(nodes, tree.instances, roots, index, slot)
        });
        assert!(same(&whole, &parts), "{} {W}: {index}", N::NAME);
    }
}

#[test]
fn nodes_child_by_child_are_nodes_as_a_whole() {
    check::<MomentNode<8>, 8, PLAIN_ROWS>();
    check::<MomentNode<4>, 4, PLAIN_ROWS>();
    check::<TwoSidedMomentNode<16>, 16, PLAIN_ROWS>();
    check::<FullMomentNode<8>, 8, PLAIN_ROWS>();
    check::<LeanMomentNode<8>, 8, PLAIN_ROWS>();
    check::<CompactNode<4>, 4, PLAIN_ROWS>();
    check::<FullNode<8>, 8, PLAIN_ROWS>();
}

#[test]
fn limits_go_by_way_of_children_too() {
    check::<Lit<LinkedMomentNode<8>, LinkedTriangle>, 8, LIMITED_ROWS>();
    check::<Lit<SpotMomentNode<8>, AnyLight>, 8, LIMITED_ROWS>();
    check::<Lit<LinkedSpotMomentNode<8>, LinkedAny>, 8, LIMITED_ROWS>();
    // They are there to be lost.
    let bvh = scene::<Lit<LinkedSpotMomentNode<8>, LinkedAny>, 8>(&mut Random(5));
    let of = |node: &Lit<LinkedSpotMomentNode<8>, LinkedAny>, slot| (node.mask(slot), node.beam(slot));
    let all = || {
        bvh.tree()
            .nodes
            .iter()
            .flat_map(|node| (0..8).map(move |slot| of(node, slot)))
    };
    assert!(all().any(|(mask, _)| mask.count_ones() > 1) && all().any(|(_, beam)| beam.is_narrow()));
}

/// Links to what is just beyond the end, and to what is of the other level.
#[test]
fn what_is_not_there_is_no_child() {
    type Layout = Lit<LinkedSpotMomentNode<8>, LinkedAny>;
    let bvh = scene::<Layout, 8>(&mut Random(5));
    let tree = bvh.tree();
    let (triangles, instances, roots) = (bvh.triangles(), tree.instances, bvh.roots());
    let mut nodes = tree.nodes.to_vec();
    let mut alien = instances.to_vec();
    alien[0].blas = roots.len() as u32;
    nodes[0].set_child(0, kind::LIGHT, triangles.len() as u32);
    let end = nodes.len() as u32;
    nodes[0].set_child(1, kind::INNER, end);
    nodes[0].set_child(2, kind::MESH, instances.len() as u32);
    nodes[0].set_child(3, kind::MESH, 0);
    nodes[0].set_child(4, kind::LIGHT, 0);
    nodes[0].set_child(5, kind::EMPTY, 0);
    for slot in [0, 1, 2, 3, 5] {
        assert_eq!(bottom_child(&nodes, triangles, 0, slot), Child::EMPTY, "{slot}");
    }
    for slot in 0..6 {
        assert_eq!(top_child(&nodes, &alien, roots, 0, slot), Child::EMPTY, "{slot}");
    }
    // A root that is no node.
    let mut lost = roots.to_vec();
    let blas = instances[0].blas as usize;
    assert_ne!(top_child(&nodes, instances, &lost, 0, 3).limits, Limits::NONE);
    lost[blas].node = end;
    assert_eq!(top_child(&nodes, instances, &lost, 0, 3).limits, Limits::NONE);
}

/// The union of the masks of the lights below a node of a bottom level.
fn masks_below(nodes: &[Lit<LinkedSpotMomentNode<8>, LinkedAny>], lights: &[LinkedAny], node: u32) -> u32 {
    let node = &nodes[node as usize];
    let of = |slot| match node.kind(slot) {
        kind::LIGHT => lights[node.link(slot) as usize].mask,
        kind::INNER => masks_below(nodes, lights, node.link(slot)),
        _ => 0,
    };
    (0..8).fold(0, |all, slot| all | of(slot))
}

/// Masks are the unions over the lights of the mesh, and beams stand where the instance is.
#[test]
fn the_top_level_knows_the_limits_of_its_meshes() {
    type Layout = Lit<LinkedSpotMomentNode<8>, LinkedAny>;
    let bvh = scene::<Layout, 8>(&mut Random(5));
    let (tree, plan) = (bvh.tree(), bvh.plan_of_everything());
    let (mut partial, mut narrow) = (0, 0);
    for &index in plan.top.nodes() {
        for slot in 0..8 {
            let node = &tree.nodes[index as usize];
            if node.kind(slot) == kind::MESH {
                let instance = &tree.instances[node.link(slot) as usize];
                let root = bvh.roots()[instance.blas as usize].node;
                let union = masks_below(tree.nodes, bvh.triangles(), root);
                let child = top_child(tree.nodes, tree.instances, bvh.roots(), index, slot);
                assert_eq!(child.limits.mask, union);
                partial += u32::from(union != u32::MAX);
                if child.limits.beam.is_narrow() {
                    let away = child.limits.beam.c - child.summary.c;
                    assert!(crate::vector::length_squared(away) < 30.0 * 30.0, "{away}");
                    narrow += 1;
                }
            }
        }
    }
    assert!(partial > 40 && narrow > 20, "{partial} {narrow}");
}
