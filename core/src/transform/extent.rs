//! The size of a mesh.

use super::vector::{dot, greatest, square_root};
use crate::light::EmissiveTriangle;

/// Triangles of a mesh that one thread measures.
#[cfg(feature = "rayon")]
const PIECE: usize = 4096;

/// How large a mesh is: a transform must leave it within the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// Greatest distance of a vertex from the mesh's origin, metres.
    pub radius: f64,
}

impl Extent {
    /// Of a mesh with these triangles.
    pub fn of(triangles: &[EmissiveTriangle]) -> Self {
        #[cfg(feature = "rayon")]
        let squared = {
            use rayon::prelude::*;
            let pieces = triangles.par_chunks(PIECE).map(radius_squared);
            pieces.reduce(|| 0.0, greatest)
        };
        #[cfg(not(feature = "rayon"))]
        let squared = radius_squared(triangles);
        Self {
            radius: square_root(squared),
        }
    }
}

fn radius_squared(triangles: &[EmissiveTriangle]) -> f64 {
    triangles
        .iter()
        .flat_map(|triangle| triangle.p)
        .fold(0.0, |most, p| {
            let p = p.map(f64::from);
            greatest(most, dot(p, p))
        })
}
