//! Proof that the device's forms of division and square root are the processor's own: all significands, both parities of
//! the exponent, all reciprocals, and as many quotients as the time allows.

use lightbvh::exact::{
    abs, clamp, div, div_emulated, floor_u32, flush, hash, max, min, order_key, recip, rsqrt, sqrt,
    sqrt_emulated, unit_f32,
};

const FRACTION: u32 = 0x007f_ffff;
const SIGN_AND_FRACTION: u32 = 0x807f_ffff;

/// IEEE division with the documented change: no denormals in or out. In f64, whose exponents tell of the exact quotient
/// whether it is below 2^-126.
fn native_div(a: f32, b: f32) -> f32 {
    let a = if a.abs() < f32::MIN_POSITIVE {
        0.0_f32.copysign(a)
    } else {
        a
    };
    let q = a / b;
    if (f64::from(a) / f64::from(b)).abs() < f64::from(f32::MIN_POSITIVE) {
        0.0_f32.copysign(q)
    } else {
        q
    }
}

/// IEEE square root with the documented change: +0 below the smallest normal number.
fn native_sqrt(x: f32) -> f32 {
    if x < f32::MIN_POSITIVE { 0.0 } else { x.sqrt() }
}

#[track_caller]
fn assert_quotient(a: f32, b: f32) {
    let expected = native_div(a, b).to_bits();
    let (emulated, shared) = (div_emulated(a, b).to_bits(), div(a, b).to_bits());
    assert!(
        emulated == expected && shared == expected,
        "{a:e} / {b:e}: expected {expected:08x}, emulated {emulated:08x}, div {shared:08x}"
    );
}

#[track_caller]
fn assert_root(x: f32) {
    let expected = native_sqrt(x).to_bits();
    let (emulated, shared) = (sqrt_emulated(x).to_bits(), sqrt(x).to_bits());
    assert!(
        emulated == expected && shared == expected,
        "sqrt {x:e} ({:08x}): expected {expected:08x}, emulated {emulated:08x}, sqrt {shared:08x}",
        x.to_bits()
    );
}

/// The bits of `x` with another biased exponent.
fn with_exponent(x: f32, exponent: u32) -> f32 {
    f32::from_bits((x.to_bits() & SIGN_AND_FRACTION) | (exponent << 23))
}

/// A finite normal number of either sign from 32 random bits, its exponent anywhere in the range.
fn normal(bits: u32) -> f32 {
    with_exponent(f32::from_bits(bits), 1 + ((bits >> 23) & 0xff) % 254)
}

/// Random quotients: plain ones, quotients near one, near a rounding tie, exact ones, and at the ends of the range.
fn check_quotients(count: u32, seed: u32) {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9);
        hash(state)
    };
    for i in 0..count {
        let (a, b) = (normal(next()), normal(next()));
        let (a, b) = match i % 8 {
            0..=3 => (a, b),
            // A few units apart: the quotient is next to one.
            4 => (f32::from_bits(b.to_bits().wrapping_add(next() % 17)), b),
            // Short significands: many quotients are exact.
            5 => (
                f32::from_bits(a.to_bits() & 0xfff8_0000),
                f32::from_bits(b.to_bits() & 0xfff8_0000),
            ),
            // b times a number of 25 bits, rounded: the quotient is next to a tie.
            6 => {
                let b = with_exponent(b, 127);
                let q = 1.0 + f64::from((next() >> 8) | 1) * 2f64.powi(-24);
                ((q * f64::from(b)) as f32, b)
            }
            // A tiny number over one near one: the result is just below the normal range, or just not.
            _ => (
                with_exponent(a, 1 + next() % 3),
                with_exponent(b, 126 + next() % 4),
            ),
        };
        if a.is_finite() {
            assert_quotient(a, b);
        }
    }
}

#[test]
fn every_significand_and_parity_has_the_ieee_root() {
    for parity in 0..2 {
        for fraction in 0..1_u32 << 23 {
            assert_root(f32::from_bits(fraction | ((126 + parity) << 23)));
        }
    }
}

