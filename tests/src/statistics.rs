//! Thresholds computed from the distribution that a statistic has when the code is right: those of `lightbvh stability`.

pub use lightbvh_host::stability::statistics::*;
