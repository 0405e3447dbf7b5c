//! Instances: bottom levels in the space of their mesh, shared by all its places in the world.
//!
//! An instance's map is any affine `x ↦ A x + t`. Weights below it are computed in the mesh's space, at the point brought
//! there by `A⁻¹(x − t)`. Where A scales unevenly, distances there are not in proportion to those in the world: that costs
//! variance, never a light. Moving an instance changes one leaf of the top level and nothing below.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::bounds::{LightBounds, MAX_SUM, MIN_PHI};
use crate::cone::normalized;
use crate::exact::{self, exponent, flush, pow2, significand};
use crate::light::{EmissiveTriangle, MIN_COORDINATE};
use crate::moments::LightMoments;
use crate::point::ShadingPoint;
use crate::trail::BitTrail;
use crate::tree::INVALID;
use crate::vector::{dot, greatest_exponent, length_squared, max3};

/// Lengths below this in a mesh's space count as zero, metres: 2^-60. Entries of the maps are zero or at least 2^-60, so no
/// product with them is subnormal.
const TINY: f32 = pow2(-60);
/// A constant of its own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;
/// Greatest magnitude of a coordinate in a mesh's space, 2^60.
const FAR: f32 = pow2(60);

/// A leaf of the top level: where a mesh stands, and which lights its triangles are there. 132 bytes.
///
/// Plain words, as the device reads them; `Transform` (feature `alloc`) derives them on the CPU.
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
    /// Number of its lights.
    pub count: u32,
    /// Has nothing to do with this instance: entry k of the list of all instances in use stands in record k.
    pub listed: u32,
    /// The columns of A; entries zero or of magnitude 2^-60 to 2^40.
    pub columns: [[f32; 3]; 3],
    /// t, metres.
    pub translation: [f32; 3],
    /// The columns of A⁻¹; entries zero or of magnitude 2^-60 to 2^60.
    pub inverse: [[f32; 3]; 3],
    /// √3 over the Frobenius norm of A⁻¹: makes A⁻ᵀ a map of normals of about unit length.
    pub per_inverse: f32,
    /// Mean factor from the flux of a triangle of the mesh to that in the world: the Frobenius norm of A's cofactors over
    /// √3, times `radiance`; zero, or 2^-100 to 2^100.
    pub flux: f32,
    /// Factor on the mesh's radiance; 0 turns it off.
    pub radiance: f32,
    /// 1 where the map mirrors, else 0.
    pub mirrored: u32,
}

const _: () = assert!(size_of::<Instance>() == 132);

impl Instance {
    /// A bottom level in world space.
    pub const IDENTITY: Self = Self {
        root: u32::MAX,
        trail: [0; 2],
        blas: u32::MAX,
        first: 0,
        first_triangle: 0,
        count: 0,
        listed: 0,
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
        inverse: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        per_inverse: 1.0,
        flux: 1.0,
        radiance: 1.0,
        mirrored: 0,
    };

    /// Its bit trail in the top level.
    #[inline(always)]
    #[must_use]
    pub fn trail(&self) -> BitTrail {
        BitTrail {
            low: self.trail[0],
            high: self.trail[1],
        }
    }

    /// Sets its bit trail in the top level.
    pub fn set_trail(&mut self, trail: BitTrail) {
        self.trail = [trail.low, trail.high];
    }

    /// The light that triangle `triangle` of the bottom level is here.
    #[inline(always)]
    #[must_use]
    pub fn light_of(&self, triangle: u32) -> u32 {
        triangle
            .wrapping_sub(self.first_triangle)
            .wrapping_add(self.first)
    }

    /// The triangle of the bottom level that light `light` is.
    #[inline(always)]
    #[must_use]
    pub fn triangle_of(&self, light: u32) -> u32 {
        light.wrapping_sub(self.first).wrapping_add(self.first_triangle)
    }

    #[inline(always)]
    fn column(&self, k: usize) -> Vec3 {
        vector(&self.columns[k])
    }

    #[inline(always)]
    fn origin(&self) -> Vec3 {
        vector(&self.translation)
    }

    /// A v.
    #[inline(always)]
    fn forward(&self, v: Vec3) -> Vec3 {
        (self.column(0) * v.x + self.column(1) * v.y) + self.column(2) * v.z
    }

