//! Emissive triangles.

mod point;
mod slots;
mod summaries;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use self::slots::Triangles;
use self::summaries::has_flux;
use super::record::{Light, shining, wrong_flags};
use super::{INVALID, LightPoint, TWO_SIDED};
use crate::bounds::{LightBounds, LightMoments};
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::luminance_of;
use crate::exact;
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

    /// Brings the triangle into the domain of this crate, or says why it cannot be.
    ///
    /// Coordinates smaller than [`MIN_COORDINATE`](super::MIN_COORDINATE) become zero (with the sign of zero dropped); nothing else changes.
    ///
    /// # Errors
    /// [`DomainError`] for a coordinate or radiance that is not finite or out of range, for negative radiance, and for flags that mean
    /// nothing.
    pub fn checked(mut self) -> Result<Self, DomainError> {
        self.p[0] = checked_place("first vertex of a triangle", self.p[0])?;
        self.p[1] = checked_place("second vertex of a triangle", self.p[1])?;
        self.p[2] = checked_place("third vertex of a triangle", self.p[2])?;
        self.radiance = checked_emission("radiance of a triangle", self.radiance)?;
        if self.flags & !TWO_SIDED != 0 {
            return Err(wrong_flags(self.flags));
        }
        Ok(self)
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
    const MESH_WORD: usize = core::mem::offset_of!(Self, mesh) / 4;
    type Slots<const W: usize> = Triangles<W>;

    fn checked(self) -> Result<Self, DomainError> {
        Self::checked(self)
    }

    #[inline(always)]
    fn mesh(&self) -> u32 {
        self.mesh
    }

    #[inline(always)]
    fn of_mesh(self, mesh: u32) -> Self {
        Self { mesh, ..self }
    }

    #[inline(always)]
    fn centroid(&self) -> [f32; 3] {
        let p = &self.p;
        let third = |k: usize| ((p[0][k] + p[1][k]) + p[2][k]) * (1.0 / 3.0);
        [third(0), third(1), third(2)]
    }

    fn reach(&self) -> f32 {
        let coordinates = self.p.iter().flatten();
        coordinates.fold(0.0, |most, &x| exact::max(most, exact::abs(x)))
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
        LightMoments::of_triangle(self)
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        instance.triangle(self, index)
    }

    #[inline(always)]
    fn point_for(&self, _from: Vec3, uv: [f32; 2]) -> LightPoint {
        self.point(uv)
    }
}

impl Instance {
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
        let mirrored = self.mirrors();
        EmissiveTriangle {
            p: [a, if mirrored { c } else { b }, if mirrored { b } else { c }],
            radiance: shining(&local.radiance, &self.radiance, has_flux(local)),
            mesh: index,
            flags: local.flags,
        }
    }
}
