//! Sequences of numbers.

use lightbvh::exact::hash;

/// Where the numbers of a point come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
pub(super) enum Sequence {
    Independent,
    Stratified,
    #[strum(serialize = "golden ratio")]
    GoldenRatio,
    #[strum(serialize = "Sobol, scrambled")]
    Sobol,
}

impl Sequence {
    /// Number `k` of `count`, as a fraction of 2^32; `seed` tells sequences of one kind apart.
    pub fn number(self, k: u32, count: u32, seed: u32) -> u32 {
        match self {
            Self::Independent => hash(seed.wrapping_add(hash(k))),
            Self::Stratified => {
                let width = (1u64 << 32) / u64::from(count);
                let within = (u64::from(hash(seed.wrapping_add(hash(k)))) * width) >> 32;
                (u64::from(k) * width + within) as u32
            }
            // Multiples of 1/φ, turned by a random number (a rank-1 lattice).
            Self::GoldenRatio => k.wrapping_mul(0x9e37_79b9).wrapping_add(hash(seed)),
            Self::Sobol => scrambled(k.reverse_bits(), seed),
        }
    }
}

/// Owen's scrambling by a hash whose bits depend on higher ones only (B. Burley, "Practical hash-based Owen scrambling", JCGT
/// 9(4), 2020), of the first dimension of Sobol's sequence, which is van der Corput's.
fn scrambled(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    let seed = hash(seed);
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// A mask whose neighbours differ: multiples of the golden ratio along a Hilbert curve (M. Roberts, "A simple method to
/// construct isotropic quasirandom blue noise point sequences", 2018, and the same on a curve).
pub(super) fn blue_noise(x: u32, y: u32) -> u32 {
    hilbert(x, y).wrapping_mul(0x9e37_79b9)
}

/// The place of a cell on a Hilbert curve of 128 × 128 cells.
fn hilbert(x: u32, y: u32) -> u32 {
    let (mut x, mut y) = (x & 127, y & 127);
    let mut place = 0;
    let mut size = 64;
    while size > 0 {
        let (right, upper) = (u32::from(x & size != 0), u32::from(y & size != 0));
        place += size * size * ((3 * right) ^ upper);
        if upper == 0 {
            if right == 1 {
                x = 127 - x;
                y = 127 - y;
            }
            (x, y) = (y, x);
        }
        size /= 2;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequences_fill_their_strata() {
        for sequence in [Sequence::Stratified, Sequence::Sobol] {
            for seed in 0..50 {
                let mut strata = [0; 64];
                for k in 0..64 {
                    strata[(sequence.number(k, 64, seed) >> 26) as usize] += 1;
                }
                assert_eq!(strata, [1; 64], "{sequence:?}");
            }
        }
    }

    #[test]
    fn the_curve_meets_every_cell_once_and_steps_to_neighbours() {
        let mut cells = vec![None; 128 * 128];
        for y in 0..128u32 {
            for x in 0..128u32 {
                let place = hilbert(x, y) as usize;
                assert!(cells[place].replace((x, y)).is_none());
            }
        }
        for pair in cells.windows(2) {
            let ((a, b), (c, d)) = (pair[0].expect("met"), pair[1].expect("met"));
            assert_eq!(a.abs_diff(c) + b.abs_diff(d), 1);
        }
    }
}
