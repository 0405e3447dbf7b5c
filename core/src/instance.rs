//! Instances: bottom levels in the space of their mesh, shared by all its places in the world.
//!
//! An instance moves, turns, mirrors and scales evenly: its map is `x ↦ A x + t` with `A = s Q`, Q orthogonal. Distances
//! then keep their proportions and angles stay, so importance may be reckoned in the mesh's space, at the point brought
//! there by `Aᵀ(x − t)/s²`; moving an instance changes one leaf of the top level and nothing below. [`Scene`](crate::scene::Scene) tells
//! which maps are of that kind; others get a bottom level of their own.
//!
//! What rounding on that way may do is bounded and allowed for (see [`Receiver`]): a light that can contribute never loses
//! all its importance.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::bounds::{LightBounds, MAX_PHI, MAX_SUM, MIN_PHI};
use crate::cone::{normalized, widened};
use crate::exact::{self, exponent, flush, pow2, significand};
use crate::light::{EmissiveTriangle, MIN_COORDINATE};
use crate::point::{Receiver, ShadingPoint};
use crate::trail::BitTrail;
use crate::tree::MeshLeaf;
use crate::vector::dot;

/// Lengths below this in a mesh's space count as zero, metres: 2^-75. Entries of the map are zero or at least 2^-45, so no
/// product with them is subnormal; the slack of an instance is at least 2^-52 m.
const TINY: f32 = pow2(-75);
/// Share of a point's distance from the mesh's origin by which it may be off once it is in the mesh's space: 2^-20. Two
/// roundings of 2^-24 for each of three products and sums, as much for the map's own, and 2^-21 for its not being quite a
/// similarity ([`Transform::similarity`] allows no more).
const POINT_SLACK: f32 = pow2(-20);
/// Slack that turns a direction by 2^-11 rad at the distance of 2048 slacks.
const NEAR: f32 = 2048.0;
/// Least angle by which a cone is widened on its way into the world, 2^-11 rad: cosines near 1 resolve no less.
const LEAST_TURN: f32 = pow2(-11);
/// Greatest magnitude of a coordinate in a mesh's space, 2^60: only points farther off than any accepted one are cut there.
const FAR: f32 = pow2(60);

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

/// A point in the space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct LocalPoint {
    p: Vec3,
    n: Vec3,
    slack: f32,
    near_squared: f32,
    tilt: f32,
}

impl Receiver for LocalPoint {
    const ROUNDED: bool = true;

    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn normal(&self) -> Vec3 {
        self.n
    }

    #[inline(always)]
    fn slack(&self) -> f32 {
        self.slack
    }

    #[inline(always)]
    fn near_squared(&self) -> f32 {
        self.near_squared
    }

    #[inline(always)]
    fn tilt(&self) -> f32 {
        self.tilt
    }
}

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
        LocalPoint {
            p: point.position(),
            n: point.normal(),
            slack: 0.0,
            near_squared: 0.0,
            tilt: 0.0,
        }
    }

    #[inline(always)]
    fn inside(&self, point: &ShadingPoint) -> LocalPoint {
        let per_scale = self.per_scale;
        let back = self.turn_back(flushed(point.position() - self.origin())) * (per_scale * per_scale);
        let p = Vec3::new(
            exact::clamp(back.x, -FAR, FAR),
            exact::clamp(back.y, -FAR, FAR),
            exact::clamp(back.z, -FAR, FAR),
        );
        let distance = (exact::abs(p.x) + exact::abs(p.y)) + exact::abs(p.z);
        let slack = distance * POINT_SLACK + self.error * per_scale;
        let near = slack * NEAR;
        let moved = LocalPoint {
            p: flushed(p),
            n: flushed(self.turn_back(point.normal()) * per_scale),
            slack,
            near_squared: near * near,
            tilt: self.tilt,
        };
        // A bottom level in the world's own space is exact, and so are its points.
        if self.error > 0.0 {
            moved
        } else {
            Self::outside(point)
        }
    }

    #[inline]
    fn to_world(&self, local: &LightBounds) -> LightBounds {
        let center = flushed((local.min + local.max) * 0.5);
        let reach = |k: usize| {
            let (low, high, c) = (
                component(local.min, k),
                component(local.max, k),
                component(center, k),
            );
            exact::max(high - c, c - low)
        };
        let half = flushed(Vec3::new(reach(0), reach(1), reach(2)));
        let absolute = |v: Vec3| Vec3::new(exact::abs(v.x), exact::abs(v.y), exact::abs(v.z));
        let (a, b, c) = (
            absolute(self.column(0)),
            absolute(self.column(1)),
            absolute(self.column(2)),
        );
        let middle = self.turn(center) + self.origin();
        let extent = (a * half.x + b * half.y) + c * half.z;
        // Rounding of the map and of the sums here, 2^-22 of what goes into them; and what the vertices may be off.
        let from = absolute(center);
        let terms = (a * from.x + b * from.y) + (c * from.z + absolute(self.origin()));
        let grown = extent * (1.0 + 4.0 * pow2(-22)) + terms * pow2(-21);
        let outward = Vec3::new(grown.x + self.error, grown.y + self.error, grown.z + self.error);
        let axis = normalized(self.turn(flushed(local.axis)) * self.per_scale);
        let turn = exact::max(self.tilt, LEAST_TURN);
        let cos_theta_o = widened(local.cos_theta_o, turn, turn * turn);

        // Φ with its exponents apart, so that no product leaves the range.
        let scale = exponent(local.phi) + exponent(self.flux);
        let bounded = if scale < -110 {
            -110
        } else if scale > 124 {
            124
        } else {
            scale
        };
        let phi = significand(local.phi) * significand(self.flux) * pow2(bounded);
        let shines = local.phi > 0.0 && self.flux > 0.0;
        // Exact where nothing moves: a bottom level in world space has the same bounds there.
        let moved = self.error > 0.0;
        LightBounds {
            min: if moved { middle - outward } else { local.min },
            max: if moved { middle + outward } else { local.max },
            axis: if moved { axis } else { local.axis },
            cos_theta_o: if moved { cos_theta_o } else { local.cos_theta_o },
            cos_theta_e: local.cos_theta_e,
            phi: if shines {
                exact::clamp(phi, MIN_PHI, MAX_SUM)
            } else {
                0.0
            },
        }
    }
}

const _: () = assert!(MAX_PHI < MAX_SUM);

#[inline(always)]
fn component(v: Vec3, k: usize) -> f32 {
    if k == 0 {
        v.x
    } else if k == 1 {
        v.y
    } else {
        v.z
    }
}

/// Without components that a product could make subnormal.
#[inline(always)]
fn flushed(v: Vec3) -> Vec3 {
    Vec3::new(flush(v.x, TINY), flush(v.y, TINY), flush(v.z, TINY))
}
