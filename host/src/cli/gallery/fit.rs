//! How many samples fit into a time, from the times of a few trials.

/// An image that was rendered for its time.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Trial {
    /// Samples per pixel, above 0.
    pub samples: u32,
    pub ms: f64,
}

/// The samples per pixel, 1 to `most`, whose image takes `budget_ms` or a little less, by a straight line through the least
/// times of the fewest and the most samples tried: what an image takes besides samples is in it. In proportion to the most
/// samples where there is one count of samples alone, or where more samples took no longer. 1 without trials.
pub(super) fn samples_in(budget_ms: f64, trials: &[Trial], most: u32) -> u32 {
    let count = |pick: fn(u32, u32) -> u32| trials.iter().map(|trial| trial.samples).reduce(pick);
    let (Some(low), Some(high)) = (count(u32::min), count(u32::max)) else {
        return 1;
    };
    // What interrupts an image makes it longer, never shorter.
    let least = |samples: u32| {
        let times = trials.iter().filter(|trial| trial.samples == samples);
        times.map(|trial| trial.ms).fold(f64::INFINITY, f64::min)
    };
    let (first, last) = (least(low), least(high));
    let slope = (last - first) / f64::from(high - low);
    let slope = if slope.is_finite() && slope > 0.0 {
        slope
    } else {
        last / f64::from(high)
    };
    let fits = f64::from(high) + (budget_ms - last) / slope;
    // A cast of what is no number gives 0.
    (fits as u32).clamp(1, most)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trials(of: &[(u32, f64)]) -> Vec<Trial> {
        of.iter().map(|&(samples, ms)| Trial { samples, ms }).collect()
    }

    #[test]
    fn what_an_image_takes_besides_samples_counts() {
        // 10 ms and 5 ms a sample: 100 ms hold 18 samples, not 100 / 15.
        let measured = trials(&[(1, 15.0), (4, 30.0)]);
        assert_eq!(samples_in(100.0, &measured, 1000), 18);
        assert_eq!(samples_in(104.9, &measured, 1000), 18);
        assert_eq!(samples_in(105.0, &measured, 1000), 19);
    }

    #[test]
    fn the_least_time_of_each_count_is_taken() {
        let disturbed = trials(&[(1, 70.0), (1, 15.0), (4, 30.0), (4, 900.0)]);
        assert_eq!(samples_in(100.0, &disturbed, 1000), 18);
        // What lies between the fewest and the most does not matter.
        let between = trials(&[(1, 15.0), (2, 500.0), (4, 30.0)]);
        assert_eq!(samples_in(100.0, &between, 1000), 18);
    }

    #[test]
    fn one_count_and_times_that_do_not_grow_are_taken_in_proportion() {
        assert_eq!(samples_in(100.0, &trials(&[(2, 8.0)]), 1000), 25);
        assert_eq!(samples_in(100.0, &trials(&[(1, 9.0), (4, 8.0)]), 1000), 50);
    }

    #[test]
    fn one_sample_at_least_and_no_more_than_are_allowed() {
        assert_eq!(samples_in(100.0, &trials(&[(1, 400.0)]), 1000), 1);
        assert_eq!(samples_in(0.001, &trials(&[(1, 15.0), (4, 30.0)]), 1000), 1);
        assert_eq!(samples_in(1e300, &trials(&[(1, 15.0), (4, 30.0)]), 1000), 1000);
        assert_eq!(samples_in(100.0, &trials(&[(1, 0.0)]), 1000), 1000);
        assert_eq!(samples_in(100.0, &[], 1000), 1);
    }
}
