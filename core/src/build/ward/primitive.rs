//! Primitives of the wide builder.

use crate::light::Light;

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
    pub fn of_light<L: Light>(index: u32, light: &L) -> Self {
        Self {
            c: light.centroid(),
            phi: light.bounds().phi,
            index,
        }
    }

    /// Position and flux side by side.
    #[inline(always)]
    pub(in crate::build) fn lanes(&self) -> [f32; 4] {
        [self.c[0], self.c[1], self.c[2], self.phi]
    }
}
