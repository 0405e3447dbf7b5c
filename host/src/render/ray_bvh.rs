//! The ray BVH: built by `obvhs`, laid out for the kernels' stackless walk.

use glam::{Vec3, Vec3A};
use lightbvh_kernels::shading::grid::{MAX_COORDINATE, STEP, snap};
use lightbvh_kernels::shading::trace::{MAX_LEAF, MAX_TRIANGLES, RayNode, SurfaceTriangle, Surfaces};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;
use std::time::Duration;

/// Boxes grow by this part of the scene's largest coordinate: two units in its last place, more than the ray-triangle
/// test errs, so that no box hides a triangle that the test alone would hit.
const PADDING: f32 = 1.0 / 4_194_304.0;

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
    /// The triangles in the order of the leaves, their vertices on the grid.
    pub triangles: Vec<SurfaceTriangle>,
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
        Ok(lay_out(&build(&snapped), &snapped))
    }

    /// What rays hit.
    pub fn surfaces(&self) -> Surfaces<'_> {
        Surfaces {
            nodes: &self.nodes,
            triangles: &self.triangles,
        }
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

/// PLOC (D. Meister and J. Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction",
/// 2018) with some reinsertion; one thread, so always the same tree.
fn build(triangles: &[SurfaceTriangle]) -> Bvh2 {
    let corners: Vec<Triangle> = triangles
        .iter()
        .map(|t| Triangle {
            v0: Vec3A::from(t.p[0]),
            v1: Vec3A::from(t.p[1]),
            v2: Vec3A::from(t.p[2]),
        })
        .collect();
    let params = BvhBuildParams {
        max_prims_per_leaf: 4,
        ..BvhBuildParams::fast_build()
    };
    const { assert!(4 <= MAX_LEAF) };
    build_bvh2_from_tris(&corners, params, &mut Duration::default())
}

/// Writes the nodes depth first, each with the place where its subtree ends.
fn lay_out(bvh: &Bvh2, triangles: &[SurfaceTriangle]) -> RayBvh {
    let largest = triangles
        .iter()
        .flat_map(|t| t.p.iter().flatten())
        .fold(0.0_f32, |m, c| m.max(c.abs()));
    let padding = largest * PADDING + 2.0 * STEP;
    let mut out = RayBvh {
        nodes: Vec::with_capacity(bvh.nodes.len()),
        triangles: Vec::with_capacity(triangles.len()),
    };
    enum Visit {
        Enter(u32),
        Leave(usize),
    }
    let mut stack = vec![Visit::Enter(0)];
    while let Some(visit) = stack.pop() {
        match visit {
            Visit::Enter(index) => {
                let node = &bvh.nodes[index as usize];
                let written = out.nodes.len();
                let mut leaf = 0;
                stack.push(Visit::Leave(written));
                if node.is_leaf() {
                    let first = out.triangles.len() as u32;
                    let range = node.first_index as usize..(node.first_index + node.prim_count) as usize;
                    out.triangles.extend(
                        bvh.primitive_indices[range]
                            .iter()
                            .map(|&i| triangles[i as usize]),
                    );
                    leaf = RayNode::leaf(first, node.prim_count);
                } else {
                    stack.push(Visit::Enter(node.first_index + 1));
                    stack.push(Visit::Enter(node.first_index));
                }
                out.nodes.push(RayNode {
                    min: (node.min - Vec3::splat(padding)).to_array().map(snap),
                    skip: 0,
                    max: (node.max + Vec3::splat(padding)).to_array().map(snap),
                    triangles: leaf,
                });
            }
            Visit::Leave(written) => out.nodes[written].skip = out.nodes.len() as u32,
        }
    }
    out
}
