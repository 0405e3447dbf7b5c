//! The walk through the ray BVH: depth first in the order of its nodes, several boxes or triangles at a time.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::device::widest::widest;
use lightbvh::exact::{max, min, pow2};

pub use super::block::{LANES, NONE, SurfaceTriangle, TriangleBlock, vertex};
use super::ray::{FAR, MISS, Meeting, Ray};
use super::textures::{NoTextures, Textures};

/// Children of a node: as many numbers as a vector register of 256 bits holds.
pub const WIDTH: usize = 8;

/// Most triangles in one ray BVH: what a [`RayNode`] can count, if each has a leaf of its own.
pub const MAX_TRIANGLES: u32 = 1 << (32 - LEAF_BITS);
/// Most inner nodes on the path to a leaf; the walk remembers two words of each.
pub const MAX_DEPTH: usize = 16;
const LEAF_BITS: u32 = 4;

/// Box distances are off by three roundings at most, 2^-24 each; widening by more than that keeps the test conservative
/// (T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013).
const WIDEN: f32 = 1.0 + 8.0 * pow2(-24);

/// All children.
#[cfg(not(target_arch = "spirv"))]
const ALL: u32 = (1 << WIDTH) - 1;

/// An inner node of the ray BVH: its children's boxes, child by child in each plane. Nodes lie in depth-first order.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RayNode {
    /// Low corners of the boxes, on the grid, metres: x of all children, y, z.
    pub min: [[f32; WIDTH]; 3],
    /// High corners of the boxes, on the grid, metres.
    pub max: [[f32; WIDTH]; 3],
    /// For a leaf its block times 16 plus the number of its triangles, at most [`LANES`]; for an inner node 16 times its
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

    /// The child that is a leaf with the first `count` triangles of `block`.
    #[inline]
    #[must_use]
    pub const fn leaf(block: u32, count: u32) -> u32 {
        (block << LEAF_BITS) | count
    }

    /// The child that is node `index`.
    #[inline]
    #[must_use]
    pub const fn inner(index: u32) -> u32 {
        index << LEAF_BITS
    }
}

/// The scene as rays see it.
#[derive(Clone, Copy)]
pub struct Surfaces<'a, S = NoTextures> {
    /// The ray BVH.
    pub nodes: &'a [RayNode],
    /// What its leaves hold.
    pub blocks: &'a [TriangleBlock],
    /// Its textures.
    pub textures: S,
}

/// The first triangle on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Its index, or [`NONE`].
    pub triangle: u32,
    /// Distance in multiples of the ray's direction; the ray's end if there is no hit.
    pub t: f32,
}

/// The nearest hit of the ray; of equally near ones, the first in the order of the triangles.
#[inline]
#[must_use]
pub fn closest_hit<S: Textures>(surfaces: &Surfaces<'_, S>, ray: &Ray) -> Hit {
    widest(
        #[inline(always)]
        || walk::<false, S>(surfaces, ray, NONE),
    )
}

/// Whether anything but the emissive triangle `except` lies on the ray. A light so never shadows itself, whatever the rounding.
#[inline]
#[must_use]
pub fn any_hit<S: Textures>(surfaces: &Surfaces<'_, S>, ray: &Ray, except: u32) -> bool {
    widest(
        #[inline(always)]
        || walk::<true, S>(surfaces, ray, except).triangle != NONE,
    )
}

/// Visits each node once at most, and a block of triangles for each of its children, whatever the words in the buffers.
#[inline(always)]
fn walk<const ANY: bool, S: Textures>(surfaces: &Surfaces<'_, S>, ray: &Ray, except: u32) -> Hit {
    let nodes = surfaces.nodes;
    let end = nodes.len() as u32;
    let mut found = Hit {
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
        let count = child & ((1 << LEAF_BITS) - 1);
        if count != 0 {
            found = hit_leaf(surfaces, first, count, ray, except, found);
        }
        if count == 0 && first >= next && first < end {
            next = first + 1;
            let met = hit_boxes(nodes, first, ray, found.t);
            if met != 0 {
                if left != 0 && depth < MAX_DEPTH {
                    path[depth] = index;
                    path_left[depth] = left;
                    depth += 1;
                }
                index = first;
                left = met;
            }
        }
        if left == 0 && depth > 0 {
            depth -= 1;
            index = path[depth];
            left = path_left[depth];
        }
        go = left != 0 && !(ANY && found.triangle != NONE);
        if go {
            let k = left.trailing_zeros() as usize & (WIDTH - 1);
            child = nodes[index as usize].children[k];
            left &= left - 1;
        }
    }
    found
}

