//! Importances against their formulas in `f64`.
//!
//! What is compared is the weight of a child over that of a sibling whose weight the formula gives at sight: the scale that
//! the children of a node share cancels.

mod eq4;
mod flux;
mod linked;
mod moments;

use glam::Vec3;

use crate::exact::pow2;
use crate::kit::{Random, Wide, dot, minus, narrow, normalize, times, wide};

impl Random {
    /// Half extents of about `size`.
    fn extents(&mut self, size: f32) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * size
    }
}

/// How far a box of these half extents reaches along `n`: the highest of its corners.
fn top(half: Wide, n: Wide) -> f64 {
    let corner = |i: u32| {
        let sign = |k: u32| if i >> k & 1 == 0 { 1.0 } else { -1.0 };
        dot([sign(0) * half[0], sign(1) * half[1], sign(2) * half[2]], n)
    };
    (0..8).map(corner).fold(f64::NEG_INFINITY, f64::max)
}

/// Down to 2^-60 of the greatest exponent as they are, and no weight is less than that.
#[test]
fn scales_span_sixty_powers_of_two() {
    for (below, kept) in [(0, 0), (21, 21), (59, 59), (60, 60), (61, 60), (700, 60)] {
        let weights = super::on_one_scale(&[300, 300 - below].map(|exponent| super::Scaled {
            significand: 1.5,
            exponent,
        }));
        assert_eq!(weights, [1.5, 1.5 * pow2(-kept)], "{below}");
    }
}
