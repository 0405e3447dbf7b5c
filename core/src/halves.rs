//! Sums and greatest numbers by halves: the halves of each row are taken together slot by slot, as registers of several
//! numbers do it, until one number is left. Rows are of up to 16 numbers.
//!
//! Many rows at a time: one software device searches all paths through a kernel's loops, and a loop for each row, one after
//! another, would be too many.

use crate::exact;

/// Puts each row's sum, its numbers added by halves, into its slot 0.
#[inline(always)]
pub(crate) fn sums<const ROWS: usize, const W: usize>(rows: &mut [[f32; W]; ROWS]) {
    let mut stride = 8;
    for _ in 0..4 {
        for slot in 0..W {
            if (slot < stride) & (slot + stride < W) {
                for k in 0..ROWS {
                    rows[k][slot] += rows[k][slot + stride];
                }
            }
        }
        stride /= 2;
    }
}

/// Puts each row's greatest number into its slot 0.
#[inline(always)]
pub(crate) fn maxima<const ROWS: usize, const W: usize>(rows: &mut [[f32; W]; ROWS]) {
    let mut stride = 8;
    for _ in 0..4 {
        for slot in 0..W {
            if (slot < stride) & (slot + stride < W) {
                for k in 0..ROWS {
                    rows[k][slot] = exact::max(rows[k][slot], rows[k][slot + stride]);
                }
            }
        }
        stride /= 2;
    }
}