#[test]
fn every_exponent_has_the_ieee_root() {
    for exponent in 1..255_u32 {
        for i in 0..2000 {
            assert_root(f32::from_bits((exponent << 23) | (hash(i) >> 9)));
        }
        assert_root(f32::from_bits(exponent << 23));
        assert_root(f32::from_bits((exponent << 23) | FRACTION));
    }
}

#[test]
fn roots_below_the_normal_numbers_are_zero() {
    for x in [
        0.0,
        -0.0,
        f32::from_bits(1),
        f32::from_bits(FRACTION),
        -1.0,
        f32::MIN,
        -f32::MIN_POSITIVE,
    ] {
        assert_root(x);
        assert_eq!(sqrt(x).to_bits(), 0);
    }
}

#[test]
#[ignore = "all 2^32 words: 37 s on two cores, with the quotients"]
fn every_float_has_the_ieee_root() {
    for bits in 0..=u32::MAX {
        let x = f32::from_bits(bits);
        if x.is_finite() {
            assert_root(x);
        }
    }
}

#[test]
fn every_reciprocal_is_the_ieee_quotient() {
    for fraction in 0..1_u32 << 23 {
        assert_quotient(1.0, with_exponent(f32::from_bits(fraction), 127));
    }
}

#[test]
fn random_and_structured_quotients_are_ieee() {
    check_quotients(20_000_000, 1);
}

#[test]
#[ignore = "10^9 quotients: 37 s on two cores, with the roots"]
fn a_billion_quotients_are_ieee() {
    check_quotients(1_000_000_000, 0x5eed_0002);
}

#[test]
fn quotients_at_the_ends_of_the_range() {
    let edges = [
        f32::MIN_POSITIVE,
        f32::MIN_POSITIVE.next_up(),
        2.0 * f32::MIN_POSITIVE,
        1.0_f32.next_down(),
        1.0,
        1.0_f32.next_up(),
        2.0_f32.next_down(),
        f32::MAX.next_down(),
        f32::MAX,
    ];
    for a in edges {
        for b in edges {
            for (a, b) in [
                (a, b),
                (-a, b),
                (a, -b),
                (-a, -b),
                (0.0, b),
                (-0.0, b),
                (0.0, -b),
                (f32::from_bits(7), b),
            ] {
                assert_quotient(a, b);
            }
        }
    }
}

/// With the longest significand over a power of two the quotient can be just below the normal numbers, where the processor
/// itself rounds it up to the least of them; found by the fuzz target `exact`.
#[test]
fn quotients_just_below_the_normal_numbers_are_zero() {
    for exponent in 1..255_u32 {
        // (2 - 2^-23) 2^(e - 127) over 2^e.
        let a = f32::from_bits(exponent << 23 | FRACTION);
        let b = 2f32.powi(exponent as i32);
        for (a, b) in [(a, b), (-a, b), (a, -b), (-a, -b)] {
            if b.is_finite() {
                assert_quotient(a, b);
                assert_eq!(div(a, b).to_bits() << 1, 0, "{a:e} / {b:e}");
                // Its neighbours stay as they are.
                assert_quotient(f32::from_bits(a.to_bits() + 1), b);
                assert_quotient(f32::from_bits(a.to_bits() - 1), b);
            }
        }
    }
}

/// The largest relative error of `f` against `exact` over all significands with the given biased exponents.
fn worst(exponents: std::ops::Range<u32>, f: fn(f32) -> f32, exact: fn(f64) -> f64) -> f64 {
    let mut worst = 0.0_f64;
    for exponent in exponents {
        for fraction in 0..1_u32 << 23 {
            let x = f32::from_bits(fraction | (exponent << 23));
            let expected = exact(f64::from(x));
            worst = worst.max(((f64::from(f(x)) - expected) / expected).abs());
        }
    }
    worst
}