    /// A⁻ᵀ v, of about the length of `v`.
    #[inline(always)]
    fn normal_to_world(&self, v: Vec3) -> Vec3 {
        Vec3::new(
            dot(vector(&self.inverse[0]), v),
            dot(vector(&self.inverse[1]), v),
            dot(vector(&self.inverse[2]), v),
        ) * self.per_inverse
    }

    /// A point of the mesh in the world. This function is the definition of where the lights of an instance are.
    #[inline]
    #[must_use]
    pub fn vertex(&self, p: [f32; 3]) -> [f32; 3] {
        let v = self.forward(flushed(vector(&p))) + self.origin();
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

    /// A point of the world in the space of the mesh, its normal again of about unit length.
    #[inline(always)]
    #[must_use]
    pub fn to_local(&self, point: &ShadingPoint) -> ShadingPoint {
        let away = flushed(point.position() - self.origin());
        let p = (vector(&self.inverse[0]) * away.x + vector(&self.inverse[1]) * away.y)
            + vector(&self.inverse[2]) * away.z;
        let n = point.normal();
        let back = flushed(Vec3::new(
            dot(self.column(0), n),
            dot(self.column(1), n),
            dot(self.column(2), n),
        ));
        let length = length_squared(back);
        // A normal that the map loses is that of a volume.
        let scale = if length >= pow2(-119) {
            exact::rsqrt(length)
        } else {
            0.0
        };
        ShadingPoint {
            p: [
                flush(exact::clamp(p.x, -FAR, FAR), TINY),
                flush(exact::clamp(p.y, -FAR, FAR), TINY),
                flush(exact::clamp(p.z, -FAR, FAR), TINY),
            ],
            n: [
                flush(back.x * scale, TINY),
                flush(back.y * scale, TINY),
                flush(back.z * scale, TINY),
            ],
        }
    }

    /// Bounds in the world of what has the bounds `local` in the space of the mesh: the box around the mapped box; the cone
    /// about the mapped axis where the map leaves the axis its length, as similarities do, else all directions.
    #[inline(always)]
    pub(crate) fn bounds_to_world(&self, local: &LightBounds) -> LightBounds {
        let center = flushed((local.min + local.max) * 0.5);
        let half = flushed(local.max - center);
        let (a, b, c) = (
            absolute(self.column(0)),
            absolute(self.column(1)),
            absolute(self.column(2)),
        );
        let middle = self.forward(center) + self.origin();
        let extent = (a * half.x + b * half.y) + c * half.z;
        let turned = self.normal_to_world(flushed(local.axis));
        let squared = length_squared(turned);
        let axis = if squared > pow2(-30) {
            normalized(turned * exact::rsqrt(squared))
        } else {
            local.axis
        };
        LightBounds {
            min: middle - extent,
            max: middle + extent,
            axis,
            cos_theta_o: if squared > 0.99 && squared < 1.01 {
                local.cos_theta_o
            } else {
                -1.0
            },
            cos_theta_e: local.cos_theta_e,
            phi: self.flux_to_world(local.phi, 1.0),
        }
    }

    /// Moments in the world of what has the moments `local` in the space of the mesh: exact for the deviations, as far as they
    /// are alike in all directions across the mean normal.
    #[inline(always)]
    pub(crate) fn moments_to_world(&self, local: &LightMoments) -> LightMoments {
        let m_squared = length_squared(local.m);
        let directed = m_squared > pow2(-16);
        let per_length = exact::rsqrt(if directed { m_squared } else { 1.0 });
        let axis = local.m * per_length;
        let mapped = self.normal_to_world(axis);
        let mapped_squared = length_squared(mapped);
        let has_axis = directed & (mapped_squared > pow2(-40));
        let per_mapped = exact::rsqrt(if has_axis { mapped_squared } else { 1.0 });
        let world_axis = mapped * per_mapped;
        // The factor on areas is that of the normals as far as they agree.
        let along_axis = if has_axis {
            mapped_squared * per_mapped
        } else {
            1.0
        };
        let area = exact::clamp(1.0 + m_squared * (along_axis - 1.0), pow2(-20), 2.0);

        // Map and deviations of about 1, by powers of two.
        let entries = max3(
            absolute(self.column(0)),
            max3(absolute(self.column(1)), absolute(self.column(2))),
        );
        let map_exponent = greatest_exponent(entries, -100);
        let own_exponent = greatest_exponent(Vec3::new(local.across, local.along, 0.0), -100);
        let to_one = pow2(-map_exponent);
        let (a, b, c) = (
            flushed(self.column(0) * to_one),
            flushed(self.column(1) * to_one),
            flushed(self.column(2) * to_one),
        );
        let across = local.across * pow2(-own_exponent);
        let along = local.along * pow2(-own_exponent);
        let (va, vn) = (across * across, along * along);
        let norm = (length_squared(a) + length_squared(b)) + length_squared(c);
        let stretched = (a * axis.x + b * axis.y) + c * axis.z;
        let total = va * norm + (vn - va) * length_squared(stretched);
        let back = Vec3::new(dot(a, world_axis), dot(b, world_axis), dot(c, world_axis));
        let turned = dot(back, axis);
        let along_world = va * length_squared(back) + (vn - va) * (turned * turned);
        let total = exact::flush(exact::max(total, 0.0), pow2(-60));
        let along_world = exact::flush(exact::max(along_world, 0.0), pow2(-60));
        let along_world = if has_axis {
            exact::min(along_world, total)
        } else {
            total * THIRD
        };
        let unit = pow2(map_exponent + own_exponent);
        let h = flushed(local.h);
        let (x, y, z) = (
            absolute(self.column(0)),
            absolute(self.column(1)),
            absolute(self.column(2)),
        );
        LightMoments {
            phi: self.flux_to_world(local.phi, area),
            c: self.forward(flushed(local.c)) + self.origin(),
            across: exact::sqrt((total - along_world) * 0.5) * unit,
            along: exact::sqrt(along_world) * unit,
            m: if has_axis {
                world_axis * (m_squared * per_length)
            } else {
                Vec3::new(0.0, 0.0, 0.0)
            },
            h: (x * h.x + y * h.y) + z * h.z,
        }
    }

    /// Flux Φ of the mesh in the world, `area` the factor on [`flux`](Self::flux) that its normals ask for, 2^-20 to 2. Positive
    /// wherever the mesh shines.
    #[inline(always)]
    pub(crate) fn flux_to_world(&self, phi: f32, area: f32) -> f32 {
        // Exponents apart, so that no product leaves the range.
        let scale = exponent(phi) + exponent(self.flux);
        let bounded = if scale < -110 {
            -110
        } else if scale > 124 {
            124
        } else {
            scale
        };
        let world = (significand(phi) * significand(self.flux) * area) * pow2(bounded);
        if phi > 0.0 && self.flux > 0.0 {
            exact::clamp(world, MIN_PHI, MAX_SUM)
        } else {
            0.0
        }
    }
}

/// Light `light` of instance `instance` in the world, as a [`SampledLight`](crate::SampledLight) names them: `triangles` are those
/// of all bottom levels, in the spaces of their meshes. Without radiance where there is no such light. In a single-level tree
/// `instance` is [`INVALID`], and its one instance is meant.
#[inline]
#[must_use]
pub fn world_light(
    triangles: &[EmissiveTriangle],
    instances: &[Instance],
    light: u32,
    instance: u32,
) -> EmissiveTriangle {
    let index = if instance == INVALID { 0 } else { instance };
    let mut out = EmissiveTriangle {
        p: [[0.0; 3]; 3],
        radiance: [0.0; 3],
        mesh: INVALID,
        flags: 0,
    };
    if index < instances.len() as u32 {
        let own = instances[index as usize];
        let triangle = own.triangle_of(light);
        let is_own = light.wrapping_sub(own.first) < own.count;
        if is_own && triangle < triangles.len() as u32 {
            let local = triangles[triangle as usize];
            out = own.triangle(&local, index);
        }
    }
    out
}

#[inline(always)]
fn vector(v: &[f32; 3]) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

#[inline(always)]
fn absolute(v: Vec3) -> Vec3 {
    Vec3::new(exact::abs(v.x), exact::abs(v.y), exact::abs(v.z))
}

/// Without components that a product could make subnormal.
#[inline(always)]
fn flushed(v: Vec3) -> Vec3 {
    Vec3::new(flush(v.x, TINY), flush(v.y, TINY), flush(v.z, TINY))
}
