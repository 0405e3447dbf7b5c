//! The ray BVH: built by `obvhs`, laid out for the kernels' walk.

use std::collections::VecDeque;

use glam::Vec3A;
use lightbvh_kernels::shading::grid::{MAX_COORDINATE, STEP, snap};
use lightbvh_kernels::shading::textures::NoTextures;
use lightbvh_kernels::shading::trace::{
    LANES, MAX_DEPTH, MAX_TRIANGLES, NONE, RayNode, SurfaceTriangle, Surfaces, TriangleBlock, WIDTH,
};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::PlocBuilder;
use obvhs::triangle::Triangle;

/// Boxes grow by this part of the scene's largest coordinate: two units in its last place, more than the ray-triangle
/// test errs on hits of rays that begin within some thousand sizes of the scene, so that no box hides those.
const PADDING: f32 = 1.0 / 4_194_304.0;

/// What a node costs, in triangles. A triangle more in a leaf that has room costs nothing; of 1, 1.5, 2, 3 and 4 images of the
/// built-in scenes take the least time with 3.
const NODE_COST: f32 = 3.0;

/// Why there is no ray BVH.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RayBvhError {
    /// A coordinate is not finite, or beyond the renderer's range.
    #[error(
        "coordinate {} of vertex {vertex} of triangle {triangle} is {value}, expected a finite number of magnitude at most \
         2^30 to render; scale the scene or repair the mesh",
        ["x", "y", "z"][*axis]
    )]
    Coordinate {
        /// Index of the triangle.
        triangle: usize,
        /// Which vertex, 0..3.
        vertex: usize,
        /// x, y, z as 0, 1, 2.
        axis: usize,
        /// What was found.
        value: f32,
    },
    /// More triangles than a node can address.
    #[error("the scene has {count} triangles, at most {MAX_TRIANGLES} can be rendered; leave some out")]
    TooMany {
        /// Number of triangles.
        count: usize,
    },
}

/// Triangles and the boxes over them, ready for upload.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RayBvh {
    /// Nodes in depth-first order; none where there is no triangle.
    pub nodes: Vec<RayNode>,
    /// The triangles, a block for each leaf, in the order of the leaves, their vertices on the grid.
    pub blocks: Vec<TriangleBlock>,
    sources: Vec<u32>,
}

impl RayBvh {
    /// Builds the ray BVH over `triangles`; the same triangles give the same words.
    ///
    /// # Errors
    /// [`RayBvhError`] naming the triangle that cannot be rendered, or their number.
    pub fn build(triangles: &[SurfaceTriangle]) -> Result<Self, RayBvhError> {
        if triangles.len() >= MAX_TRIANGLES as usize {
            return Err(RayBvhError::TooMany {
                count: triangles.len(),
            });
        }
        let snapped = triangles
            .iter()
            .enumerate()
            .map(|(index, triangle)| snap_triangle(index, triangle))
            .collect::<Result<Vec<_>, _>>()?;
        if snapped.is_empty() {
            return Ok(Self::default());
        }
        let tree = build(&snapped);
        let area = |node: u32| f64::from(tree.nodes[node as usize].aabb().half_area());
        if let Some(found) = written(&tree, &snapped, area) {
            return Ok(found);
        }
        // Nodes of a balanced tree come level by level: three levels become one.
        let found = written(&balanced(&tree), &snapped, |node| -f64::from(node));
        Ok(found.expect("2^26 leaves have nine levels"))
    }

    /// The triangles and their numbers in a [`Hit`](lightbvh_kernels::shading::trace::Hit), in the order of the leaves.
    pub fn triangles(&self) -> impl Iterator<Item = (u32, SurfaceTriangle)> + '_ {
        let lanes = self
            .blocks
            .iter()
            .flat_map(|block| (0..LANES).map(|lane| block.get(lane)));
        (0..)
            .zip(lanes)
            .filter_map(|(index, triangle)| Some((index, triangle?)))
    }

    /// What rays hit.
    pub fn surfaces(&self) -> Surfaces<'_> {
        Surfaces {
            nodes: &self.nodes,
            blocks: &self.blocks,
            textures: NoTextures,
        }
    }

    /// By the number of a triangle in a [`Hit`](lightbvh_kernels::shading::trace::Hit) the index that it was built with;
    /// [`NONE`] in lanes without one.
    pub fn sources(&self) -> &[u32] {
        &self.sources
    }
}

fn snap_triangle(index: usize, triangle: &SurfaceTriangle) -> Result<SurfaceTriangle, RayBvhError> {
    let mut snapped = *triangle;
    for (vertex, p) in snapped.p.iter_mut().enumerate() {
        for (axis, c) in p.iter_mut().enumerate() {
            // NaN is in no range.
            if !(-MAX_COORDINATE..=MAX_COORDINATE).contains(c) {
                return Err(RayBvhError::Coordinate {
                    triangle: index,
                    vertex,
                    axis,
                    value: *c,
                });
            }
            *c = snap(*c);
        }
    }
    Ok(snapped)
}

/// PLOC with some reinsertion; one thread, so always the same tree.
fn build(triangles: &[SurfaceTriangle]) -> Bvh2 {
    let corners: Vec<Triangle> = triangles
        .iter()
        .map(|t| Triangle {
            v0: Vec3A::from(t.p[0]),
            v1: Vec3A::from(t.p[1]),
            v2: Vec3A::from(t.p[2]),
        })
        .collect();
    let params = BvhBuildParams::fast_build();
    let mut bvh = PlocBuilder::with_capacity(corners.len()).build(
        params.ploc_search_distance,
        &corners,
        (0..corners.len() as u32).collect(),
        params.sort_precision,
        params.search_depth_threshold,
    );
    ReinsertionOptimizer::default().run(&mut bvh, params.reinsertion_batch_ratio, None);
    collapse(&mut bvh, LANES as u32, NODE_COST);
    bvh
}

