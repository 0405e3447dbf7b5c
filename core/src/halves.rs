//! Sums and greatest numbers by halves: the halves of each row are taken together slot by slot, as registers of several
//! numbers do it, until one number is left. Rows are of up to 16 numbers.

use crate::exact;
use crate::unroll::each;

/// Puts each row's numbers, taken together by halves, into its slot 0.
#[inline(always)]
fn halved<const ROWS: usize, const W: usize>(rows: &mut [[f32; W]; ROWS], both: impl Fn(f32, f32) -> f32) {
    each!(step, 4, {
        let stride = 8 >> step;
        each!(slot, W, {
            if (slot < stride) & (slot + stride < W) {
                each!(k, ROWS, {
                    rows[k][slot] = both(rows[k][slot], rows[k][slot + stride]);
                });
            }
        });
    });
}

/// Puts each row's sum, its numbers added by halves, into its slot 0.
#[inline(always)]
pub(crate) fn sums<const ROWS: usize, const W: usize>(rows: &mut [[f32; W]; ROWS]) {
    halved(rows, |a, b| a + b);
}

/// Puts each row's greatest number into its slot 0.
#[inline(always)]
pub(crate) fn maxima<const ROWS: usize, const W: usize>(rows: &mut [[f32; W]; ROWS]) {
    halved(rows, exact::max);
}
