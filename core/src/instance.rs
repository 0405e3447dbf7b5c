//! Instances: bottom levels in the space of their mesh, shared by all its places in the world.
//!
//! An instance moves, turns, mirrors and scales evenly: its map is `x ↦ A x + t` with `A = s Q`, Q orthogonal. Distances
//! then keep their proportions and angles stay, so importance may be reckoned in the mesh's space, at the point brought
//! there by `Aᵀ(x − t)/s²`; moving an instance changes one leaf of the top level and nothing below. [`Scene`](crate::scene::Scene) tells
//! which maps are of that kind; others get a bottom level of their own.
//!
//! What rounding on that way may do is bounded and allowed for (see [`Receiver`](crate::point::Receiver)): a light that can
//! contribute never loses all its importance.

mod local;
mod world;

pub use local::LocalPoint;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::bounds::LightBounds;
use crate::exact::{self, flush, pow2};
use crate::light::{EmissiveTriangle, MIN_COORDINATE};
use crate::point::ShadingPoint;
use crate::trail::BitTrail;
use crate::tree::MeshLeaf;
use crate::vector::dot;

/// Lengths below this in a mesh's space count as zero, metres: 2^-75. Entries of the map are zero or at least 2^-45, so no
/// product with them is subnormal; the slack of an instance is at least 2^-52 m.
const TINY: f32 = pow2(-75);

/// A leaf of the top level: where a mesh stands, and which lights its triangles are there.
///
/// Plain words, as the device reads them. [`Instance::inside`](MeshLeaf::inside) and
/// [`to_world`](MeshLeaf::to_world) are the maps; everything is derived on the CPU, from the transform and the mesh's extent.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// Node index of the root of its bottom level.
    pub root: u32,
    /// Its bit trail in the top level, low and high word.
    pub trail: [u32; 2],
    /// Index of its bottom level.
    pub blas: u32,
    /// Its first light; its lights are numbered without gaps.
    pub first: u32,
    /// The triangle that its first light is.
    pub first_triangle: u32,
    /// The columns of A; each entry zero or at least 2^-45.
    pub columns: [[f32; 3]; 3],
    /// t, metres.
    pub translation: [f32; 3],
    /// 1/s.
    pub per_scale: f32,
    /// Factor from the flux of a triangle of the mesh to that in the world: s² times the factor on its radiance.
    pub flux: f32,
    /// Factor on the mesh's radiance; 0 turns it off.
    pub radiance: f32,
    /// By how much a vertex in the world may be off the exact map's, metres.
    pub error: f32,
    /// By how much that may turn a triangle's normal, rad.
    pub tilt: f32,
    /// 1 where the map mirrors, else 0.
    pub mirrored: u32,
}

const _: () = assert!(size_of::<Instance>() == 96);

impl Instance {
    #[inline(always)]
    fn column(&self, k: usize) -> Vec3 {
        Vec3::new(self.columns[k][0], self.columns[k][1], self.columns[k][2])
    }

    /// A v.
    #[inline(always)]
    fn turn(&self, v: Vec3) -> Vec3 {
        (self.column(0) * v.x + self.column(1) * v.y) + self.column(2) * v.z
    }

    /// Aᵀ v.
    #[inline(always)]
    fn turn_back(&self, v: Vec3) -> Vec3 {
        Vec3::new(
            dot(self.column(0), v),
            dot(self.column(1), v),
            dot(self.column(2), v),
        )
    }

    #[inline(always)]
    fn origin(&self) -> Vec3 {
        Vec3::new(self.translation[0], self.translation[1], self.translation[2])
    }

    /// A point of the mesh in the world. This function is the definition of where the lights of an instance are.
    #[inline]
    #[must_use]
    pub fn vertex(&self, p: [f32; 3]) -> [f32; 3] {
        let v = self.turn(flushed(Vec3::new(p[0], p[1], p[2]))) + self.origin();
        [
            flush(v.x, MIN_COORDINATE),
            flush(v.y, MIN_COORDINATE),
            flush(v.z, MIN_COORDINATE),
        ]
    }

    /// Triangle `local` of the mesh as it stands in the world, as part of mesh light `index`. Where the map mirrors, two
    /// vertices are swapped, so that the front stays in front. A triangle without flux in the mesh, having no area there, has
    /// no radiance in the world, whatever area rounding may give it: no tree holds it.
    #[inline]
    #[must_use]
    pub fn triangle(&self, local: &EmissiveTriangle, index: u32) -> EmissiveTriangle {
        let (a, b, c) = (
            self.vertex(local.p[0]),
            self.vertex(local.p[1]),
            self.vertex(local.p[2]),
        );
        let mirrored = self.mirrored != 0;
        let shines = self.radiance > 0.0 && LightBounds::of_triangle(local).phi > 0.0;
        let shine = |channel: usize| {
            let l = local.radiance[channel];
            let scaled = exact::clamp(
                l * self.radiance,
                crate::light::MIN_RADIANCE,
                crate::light::MAX_RADIANCE,
            );
            if l > 0.0 && shines { scaled } else { 0.0 }
        };
        EmissiveTriangle {
            p: [a, if mirrored { c } else { b }, if mirrored { b } else { c }],
            radiance: [shine(0), shine(1), shine(2)],
            mesh: index,
            flags: local.flags,
        }
    }
}

impl MeshLeaf for Instance {
    type Local = LocalPoint;

    fn world(root: u32, blas: u32) -> Self {
        Self {
            root,
            trail: [0; 2],
            blas,
            first: 0,
            first_triangle: 0,
            columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            translation: [0.0; 3],
            per_scale: 1.0,
            flux: 1.0,
            radiance: 1.0,
            error: 0.0,
            tilt: 0.0,
            mirrored: 0,
        }
    }

    #[inline(always)]
    fn root(&self) -> u32 {
        self.root
    }

    #[inline(always)]
    fn blas(&self) -> u32 {
        self.blas
    }

    #[inline(always)]
    fn trail(&self) -> BitTrail {
        BitTrail {
            low: self.trail[0],
            high: self.trail[1],
        }
    }

    fn set_trail(&mut self, trail: BitTrail) {
        self.trail = [trail.low, trail.high];
    }

    #[inline(always)]
    fn light_of(&self, triangle: u32) -> u32 {
        triangle
            .wrapping_sub(self.first_triangle)
            .wrapping_add(self.first)
    }

    #[inline(always)]
    fn triangle_of(&self, light: u32) -> u32 {
        light.wrapping_sub(self.first).wrapping_add(self.first_triangle)
    }

    #[inline(always)]
    fn outside(point: &ShadingPoint) -> LocalPoint {
        LocalPoint::outside(point)
    }

    #[inline(always)]
    fn inside(&self, point: &ShadingPoint) -> LocalPoint {
        LocalPoint::inside(self, point)
    }

    // Left to the compiler it is inlined in small programs only; called, it keeps `lanes` from running lanes side by side.
    #[inline(always)]
    fn to_world(&self, local: &LightBounds) -> LightBounds {
        world::to_world(self, local)
    }
}

/// Without components that a product could make subnormal.
#[inline(always)]
fn flushed(v: Vec3) -> Vec3 {
    Vec3::new(flush(v.x, TINY), flush(v.y, TINY), flush(v.z, TINY))
}
