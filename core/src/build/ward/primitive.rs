//! What the wide builder sorts.

use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::bounds::LightBounds;
use crate::light::EmissiveTriangle;

/// A light, or a group of lights, as Ward's criterion sees it: 20 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WardPrimitive {
    /// Flux-weighted centre, metres; magnitude zero or in about 2^-124..=2^40.
    pub c: [f32; 3],
    /// Flux, W; zero or in 2^-100..=2^126.
    pub phi: f32,
    /// Index of the light.
    pub index: u32,
}

impl WardPrimitive {
    /// A light of radiance that does not vary over it: its centre of flux is its centroid.
    #[inline]
    #[must_use]
    pub fn of_triangle(index: u32, triangle: &EmissiveTriangle) -> Self {
        let p = &triangle.p;
        let third = |k: usize| ((p[0][k] + p[1][k]) + p[2][k]) * (1.0 / 3.0);
        Self {
            c: [third(0), third(1), third(2)],
            phi: LightBounds::of_triangle(triangle).phi,
            index,
        }
    }

    /// Position and flux side by side.
    #[inline(always)]
    pub(in crate::build) fn lanes(&self) -> [f32; 4] {
        [self.c[0], self.c[1], self.c[2], self.phi]
    }
}

/// One primitive for each of `triangles`, by index.
#[must_use]
pub fn ward_primitives(triangles: &[EmissiveTriangle]) -> Vec<WardPrimitive> {
    let of = |(i, triangle): (usize, &EmissiveTriangle)| WardPrimitive::of_triangle(i as u32, triangle);
    #[cfg(feature = "rayon")]
    if super::is_parallel(triangles.len()) {
        return triangles
            .par_iter()
            .enumerate()
            .with_min_len(super::CHUNK)
            .map(of)
            .collect();
    }
    triangles.iter().enumerate().map(of).collect()
}
