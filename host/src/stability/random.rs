//! Random numbers: a seeded stream, and the ends of the range.

use lightbvh::{Random64, exact};

/// A small stream of random numbers on the crate's own hash.
#[derive(Clone, Debug)]
pub struct Random(u32);

impl Random {
    /// A stream from a seed.
    pub fn new(seed: u32) -> Self {
        Self(exact::hash(seed ^ 0x9e37_79b9))
    }

    /// 32 uniform bits.
    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        exact::hash(self.0)
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f32 {
        exact::unit_f32(self.bits())
    }

    /// Uniform in `[low, high)`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Uniform in `0..n`.
    pub fn below(&mut self, n: u32) -> u32 {
        (self.unit() * n as f32) as u32
    }

    /// A uniform direction.
    pub fn direction(&mut self) -> [f32; 3] {
        loop {
            let v = [
                self.between(-1.0, 1.0),
                self.between(-1.0, 1.0),
                self.between(-1.0, 1.0),
            ];
            let l = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
            if l > 1e-3 && l <= 1.0 {
                return v.map(|x| x / l.sqrt());
            }
        }
    }
}

/// Random numbers by which the choices of a walk fall on the ends of their ranges.
pub const ENDS: [Random64; 8] = [
    ends(0, 0),
    ends(0, 1),
    ends(0, u32::MAX),
    ends((1 << 31) - 1, u32::MAX),
    ends(1 << 31, 0),
    ends(u32::MAX, 0),
    ends(u32::MAX, u32::MAX - 1),
    ends(u32::MAX, u32::MAX),
];

const fn ends(high: u32, low: u32) -> Random64 {
    Random64 { high, low }
}
