//! The arithmetic over all its inputs: all 2^32 words where there is one operand (on demand; a share of them by default), all
//! pairs of a structured set where there are two.

use lightbvh::exact::{
    abs, clamp, div, div_emulated, exponent, floor_small, floor_u32, flush, hash, max, min, order_key, pow2,
    recip, recip_rough, rsqrt, rsqrt_rough, significand, sqrt, sqrt_emulated, unit_f32,
};
use rayon::prelude::*;

/// By default one word of so many, a prime: 34 million words.
const SHARE: usize = 127;

/// Every `step`-th word, from a different one in each block, on all cores.
fn words(step: usize, test: impl Fn(u32) + Sync) {
    (0..1_u32 << 12).into_par_iter().for_each(|block| {
        let first = hash(block) % step as u32;
        (first..1 << 20).step_by(step).for_each(|i| test(block << 20 | i));
    });
}

/// Square root and its device form are IEEE's; +0 below the normal numbers.
fn root(word: u32) {
    let x = f32::from_bits(word);
    if x.is_finite() {
        let expected = if x < f32::MIN_POSITIVE { 0.0 } else { x.sqrt() };
        assert_eq!(sqrt(x).to_bits(), expected.to_bits(), "sqrt {word:08x}");
        assert_eq!(sqrt_emulated(x).to_bits(), expected.to_bits(), "sqrt {word:08x}");
    }
}

/// So is one over a number, and a number over three; zero below the normal numbers.
fn quotient(word: u32) {
    let x = f32::from_bits(word);
    if x.is_normal() {
        for (a, b) in [(1.0, x), (x, 3.0)] {
            let q: f32 = a / b;
            let expected = if q.abs() < f32::MIN_POSITIVE {
                0.0_f32.copysign(q)
            } else {
                q
            };
            assert_eq!(div(a, b).to_bits(), expected.to_bits(), "{a:e} / {b:e}");
            assert_eq!(div_emulated(a, b).to_bits(), expected.to_bits(), "{a:e} / {b:e}");
        }
    }
}

/// The cheap reciprocals are within their bounds over the whole of their domains.
fn cheap(word: u32) {
    let x = f32::from_bits(word);
    let relative = |y: f32, exact: f64| ((f64::from(y) - exact) / exact).abs();
    if x.is_normal() && x.abs() <= pow2(125) {
        let exact = 1.0 / f64::from(x);
        assert!(relative(recip(x), exact) < 7e-6, "recip {x:e}");
        assert!(relative(recip_rough(x), exact) < 3e-3, "recip_rough {x:e}");
    }
    if x >= pow2(-125) && x.is_finite() {
        let exact = 1.0 / f64::from(x).sqrt();
        assert!(relative(rsqrt(x), exact) < 5e-6, "rsqrt {x:e}");
        assert!(relative(rsqrt_rough(x), exact) < 7e-4, "rsqrt_rough {x:e}");
    }
}

/// Conversions, and what is done on the bits.
fn conversion(word: u32) {
    let x = f32::from_bits(word);
    assert_eq!(
        f64::from(unit_f32(word)),
        f64::from(word >> 8) * 2f64.powi(-24),
        "{word:08x}"
    );
    let e = word as i32;
    assert_eq!(f64::from(pow2(e)), 2f64.powi(e.clamp(-126, 127)), "{e}");
    if (-1 << 24..=1 << 24).contains(&e) {
        assert_eq!(f64::from(e as f32), f64::from(e));
    }
    if x.is_nan() {
        return;
    }
    if (0.0..=16_777_216.0).contains(&x) {
        assert_eq!(f64::from(floor_u32(x)), f64::from(x).floor(), "{x:e}");
    }
    if (0.0..4_194_304.0).contains(&x) && word != 0x8000_0000 {
        assert_eq!(floor_small(x), x as u32, "{x:e}");
    }
    if x.is_normal() {
        let again = f64::from(significand(abs(x))) * 2f64.powi(exponent(x));
        assert_eq!(again, f64::from(x.abs()), "{x:e}");
        assert!((1.0..2.0).contains(&significand(abs(x))));
    } else if x.is_finite() {
        assert_eq!(exponent(x), -127, "{x:e}");
    }
    assert_eq!(abs(x).to_bits(), word & 0x7fff_ffff);
    for tiny in [pow2(-126), pow2(-100), 1.0] {
        let expected = if x.abs() < tiny { 0 } else { word };
        assert_eq!(flush(x, tiny).to_bits(), expected, "{x:e} {tiny:e}");
    }
    // The key's order is the total order; to the next word it goes by one, up or down.
    let next = f32::from_bits(word.wrapping_add(1));
    if !next.is_nan() {
        assert_eq!(order_key(x).cmp(&order_key(next)), x.total_cmp(&next), "{x:e}");
        let step = if word >> 31 == 0 { 1_u32 } else { u32::MAX };
        if word != 0x7fff_ffff && word != u32::MAX {
            assert_eq!(order_key(next), order_key(x).wrapping_add(step), "{x:e}");
        }
    }
}

