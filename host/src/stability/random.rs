//! Random numbers: a seeded stream, and the numbers that are hardest for a walk.

use lightbvh::exact;

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

/// The inverse of [`exact::hash`], which is a permutation: PCG's output function undone step by step.
pub fn unhash(hashed: u32) -> u32 {
    // A shift by at least half the width undoes itself.
    let word = hashed ^ (hashed >> 22);
    let scrambled = word.wrapping_mul(inverse(277_803_737));
    // The upper four bits, which choose the shift, stand as they were; each round restores as many bits more.
    let shift = (scrambled >> 28) + 4;
    let mut state = scrambled;
    for _ in 0..8 {
        state = scrambled ^ (state >> shift);
    }
    state
        .wrapping_sub(2_891_336_453)
        .wrapping_mul(inverse(747_796_405))
}

/// The inverse of an odd number modulo 2^32, by Newton's steps: each doubles the number of right bits, three at first.
fn inverse(odd: u32) -> u32 {
    let mut x = odd;
    for _ in 0..4 {
        x = x.wrapping_mul(2u32.wrapping_sub(odd.wrapping_mul(x)));
    }
    x
}

/// Random numbers that make choices of a walk fall on their ends: for the first levels, those whose hash there is zero, all
/// ones, or has nothing but ones or zeros in the bits that decide; and 0, 1, all ones themselves.
///
/// A walk hashes `random + 0x9e3779b9 (4 level + storey)` at each level (`lightbvh::traverse`); were that changed, these would
/// be random numbers like any others.
pub fn adversarial(levels: u32) -> Vec<u32> {
    let mut out = vec![0, 1, u32::MAX, u32::MAX - 1, 1 << 31, (1 << 31) - 1];
    for choice in 0..levels * 4 {
        for hashed in [0, 0xff, 0x100, 0xffff_ff00, u32::MAX] {
            out.push(unhash(hashed).wrapping_sub(choice.wrapping_mul(0x9e37_79b9)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unhash_undoes_hash() {
        for i in 0..200_000u32 {
            let x = i.wrapping_mul(0x9e37_79b9) ^ (i >> 7);
            assert_eq!(unhash(exact::hash(x)), x);
        }
        assert_eq!(exact::hash(unhash(0)), 0);
        assert_eq!(exact::hash(unhash(u32::MAX)), u32::MAX);
    }
}
