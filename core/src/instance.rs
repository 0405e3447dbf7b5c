//! Instances: bottom levels in the space of their mesh, shared by all its places in the world.
//!
//! An instance's map is any affine `x ↦ A x + t`. Weights below it are computed in the mesh's space, at the point brought
//! there by `A⁻¹(x − t)`. Where A scales unevenly, distances there are not in proportion to those in the world: that costs
//! variance, never a light. Moving an instance changes one leaf of the top level and nothing below.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::domain::{MAX_COORDINATE, MIN_COORDINATE};
use crate::exact::{self, flush, pow2};
use crate::vector::{abs3, cross, dot, flush3, greatest_exponent, length_squared, max3, vector};

/// Lengths below this in a mesh's space count as zero, metres: 2^-60. Entries of the maps are zero or at least 2^-60, so no
/// product with them is subnormal.
pub(crate) const TINY: f32 = pow2(-60);
/// Products below this count as zero, as coordinates do, metres: no sum of such numbers is subnormal.
const LEAST_PRODUCT: f32 = MIN_COORDINATE;
const THIRD: f32 = 1.0 / 3.0;
/// Greatest magnitude of a coordinate in a mesh's space, 2^60.
pub(crate) const FAR: f32 = pow2(60);

/// A placed mesh: its map into the world, and the numbers of its lights. 136 bytes.
///
/// Plain words, as the device reads them; `Transform` (feature `alloc`) derives them on the CPU.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// Node index of the root of its bottom level; `u32::MAX` where its mesh is one light, which has none.
    pub root: u32,
    /// Index of its mesh, and of the root of its bottom level.
    pub blas: u32,
    /// Its first light; its lights are numbered without gaps.
    pub first: u32,
    /// The triangle that its first light is.
    pub first_light: u32,
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
    /// Mean factor from the flux of a light of the mesh to that in the world: the luminance of `radiance`, times what A makes of areas:
    /// the Frobenius norm of its cofactors over √3, or 1 of a mesh whose lights have no size ([`Light::is_surface`](crate::light::Light::is_surface)). Zero, or 2^-100 to 2^100.
    pub flux: f32,
    /// Factor on the mesh's radiance, linear RGB; zeros turn it off.
    pub radiance: [f32; 3],
    /// Which receivers it lights, as bits: those whose mask has one of them ([`LinkedPoint`](crate::importance::LinkedPoint)). Read where nodes
    /// store masks, by nothing else.
    pub mask: u32,
    /// [`MIRRORS`](Self::MIRRORS) where the map mirrors, and [`IS_NOT_BY_AREA`](Self::IS_NOT_BY_AREA).
    pub mirrored: u32,
}

const _: () = assert!(size_of::<Instance>() == 136);

impl Instance {
    /// A bottom level in world space.
    pub const IDENTITY: Self = Self {
        root: u32::MAX,
        blas: u32::MAX,
        first: 0,
        first_light: 0,
        count: 0,
        listed: 0,
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
        inverse: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        per_inverse: 1.0,
        flux: 1.0,
        radiance: [1.0; 3],
        mask: u32::MAX,
        mirrored: 0,
    };

    /// Bit of [`mirrored`](Self::mirrored): the determinant of A is negative.
    pub const MIRRORS: u32 = 1;
    /// Bit of [`mirrored`](Self::mirrored): a mesh of lights, none of which emits from a surface.
    pub const IS_NOT_BY_AREA: u32 = 2;

    /// Whether its map turns left hands into right ones.
    #[inline(always)]
    #[must_use]
    pub fn mirrors(&self) -> bool {
        self.mirrored & Self::MIRRORS != 0
    }

    /// The light that triangle `triangle` of the bottom level is here.
    #[inline(always)]
    #[must_use]
    pub fn light_of(&self, triangle: u32) -> u32 {
        triangle.wrapping_sub(self.first_light).wrapping_add(self.first)
    }

    /// The triangle of the bottom level that light `light` is.
    #[inline(always)]
    #[must_use]
    pub fn triangle_of(&self, light: u32) -> u32 {
        light.wrapping_sub(self.first).wrapping_add(self.first_light)
    }

    #[inline(always)]
    pub(crate) fn column(&self, k: usize) -> Vec3 {
        // By a choice: rust-gpu inlines whatever has an index that might be out of bounds.
        if k == 0 {
            vector(&self.columns[0])
        } else if k == 1 {
            vector(&self.columns[1])
        } else {
            vector(&self.columns[2])
        }
    }

    #[inline(always)]
    pub(crate) fn origin(&self) -> Vec3 {
        vector(&self.translation)
    }

