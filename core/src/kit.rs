//! Shared by the tests of core: numbers, triangles, scenes.

pub mod lights;
mod numbers;
pub mod scenes;

pub use numbers::*;

use crate::light::EmissiveTriangle;
use crate::node::{Node, kind};

/// A triangle that shines 1 W/(m² sr).
pub fn triangle(p: [[f32; 3]; 3]) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

/// A node over lights of these summaries.
pub fn node<N: Node<W>, const W: usize>(sets: &[N::Summary; W]) -> N {
    let mut node = N::EMPTY;
    (0..W).for_each(|slot| node.set_child(slot, kind::LIGHT, slot as u32));
    node.set_summaries(sets);
    node
}
