//! The size of a mesh, and of what is finest in it.

use super::vector::{cross, dot, greatest, square_root};
use crate::light::EmissiveTriangle;

/// Triangles of a mesh that one thread measures.
#[cfg(feature = "rayon")]
const PIECE: usize = 4096;

/// How large a mesh is, and how fine: what rounding is measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// Greatest distance of a vertex from the mesh's origin, metres.
    pub radius: f64,
    /// Least height of a triangle whose normal counts, metres; infinite where there is none.
    pub finest: f64,
}

impl Extent {
    /// Of a mesh with these triangles.
    pub fn of(triangles: &[EmissiveTriangle]) -> Self {
        #[cfg(feature = "rayon")]
        let squares = {
            use rayon::prelude::*;
            let pieces = triangles.par_chunks(PIECE).map(Self::squares);
            pieces.reduce(|| Self::NONE, Self::and)
        };
        #[cfg(not(feature = "rayon"))]
        let squares = Self::squares(triangles);
        Self {
            radius: square_root(squares.radius),
            finest: if squares.finest < f64::INFINITY {
                square_root(squares.finest)
            } else {
                f64::INFINITY
            },
        }
    }

    const NONE: Self = Self {
        radius: 0.0,
        finest: f64::INFINITY,
    };

    /// The extents of two parts together.
    fn and(self, other: Self) -> Self {
        Self {
            radius: greatest(self.radius, other.radius),
            finest: -greatest(-self.finest, -other.finest),
        }
    }

    /// The squares of the extent.
    fn squares(triangles: &[EmissiveTriangle]) -> Self {
        triangles.iter().fold(Self::NONE, |extent, triangle| {
            let p = triangle.p.map(|p| p.map(f64::from));
            let [a, b, c] = p.map(|vertex| dot(vertex, vertex));
            let radius = greatest(a, greatest(b, c));
            // Only triangles whose normal bounds what they light.
            let bounds = crate::bounds::LightBounds::of_triangle(triangle);
            let finest = if bounds.phi > 0.0 && bounds.cos_theta_o > -1.0 {
                let edge = |i: usize, j: usize| core::array::from_fn(|k| p[j][k] - p[i][k]);
                let (a, b, c) = (edge(0, 1), edge(0, 2), edge(1, 2));
                let longest = greatest(dot(a, a), greatest(dot(b, b), dot(c, c)));
                let area = cross(a, b);
                dot(area, area) / longest
            } else {
                f64::INFINITY
            };
            extent.and(Self { radius, finest })
        })
    }
}
