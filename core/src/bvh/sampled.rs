//! A light sample with all that shading needs, and whose light it is.

use super::edit::{InstanceId, MeshId};
use crate::light::LightPoint;

/// A light sample: the light, a point on it, and its irradiance. The estimate is [`irradiance`](Self::irradiance) over [`pmf`](Self::pmf).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sampled<L> {
    /// The light, in the world.
    pub light: L,
    /// Whose it is.
    pub instance: InstanceId,
    /// Its place in its mesh, as that was given, counting from 0.
    pub part: u32,
    /// Probability of the light, in (0, 1].
    pub pmf: f32,
    /// The point on it, with its density over area.
    pub point: LightPoint,
    /// Direction from the receiver to the point, of length 1 within 2^-16; zero where it lies within 2^-50 m.
    pub direction: [f32; 3],
    /// Distance to the point, metres.
    pub distance: f32,
    /// Density over solid angle, `pmf` included, 1/sr; 0 where no ray meets the light, as of points and spots. See
    /// [`mis_weight`](crate::light::mis_weight).
    pub pdf: f32,
    /// Irradiance from the point, visibility apart, W/m², linear RGB: [`LightPoint::irradiance`], at the side of a
    /// [`TransmissivePoint`](crate::importance::TransmissivePoint) that the point is seen from.
    pub irradiance: [f32; 3],
}

/// Whose light a [`SampledLight`](crate::SampledLight) is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Owner<L> {
    /// The light, in the world.
    pub light: L,
    /// Whose it is.
    pub instance: InstanceId,
    /// Its place in its mesh, as that was given, counting from 0.
    pub part: u32,
    /// The mesh; a light by itself has one of its own.
    pub mesh: MeshId,
}
