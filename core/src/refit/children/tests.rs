//! Nodes child by child are nodes as a whole, to the bit, in every layout.

use alloc::vec::Vec;

use bytemuck::cast_slice;

use super::*;
use crate::bvh::Cursor;
use crate::kit::Random;
use crate::kit::scenes::{Lamp, bare, lamps};
use crate::light::AnyLight;
use crate::node::{CompactNode, LinkedSpotMomentNode, MomentNode, SpotMomentNode, TwoSidedMomentNode};
use crate::trail::leaf;
use crate::{Bvh, Transform};

/// Two meshes, a small and a large one, each twice, one of the instances of the larger turned and scaled.
fn scene<N: Node<W>, const W: usize>(random: &mut Random) -> Bvh<(N, ()), W>
where
    N::Light: Lamp,
{
    let mut bvh = Bvh::default();
    for count in [3, 200] {
        let mesh = bvh.add_mesh(lamps(random, count)).expect("lights");
        let maps = [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]].map(|x| Transform {
            columns: [x, [0.0, 1.0 + x[2] / 2.0, 0.0], [x[2] - 2.0 * x[0], 0.0, 0.0]],
            ..Transform::at((random.vector() * 50.0).to_array())
        });
        for transform in maps {
            bvh.add_instance(mesh, transform).expect("an instance");
        }
    }
    for k in 0..60 {
        let mesh = bvh.add_mesh(lamps(random, 1 + k % 2)).expect("lights");
        let at = Transform::at((random.vector() * 50.0).to_array());
        bvh.add_instance(mesh, at).expect("an instance");
    }
    bvh.refit();
    bvh
}

/// All nodes in one array, as on a device, those of the top level last, and where they begin.
fn flat<N: Node<W>, const W: usize>(bvh: &Bvh<(N, ()), W>) -> (Vec<N>, u32) {
    let [nodes, top] = [bvh.view().nodes(), bvh.view().top_nodes()];
    ([nodes, top].concat(), nodes.len() as u32)
}

/// The node of which each child is computed by itself.
fn by_children<N: Node<W>, const W: usize, const ROWS: usize>(
    nodes: &[N],
    index: u32,
    child: impl Fn(usize) -> Child<N::Summary>,
) -> N {
    assert_eq!(child_rows::<N, W>(), ROWS);
    let mut children = [[[0; W]; ROWS]];
    (0..W).for_each(|slot| child(slot).put(&mut children, 0, slot));
    let mut blank = nodes.to_vec();
    blank[index as usize] = bare(&blank[index as usize]);
    assembled(&blank, index, &children, 0)
}

fn same<N: Node<W>, const W: usize>(a: &N, b: &N) -> bool {
    cast_slice::<N, u32>(core::slice::from_ref(a)) == cast_slice::<N, u32>(core::slice::from_ref(b))
}

fn check<N: Node<W>, const W: usize, const ROWS: usize>()
where
    N::Light: Lamp,
{
    let bvh = scene::<N, W>(&mut Random(5));
    let plan = Cursor::default().plan(&bvh);
    let (nodes, first) = flat(&bvh);
    let (nodes, view) = (&*nodes, bvh.view());
    let (lights, instances) = (view.lights(), view.instances());
    assert!(plan.bottom.nodes().len() > 20 && plan.top.nodes().len() > 4);
    for &index in plan.bottom.nodes() {
        let parts = by_children::<N, W, ROWS>(nodes, index, |slot| bottom_child(nodes, lights, index, slot));
        assert!(same(&nodes[index as usize], &parts), "{} {W}: {index}", N::NAME);
    }
    for index in plan.top.nodes().iter().map(|node| first + node) {
        let parts = by_children::<N, W, ROWS>(nodes, index, |slot| {
            top_child(nodes, first, lights, instances, index, slot)
        });
        assert!(same(&nodes[index as usize], &parts), "{} {W}: {index}", N::NAME);
    }
}

#[test]
fn nodes_child_by_child_are_nodes_as_a_whole() {
    check::<MomentNode<8>, 8, PLAIN_ROWS>();
    check::<MomentNode<4>, 4, PLAIN_ROWS>();
    check::<TwoSidedMomentNode<16>, 16, PLAIN_ROWS>();
    check::<CompactNode<4>, 4, PLAIN_ROWS>();
}

#[test]
fn limits_go_by_way_of_children_too() {
    check::<SpotMomentNode<8, AnyLight>, 8, LIMITED_ROWS>();
    check::<LinkedSpotMomentNode<8, AnyLight>, 8, LIMITED_ROWS>();
    // They are there to be lost.
    let bvh = scene::<LinkedSpotMomentNode<8, AnyLight>, 8>(&mut Random(5));
    let of =
        |node: &LinkedSpotMomentNode<8, AnyLight>, slot| (node.mask(slot), node.beam(slot), node.end(slot));
    let (nodes, _) = flat(&bvh);
    let all = || {
        nodes
            .iter()
            .flat_map(|node| (0..8).map(move |slot| of(node, slot)))
    };
    assert!(all().any(|(mask, ..)| mask.count_ones() > 1));
    assert!(all().any(|(_, beam, _)| beam.is_narrow()) && all().any(|(.., end)| end < 100.0));
}

/// Links just beyond the end of an array, and to the other level.
#[test]
fn dangling_links_are_empty_children() {
    type Layout = LinkedSpotMomentNode<8, AnyLight>;
    let bvh = scene::<Layout, 8>(&mut Random(5));
    let (lights, mut instances) = (bvh.view().lights(), bvh.view().instances().to_vec());
    let mut nodes = [bvh.view().nodes(), &[Layout::EMPTY]].concat();
    let (at, end) = (bvh.view().nodes().len(), nodes.len() as u32);
    let known = instances.len() as u32;
    instances.extend([instances[0]; 2]);
    instances[known as usize].root = end;
    let alone = &mut instances[known as usize + 1];
    (alone.root, alone.first_light) = (INVALID, lights.len() as u32);
    nodes[at].set_child(0, kind::LIGHT, lights.len() as u32);
    nodes[at].set_child(1, kind::INNER, end);
    nodes[at].set_child(2, kind::MESH, known + 2);
    nodes[at].set_child(3, kind::MESH, known);
    nodes[at].set_child(4, kind::MESH, leaf(known, 1));
    nodes[at].set_child(5, kind::MESH, known + 1);
    nodes[at].set_child(6, kind::EMPTY, 0);
    let bottom = |nodes: &[Layout], slot| bottom_child(nodes, lights, at as u32, slot);
    let top = |nodes: &[Layout], slot| top_child(nodes, 0, lights, &instances, at as u32, slot);
    for slot in 0..7 {
        assert_eq!(bottom(&nodes, slot), Child::EMPTY, "{slot}");
        assert_eq!(top(&nodes, slot), Child::EMPTY, "{slot}");
    }
    nodes[at].set_child(0, kind::LIGHT, 0);
    nodes[at].set_child(2, kind::MESH, 0);
    assert_ne!(bottom(&nodes, 0), Child::EMPTY);
    assert_eq!(bottom(&nodes, 2), Child::EMPTY);
    assert_ne!(top(&nodes, 2), Child::EMPTY);
}
