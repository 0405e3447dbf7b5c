//! Multiple importance sampling: how two techniques that find the same light share it.

use crate::shading::grid::div;
use lightbvh::exact::{flush, pow2};

/// Ratios of densities below this count as zero, so that their squares are normal numbers.
const SMALLEST_RATIO: f32 = pow2(-60);

/// The power heuristic with exponent 2 (E. Veach and L. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo
/// Rendering", 1995, section 5.2; one sample by each technique): the weight of a direction found with density `own`, which
/// the other finds with density `other`. Densities are 0 or at least 2^-100, and at most 2^104.
///
/// The weights of the two techniques, each the other's `other`, sum to one within one rounding of each. A density of zero
/// leaves everything to the other technique; of two of them, the one that asks has weight 1.
#[inline]
#[must_use]
pub fn power_heuristic(own: f32, other: f32) -> f32 {
    let less = own < other;
    let greater = if less { other } else { own };
    let smaller = if less { own } else { other };
    let mut ratio = 0.0;
    if smaller > 0.0 {
        ratio = flush(div(smaller, greater), SMALLEST_RATIO);
    }
    let squared = ratio * ratio;
    div(if less { squared } else { 1.0 }, 1.0 + squared)
}
