//! The size of a mesh.

use crate::exact;
use crate::light::Light;

/// How large a mesh is: a transform must leave it within the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// Greatest magnitude of a coordinate that a light reaches, metres.
    pub coordinate: f64,
}

impl Extent {
    /// Of a mesh with these triangles.
    pub fn of<L: Light>(triangles: &[L]) -> Self {
        let reaches = triangles.iter().map(Light::reach);
        Self {
            coordinate: f64::from(reaches.fold(0.0, exact::max)),
        }
    }
}
