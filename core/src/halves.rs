//! Sums and greatest numbers by halves: the halves of the array are taken together slot by slot, as registers of several
//! numbers do it, until one number is left. Arrays are of up to 16 numbers.

use crate::exact;
pub(crate) use crate::importance::halving_sum as sum;

/// The greatest of numbers.
#[inline(always)]
pub(crate) fn greatest<const W: usize>(numbers: &[f32; W]) -> f32 {
    let mut most = *numbers;
    let mut stride = 8;
    for _ in 0..4 {
        for slot in 0..W {
            if slot < stride && slot + stride < W {
                most[slot] = exact::max(most[slot], most[slot + stride]);
            }
        }
        stride /= 2;
    }
    most[0]
}

/// The least of numbers.
#[inline(always)]
pub(crate) fn least<const W: usize>(numbers: &[f32; W]) -> f32 {
    let mut least = *numbers;
    let mut stride = 8;
    for _ in 0..4 {
        for slot in 0..W {
            if slot < stride && slot + stride < W {
                least[slot] = exact::min(least[slot], least[slot + stride]);
            }
        }
        stride /= 2;
    }
    least[0]
}
