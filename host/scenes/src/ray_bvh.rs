//! The ray BVH: built by `obvhs`, laid out for the kernels' walk.

use glam::Vec3A;
use lightbvh_kernels::shading::grid::{MAX_COORDINATE, STEP, snap};
use lightbvh_kernels::shading::skin::NoSkin;
use lightbvh_kernels::shading::trace::{
    LANES, MAX_DEPTH, MAX_TRIANGLES, NONE, RayNode, SurfaceTriangle, Surfaces, TriangleBlock, WIDTH,
};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::PlocBuilder;
use obvhs::triangle::Triangle;
use std::ops::Range;

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
        Ok(Layout::new(&build(&snapped), &snapped).written())
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
            skin: NoSkin,
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

/// The binary tree as the walk's: its leaves in their order, and nodes over runs of them.
struct Layout<'a> {
    bvh: &'a Bvh2,
    triangles: &'a [SurfaceTriangle],
    padding: f32,
    /// The binary leaves, depth first.
    leaves: Vec<u32>,
    /// Where the leaves of each binary node lie among them.
    runs: Vec<Range<u32>>,
    /// Of each binary node, around the triangles where they are.
    boxes: Vec<Aabb>,
}

/// Some leaves, one after the other.
#[derive(Clone)]
enum Part {
    /// Those of a binary node.
    Node(u32),
    /// Those of no node, halved in the middle: where the binary tree is deeper than walks go.
    Run(Range<u32>),
}

/// A part that is to be written, and whose child it is.
struct Visit {
    part: Part,
    parent: usize,
    slot: usize,
    /// Inner nodes that a path through it may have from here on.
    levels: u32,
}

impl<'a> Layout<'a> {
    fn new(bvh: &'a Bvh2, triangles: &'a [SurfaceTriangle]) -> Self {
        let largest = triangles
            .iter()
            .flat_map(|t| t.p.iter().flatten())
            .fold(0.0_f32, |m, c| m.max(c.abs()));
        let mut leaves = Vec::new();
        let mut runs = vec![0..0; bvh.nodes.len()];
        let mut boxes = vec![Aabb::empty(); bvh.nodes.len()];
        // Twice on the stack: to begin its run, and to end it.
        let mut stack = vec![(0_u32, false)];
        while let Some((index, ends)) = stack.pop() {
            let (node, at) = (&bvh.nodes[index as usize], index as usize);
            if ends {
                runs[at].end = leaves.len() as u32;
                let first = node.first_index as usize;
                boxes[at] = if node.is_leaf() {
                    let own = &bvh.primitive_indices[first..first + node.prim_count as usize];
                    own.iter().fold(Aabb::empty(), |all, &i| {
                        let [a, b, c] = triangles[i as usize].p.map(Vec3A::from);
                        all.union(&Aabb::new(a.min(b).min(c), a.max(b).max(c)))
                    })
                } else {
                    boxes[first].union(&boxes[first + 1])
                };
            } else {
                runs[at].start = leaves.len() as u32;
                stack.push((index, true));
                if node.is_leaf() {
                    leaves.push(index);
                } else {
                    stack.push((node.first_index + 1, false));
                    stack.push((node.first_index, false));
                }
            }
        }
        Self {
            bvh,
            triangles,
            padding: largest * PADDING + 2.0 * STEP,
            leaves,
            runs,
            boxes,
        }
    }

    fn run(&self, part: &Part) -> Range<u32> {
        match part {
            Part::Node(index) => self.runs[*index as usize].clone(),
            Part::Run(run) => run.clone(),
        }
    }

    fn bounds(&self, part: &Part) -> Aabb {
        match part {
            Part::Node(index) => self.boxes[*index as usize],
            Part::Run(run) => self.leaves[run.start as usize..run.end as usize]
                .iter()
                .map(|&leaf| self.boxes[leaf as usize])
                .fold(Aabb::empty(), |a, b| a.union(&b)),
        }
    }

