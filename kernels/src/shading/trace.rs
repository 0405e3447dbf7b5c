//! The walk through the ray BVH: depth first in the order of its nodes, several boxes at a time.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::{max, min, pow2};
use lightbvh::widest::widest;

use super::ray::{FAR, MISS, Ray};

/// No triangle, no light.
pub const NONE: u32 = u32::MAX;

/// Children of a node: as many numbers as a vector register of 256 bits holds.
pub const WIDTH: usize = 8;

/// Most triangles in one leaf.
pub const MAX_LEAF: u32 = (1 << LEAF_BITS) - 1;
/// Most triangles in one ray BVH: what a [`RayNode`] can count.
pub const MAX_TRIANGLES: u32 = 1 << (32 - LEAF_BITS);
/// Most inner nodes on the path to a leaf; the walk remembers two words of each.
pub const MAX_DEPTH: usize = 16;
const LEAF_BITS: u32 = 4;

/// Box distances are off by three roundings at most, 2^-24 each; widening by more than that keeps the test conservative
/// (T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013).
const WIDEN: f32 = 1.0 + 8.0 * pow2(-24);

/// All children.
const ALL: u32 = (1 << WIDTH) - 1;

/// An inner node of the ray BVH: its children's boxes, child by child in each plane. Nodes lie in depth-first order.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RayNode {
    /// Low corners of the boxes, on the grid, metres: x of all children, y, z.
    pub min: [[f32; WIDTH]; 3],
    /// High corners of the boxes, on the grid, metres.
    pub max: [[f32; WIDTH]; 3],
    /// For a leaf its first triangle times 16 plus the number of its triangles, at most [`MAX_LEAF`]; for an inner node 16 times its
    /// index, which is larger than this node's; 0 for no child, after all others.
    pub children: [u32; WIDTH],
}

const _: () = assert!(size_of::<RayNode>() == 28 * WIDTH);

impl RayNode {
    /// A node without children: boxes beyond all that rays reach.
    pub const EMPTY: Self = Self {
        min: [[FAR; WIDTH]; 3],
        max: [[FAR; WIDTH]; 3],
        children: [0; WIDTH],
    };

    /// The child that is a leaf with `count` triangles from `first` on.
    #[inline]
    #[must_use]
    pub const fn leaf(first: u32, count: u32) -> u32 {
        (first << LEAF_BITS) | count
    }

    /// The child that is node `index`.
    #[inline]
    #[must_use]
    pub const fn inner(index: u32) -> u32 {
        index << LEAF_BITS
    }
}

/// A triangle of the scene, in the order of the ray BVH's leaves; 48 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SurfaceTriangle {
    /// Vertices in world space, on the grid, metres; counter-clockwise seen from the front.
    pub p: [[f32; 3]; 3],
    /// Index of the material.
    pub material: u32,
    /// The light that it is, as a [`SampledLight`](lightbvh::SampledLight) numbers it, or [`NONE`].
    pub light: u32,
    /// That light's instance; not read where all lights are of one instance.
    pub instance: u32,
}

const _: () = assert!(size_of::<SurfaceTriangle>() == 48);

/// The scene as rays see it.
#[derive(Clone, Copy)]
pub struct Surfaces<'a> {
    /// The ray BVH.
    pub nodes: &'a [RayNode],
    /// What its leaves hold.
    pub triangles: &'a [SurfaceTriangle],
}

/// The first triangle on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Its index, or [`NONE`].
    pub triangle: u32,
    /// Distance in multiples of the ray's direction; the ray's end if there is no hit.
    pub t: f32,
}

/// The vertex `k` of triangle `index`.
#[inline]
#[must_use]
pub fn vertex(triangles: &[SurfaceTriangle], index: u32, k: usize) -> Vec3 {
    let i = index as usize;
    Vec3::new(triangles[i].p[k][0], triangles[i].p[k][1], triangles[i].p[k][2])
}

/// The nearest hit of the ray; of equally near ones, the first in the order of the triangles.
#[inline]
#[must_use]
pub fn closest_hit(surfaces: &Surfaces<'_>, ray: &Ray) -> Hit {
    widest(
        #[inline(always)]
        || walk::<false>(surfaces, ray, NONE),
    )
}

/// Whether anything but the emissive triangle `except` lies on the ray. A light so never shadows itself, whatever the
/// rounding.
#[inline]
#[must_use]
pub fn any_hit(surfaces: &Surfaces<'_>, ray: &Ray, except: u32) -> bool {
    widest(
        #[inline(always)]
        || walk::<true>(surfaces, ray, except).triangle != NONE,
    )
}