/// Both zeros, both infinities, and of every exponent the ends and some numbers between, of both signs.
fn structured() -> Vec<f32> {
    let mut out = vec![0.0, f32::INFINITY];
    for e in 1..255_u32 {
        let fractions = [0, 1, 0x0040_0000, hash(e) >> 9, 0x007f_fffe, 0x007f_ffff];
        out.extend(fractions.map(|fraction| f32::from_bits(e << 23 | fraction)));
    }
    let negative: Vec<f32> = out.iter().map(|x| -x).collect();
    out.extend(negative);
    out
}

/// The least and greatest of two, the second where they are equal; the keys' order agrees, but for telling the zeros apart.
fn pair(a: f32, b: f32) {
    let (least, greatest) = if a == b {
        (b, b)
    } else if a.total_cmp(&b).is_lt() {
        (a, b)
    } else {
        (b, a)
    };
    assert_eq!(min(a, b).to_bits(), least.to_bits(), "min({a:e}, {b:e})");
    assert_eq!(max(a, b).to_bits(), greatest.to_bits(), "max({a:e}, {b:e})");
    assert_eq!(order_key(a).cmp(&order_key(b)), a.total_cmp(&b), "{a:e} {b:e}");
}

#[test]
fn a_share_of_all_words() {
    words(SHARE, root);
    words(SHARE, quotient);
    words(SHARE, cheap);
    words(SHARE, conversion);
}

#[test]
#[ignore = "all 2^32 words: the four of this file together 132 s on two cores"]
fn every_root() {
    words(1, root);
}

#[test]
#[ignore = "all 2^32 words: the four of this file together 132 s on two cores"]
fn every_reciprocal_and_third() {
    words(1, quotient);
}

#[test]
#[ignore = "all 2^32 words: the four of this file together 132 s on two cores"]
fn every_cheap_reciprocal() {
    words(1, cheap);
}

#[test]
#[ignore = "all 2^32 words: the four of this file together 132 s on two cores"]
fn every_conversion() {
    words(1, conversion);
}

#[test]
fn all_structured_pairs_are_ordered() {
    let numbers = structured();
    assert!(numbers.len() > 3000);
    numbers
        .par_iter()
        .for_each(|&a| numbers.iter().for_each(|&b| pair(a, b)));
}

#[test]
fn random_pairs_are_ordered() {
    words(SHARE, |word| {
        let (a, b) = (f32::from_bits(word), f32::from_bits(hash(word)));
        if !a.is_nan() && !b.is_nan() && a.abs() >= f32::MIN_POSITIVE && b.abs() >= f32::MIN_POSITIVE {
            pair(a, b);
        }
    });
}

#[test]
fn all_structured_triples_are_clamped() {
    let numbers: Vec<f32> = structured().into_iter().step_by(23).collect();
    numbers.par_iter().for_each(|&x| {
        for &lo in &numbers {
            for &hi in numbers.iter().filter(|&&hi| lo <= hi) {
                let clamped = clamp(x, lo, hi);
                assert!(clamped == x.clamp(lo, hi), "{x:e} {lo:e} {hi:e}");
                if lo <= x && x <= hi {
                    assert_eq!(clamped.to_bits(), x.to_bits());
                }
            }
        }
    });
}
