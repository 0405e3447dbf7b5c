//! Summaries of a mesh in the world.

use glam::Vec3;

use crate::bounds::{LightBounds, LightMoments};
use crate::cone::normalized;
use crate::emission::{MAX_SUM, MIN_PHI};
use crate::exact::{self, exponent, pow2, significand};
use crate::instance::{Instance, flushed};
use crate::light::MIN_COORDINATE;
use crate::vector::{abs3, dot, flush3, greatest_exponent, length_squared};

/// A constant of its own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;

/// Exponent of the least unit of deviations in the world, 2^-84 m: where map and mesh together are smaller they count as zero.
const LEAST_WORLD_EXPONENT: i32 = -84;

impl Instance {
    /// Half extents of the box around a mapped box of the half extents `half`.
    #[inline(always)]
    fn extent_to_world(&self, half: Vec3) -> Vec3 {
        let (a, b, c) = (abs3(self.column(0)), abs3(self.column(1)), abs3(self.column(2)));
        (a * half.x + b * half.y) + c * half.z
    }

    /// Bounds in the world of what has the bounds `local` in the space of the mesh: the box around the mapped box; the cone
    /// about the mapped axis where the map leaves the axis its length, as similarities do, else all directions.
    #[inline(always)]
    pub(crate) fn bounds_to_world(&self, local: &LightBounds) -> LightBounds {
        let center = flushed((local.min + local.max) * 0.5);
        let half = flushed(local.max - center);
        let middle = self.forward(center) + self.origin();
        let extent = self.extent_to_world(half);
        let turned = self.normal_to_world(flushed(local.axis));
        let squared = length_squared(turned);
        let axis = if squared > pow2(-30) {
            normalized(turned * exact::rsqrt(squared))
        } else {
            local.axis
        };
        LightBounds {
            // As coordinates in the world are: nothing is nearer to zero than those, and it.
            min: flush3(middle - extent, MIN_COORDINATE),
            max: flush3(middle + extent, MIN_COORDINATE),
            axis,
            cos_theta_o: if squared > 0.99 && squared < 1.01 {
                local.cos_theta_o
            } else {
                -1.0
            },
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
        let area = if self.mirrored & Self::IS_NOT_BY_AREA == 0 {
            exact::clamp(1.0 + m_squared * (along_axis - 1.0), pow2(-20), 2.0)
        } else {
            1.0
        };

        // Map and deviations of about 1, by powers of two.
        let ([a, b, c], map_exponent) = self.columns_of_one();
        let own_exponent = greatest_exponent(Vec3::new(local.across, local.along, 0.0), -100);
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
        // The roots below are zero or at least 2^-42: deviations are zero or normal numbers.
        let e = map_exponent + own_exponent;
        let unit = if e < LEAST_WORLD_EXPONENT { 0.0 } else { pow2(e) };
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
            h: self.extent_to_world(flushed(local.h)),
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