    /// The children of a part of several leaves, in their order. Of those that there are the largest is replaced by its own
    /// children (I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008), unless one then had more leaves than fit
    /// below it.
    fn children(&self, part: &Part, levels: u32) -> Vec<Part> {
        let fits = |part: &Part| self.run(part).len() as u64 <= (WIDTH as u64).saturating_pow(levels - 1);
        let mut children = vec![part.clone()];
        while let Some((at, node)) = self.largest(&children)
            && children.len() < WIDTH
        {
            let first = self.bvh.nodes[node as usize].first_index;
            children.splice(at..=at, [Part::Node(first), Part::Node(first + 1)]);
        }
        if children.len() == 1 || !children.iter().all(fits) {
            let run = self.run(part);
            let (count, parts) = (run.len() as u64, run.len().min(WIDTH) as u64);
            let bound = |k: u64| run.start + (count * k / parts) as u32;
            children = (0..parts).map(|k| Part::Run(bound(k)..bound(k + 1))).collect();
        }
        children
    }

    /// The largest inner node of the binary tree among `parts`, and where it is.
    fn largest(&self, parts: &[Part]) -> Option<(usize, u32)> {
        let area = |index: u32| self.bvh.nodes[index as usize].aabb().half_area();
        let nodes = parts.iter().enumerate().filter_map(|(at, part)| match part {
            Part::Node(index) if !self.bvh.nodes[*index as usize].is_leaf() => Some((at, *index)),
            _ => None,
        });
        nodes.max_by(|a, b| area(a.1).total_cmp(&area(b.1)).then(b.0.cmp(&a.0)))
    }

    fn written(&self) -> RayBvh {
        let mut out = RayBvh {
            nodes: vec![RayNode::EMPTY],
            blocks: Vec::with_capacity(self.leaves.len()),
            sources: Vec::with_capacity(self.leaves.len() * LANES),
        };
        let mut stack = Vec::new();
        self.push_children(&Part::Node(0), 0, MAX_DEPTH as u32, &mut out, &mut stack);
        while let Some(Visit {
            part,
            parent,
            slot,
            levels,
        }) = stack.pop()
        {
            let run = self.run(&part);
            out.nodes[parent].children[slot] = if run.len() == 1 {
                let leaf = &self.bvh.nodes[self.leaves[run.start as usize] as usize];
                let index = out.blocks.len() as u32;
                let range = leaf.first_index as usize..(leaf.first_index + leaf.prim_count) as usize;
                let mut block = TriangleBlock::EMPTY;
                let first = out.sources.len();
                out.sources.resize(first + LANES, NONE);
                for (lane, &i) in self.bvh.primitive_indices[range].iter().enumerate() {
                    block.set(lane, &self.triangles[i as usize]);
                    out.sources[first + lane] = i;
                }
                out.blocks.push(block);
                RayNode::leaf(index, leaf.prim_count)
            } else {
                let index = out.nodes.len();
                out.nodes.push(RayNode::EMPTY);
                self.push_children(&part, index, levels, &mut out, &mut stack);
                RayNode::inner(index as u32)
            };
        }
        out
    }

    /// Writes the boxes of the children of `part`, which is node `index`, and leaves it to the `stack` to write those.
    fn push_children(
        &self,
        part: &Part,
        index: usize,
        levels: u32,
        out: &mut RayBvh,
        stack: &mut Vec<Visit>,
    ) {
        let children = self.children(part, levels);
        for (slot, child) in children.into_iter().enumerate().rev() {
            let bounds = self.bounds(&child);
            let low = (bounds.min - Vec3A::splat(self.padding)).to_array().map(snap);
            let high = (bounds.max + Vec3A::splat(self.padding)).to_array().map(snap);
            let node = &mut out.nodes[index];
            for axis in 0..3 {
                node.min[axis][slot] = low[axis];
                node.max[axis][slot] = high[axis];
            }
            stack.push(Visit {
                part: child,
                parent: index,
                slot,
                levels: levels - 1,
            });
        }
    }
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
