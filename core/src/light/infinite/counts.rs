//! Weights as counts that add up to 2^31, each exact in `f32`.

use alloc::vec::Vec;

use super::environment::BITS;

/// All counts together.
const ALL: u64 = 1 << BITS;
/// Up to here `f32` counts; greater counts are multiples of [`STEP`], which it holds up to [`ALL`].
const FINE: u64 = 1 << 24;
const STEP: u64 = ALL / FINE;

/// Counts in proportion to `weights`, at least 1 where one is positive, 2^31 in all; all zero where none is. At most 2^22 weights.
pub(super) fn counts_of(weights: &[f64]) -> Vec<u32> {
    let total: f64 = weights.iter().sum();
    let lit = weights.iter().filter(|&&weight| weight > 0.0).count() as u64;
    if lit == 0 {
        return alloc::vec![0; weights.len()];
    }
    // What is left when each has its one.
    let spare = (ALL - lit) as f64;
    let mut counts: Vec<u64> = weights
        .iter()
        .map(|&weight| match weight > 0.0 {
            true => coarse(1 + (weight / total * spare) as u64),
            false => 0,
        })
        .collect();
    // Rounded down, they are too few by one each, and by a step for each that is large. The smallest take them, each as far as
    // it is fine.
    let mut left = ALL.saturating_sub(counts.iter().sum());
    let mut order: Vec<usize> = (0..counts.len()).filter(|&k| counts[k] > 0).collect();
    order.sort_by_key(|&k| core::cmp::Reverse(counts[k]));
    // In proportion first: one each for the largest of the fine ones.
    for &k in order.iter().filter(|&&k| weights[k] > 0.0) {
        if left == 0 {
            break;
        }
        if counts[k] < FINE {
            counts[k] += 1;
            left -= 1;
        }
    }
    for &k in order.iter().rev() {
        let more = left.min(FINE.saturating_sub(counts[k]));
        counts[k] += more;
        left -= more;
    }
    // None is fine any more: all are multiples of a step, and so is what is left.
    if let Some(&largest) = order.first() {
        counts[largest] += left;
    }
    counts.into_iter().map(|count| count as u32).collect()
}

/// The greatest count up to this one that `f32` holds.
fn coarse(count: u64) -> u64 {
    if count <= FINE { count } else { count / STEP * STEP }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::Random;

    /// Whatever the weights are: 2^31 in all, none lost, none added, each exact, each within a little of its share.
    #[test]
    fn counts_add_up_and_are_exact() {
        let random = &mut Random(4);
        let mut cases: Vec<Vec<f64>> = alloc::vec![
            alloc::vec![1.0],
            alloc::vec![1.0, 2.0],
            alloc::vec![1.0, 0.0, 1e-300, 1e300],
            alloc::vec![1.0; 3],
            alloc::vec![1.0; 127],
            alloc::vec![1.0; 129],
            alloc::vec![f64::MIN_POSITIVE; 64],
        ];
        for k in 0..400 {
            let count = 1 << (k % 13);
            let power = 1 + k % 40;
            cases.push((0..count).map(|_| f64::from(random.unit()).powi(power)).collect());
        }
        for weights in cases {
            let counts = counts_of(&weights);
            assert_eq!(counts.iter().map(|&count| u64::from(count)).sum::<u64>(), ALL);
            let total: f64 = weights.iter().sum();
            for (&weight, &count) in weights.iter().zip(&counts) {
                assert_eq!(weight > 0.0, count > 0);
                assert_eq!(f64::from(count as f32), f64::from(count));
                let share = weight / total;
                let error = (f64::from(count) / ALL as f64 - share).abs();
                // A step where it is large, and what the large ones left.
                assert!(
                    error < 1.3e-5 + 1e-3 * share,
                    "{count} for {share} of {}",
                    weights.len()
                );
            }
        }
        assert_eq!(counts_of(&[0.0, 0.0]), [0, 0]);
    }
}
