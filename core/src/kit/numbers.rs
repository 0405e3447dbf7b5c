//! Numbers that look random and are the same in every run, vectors in `f64`. Tests of the public interface include this file.

use glam::Vec3;

use crate::exact::{hash, pow2, unit_f32};

/// Hashes of 1, 2, 3 and so on after its seed.
#[derive(Clone)]
pub struct Random(pub u32);

impl Random {
    pub fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0)
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f32 {
        unit_f32(self.word())
    }

    /// From -1 to 1.
    pub fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    /// From 0 to `count` - 1.
    pub fn below(&mut self, count: u32) -> u32 {
        (self.unit() * count as f32) as u32
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }

    /// From 2^`low` to 2^`high`, as often in each octave.
    pub fn power(&mut self, low: i32, high: i32) -> f32 {
        let octave = low + self.below((high - low) as u32) as i32;
        pow2(octave) * (1.0 + self.unit())
    }

    /// A unit vector.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = wide(self.vector());
            if (0.01..=1.0).contains(&dot(v, v)) {
                return narrow(normalize(v));
            }
        }
    }

    /// Three unit vectors at right angles to each other.
    pub fn axes(&mut self) -> [Wide; 3] {
        let x = wide(self.direction());
        let y = normalize(cross(x, wide(self.vector())));
        [x, y, cross(x, y)]
    }
}

pub type Wide = [f64; 3];

pub fn wide(v: Vec3) -> Wide {
    v.to_array().map(f64::from)
}

pub fn narrow(v: Wide) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}

pub fn minus(a: Wide, b: Wide) -> Wide {
    [0, 1, 2].map(|k| a[k] - b[k])
}

pub fn times(v: Wide, s: f64) -> Wide {
    v.map(|x| x * s)
}

pub fn dot(a: Wide, b: Wide) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Wide, b: Wide) -> Wide {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

pub fn normalize(v: Wide) -> Wide {
    times(v, 1.0 / dot(v, v).sqrt())
}
