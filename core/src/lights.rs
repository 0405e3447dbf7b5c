//! Validated input: lights in the world, grouped into mesh lights.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use crate::domain::DomainError;
use crate::light::{EmissiveTriangle, Light};

/// Most lights that one light BVH holds: 2^30, so that every index and word address fits 32 bits.
pub const MAX_LIGHTS: usize = 1 << 30;

/// Lights within the domain of this crate, ordered by mesh light. Everything behind this type may rely on
/// that.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights<L = EmissiveTriangle> {
    lights: Vec<L>,
    /// First light of each mesh light, then the number of lights.
    starts: Vec<u32>,
}

impl<L: Light> Lights<L> {
    /// Takes lights ordered by mesh light: `mesh` starts at 0 and grows by at most one from light to light. There may be
    /// none.
    ///
    /// # Errors
    /// [`LightsError`], naming the light, when one is outside the domain or out of order, and when there are more than
    /// [`MAX_LIGHTS`].
    pub fn new(mut lights: Vec<L>) -> Result<Self, LightsError> {
        if lights.len() > MAX_LIGHTS {
            return Err(LightsError::TooMany { count: lights.len() });
        }
        let mut starts = Vec::new();
        for (index, light) in lights.iter_mut().enumerate() {
            *light = light
                .checked()
                .map_err(|error| LightsError::Light { index, error })?;
            let next = starts.len() as u32;
            if light.mesh() == next {
                starts.push(index as u32);
            } else if next == 0 || light.mesh() != next - 1 {
                return Err(LightsError::Order {
                    index,
                    expected: next,
                    found: light.mesh(),
                });
            }
        }
        starts.push(lights.len() as u32);
        Ok(Self { lights, starts })
    }

    /// The lights.
    #[must_use]
    pub fn all(&self) -> &[L] {
        &self.lights
    }

    /// Number of mesh lights.
    #[must_use]
    pub fn mesh_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The lights of mesh light `mesh`, below [`mesh_count`](Self::mesh_count).
    #[must_use]
    pub fn mesh(&self, mesh: usize) -> Range<usize> {
        self.starts[mesh] as usize..self.starts[mesh + 1] as usize
    }
}

/// Why lights are refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LightsError {
    /// More than [`MAX_LIGHTS`] lights.
    TooMany {
        /// How many there are.
        count: usize,
    },
    /// A light is outside the domain.
    Light {
        /// Its index.
        index: usize,
        /// What is wrong with it.
        error: DomainError,
    },
    /// A light names a mesh light out of order.
    Order {
        /// Index of the light.
        index: usize,
        /// The mesh light that may begin here; the one before it may go on.
        expected: u32,
        /// The mesh light of the light.
        found: u32,
    },
}

impl fmt::Display for LightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooMany { count } => {
                write!(f, "{count} lights, expected at most 2^30; split the scene")
            }
            Self::Light { index, error } => write!(f, "light {index}: {error}"),
            Self::Order {
                index,
                expected,
                found,
            } => write!(
                f,
                "light {index} belongs to mesh light {found}, expected {expected} or the one before it; \
                 order the lights by mesh light"
            ),
        }
    }
}

impl core::error::Error for LightsError {}
