//! The size of a mesh.

use crate::exact;
use crate::light::Light;

/// Triangles of a mesh that one thread measures.
#[cfg(feature = "rayon")]
const PIECE: usize = 4096;

/// How large a mesh is: a transform must leave it within the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// Greatest magnitude of a coordinate that a light reaches, metres.
    pub coordinate: f64,
}

impl Extent {
    /// Of a mesh with these triangles.
    pub fn of<L: Light>(triangles: &[L]) -> Self {
        #[cfg(feature = "rayon")]
        let coordinate = {
            use rayon::prelude::*;
            let pieces = triangles.par_chunks(PIECE).map(greatest_coordinate);
            pieces.reduce(|| 0.0, exact::max)
        };
        #[cfg(not(feature = "rayon"))]
        let coordinate = greatest_coordinate(triangles);
        Self {
            coordinate: f64::from(coordinate),
        }
    }
}

fn greatest_coordinate<L: Light>(triangles: &[L]) -> f32 {
    let reaches = triangles.iter().map(Light::reach);
    reaches.fold(0.0, exact::max)
}