    /// A v, of components zero or at least 2^-60. What its own are, zero or a normal number, a sum with a coordinate is too.
    #[inline(always)]
    pub(crate) fn forward(&self, v: Vec3) -> Vec3 {
        flush3(self.column(0) * v.x + self.column(1) * v.y, LEAST_PRODUCT) + self.column(2) * v.z
    }

    /// A⁻ᵀ v, of about the length of `v`.
    #[inline(always)]
    pub(crate) fn normal_to_world(&self, v: Vec3) -> Vec3 {
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
        let v = within(self.mapped(vector(&p)) + self.origin());
        [v.x, v.y, v.z]
    }

    /// A direction of the mesh in the world, again of length 1; itself where the map loses it.
    #[inline(always)]
    pub(crate) fn direction_to_world(&self, v: Vec3) -> Vec3 {
        let there = self.forward(flushed(v));
        let scaled = flushed(there * pow2(-greatest_exponent(there, -100)));
        let squared = length_squared(scaled);
        let unit = scaled * exact::rsqrt(exact::max(squared, pow2(-60)));
        let is_kept = exact::mask_of(squared > pow2(-40));
        Vec3::new(
            f32::from_bits(exact::masked_u32(is_kept, unit.x.to_bits(), v.x.to_bits())),
            f32::from_bits(exact::masked_u32(is_kept, unit.y.to_bits(), v.y.to_bits())),
            f32::from_bits(exact::masked_u32(is_kept, unit.z.to_bits(), v.z.to_bits())),
        )
    }

    /// The columns, the greatest entry of magnitude 1 to 2, times two to this power.
    #[inline(always)]
    pub(crate) fn columns_of_one(&self) -> ([Vec3; 3], i32) {
        let (a, b, c) = (self.column(0), self.column(1), self.column(2));
        let e = greatest_exponent(max3(max3(abs3(a), abs3(b)), abs3(c)), -60);
        let to_one = pow2(-e);
        ([flushed(a * to_one), flushed(b * to_one), flushed(c * to_one)], e)
    }

    /// How much longer lengths are in the world, in the mean: the root of the factor on areas, which is the root mean square over all directions.
    #[inline(always)]
    pub(crate) fn scale(&self) -> f32 {
        let ([a, b, c], e) = self.columns_of_one();
        let tiny = pow2(-50);
        let (ab, bc, ca) = (
            flush3(cross(a, b), tiny),
            flush3(cross(b, c), tiny),
            flush3(cross(c, a), tiny),
        );
        let squared = (length_squared(ab) + length_squared(bc)) + length_squared(ca);
        exact::sqrt(exact::sqrt(squared * THIRD)) * pow2(e)
    }

    /// A vector of the mesh in the world, metres: within the domain of coordinates.
    #[inline(always)]
    pub(crate) fn edge_to_world(&self, v: Vec3) -> Vec3 {
        within(self.mapped(v))
    }

    /// A v, as the definition of where lights are has it.
    #[inline(always)]
    fn mapped(&self, v: Vec3) -> Vec3 {
        let (a, b, c) = (self.column(0) * v.x, self.column(1) * v.y, self.column(2) * v.z);
        (flush3(a, LEAST_PRODUCT) + flush3(b, LEAST_PRODUCT)) + flush3(c, LEAST_PRODUCT)
    }

    /// A direction of the world in the space of the mesh, again of about unit length; zero where the map loses it.
    #[inline(always)]
    pub(crate) fn direction_to_local(&self, v: Vec3) -> Vec3 {
        let v = flushed(v);
        let two = vector(&self.inverse[0]) * v.x + vector(&self.inverse[1]) * v.y;
        let back = flush3(two, LEAST_PRODUCT) + vector(&self.inverse[2]) * v.z;
        let e = greatest_exponent(back, -100);
        let scaled = flushed(back * pow2(-e));
        scaled * exact::rsqrt(exact::max(length_squared(scaled), pow2(-60)))
    }
}

/// Within the domain of coordinates.
#[inline(always)]
fn within(v: Vec3) -> Vec3 {
    let within = |x: f32| flush(exact::clamp(x, -MAX_COORDINATE, MAX_COORDINATE), MIN_COORDINATE);
    Vec3::new(within(v.x), within(v.y), within(v.z))
}

/// Without components that a product could make subnormal.
#[inline(always)]
pub(crate) fn flushed(v: Vec3) -> Vec3 {
    Vec3::new(flush(v.x, TINY), flush(v.y, TINY), flush(v.z, TINY))
}

#[cfg(all(test, feature = "alloc"))]
mod tests;
