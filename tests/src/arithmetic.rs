//! The permitted arithmetic against the processor's own, in `f32` and in `f64`: both forms of division and root are the IEEE results, the
//! cheap ones keep their bounds, the rest is exact.

use lightbvh::exact;

/// A subnormal number as zero of its sign.
#[inline]
fn normal_or_zero(x: f32) -> f32 {
    if x.abs() < f32::MIN_POSITIVE {
        0f32.copysign(x)
    } else {
        x
    }
}

/// Both forms of division are the IEEE quotient, without subnormal numbers in or out.
#[inline]
pub fn quotient(a: f32, b: f32) {
    if normal_or_zero(b) == 0.0 {
        return;
    }
    let a = normal_or_zero(a);
    // Rounding twice, to 53 bits and to 24, is rounding once for a quotient; its own 53 bits tell what is below 2^-126.
    let quotient = f64::from(a) / f64::from(b);
    let expected = if quotient.abs() < f64::from(f32::MIN_POSITIVE) {
        0f32.copysign(quotient as f32)
    } else {
        assert_eq!(
            (a / b).to_bits(),
            (quotient as f32).to_bits(),
            "{a:e} / {b:e} on this processor"
        );
        quotient as f32
    }
    .to_bits();
    assert_eq!(expected, exact::div(a, b).to_bits(), "{a:e} / {b:e}");
    assert_eq!(
        expected,
        exact::div_emulated(a, b).to_bits(),
        "{a:e} / {b:e}, emulated"
    );
}

/// Both forms of the square root are IEEE's; +0 below the normal numbers.
#[inline]
pub fn root(x: f32) {
    let expected = if x < f32::MIN_POSITIVE { 0.0 } else { x.sqrt() }.to_bits();
    let twice = if x < f32::MIN_POSITIVE {
        0.0
    } else {
        f64::from(x).sqrt() as f32
    };
    assert_eq!(expected, twice.to_bits(), "root of {x:e} on this processor");
    assert_eq!(expected, exact::sqrt(x).to_bits(), "root of {x:e}");
    assert_eq!(
        expected,
        exact::sqrt_emulated(x).to_bits(),
        "root of {x:e}, emulated"
    );
}

/// The cheap ones, against the bounds in their documentation.
#[inline]
pub fn reciprocals(x: f32) {
    let off = |found: f32, exact: f64| (f64::from(found) / exact - 1.0).abs();
    let magnitude = x.abs();
    if (f32::MIN_POSITIVE..=2f32.powi(125)).contains(&magnitude) {
        let expected = 1.0 / f64::from(x);
        assert!(off(exact::recip(x), expected) < 7e-6, "recip {x:e}");
        assert!(off(exact::recip_rough(x), expected) < 3e-3, "recip_rough {x:e}");
    }
    if x >= 2f32.powi(-125) {
        let expected = 1.0 / f64::from(x).sqrt();
        assert!(off(exact::rsqrt(x), expected) < 5e-6, "rsqrt {x:e}");
        assert!(off(exact::rsqrt_rough(x), expected) < 6.6e-4, "rsqrt_rough {x:e}");
    }
}

/// Exponent and significand make the number again.
#[inline]
pub fn parts(x: f32) {
    let e = exact::exponent(x);
    if x.abs() < f32::MIN_POSITIVE {
        assert_eq!(e, -127, "{x:e}");
        return;
    }
    assert_eq!(f64::from(exact::pow2(e)), 2f64.powi(e), "{x:e}");
    let s = exact::significand(x.abs());
    assert!((1.0..2.0).contains(&s), "{x:e}");
    assert_eq!(f64::from(s) * 2f64.powi(e), f64::from(x.abs()));
}

/// Floors to integers, where they are defined.
#[inline]
pub fn floors(x: f32) {
    if (0.0..=16_777_216.0).contains(&x) {
        assert_eq!(f64::from(exact::floor_u32(x)), f64::from(x).floor(), "{x:e}");
    }
    if (0.0..4_194_304.0).contains(&x) {
        assert_eq!(exact::floor_small(x), exact::floor_u32(x), "{x:e}");
    }
}

/// The least and greatest of two, and a number clamped between them.
#[inline]
pub fn order(a: f32, b: f32, c: f32) {
    // Of equal ones the second, which matters for zeros.
    let (less, more) = (if a < b { a } else { b }, if a > b { a } else { b });
    assert_eq!(exact::min(a, b).to_bits(), less.to_bits(), "min {a:e} {b:e}");
    assert_eq!(exact::max(a, b).to_bits(), more.to_bits(), "max {a:e} {b:e}");
    assert_eq!(exact::min(a, b), a.min(b));
    assert_eq!(exact::max(a, b), a.max(b));
    assert_eq!(exact::abs(a).to_bits(), a.abs().to_bits());
    let clamped = exact::clamp(c, a, b);
    if a <= b {
        assert_eq!(clamped, c.clamp(a, b), "{c:e} in {a:e}..={b:e}");
    } else {
        assert!(clamped == a || clamped == b, "{c:e} in {a:e}..={b:e}");
    }
}

/// Zero below `tiny`, else the number.
#[inline]
pub fn flushed(x: f32, tiny: f32) {
    let expected = if x.abs() < tiny { 0.0 } else { x };
    assert_eq!(
        exact::flush(x, tiny).to_bits(),
        expected.to_bits(),
        "{x:e} below {tiny:e}"
    );
}

/// The hash is a permutation; unit floats and powers of two are exact.
#[inline]
pub fn integers([a, b]: [u32; 2]) {
    assert_eq!(exact::hash(a) == exact::hash(b), a == b, "a permutation");
    let unit = exact::unit_f32(a);
    assert_eq!(f64::from(unit), f64::from(a >> 8) / 16_777_216.0, "{a:08x}");
    assert!((0.0..1.0).contains(&unit));
    let e = a as i32;
    assert_eq!(f64::from(exact::pow2(e)), 2f64.powi(e.clamp(-126, 127)), "{e}");
}
