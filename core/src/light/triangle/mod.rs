//! Emissive triangles.

mod point;
mod slots;
mod summaries;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use self::slots::Triangles;
use self::summaries::{has_flux, moments};
use super::record::{Light, checked_sides, greatest, of_mesh, shining};
use super::{INVALID, LightPoint, TWO_SIDED};
use crate::bounds::{LightBounds, LightMoments};
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::luminance_of;
use crate::instance::Instance;
use crate::vector::vector;

/// A triangle that emits the same radiance in every direction of its front side (or of both sides).
///
/// The front side is the one from which the vertices run counter-clockwise; `(p1 − p0) × (p2 − p0)` points to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct EmissiveTriangle {
    /// Vertices, metres, in the space of the mesh (for `Lights`, of the world); magnitude zero or in [`MIN_COORDINATE`](super::MIN_COORDINATE)`..=`[`MAX_COORDINATE`](super::MAX_COORDINATE).
    pub p: [[f32; 3]; 3],
    /// Radiance, W/(m² sr), linear RGB; zero or in [`MIN_RADIANCE`](super::MIN_RADIANCE)`..=`[`MAX_RADIANCE`](super::MAX_RADIANCE).
    pub radiance: [f32; 3],
    /// Index of the mesh light that owns the triangle: what [`Lights`](crate::Lights) takes, and what a light in the world has. Not looked
    /// at where a mesh is given to a [`Bvh`](crate::Bvh).
    pub mesh: u32,
    /// [`TWO_SIDED`](Self::TWO_SIDED) or 0.
    pub flags: u32,
}

const _: () = assert!(size_of::<EmissiveTriangle>() == 56);

impl EmissiveTriangle {
    /// Bit of [`flags`](Self::flags): the triangle emits from both faces.
    pub const TWO_SIDED: u32 = TWO_SIDED;

    /// Vertex `k` in 0..3; the last one for any other.
    #[inline]
    #[must_use]
    pub fn vertex(&self, k: usize) -> Vec3 {
        // By a choice: rust-gpu inlines whatever has an index that might be out of bounds.
        let p = if k == 0 {
            self.p[0]
        } else if k == 1 {
            self.p[1]
        } else {
            self.p[2]
        };
        vector(&p)
    }

    /// Whether both faces emit.
    #[inline]
    #[must_use]
    pub fn is_two_sided(&self) -> bool {
        self.flags & TWO_SIDED != 0
    }

    /// Luminance of the radiance (Rec. ITU-R BT.709-6, section 3: the weights of linear R, G, B).
    #[inline]
    #[must_use]
    pub fn luminance(&self) -> f32 {
        luminance_of(&self.radiance)
    }
}

impl Light for EmissiveTriangle {
    const NAME: &'static str = "emissive triangle";
    const DARK: Self = Self {
        p: [[0.0; 3]; 3],
        radiance: [0.0; 3],
        mesh: INVALID,
        flags: 0,
    };
    of_mesh!();
    type Slots<const W: usize> = Triangles<W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p[0] = checked_place("first vertex of a triangle", self.p[0])?;
        self.p[1] = checked_place("second vertex of a triangle", self.p[1])?;
        self.p[2] = checked_place("third vertex of a triangle", self.p[2])?;
        self.radiance = checked_emission("radiance of a triangle", self.radiance)?;
        checked_sides(self.flags)?;
        Ok(self)
    }

    #[inline(always)]
    fn centroid(&self) -> [f32; 3] {
        let p = &self.p;
        let third = |k: usize| ((p[0][k] + p[1][k]) + p[2][k]) * (1.0 / 3.0);
        [third(0), third(1), third(2)]
    }

    fn reach(&self) -> f32 {
        greatest(self.p.as_flattened())
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        has_flux(self)
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        LightBounds::of_triangle(self)
    }

    #[inline(always)]
    fn moments(&self) -> LightMoments {
        moments(self)
    }

    /// Where the map mirrors, two vertices are swapped, so that the front stays in front. A triangle without flux in the mesh, having no
    /// area there, has no radiance in the world, whatever area rounding may give it: no tree holds it.
    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        let [a, b, c] = self.p;
        let (a, b, c) = (instance.vertex(a), instance.vertex(b), instance.vertex(c));
        let mirrored = instance.mirrors();
        Self {
            p: [a, if mirrored { c } else { b }, if mirrored { b } else { c }],
            radiance: shining(&self.radiance, &instance.radiance, has_flux(self)),
            mesh: index,
            flags: self.flags,
        }
    }

    #[inline(always)]
    fn point_for(&self, _from: Vec3, uv: [f32; 2]) -> LightPoint {
        self.point(uv)
    }
}
