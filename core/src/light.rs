//! The light that this crate samples: an emissive triangle, and the domain in which it is accepted.

mod point;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

pub use point::{LightPoint, uniform_point};

use crate::error::Number;
use crate::exact;

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// [`EmissiveTriangle::flags`] bit: the triangle emits from both faces.
pub const TWO_SIDED: u32 = 1;

/// Largest magnitude of a coordinate, metres: 2^40.
pub const MAX_COORDINATE: f32 = exact::pow2(40);
/// Smallest magnitude of a coordinate that is not zero, metres: 2^-100. The difference of two coordinates is then zero
/// or a normal number, which a device that flushes subnormal numbers keeps.
pub const MIN_COORDINATE: f32 = exact::pow2(-100);
/// Smallest radiance that is not zero, W/(m² sr): 2^-100.
pub const MIN_RADIANCE: f32 = exact::pow2(-100);
/// Largest radiance, W/(m² sr): 2^100.
pub const MAX_RADIANCE: f32 = exact::pow2(100);

/// A triangle that emits the same radiance in every direction of its front side (or of both sides).
///
/// The front side is the one from which the vertices run counter-clockwise; `(p1 − p0) × (p2 − p0)` points to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct EmissiveTriangle {
    /// Vertices, metres, in the space of the mesh (for `Lights`, of the world); magnitude zero or in [`MIN_COORDINATE`]`..=`[`MAX_COORDINATE`].
    pub p: [[f32; 3]; 3],
    /// Radiance, W/(m² sr), linear RGB; zero or in [`MIN_RADIANCE`]`..=`[`MAX_RADIANCE`].
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

    /// Vertex `k` in 0..3.
    #[inline]
    #[must_use]
    pub fn vertex(&self, k: usize) -> Vec3 {
        Vec3::new(self.p[k][0], self.p[k][1], self.p[k][2])
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
        (0.2126 * self.radiance[0] + 0.7152 * self.radiance[1]) + 0.0722 * self.radiance[2]
    }

    /// Brings the triangle into the domain of this crate, or says why it cannot be.
    ///
    /// Coordinates smaller than [`MIN_COORDINATE`] become zero (with the sign of zero dropped); nothing else changes.
    ///
    /// # Errors
    /// [`LightError`] for a coordinate or radiance that is not finite or out of range, for negative radiance, and for flags that mean
    /// nothing.
    pub fn checked(mut self) -> Result<Self, LightError> {
        for vertex in 0..3 {
            for axis in 0..3 {
                let value = self.p[vertex][axis];
                // NaN is in no range.
                if !(-MAX_COORDINATE..=MAX_COORDINATE).contains(&value) {
                    return Err(LightError::Coordinate { vertex, axis, value });
                }
                self.p[vertex][axis] = exact::flush(value, MIN_COORDINATE);
            }
        }
        for channel in 0..3 {
            let value = self.radiance[channel];
            let in_range = value == 0.0 || (MIN_RADIANCE..=MAX_RADIANCE).contains(&value);
            if !in_range {
                return Err(LightError::Radiance { channel, value });
            }
            self.radiance[channel] = exact::flush(value, MIN_RADIANCE);
        }
        if self.flags & !TWO_SIDED != 0 {
            return Err(LightError::Flags { flags: self.flags });
        }
        Ok(self)
    }
}

/// Why a light is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LightError {
    /// A coordinate is NaN, infinite or beyond [`MAX_COORDINATE`].
    Coordinate {
        /// Which vertex, 0..3.
        vertex: usize,
        /// Which coordinate: x, y, z as 0, 1, 2.
        axis: usize,
        /// What was found.
        value: f32,
    },
    /// A radiance is NaN, infinite, negative, above [`MAX_RADIANCE`], or positive and below [`MIN_RADIANCE`].
    Radiance {
        /// Which channel: R, G, B as 0, 1, 2.
        channel: usize,
        /// What was found.
        value: f32,
    },
    /// A bit of [`flags`](EmissiveTriangle::flags) that means nothing.
    Flags {
        /// What was found.
        flags: u32,
    },
}

impl core::fmt::Display for LightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Coordinate { vertex, axis, value } => write!(
                f,
                "coordinate {} of vertex {vertex} is {}, expected a finite number of magnitude at most 2^40 (1.1e12); \
                 scale the scene or repair the mesh",
                ['x', 'y', 'z'][axis],
                Number(value)
            ),
            Self::Radiance { channel, value } => write!(
                f,
                "{} radiance is {}, expected 0 or a number from 2^-100 to 2^100 (7.9e-31 to 1.3e30); repair the material's emission",
                ["red", "green", "blue"][channel],
                Number(value)
            ),
            Self::Flags { flags } => write!(
                f,
                "flags are {flags:#x}, expected 0 or TWO_SIDED ({TWO_SIDED}); clear the other bits"
            ),
        }
    }
}

impl core::error::Error for LightError {}