/// The leaves of a tree that is deeper than walks go, under the least depth.
fn balanced(tree: &Bvh2) -> Bvh2 {
    let leaves: Vec<Bvh2Node> = tree.nodes.iter().filter(|node| node.is_leaf()).copied().collect();
    let mut nodes = vec![leaves[0]];
    let mut runs = VecDeque::from([(0, 0..leaves.len())]);
    while let Some((index, run)) = runs.pop_front() {
        if run.len() == 1 {
            nodes[index] = leaves[run.start];
            continue;
        }
        let middle = run.start.midpoint(run.end);
        let first = nodes.len();
        nodes.extend([leaves[0]; 2]);
        nodes[index] = Bvh2Node::new(Aabb::empty(), 0, first as u32);
        runs.extend([(first, run.start..middle), (first + 1, middle..run.end)]);
    }
    for index in (0..nodes.len()).rev() {
        let first = nodes[index].first_index as usize;
        if !nodes[index].is_leaf() {
            let bounds = nodes[first].aabb().union(nodes[first + 1].aabb());
            nodes[index].set_aabb(bounds);
        }
    }
    Bvh2 {
        nodes,
        primitive_indices: tree.primitive_indices.clone(),
        ..Bvh2::default()
    }
}

/// The children of a node in their order: the inner one of the highest rank is replaced by its own children while there is
/// room (I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008, by area).
fn children(tree: &Bvh2, node: u32, rank: &impl Fn(u32) -> f64) -> Vec<u32> {
    let mut children = vec![node];
    while children.len() < WIDTH {
        let inner = children.iter().copied().enumerate();
        let inner = inner.filter(|&(_, own)| !tree.nodes[own as usize].is_leaf());
        let highest = inner.max_by(|a, b| rank(a.1).total_cmp(&rank(b.1)).then(b.0.cmp(&a.0)));
        let Some((at, own)) = highest else { break };
        let first = tree.nodes[own as usize].first_index;
        children.splice(at..=at, [first, first + 1]);
    }
    children
}

/// The binary tree as the walk's; none if it is deeper than walks go.
fn written(tree: &Bvh2, triangles: &[SurfaceTriangle], rank: impl Fn(u32) -> f64) -> Option<RayBvh> {
    let all = triangles.iter().flat_map(|own| own.p.iter().flatten());
    let largest = all.fold(0.0_f32, |most, c| most.max(c.abs()));
    let padding = Vec3A::splat(largest * PADDING + 2.0 * STEP);
    let mut out = RayBvh::default();
    // A binary node, where its own index goes, and the inner nodes that a path may have from it on.
    let mut stack = vec![(0_u32, None, MAX_DEPTH)];
    while let Some((binary, parent, levels)) = stack.pop() {
        let node = &tree.nodes[binary as usize];
        let child = if node.is_leaf() && parent.is_some() {
            let mut block = TriangleBlock::EMPTY;
            let mut sources = [NONE; LANES];
            let first = node.first_index as usize;
            let own = &tree.primitive_indices[first..first + node.prim_count as usize];
            for (lane, &index) in own.iter().enumerate() {
                block.set(lane, &triangles[index as usize]);
                sources[lane] = index;
            }
            out.blocks.push(block);
            out.sources.extend(sources);
            RayNode::leaf(out.blocks.len() as u32 - 1, node.prim_count)
        } else {
            let (index, below) = (out.nodes.len(), levels.checked_sub(1)?);
            let mut own = RayNode::EMPTY;
            for (slot, child) in children(tree, binary, &rank).into_iter().enumerate().rev() {
                let bounds = tree.nodes[child as usize].aabb();
                let low = (bounds.min - padding).to_array().map(snap);
                let high = (bounds.max + padding).to_array().map(snap);
                for axis in 0..3 {
                    own.min[axis][slot] = low[axis];
                    own.max[axis][slot] = high[axis];
                }
                stack.push((child, Some((index, slot)), below));
            }
            out.nodes.push(own);
            RayNode::inner(index as u32)
        };
        if let Some((parent, slot)) = parent {
            let parent: &mut RayNode = &mut out.nodes[parent];
            parent.children[slot] = child;
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use lightbvh_kernels::shading::ray::{FAR, Ray};
    use lightbvh_kernels::shading::trace::closest_hit;

    /// Many triangles in one place are met there, and boxes hold them.
    #[test]
    fn copies_in_one_place_are_met_there() {
        let one = |p| SurfaceTriangle {
            p,
            material: 0,
            light: NONE,
            instance: NONE,
        };
        let here = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let behind = here.map(|[x, y, _]| [x, y, -1.0]);
        let mut triangles = vec![one(here); 5000];
        triangles.extend(vec![one([[0.25, 0.25, 0.5]; 3]); 100]);
        triangles.push(one(behind));
        let rays = RayBvh::build(&triangles).expect("a ray BVH");
        assert_eq!(rays.triangles().count(), triangles.len());
        for (at, from, distance) in [([0.25, 0.25], 1.0, 1.0), ([0.25, 0.25], -3.0, 2.0)] {
            let towards = Vec3::new(0.0, 0.0, if from > 0.0 { -1.0 } else { 1.0 });
            let ray = Ray::new(Vec3::new(at[0], at[1], from), towards, FAR);
            let hit = closest_hit(&rays.surfaces(), &ray);
            assert_eq!(hit.t, distance);
        }
        let mut sources = rays.sources().to_vec();
        sources.retain(|&source| source != NONE);
        sources.sort_unstable();
        assert!(sources.iter().copied().eq(0..triangles.len() as u32));
    }
}