/// Visits each node once at most, and [`MAX_LEAF`] triangles for each of its children, whatever the words in the buffers.
#[inline(always)]
fn walk<const ANY: bool>(surfaces: &Surfaces<'_>, ray: &Ray, except: u32) -> Hit {
    let nodes = surfaces.nodes;
    let triangles = surfaces.triangles;
    let end = nodes.len() as u32;
    let triangle_count = triangles.len() as u32;
    let mut hit = Hit {
        triangle: NONE,
        t: ray.t_max,
    };
    // Nodes on the path to `index` whose later children are still to be visited: which node, and which children.
    let mut path = [0_u32; MAX_DEPTH];
    let mut path_left = [0_u32; MAX_DEPTH];
    let mut depth = 0;
    let mut index = 0;
    let mut left = 0;
    // Nodes before this one have been visited, or were passed by.
    let mut next = 0;
    let mut child = RayNode::inner(0);
    let mut go = end > 0;
    while go {
        let first = child >> LEAF_BITS;
        let count = child & MAX_LEAF;
        for k in 0..count {
            let candidate = first + k;
            if candidate < triangle_count {
                let t = ray.hit_triangle(
                    vertex(triangles, candidate, 0),
                    vertex(triangles, candidate, 1),
                    vertex(triangles, candidate, 2),
                    hit.t,
                );
                let excepted = ANY && except != NONE && triangles[candidate as usize].light == except;
                if t != MISS && !excepted {
                    hit = Hit {
                        triangle: candidate,
                        t,
                    };
                }
            }
        }
        if count == 0 && first >= next && first < end {
            next = first + 1;
            let found = hit_boxes(nodes, first, ray, hit.t);
            if found != 0 {
                if left != 0 && depth < MAX_DEPTH {
                    path[depth] = index;
                    path_left[depth] = left;
                    depth += 1;
                }
                index = first;
                left = found;
            }
        }
        if left == 0 && depth > 0 {
            depth -= 1;
            index = path[depth];
            left = path_left[depth];
        }
        go = left != 0 && !(ANY && hit.triangle != NONE);
        if go {
            let k = left.trailing_zeros() as usize & (WIDTH - 1);
            child = nodes[index as usize].children[k];
            left &= left - 1;
        }
    }
    hit
}

/// The children of a node whose boxes the ray comes through before `nearest`, a bit for each. Never misses a box that the ray touches
/// inside; may report one that it passes within a rounding error.
// rust-gpu has no iterators over arrays.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
fn hit_boxes(nodes: &[RayNode], index: u32, ray: &Ray, nearest: f32) -> u32 {
    let i = index as usize;
    let [x_enter, x_leave] = crossed(&nodes[i].min[0], &nodes[i].max[0], ray.origin.x, ray.inverse.x);
    let [y_enter, y_leave] = crossed(&nodes[i].min[1], &nodes[i].max[1], ray.origin.y, ray.inverse.y);
    let [z_enter, z_leave] = crossed(&nodes[i].min[2], &nodes[i].max[2], ray.origin.z, ray.inverse.z);
    let mut misses = [0; WIDTH];
    for k in 0..WIDTH {
        let enter = max(max(x_enter[k], y_enter[k]), z_enter[k]);
        let leave = min(min(x_leave[k], y_leave[k]), z_leave[k]);
        let before = min(leave, nearest) * WIDEN - enter;
        // Signs and no comparisons: the compiler makes vectors of these.
        misses[k] = ((leave.to_bits() | before.to_bits()) >> 31) << k;
    }
    let mut all = 0;
    for k in 0..WIDTH {
        all |= misses[k];
    }
    all ^ ALL
}

/// Where a ray from `origin` comes between two planes of each box, and where it leaves.
#[inline(always)]
fn crossed(low: &[f32; WIDTH], high: &[f32; WIDTH], origin: f32, inverse: f32) -> [[f32; WIDTH]; 2] {
    let (mut enter, mut leave) = ([0.0; WIDTH], [0.0; WIDTH]);
    for k in 0..WIDTH {
        let a = (low[k] - origin) * inverse;
        let b = (high[k] - origin) * inverse;
        enter[k] = min(a, b);
        leave[k] = max(b, a);
    }
    [enter, leave]
}
