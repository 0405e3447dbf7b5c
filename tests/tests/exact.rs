//! The arithmetic over all its inputs: all significands, all pairs of structured numbers, and a
//! share of all 2^32 words; on demand all of them.

use lightbvh::exact::{hash, rsqrt};
use lightbvh_tests::arithmetic::{floors, flushed, integers, order, parts, quotient, reciprocals, root};
use rayon::prelude::*;

const FRACTION: u32 = 0x007f_ffff;

/// By default one word of so many, a prime: 34 million words.
const SHARE: usize = 127;

/// Every `step`-th word, from a different one in each block, on all cores.
fn words(step: usize, test: impl Fn(u32) + Sync) {
    (0..1_u32 << 12).into_par_iter().for_each(|block| {
        let first = hash(block) % step as u32;
        (first..1 << 20).step_by(step).for_each(|i| test(block << 20 | i));
    });
}

/// Every function of one number, and the next number of the order.
fn one(word: u32) {
    let x = f32::from_bits(word);
    integers([word, hash(word)]);
    if !x.is_finite() {
        return;
    }
    root(x);
    quotient(1.0, x);
    quotient(x, 3.0);
    reciprocals(x);
    parts(x);
    floors(x);
    for tiny in [f32::MIN_POSITIVE, 2f32.powi(-100), 1.0] {
        flushed(x, tiny);
    }
    let next = f32::from_bits(word.wrapping_add(1));
    if next.is_finite() {
        order(x, next, x);
    }
}

#[test]
fn every_significand_has_its_root_and_reciprocals() {
    (0..=FRACTION).into_par_iter().for_each(|fraction| {
        for exponent in [126, 127] {
            let x = f32::from_bits(exponent << 23 | fraction);
            root(x);
            reciprocals(x);
            quotient(1.0, x);
        }
    });
    assert!(rsqrt(0.0).is_finite());
}

#[test]
fn a_share_of_all_words() {
    words(SHARE, one);
}

#[test]
#[ignore = "all 2^32 words: some minutes"]
fn every_word() {
    words(1, one);
}

/// Both zeros, both infinities, and of every exponent the ends and some numbers between, of both signs.
fn structured() -> Vec<f32> {
    let mut out = vec![0.0, f32::INFINITY];
    for e in 1..255_u32 {
        let fractions = [0, 1, 0x0040_0000, hash(e) >> 9, FRACTION - 1, FRACTION];
        out.extend(fractions.map(|fraction| f32::from_bits(e << 23 | fraction)));
    }
    let negative: Vec<f32> = out.iter().map(|x| -x).collect();
    out.extend(negative);
    out
}

/// The longest significand over a power of two may be just below the normal numbers, where the processor itself rounds up to the
/// least of them.
#[test]
fn all_structured_pairs_are_divided_and_ordered() {
    let numbers = structured();
    numbers.par_iter().for_each(|&a| {
        for &b in &numbers {
            order(a, b, a);
            if a.is_finite() && b.is_finite() {
                quotient(a, b);
            }
        }
    });
}

#[test]
fn all_structured_triples_are_clamped() {
    let numbers: Vec<f32> = structured().into_iter().step_by(23).collect();
    numbers.par_iter().for_each(|&x| {
        for &low in &numbers {
            numbers.iter().for_each(|&high| order(low, high, x));
        }
    });
}

/// A finite normal number of either sign from 32 random bits, its exponent anywhere in the range.
fn normal(bits: u32) -> f32 {
    with_exponent(bits, 1 + (bits >> 23 & 0xff) % 254)
}

fn with_exponent(bits: u32, exponent: u32) -> f32 {
    f32::from_bits(bits & !(0xff << 23) | exponent << 23)
}

/// Random quotients: plain ones, quotients near one, near a rounding tie, exact ones, and at the ends of the range.
fn check_quotients(count: u32, seed: u32) {
    (0..count).into_par_iter().for_each(|i| {
        let [x, y, z] = [0, 1, 2].map(|k| hash(hash(seed.wrapping_add(i)).wrapping_add(k)));
        let (a, b) = (normal(x), normal(y));
        let (a, b) = match i % 8 {
            0..=3 => (a, b),
            // A few units apart: the quotient is next to one.
            4 => (f32::from_bits(b.to_bits().wrapping_add(z % 17)), b),
            // Short significands: many quotients are exact.
            5 => (
                f32::from_bits(a.to_bits() & 0xfff8_0000),
                f32::from_bits(b.to_bits() & 0xfff8_0000),
            ),
            // b times a number of 25 bits, rounded: the quotient is next to a tie.
            6 => {
                let b = with_exponent(y, 127);
                let q = 1.0 + f64::from((z >> 8) | 1) * 2f64.powi(-24);
                ((q * f64::from(b)) as f32, b)
            }
            // A tiny number over one near one: the result is just below the normal range, or just not.
            _ => (with_exponent(x, 1 + z % 3), with_exponent(y, 126 + (z >> 8) % 4)),
        };
        if a.is_finite() {
            quotient(a, b);
            order(a, b, b);
        }
    });
}

#[test]
fn random_and_structured_quotients_are_ieee() {
    check_quotients(20_000_000, 1);
}

#[test]
#[ignore = "10^9 quotients: a minute"]
fn a_billion_quotients_are_ieee() {
    check_quotients(1_000_000_000, 0x5eed_0002);
}

/// Each of the 2^16 values of the hash's upper half gets its share of the first 2^22 integers (χ²; the bound is six standard
/// deviations, 6 sqrt(2n), off the mean n).
#[test]
fn the_hash_is_uniform() {
    let mut counts = vec![0_u32; 1 << 16];
    for i in 0..1_u32 << 22 {
        counts[(hash(i) >> 16) as usize] += 1;
    }
    let chi_square: f64 = counts.iter().map(|&c| (f64::from(c) - 64.0).powi(2) / 64.0).sum();
    let n = 65_535.0_f64;
    assert!(
        (chi_square - n).abs() < 6.0 * (2.0 * n).sqrt(),
        "chi-square {chi_square}"
    );
}
