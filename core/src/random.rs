//! The number that drives a walk.

use crate::exact::hash;

/// A uniform number in `[0, 1)`, a multiple of 2^-64.
///
/// From a `u32` it takes its upper 32 bits, and appends 32 more that a hash of them gives: a sequence of stratified,
/// low-discrepancy or blue-noise `u32` keeps its order. From a `u64` it takes all bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Random64 {
    /// The upper 32 bits.
    pub high: u32,
    /// The lower 32 bits.
    pub low: u32,
}

impl From<u32> for Random64 {
    #[inline(always)]
    fn from(high: u32) -> Self {
        Self {
            high,
            low: hash(high),
        }
    }
}

impl From<u64> for Random64 {
    #[inline(always)]
    fn from(bits: u64) -> Self {
        Self {
            high: (bits >> 32) as u32,
            low: bits as u32,
        }
    }
}

impl Random64 {
    /// The number times 2^`bits` without its integer part; `bits` in 0..=22.
    #[inline(always)]
    #[must_use]
    pub(crate) fn shifted(self, bits: u32) -> Self {
        // No shift by 32.
        let carried = (self.low >> 1) >> (31 - bits);
        Self {
            high: (self.high << bits) | carried,
            low: self.low << bits,
        }
    }

    /// Number `k` of `count` at equal distances, of which this one is the first: this number plus k / `count`, modulo 1, where
    /// 1 / `count` is rounded down to a multiple of 2^-32 (systematic sampling). Each is as uniform as this one, and each of
    /// `count` equal strata holds one of them, to `count` times 2^-32. 1 for a `count` of 0.
    #[inline(always)]
    #[must_use]
    pub fn spaced(self, k: u32, count: u32) -> Self {
        let count = if count > 0 { count } else { 1 };
        // 2^32 / count rounded down, in 32 bits; 2^32 itself is 0, and k too.
        let step = (count.wrapping_neg() / count).wrapping_add(1);
        Self {
            high: self.high.wrapping_add(k.wrapping_mul(step)),
            low: self.low,
        }
    }

    /// The integer part of the number times `count`, below `count`, and what remains: again a uniform number.
    #[inline(always)]
    #[must_use]
    pub fn pick(self, count: u32) -> (u32, Self) {
        let (carry, low) = wide_product(self.low, count);
        let (index, high) = wide_product(self.high, count);
        let sum = high.wrapping_add(carry);
        let overflow = if sum < high { 1 } else { 0 };
        (index.wrapping_add(overflow), Self { high: sum, low })
    }
}

/// The upper and the lower word of a product. By halves of words: 64-bit integers are a feature that a device may lack.
#[inline(always)]
fn wide_product(a: u32, b: u32) -> (u32, u32) {
    let (a1, a0) = (a >> 16, a & 0xffff);
    let (b1, b0) = (b >> 16, b & 0xffff);
    let low = a0 * b0;
    let middle = a1.wrapping_mul(b0).wrapping_add(low >> 16);
    let other = a0.wrapping_mul(b1).wrapping_add(middle & 0xffff);
    let high = (a1.wrapping_mul(b1))
        .wrapping_add(middle >> 16)
        .wrapping_add(other >> 16);
    (high, a.wrapping_mul(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::hash;

    #[test]
    fn products_and_picks_are_those_of_wider_integers() {
        for i in 0..100_000u32 {
            let corner = [0, 1, u32::MAX, 0x8000_0000, 0xffff, 0x1_0000];
            let a = if i < 36 { corner[(i / 6) as usize] } else { hash(i) };
            let b = if i < 36 {
                corner[(i % 6) as usize]
            } else {
                hash(!i)
            };
            let product = u64::from(a) * u64::from(b);
            assert_eq!(wide_product(a, b), ((product >> 32) as u32, product as u32));
            let bits = (u64::from(a) << 32) | u64::from(hash(b));
            let wide = u128::from(bits) * u128::from(b);
            let (index, rest) = Random64::from(bits).pick(b);
            assert_eq!((index, rest), ((wide >> 64) as u32, Random64::from(wide as u64)));
            for (k, count) in [(a, b), (a % 8, 8), (a % 5, 5), (0, 1), (7, 0), (a, 1 << 31)] {
                let step = (1u64 << 32) / u64::from(count.max(1));
                let moved = bits.wrapping_add((step << 32).wrapping_mul(u64::from(k)));
                assert_eq!(Random64::from(bits).spaced(k, count), Random64::from(moved));
            }
            for shift in 0..=22 {
                assert_eq!(Random64::from(bits).shifted(shift), Random64::from(bits << shift));
            }
        }
    }
}
