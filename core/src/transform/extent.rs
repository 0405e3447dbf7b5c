//! The size of a mesh.

use crate::exact;
use crate::light::Light;

/// Triangles of a mesh that one thread measures.
#[cfg(feature = "rayon")]
const PIECE: usize = 4096;

/// How large a mesh is: a transform must leave it within the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// Greatest magnitude of a coordinate that a light reaches, metres; not less than it where that is not known exactly.
    pub coordinate: f64,
    /// Whether it is known exactly: not where the triangle that reached farthest was replaced.
    pub is_exact: bool,
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
            is_exact: true,
        }
    }

    /// Once triangles of extent `new` are in place of some of extent `old`: never less than the truth, in time in proportion to
    /// what changed.
    pub fn with(&self, old: &Self, new: &Self) -> Self {
        let grows = new.coordinate >= self.coordinate;
        Self {
            coordinate: if grows { new.coordinate } else { self.coordinate },
            is_exact: grows || (self.is_exact && old.is_exact && old.coordinate < self.coordinate),
        }
    }
}

fn greatest_coordinate<L: Light>(triangles: &[L]) -> f32 {
    let reaches = triangles.iter().map(Light::reach);
    reaches.fold(0.0, exact::max)
}
