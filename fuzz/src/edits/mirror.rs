//! A copy of a scene's arrays that plans alone keep up to date, as on a device.

use std::ops::Range;

use bytemuck::Pod;
use lightbvh::bvh::{Cursor, RefitPlan};
use lightbvh::refit::{self, BlasRoot};
use lightbvh::tree::Links;
use lightbvh::{
    Bvh, EmissiveTriangle, INVALID, ImportanceModel, Instance, LightNode, LightTree, ShadingPoint,
};

/// The arrays.
pub struct Mirror<N> {
    cursor: Cursor,
    nodes: Vec<N>,
    top: Vec<N>,
    triangles: Vec<EmissiveTriangle>,
    trails: Vec<u32>,
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
    above: Vec<u32>,
    places: Vec<u32>,
    parts: Vec<u32>,
}

impl<N> Default for Mirror<N> {
    fn default() -> Self {
        Self {
            cursor: Cursor::default(),
            nodes: Vec::new(),
            top: Vec::new(),
            triangles: Vec::new(),
            trails: Vec::new(),
            instances: Vec::new(),
            roots: Vec::new(),
            above: Vec::new(),
            places: Vec::new(),
            parts: Vec::new(),
        }
    }
}

/// Copies ranges of an array that may be longer than before.
fn copy<T: Pod>(to: &mut Vec<T>, from: &[T], ranges: &[Range<u32>], all: bool) {
    to.resize(to.len().max(from.len()), T::zeroed());
    if all {
        to[..from.len()].copy_from_slice(from);
    }
    for range in ranges {
        let range = range.start as usize..range.end as usize;
        to[range.clone()].copy_from_slice(&from[range]);
    }
}

fn words<T: Pod>(one: &T) -> &[u8] {
    bytemuck::bytes_of(one)
}

impl<N> Mirror<N> {
    /// Copies what a plan of the scene says, and computes what it lists. Returns the plan.
    pub fn follow<const W: usize>(&mut self, scene: &Bvh<N, (), W>) -> RefitPlan
    where
        N: LightNode<W>,
    {
        let plan = scene.plan(&mut self.cursor);
        let tree = scene.tree();
        let (all, whole_top) = (plan.everything, plan.whole_top);
        // Copy no summaries: the passes compute them.
        let bare = |node: &N| {
            let mut own = N::EMPTY;
            (0..W).for_each(|slot| own.set_child(slot, node.kind(slot), node.link(slot)));
            own
        };
        let nodes: Vec<N> = scene.nodes().iter().map(bare).collect();
        let top: Vec<N> = scene.top_nodes().iter().map(bare).collect();
        copy(&mut self.nodes, &nodes, &plan.written_nodes, all);
        copy(&mut self.top, &top, &plan.written_top, whole_top);
        copy(
            &mut self.triangles,
            scene.triangles(),
            &plan.written_triangles,
            all,
        );
        let of_trails = plan
            .written_trails
            .iter()
            .map(|range| range.start * tree.trail_words..range.end * tree.trail_words);
        copy(&mut self.trails, tree.trails, &of_trails.collect::<Vec<_>>(), all);
        copy(
            &mut self.instances,
            scene.instances(),
            &plan.written_instances,
            all,
        );
        copy(&mut self.above, tree.links.above, &plan.written_above, whole_top);
        copy(
            &mut self.places,
            tree.links.places,
            &plan.written_places,
            whole_top,
        );
        copy(&mut self.parts, tree.links.parts, &plan.written_parts, whole_top);

        for level in plan.bottom.ranges() {
            for &node in &plan.bottom.nodes()[level] {
                self.nodes[node as usize] = refit::bottom(&self.nodes, &self.triangles, node);
            }
        }
        self.roots
            .resize(scene.roots().len(), bytemuck::Zeroable::zeroed());
        for &mesh in &plan.roots {
            self.roots[mesh as usize] = refit::root(&self.nodes, scene.roots()[mesh as usize].node);
        }
        let first = self.nodes.len();
        let mut flat = [&*self.nodes, &*self.top].concat();
        for level in plan.top.ranges() {
            for &node in &plan.top.nodes()[level] {
                let own = first as u32 + node;
                flat[own as usize] = refit::top(&flat, first as u32, &self.instances, &self.roots, own);
            }
        }
        self.top = flat.split_off(first);
        plan
    }

    /// Each node in use has the words of the scene's, and each light its probability.
    pub fn check<I: ImportanceModel<N, W>, const W: usize>(
        &self,
        scene: &Bvh<N, (), W>,
        point: &ShadingPoint,
        random: u32,
    ) where
        N: LightNode<W>,
    {
        let all = scene.plan_of_everything();
        for &node in all.bottom.nodes() {
            let node = node as usize;
            assert_eq!(
                words(&self.nodes[node]),
                words(&scene.nodes()[node]),
                "node {node}"
            );
        }
        for &mesh in &all.roots {
            let mesh = mesh as usize;
            assert_eq!(
                words(&self.roots[mesh]),
                words(&scene.roots()[mesh]),
                "mesh {mesh}"
            );
        }
        for &node in all.top.nodes() {
            let node = node as usize;
            assert_eq!(
                words(&self.top[node]),
                words(&scene.top_nodes()[node]),
                "top {node}"
            );
        }
        let whole = scene.by::<I>();
        let own: LightTree<'_, N, I, W> = LightTree {
            nodes: &self.nodes,
            top: &self.top,
            instances: &self.instances,
            trails: &self.trails,
            links: Links {
                above: &self.above,
                places: &self.places,
                parts: &self.parts,
            },
            ..whole
        };
        for (light, triangle) in (0..).zip(scene.world_lights()) {
            if triangle.mesh != INVALID {
                let [pmf, known] = [own, whole].map(|tree| tree.pmf(point, light, triangle.mesh));
                assert_eq!(pmf.to_bits(), known.to_bits(), "light {light} at {point:?}");
                let found = own.triangle(&self.triangles, light, triangle.mesh);
                assert_eq!(words(&found), words(&triangle));
            }
        }
        assert_eq!(own.sample(point, random), whole.sample(point, random));
    }
}
