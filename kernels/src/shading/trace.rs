//! The walk through the ray BVH: stackless, in the order of its nodes, with skip links.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::ray::{MISS, Ray};

/// No triangle, no light.
pub const NONE: u32 = u32::MAX;

/// Most triangles in one leaf.
pub const MAX_LEAF: u32 = (1 << LEAF_BITS) - 1;
/// Most triangles in one ray BVH: what [`RayNode::triangles`] can count.
pub const MAX_TRIANGLES: u32 = 1 << (32 - LEAF_BITS);
const LEAF_BITS: u32 = 4;

/// A node of the ray BVH; 32 bytes. Nodes lie in depth-first order: a ray that hits the box goes on with the next node,
/// one that misses it with node `skip`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RayNode {
    /// Low corner of the box, on the grid, metres.
    pub min: [f32; 3],
    /// The node after this one's subtree; the number of nodes where there is none. Larger than the node's own index,
    /// and read as if it were where it is not, so every walk ends.
    pub skip: u32,
    /// High corner of the box, on the grid, metres.
    pub max: [f32; 3],
    /// First triangle times 16 plus the number of triangles, at most [`MAX_LEAF`]; 0 for an inner node.
    pub triangles: u32,
}

const _: () = assert!(size_of::<RayNode>() == 32);

impl RayNode {
    /// The word [`triangles`](Self::triangles) of a leaf with `count` triangles from `first` on.
    #[inline]
    #[must_use]
    pub const fn leaf(first: u32, count: u32) -> u32 {
        (first << LEAF_BITS) | count
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
    walk::<false>(surfaces, ray, NONE)
}

/// Whether anything but the emissive triangle `except` lies on the ray. A light so never shadows itself, whatever the
/// rounding.
#[inline]
#[must_use]
pub fn any_hit(surfaces: &Surfaces<'_>, ray: &Ray, except: u32) -> bool {
    walk::<true>(surfaces, ray, except).triangle != NONE
}

/// Visits at most each node once, and [`MAX_LEAF`] triangles for each, whatever the words in the buffers.
#[inline]
fn walk<const ANY: bool>(surfaces: &Surfaces<'_>, ray: &Ray, except: u32) -> Hit {
    let nodes = surfaces.nodes;
    let triangles = surfaces.triangles;
    let end = nodes.len() as u32;
    let triangle_count = triangles.len() as u32;
    let mut hit = Hit {
        triangle: NONE,
        t: ray.t_max,
    };
    let mut index = 0;
    while index < end {
        let i = index as usize;
        let low = Vec3::new(nodes[i].min[0], nodes[i].min[1], nodes[i].min[2]);
        let high = Vec3::new(nodes[i].max[0], nodes[i].max[1], nodes[i].max[2]);
        let skip = nodes[i].skip;
        let packed = nodes[i].triangles;
        let inside = ray.hits_box(low, high, hit.t);
        let first = packed >> LEAF_BITS;
        let count = if inside { packed & MAX_LEAF } else { 0 };
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
        let next = if inside || skip <= index { index + 1 } else { skip };
        index = if ANY && hit.triangle != NONE { end } else { next };
    }
    hit
}
