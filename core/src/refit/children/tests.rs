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