/// The nearest of `hit` and what the ray meets among the triangles of a block, which are tested all at once. Lanes without a triangle
/// meet nothing, so their number need not be known.
// Loops over lanes: the compiler makes vectors of these, but not where corners are read by `map`, nor where a lane needs the one
// before.
#[cfg(not(target_arch = "spirv"))]
#[allow(clippy::needless_range_loop)]
#[inline(always)]
fn hit_leaf<S: Textures>(
    surfaces: &Surfaces<'_, S>,
    index: u32,
    _count: u32,
    ray: &Ray,
    except: u32,
    found: Hit,
) -> Hit {
    let mut found = found;
    if let Some(block) = surfaces.blocks.get(index as usize) {
        let corner =
            |k: usize, lane: usize| Vec3::new(block.p[k][0][lane], block.p[k][1][lane], block.p[k][2][lane]);
        let (mut t, mut determinant, mut near) = ([0.0; LANES], [0.0; LANES], [0; LANES]);
        for lane in 0..LANES {
            let met = ray.meet(corner(0, lane), corner(1, lane), corner(2, lane));
            t[lane] = met.t;
            determinant[lane] = met.determinant;
            near[lane] = u32::from(met.inside & (met.t < found.t * met.determinant)) << lane;
        }
        let mut left = 0;
        for lane in 0..LANES {
            left |= near[lane];
        }
        while left != 0 {
            let lane = left.trailing_zeros() as usize & (LANES - 1);
            left &= left - 1;
            let met = Meeting {
                t: t[lane],
                determinant: determinant[lane],
                inside: true,
            };
            let triangle = index * LANES as u32 + lane as u32;
            found = nearer(surfaces, ray, found, met, block.light[lane], except, triangle);
        }
    }
    found
}

/// The same one by one: an invocation of a device is a lane itself.
#[cfg(target_arch = "spirv")]
#[inline(always)]
fn hit_leaf<S: Textures>(
    surfaces: &Surfaces<'_, S>,
    index: u32,
    count: u32,
    ray: &Ray,
    except: u32,
    found: Hit,
) -> Hit {
    let mut found = found;
    let blocks = surfaces.blocks;
    if index < blocks.len() as u32 {
        let i = index as usize;
        let lanes = if count < LANES as u32 { count } else { LANES as u32 };
        for lane in 0..lanes {
            let triangle = index * LANES as u32 + lane;
            let met = ray.meet(
                vertex(blocks, triangle, 0),
                vertex(blocks, triangle, 1),
                vertex(blocks, triangle, 2),
            );
            let light = blocks[i].light[lane as usize];
            found = nearer(surfaces, ray, found, met, light, except, triangle);
        }
    }
    found
}

/// The nearer of what was found and a triangle that is `light`.
#[inline(always)]
fn nearer<S: Textures>(
    surfaces: &Surfaces<'_, S>,
    ray: &Ray,
    found: Hit,
    met: Meeting,
    light: u32,
    except: u32,
    triangle: u32,
) -> Hit {
    let t = met.before(found.t);
    let excepted = except != NONE && light == except;
    let mut nearer = found;
    if t != MISS && !excepted && surfaces.textures.stops(surfaces.blocks, ray, triangle) {
        nearer = Hit { triangle, t };
    }
    nearer
}

/// The children of a node whose boxes the ray comes through before `nearest`, a bit for each. Never misses a box that the ray touches
/// inside; may report one that it passes within a rounding error.
// Loops over lanes and signs in place of comparisons: the compiler makes vectors of these.
#[cfg(not(target_arch = "spirv"))]
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
        misses[k] = ((leave.to_bits() | before.to_bits()) >> 31) << k;
    }
    let mut all = 0;
    for k in 0..WIDTH {
        all |= misses[k];
    }
    all ^ ALL
}

/// The same one by one: what an invocation of a device keeps in arrays lies in memory.
#[cfg(target_arch = "spirv")]
#[inline(always)]
fn hit_boxes(nodes: &[RayNode], index: u32, ray: &Ray, nearest: f32) -> u32 {
    let i = index as usize;
    let mut all = 0;
    for k in 0..WIDTH {
        let a = Vec3::new(nodes[i].min[0][k], nodes[i].min[1][k], nodes[i].min[2][k]) - ray.origin;
        let b = Vec3::new(nodes[i].max[0][k], nodes[i].max[1][k], nodes[i].max[2][k]) - ray.origin;
        let (a, b) = (a * ray.inverse, b * ray.inverse);
        let enter = max(max(min(a.x, b.x), min(a.y, b.y)), min(a.z, b.z));
        let leave = min(min(max(b.x, a.x), max(b.y, a.y)), max(b.z, a.z));
        let before = min(leave, nearest) * WIDEN - enter;
        let misses = (leave.to_bits() | before.to_bits()) >> 31;
        all |= (1 - misses) << k;
    }
    all
}

/// Where a ray from `origin` comes between two planes of each box, and where it leaves.
#[cfg(not(target_arch = "spirv"))]
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
