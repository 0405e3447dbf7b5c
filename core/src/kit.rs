//! Shared by the tests of core: numbers, triangles, scenes.

pub mod lights;
mod numbers;
pub mod plain;
pub mod scenes;

pub use numbers::*;

use crate::light::EmissiveTriangle;

/// A triangle that shines 1 W/(m² sr).
pub fn triangle(p: [[f32; 3]; 3]) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}
