//! Both levels as deep as bit trails are long.

use bytemuck::Zeroable;
use lightbvh::TreeWords;
use lightbvh::node::kind;
use lightbvh::refit::BlasRoot;
use lightbvh::trail::{BitTrail, max_levels, place};
use lightbvh::{EmissiveTriangle, Instance, LightNode, exact};

use super::built::checked;
use super::passes::passes_of;
use crate::known::tree::Tree;

/// A chain of nodes from node `first` on: children `0..children` of `kind` on the way, the last two in the last node. Gives the
/// trails of the children, and the node of the chain and the slot where each is.
fn chain<N: LightNode<W>, const W: usize>(
    nodes: &mut Vec<N>,
    of: u32,
    first_child: u32,
) -> (Vec<BitTrail>, Vec<(u32, u32)>) {
    let (levels, width) = (max_levels(W), W as u32);
    let first = nodes.len() as u32;
    let (mut trails, mut places) = (Vec::new(), Vec::new());
    let mut way = BitTrail::default();
    for level in 0..levels {
        let mut node = N::EMPTY;
        let (own, next) = (level % width, (level * 3 + 1) % width);
        let next = if next == own { (own + 1) % width } else { next };
        node.set_child(own as usize, of, first_child + level);
        trails.push(way.with::<W>(level, own));
        places.push((level, own));
        if level + 1 == levels {
            node.set_child(next as usize, of, first_child + levels);
            trails.push(way.with::<W>(level, next));
            places.push((level, next));
        } else {
            node.set_child(next as usize, kind::INNER, first + level + 1);
            way = way.with::<W>(level, next);
        }
        nodes.push(node);
    }
    (trails, places)
}

pub(super) fn deep<N: LightNode<W>, const W: usize>() -> Tree<N, W> {
    let levels = max_levels(W);
    // Lights at halving distances along x, all of the same flux but for rounding; those of the last mesh along y.
    let light = |x: f32, y: f32, size: f32, mesh: u32| EmissiveTriangle {
        p: [[x, y, 0.0], [x, y + size, 0.0], [x, y, size]],
        radiance: [exact::pow2(20), 1.0, 0.0],
        mesh,
        flags: 1,
    };
    let (mut nodes, mut triangles, mut roots) = (Vec::<N>::new(), Vec::new(), Vec::new());
    let mut trails = Vec::new();
    for mesh in 0..levels {
        let x = exact::pow2(30 - mesh as i32);
        let mut node = N::EMPTY;
        node.set_child(mesh as usize % W, kind::LIGHT, triangles.len() as u32);
        trails.push(BitTrail::default().with::<W>(0, mesh % W as u32));
        roots.push(nodes.len() as u32);
        nodes.push(node);
        triangles.push(light(x, 0.0, x * 0.125, mesh));
    }
    roots.push(nodes.len() as u32);
    trails.extend(chain(&mut nodes, kind::LIGHT, triangles.len() as u32).0);
    for i in 0..=levels {
        let y = exact::pow2(-(i as i32));
        triangles.push(light(0.0, y, y * 0.125, levels));
    }
    let root = nodes.len() as u32;
    let (_, places) = chain(&mut nodes, kind::MESH, 0);
    let inner = |level: u32| (0..W).find(|&slot| nodes[(root + level) as usize].kind(slot) == kind::INNER);
    let instances: Vec<Instance> = (0..=levels)
        .map(|mesh| {
            let own = |light: &&EmissiveTriangle| light.mesh == mesh;
            let (node, slot) = places[mesh as usize];
            // Node `mesh` of the chain hangs in the one before it.
            let above = mesh.checked_sub(1).filter(|_| mesh < levels);
            let above = above.and_then(|above| Some(place::<W>(above, inner(above)? as u32)));
            Instance {
                root: roots[mesh as usize],
                blas: mesh,
                // Lights stand by mesh, one in each but the last.
                first: mesh,
                first_triangle: mesh,
                count: triangles.iter().filter(own).count() as u32,
                listed: mesh,
                place: place::<W>(node, slot),
                above: above.unwrap_or(u32::MAX),
                ..Instance::IDENTITY
            }
        })
        .collect();
    let roots: Vec<BlasRoot> = roots
        .iter()
        .map(|&node| BlasRoot {
            node,
            ..BlasRoot::zeroed()
        })
        .collect();
    let triangles_count = triangles.len() as u32;
    let lights = checked(triangles);
    Tree {
        passes: passes_of(&nodes, &roots, root, true),
        nodes,
        meshes_of_lights: lights.triangles().iter().map(|t| t.mesh).collect(),
        triangles: lights.triangles().to_vec(),
        instances,
        roots,
        trails: trails.iter().flat_map(|t| [t.low, t.high]).collect(),
        push: TreeWords {
            root,
            trail_words: 2,
            live: levels + 1,
            lights: triangles_count,
            depth: 2 * levels,
        },
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}
