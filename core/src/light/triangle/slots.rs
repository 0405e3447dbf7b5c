//! Triangles as processors compute several of them at a time.

use crate::light::{EmissiveTriangle, LightSlots};

/// The triangles of a node's slots word by word, as [`Lanes`](crate::summary::Lanes).
#[derive(Clone, Copy, Debug)]
pub struct Triangles<const W: usize> {
    /// The vertices, then the radiance.
    words: [[f32; W]; 12],
    flags: [u32; W],
    /// All ones in a slot with a triangle, else zero.
    present: [u32; W],
}

impl<const W: usize> LightSlots<EmissiveTriangle, W> for Triangles<W> {
    const NONE: Self = Self {
        words: [[0.0; W]; 12],
        flags: [0; W],
        present: [0; W],
    };

    #[inline(always)]
    fn set(&mut self, slot: usize, triangle: &EmissiveTriangle) {
        for k in 0..3 {
            self.words[k][slot] = triangle.p[0][k];
            self.words[3 + k][slot] = triangle.p[1][k];
            self.words[6 + k][slot] = triangle.p[2][k];
            self.words[9 + k][slot] = triangle.radiance[k];
        }
        self.flags[slot] = triangle.flags;
        self.present[slot] = u32::MAX;
    }

    #[inline(always)]
    fn remove(&mut self, slot: usize) {
        self.present[slot] = 0;
    }

    #[inline(always)]
    fn present(&self, slot: usize) -> u32 {
        self.present[slot]
    }

    #[inline(always)]
    fn get(&self, slot: usize) -> EmissiveTriangle {
        let w = &self.words;
        EmissiveTriangle {
            p: [
                [w[0][slot], w[1][slot], w[2][slot]],
                [w[3][slot], w[4][slot], w[5][slot]],
                [w[6][slot], w[7][slot], w[8][slot]],
            ],
            radiance: [w[9][slot], w[10][slot], w[11][slot]],
            mesh: 0,
            flags: self.flags[slot],
        }
    }
}
