//! The passes: which children there are, gathered until every lane has one.

use super::wide::Lanes;
use super::{Target, run as run_list};
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::refit::BlasRoot;
use crate::tree::MeshLeaf;

/// [`refit::leaves`](crate::refit::leaves) over `list`.
pub fn leaves<N: LightNode<W>, const W: usize>(
    nodes: &mut [N],
    triangles: &[EmissiveTriangle],
    list: &[u32],
) {
    run_list(&Leaves { triangles }, nodes, list);
}

/// [`refit::level`](crate::refit::level) over `list`, whose nodes are all of one level.
pub fn level<N: LightNode<W>, const W: usize>(nodes: &mut [N], list: &[u32]) {
    run_list(&Level, nodes, list);
}

/// [`refit::mesh_leaves`](crate::refit::mesh_leaves) over `list`.
pub fn mesh_leaves<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    nodes: &mut [N],
    meshes: &[L],
    roots: &[BlasRoot],
    list: &[u32],
) {
    run_list(&MeshLeaves { meshes, roots }, nodes, list);
}

/// What gives children of one kind their bounds.
pub(super) trait Pass<N, const W: usize>: Sync {
    /// The kind of those children.
    const KIND: u32;

    /// Whether a link leads to something.
    fn leads(&self, all: &[N], link: u32) -> bool;
    /// The bounds of what the links lead to; lanes from `links.len()` on may be anything.
    fn bounds(&self, all: &[N], links: &[u32]) -> Lanes<W>;
}

struct Leaves<'a> {
    triangles: &'a [EmissiveTriangle],
}

impl<N: LightNode<W>, const W: usize> Pass<N, W> for Leaves<'_> {
    const KIND: u32 = kind::LIGHT;

    #[inline(always)]
    fn leads(&self, _: &[N], link: u32) -> bool {
        (link as usize) < self.triangles.len()
    }

    #[inline(always)]
    fn bounds(&self, _: &[N], links: &[u32]) -> Lanes<W> {
        let mut triangles = [EmissiveTriangle {
            p: [[0.0; 3]; 3],
            radiance: [0.0; 3],
            mesh: 0,
            flags: 0,
        }; W];
        for (triangle, &link) in triangles.iter_mut().zip(links) {
            *triangle = self.triangles[link as usize];
        }
        Lanes::of_triangles(&triangles)
    }
}

struct Level;

impl<N: LightNode<W>, const W: usize> Pass<N, W> for Level {
    const KIND: u32 = kind::INNER;

    #[inline(always)]
    fn leads(&self, all: &[N], link: u32) -> bool {
        (link as usize) < all.len()
    }

    #[inline(always)]
    fn bounds(&self, all: &[N], links: &[u32]) -> Lanes<W> {
        let mut children = [N::EMPTY; W];
        for (child, &link) in children.iter_mut().zip(links) {
            *child = all[link as usize];
        }
        Lanes::merged(&children)
    }
}

struct MeshLeaves<'a, L> {
    meshes: &'a [L],
    roots: &'a [BlasRoot],
}

impl<N: LightNode<W>, L: MeshLeaf, const W: usize> Pass<N, W> for MeshLeaves<'_, L> {
    const KIND: u32 = kind::MESH;

    #[inline(always)]
    fn leads(&self, _: &[N], link: u32) -> bool {
        let mesh = self.meshes.get(link as usize);
        mesh.is_some_and(|mesh| (mesh.blas() as usize) < self.roots.len())
    }

    #[inline(always)]
    fn bounds(&self, _: &[N], links: &[u32]) -> Lanes<W> {
        let mut meshes = [L::world(0, 0); W];
        let mut roots = [BlasRoot::new(0, &crate::LightBounds::EMPTY); W];
        for ((mesh, root), &link) in meshes.iter_mut().zip(&mut roots).zip(links) {
            *mesh = self.meshes[link as usize];
            *root = self.roots[mesh.blas() as usize];
        }
        Lanes::in_world(&meshes, &roots)
    }
}

/// Children waiting until every lane has one.
struct Batch<const W: usize> {
    entries: [u32; W],
    nodes: [u32; W],
    slots: [u32; W],
    links: [u32; W],
    count: usize,
}

/// Runs a pass over `list` on this thread.
pub(super) fn run<N: LightNode<W>, P: Pass<N, W>, const W: usize>(
    pass: &P,
    target: &mut impl Target<N>,
    list: &[u32],
) {
    let mut batch = Batch {
        entries: [0; W],
        nodes: [0; W],
        slots: [0; W],
        links: [0; W],
        count: 0,
    };
    for (entry, &node) in (0..).zip(list) {
        for slot in 0..W {
            let all = target.all();
            let own = &all[node as usize];
            let link = own.link(slot);
            if own.kind(slot) == P::KIND && pass.leads(all, link) {
                let lane = batch.count;
                batch.entries[lane] = entry;
                batch.nodes[lane] = node;
                batch.slots[lane] = slot as u32;
                batch.links[lane] = link;
                batch.count += 1;
                if batch.count == W {
                    finish(pass, target, &batch);
                    batch.count = 0;
                }
            }
        }
    }
    if batch.count > 0 {
        finish(pass, target, &batch);
    }
}

/// Computes the waiting children and puts them where they belong.
fn finish<N: LightNode<W>, P: Pass<N, W>, const W: usize>(
    pass: &P,
    target: &mut impl Target<N>,
    batch: &Batch<W>,
) {
    let links = &batch.links[..batch.count];
    let bounds = pass.bounds(target.all(), links);
    let mut packed = N::EMPTY;
    for (lane, &link) in links.iter().enumerate() {
        packed.set_child(lane, P::KIND, link);
    }
    bounds.pack(&mut packed);
    for lane in 0..links.len() {
        let own = target.own(batch.entries[lane] as usize, batch.nodes[lane]);
        own.copy_child(batch.slots[lane] as usize, &packed, lane);
    }
}
