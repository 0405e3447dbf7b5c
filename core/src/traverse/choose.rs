//! The choice of a child.

use crate::exact::{self, hash};

/// A slot with probability weight / sum: pairs of neighbours choose between their two, pairs of pairs between those, and
/// so on, with fresh bits on every storey, so that they do not run dry in deep trees. The pairs of one storey may share
/// theirs since only one of them counts in the end.
///
/// The smaller side of a choice is taken when `u · both < smaller`, with a `u` that resolves far below 2^-24: so a side
/// of tiny probability is neither starved nor favoured.
#[inline(always)]
pub(super) fn choose<const W: usize>(weights: &[f32; W], random: u32, position: u32) -> u32 {
    let mut slots = [0; W];
    for slot in 0..W {
        slots[slot] = slot as u32;
    }
    let mut sums = *weights;
    let mut stride = 1;
    for storey in 0..4 {
        let u = dense_unit(random.wrapping_add((position * 4 + storey).wrapping_mul(0x9e37_79b9)));
        for slot in 0..W {
            if slot & (2 * stride - 1) == 0 && slot + stride < W {
                let (a, b) = (sums[slot], sums[slot + stride]);
                let both = a + b;
                let smaller = exact::min(a, b);
                let second = (u * both < smaller) == (b <= a);
                slots[slot] = if second { slots[slot + stride] } else { slots[slot] };
                sums[slot] = both;
            }
        }
        stride *= 2;
    }
    slots[0]
}

/// A uniform number in `[0, 1]` that resolves 2^-48; 1 only by rounding, with a probability of 2^-24.
#[inline(always)]
fn dense_unit(seed: u32) -> f32 {
    let high = hash(seed);
    // The first 24 bits suffice unless they are zeros; then bits scrambled from the other eight follow them: as many
    // different values as there are seeds for them.
    let low = high.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995;
    (high >> 8) as i32 as f32 * exact::pow2(-24) + (low >> 8) as i32 as f32 * exact::pow2(-48)
}
