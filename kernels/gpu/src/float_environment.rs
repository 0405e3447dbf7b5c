//! The calling thread's floating-point mode, which software devices inherit.

use core::hint::black_box;

/// How the calling thread's `f32` arithmetic behaves, found by calculating.
///
/// The worker threads of a software device may inherit the mode of the thread that creates the device, and a stray
/// flush-to-zero there changes results without a word. So the device is to be created where this is the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FloatEnvironment {
    /// Results are rounded to the nearest number, to the even one of two.
    pub nearest: bool,
    /// Subnormal results are kept.
    pub keeps_results: bool,
    /// Subnormal operands are not taken for zero.
    pub keeps_operands: bool,
}

impl Default for FloatEnvironment {
    /// What a thread begins with: rounding to nearest, subnormals kept.
    fn default() -> Self {
        Self {
            nearest: true,
            keeps_results: true,
            keeps_operands: true,
        }
    }
}

impl FloatEnvironment {
    /// That of the calling thread.
    #[must_use]
    pub fn current() -> Self {
        let sum = |a: f32, b: f32| black_box(a) + black_box(b);
        // A quarter and three quarters of a unit, up and down, and the halves between, which go to the even number.
        let unit = f32::EPSILON;
        let nearest = sum(1.0, unit / 4.0) == 1.0
            && sum(1.0, unit * 0.75) == 1.0 + unit
            && sum(-1.0, unit / -4.0) == -1.0
            && sum(-1.0, unit * -0.75) == -1.0 - unit
            && sum(1.0, unit / 2.0) == 1.0
            && sum(1.0 + unit, unit / 2.0) == 1.0 + 2.0 * unit;
        // Bits are looked at, for a comparison too may take a subnormal number for zero.
        let half = black_box(f32::MIN_POSITIVE) * black_box(0.5);
        let normal = black_box(f32::from_bits(1 << 22)) * black_box(4.0);
        Self {
            nearest,
            keeps_results: half.to_bits() == 1 << 22,
            keeps_operands: normal.to_bits() == f32::MIN_POSITIVE.to_bits() + (1 << 23),
        }
    }

    /// Whether it is what a thread begins with.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
