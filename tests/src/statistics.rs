//! Thresholds computed from the distribution that a statistic has when the code is right.

/// Upper quantile of the χ² distribution: exceeded with probability `tail` (Wilson & Hilferty 1931). Good to a percent
/// from three degrees of freedom on, at tails down to 1e-9.
pub fn chi_squared_quantile(degrees: usize, tail: f64) -> f64 {
    let k = degrees as f64;
    let a = 2.0 / (9.0 * k);
    k * (1.0 - a + normal_quantile(tail) * a.sqrt()).powi(3)
}

/// Upper quantile of the normal distribution (Abramowitz & Stegun 1964, 26.2.23; error below 4.5e-4).
pub fn normal_quantile(tail: f64) -> f64 {
    let t = (-2.0 * tail.ln()).sqrt();
    t - (2.515_517 + t * (0.802_853 + t * 0.010_328))
        / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)))
}

/// χ² of observed counts against expected probabilities, cells expected below 8 pooled. Returns the statistic and its
/// degrees of freedom; a count where none is expected gives infinity.
pub fn chi_squared(observed: &[u64], expected: &[f64]) -> (f64, usize) {
    let total = observed.iter().sum::<u64>() as f64;
    let (mut statistic, mut cells) = (0.0, 0);
    let (mut pooled_observed, mut pooled_expected) = (0.0, 0.0);
    for (&o, &p) in observed.iter().zip(expected) {
        let (o, e) = (o as f64, p * total);
        if e == 0.0 && o > 0.0 {
            return (f64::INFINITY, 1);
        }
        if e < 8.0 {
            pooled_observed += o;
            pooled_expected += e;
        } else {
            statistic += (o - e) * (o - e) / e;
            cells += 1;
        }
    }
    if pooled_expected >= 1.0 {
        statistic +=
            (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        cells += 1;
    }
    (statistic, usize::max(cells, 2) - 1)
}

/// Mean and standard error of the mean.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Mean {
    /// Takes one more value (Welford 1962).
    pub fn add(&mut self, x: f64) {
        self.count += 1.0;
        let d = x - self.mean;
        self.mean += d / self.count;
        self.squares += d * (x - self.mean);
    }

    /// The mean so far.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Its standard error.
    pub fn error(&self) -> f64 {
        (self.squares / (self.count - 1.0) / self.count).sqrt()
    }
}