#[test]
fn cheap_reciprocals_keep_their_bounds() {
    let recip_error = worst(126..128, recip, |x| 1.0 / x);
    let rsqrt_error = worst(126..128, rsqrt, |x| 1.0 / x.sqrt());
    println!("largest relative error: recip {recip_error:e}, rsqrt {rsqrt_error:e}");
    assert!(recip_error < 7e-6, "recip: {recip_error:e}");
    assert!(rsqrt_error < 5e-6, "rsqrt: {rsqrt_error:e}");
}

#[test]
fn cheap_reciprocals_hold_over_their_whole_range() {
    for i in 0..4_000_000_u32 {
        let x = with_exponent(f32::from_bits(hash(i)), 1 + i % 251);
        let expected = 1.0 / f64::from(x);
        assert!(
            ((f64::from(recip(x)) - expected) / expected).abs() < 7e-6,
            "recip {x:e}"
        );
        let x = with_exponent(f32::from_bits(hash(i) & FRACTION), 2 + i % 253);
        let expected = 1.0 / f64::from(x).sqrt();
        assert!(
            ((f64::from(rsqrt(x)) - expected) / expected).abs() < 5e-6,
            "rsqrt {x:e}"
        );
    }
    for x in [2f32.powi(125), -(2f32.powi(125)), f32::MIN_POSITIVE] {
        assert!(
            (f64::from(recip(x)) * f64::from(x) - 1.0).abs() < 7e-6,
            "recip {x:e}"
        );
    }
    assert!(rsqrt(0.0).is_finite());
    assert!((f64::from(rsqrt(f32::MAX)).powi(2) * f64::from(f32::MAX) - 1.0).abs() < 1e-5);
}

#[test]
fn order_agrees_with_the_native_one() {
    for i in 0..1_000_000 {
        let (a, b, c) = (
            normal(hash(3 * i)),
            normal(hash(3 * i + 1)),
            normal(hash(3 * i + 2)),
        );
        assert_eq!(min(a, b), a.min(b));
        assert_eq!(max(a, b), a.max(b));
        assert_eq!(abs(a), a.abs());
        assert_eq!(order_key(a) < order_key(b), a < b);
        let (lo, hi) = (min(b, c), max(b, c));
        assert_eq!(clamp(a, lo, hi), a.clamp(lo, hi));
    }
    assert_eq!(min(0.0, -0.0).to_bits(), (-0.0_f32).to_bits());
    assert_eq!(max(-0.0, 0.0).to_bits(), 0);
    assert!(order_key(-0.0) < order_key(0.0));
}

#[test]
fn flush_hides_small_numbers_and_the_sign_of_zero() {
    let tiny = 2f32.powi(-100);
    for x in [0.0, -0.0, tiny.next_down(), -tiny.next_down(), f32::from_bits(1)] {
        assert_eq!(flush(x, tiny).to_bits(), 0, "{x:e}");
    }
    for x in [tiny, -tiny, 1.0, f32::MAX, f32::MIN] {
        assert_eq!(flush(x, tiny).to_bits(), x.to_bits(), "{x:e}");
    }
}

#[test]
fn integers_and_unit_floats() {
    assert_eq!(unit_f32(0), 0.0);
    assert_eq!(unit_f32(u32::MAX), 1.0_f32.next_down());
    for h in 0..1_u32 << 24 {
        let u = unit_f32((h << 8) | (h & 0xff));
        assert_eq!(u * 16_777_216.0, h as f32);
        assert_eq!(floor_u32(u * 16_777_216.0), h);
    }
    assert_eq!(floor_u32(16_777_216.0), 1 << 24);
    assert_eq!(floor_u32(1.0_f32.next_down()), 0);
}

/// Each of the 2^16 values of the hash's upper half gets its share of the first 2^22 integers (chi-square; the bound is
/// six standard deviations, 6 sqrt(2n), off the mean n).
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
