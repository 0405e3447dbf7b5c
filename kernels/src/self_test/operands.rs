//! The standard operands of the self-test.

use super::Operands;

/// Bits of 1, the unit of the hand-made triples.
const ONE: u32 = 0x3f80_0000;

/// Triples made so that each kind of defect shows in at least one word of at least one of them.
const HAND_MADE: [Operands; 12] = [
    // (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24: the product drops its last bit, a fused multiply-add of -(1 + 2^-11) keeps it.
    Operands {
        a: ONE + 0x800,
        b: ONE + 0x800,
        c: 0xbf80_1000,
    },
    // The same with the sign turned, for negated forms.
    Operands {
        a: ONE + 0x800,
        b: 0xbf80_0800,
        c: ONE + 0x1000,
    },
    // 2^24 + 1 - 2^24: a tie that goes to even, so real algebra and rounding disagree.
    Operands {
        a: 0x4b80_0000,
        b: ONE,
        c: 0xcb80_0000,
    },
    Operands {
        a: ONE,
        b: 0x4b80_0000,
        c: ONE,
    },
    // Ties to even downwards and upwards, and just beside a tie.
    Operands {
        a: ONE,
        b: 0x3380_0000,
        c: 0x3400_0000,
    },
    Operands {
        a: ONE + 1,
        b: 0x3380_0000,
        c: 0xb380_0000,
    },
    Operands {
        a: ONE,
        b: 0x3380_0001,
        c: 0x337f_ffff,
    },
    // The same below zero: tells rounding towards zero from rounding down.
    Operands {
        a: 0xbf80_0000,
        b: 0xb380_0001,
        c: 0xb37f_ffff,
    },
    Operands {
        a: 0xbf80_0001,
        b: 0xb380_0000,
        c: 0x3380_0000,
    },
    // Thirds and tenths: every product and quotient is inexact.
    Operands {
        a: 0x3eaa_aaab,
        b: 0x3dcc_cccd,
        c: 0x4040_0000,
    },
    // The largest fraction, where roots and quotients are hardest to round.
    Operands {
        a: ONE | 0x007f_ffff,
        b: 0x3fff_fffe,
        c: 0x3f7f_ffff,
    },
    // Equal operands: differences vanish, comparisons tie.
    Operands {
        a: 0x4049_0fdb,
        b: 0x4049_0fdb,
        c: 0x4049_0fdb,
    },
];

/// `count` operand triples: the hand-made ones first, then hashed ones with magnitudes in [2^-20, 2^20) and both
/// signs, every other one with `c` close to `-(a * b)`, where a contraction shows most. The same on every call.
#[must_use]
pub fn operands(count: u32) -> Vec<Operands> {
    (0..count)
        .map(|i| HAND_MADE.get(i as usize).copied().unwrap_or_else(|| hashed(i)))
        .collect()
}

/// The triple that belongs to index `i`.
fn hashed(i: u32) -> Operands {
    let a = number(hash(3 * i));
    let b = number(hash(3 * i + 1));
    let c = if i.is_multiple_of(2) {
        -(a * b)
    } else {
        number(hash(3 * i + 2))
    };
    Operands {
        a: a.to_bits(),
        b: b.to_bits(),
        c: c.to_bits(),
    }
}

/// A float with the sign and fraction of `h` and an exponent in [-20, 20) taken from its other bits.
fn number(h: u32) -> f32 {
    let exponent = 107 + (h >> 23 & 0xff) % 40;
    f32::from_bits(h & 0x807f_ffff | exponent << 23)
}

/// Output function of PCG-RXS-M-XS-32 (O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation", 2014), after one step of its generator.
fn hash(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::self_test::{CHECK_COUNT, SelfTestPush, self_test};
    use glam::UVec3;
    use lightbvh::exact;
    use lightbvh_gpu::self_test::CHECKS;

    fn answers(set: &[Operands]) -> Vec<u32> {
        let push = SelfTestPush {
            count: set.len() as u32,
        };
        let mut out = vec![0xffff_ffff; set.len() * CHECK_COUNT as usize];
        for i in 0..push.count + 3 {
            self_test(UVec3::new(i, 0, 0), &push, set, &mut out);
        }
        out
    }

    fn word(name: &str) -> usize {
        CHECKS
            .iter()
            .position(|check| check.name == name)
            .expect("a check of that name")
    }

    /// Answers worked out by hand: the CPU must give them, whatever it was compiled with.
    #[test]
    fn the_cpu_knows_the_answers() {
        let out = answers(&HAND_MADE);
        let at = |triple: usize, name: &str| out[triple * CHECK_COUNT as usize + word(name)];
        // Uncontracted, (1 + 2^-12)^2 rounds to 1 + 2^-11 and nothing is left; fused, 2^-24 would be.
        assert_eq!(at(0, "multiply_add"), 0);
        assert_eq!(at(1, "multiply_add"), 0);
        assert_eq!(at(0, "product"), ONE + 0x1000);
        // 2^24 + 1 rounds back to 2^24.
        assert_eq!(at(2, "sum_minus_first"), 0);
        assert_eq!(at(3, "sum_minus_second"), 0);
        assert_eq!(at(2, "two_sum_error"), ONE);
        assert_eq!(at(2, "sum_from_the_left"), 0);
        // 1 + 2^-24 is a tie and goes to 1; one unit more goes up; 1 + 2^-23 + 2^-24 ties to the even 1 + 2^-22.
        assert_eq!(at(4, "sum"), ONE);
        assert_eq!(at(6, "sum"), ONE + 1);
        assert_eq!(at(5, "sum"), ONE + 2);
        assert_eq!(at(7, "sum"), 0xbf80_0001);
        assert_eq!(at(8, "sum"), 0xbf80_0002);
        assert_eq!(at(11, "difference"), 0);
    }

    #[test]
    fn every_word_is_written_and_none_beyond_the_count() {
        let set = operands(100);
        let mut out = answers(&set);
        assert!(out.iter().all(|&word| word != 0xffff_ffff));
        out.push(7);
        self_test(
            UVec3::new(100, 0, 0),
            &SelfTestPush { count: 100 },
            &set,
            &mut out,
        );
        assert_eq!(out.last(), Some(&7));
    }

    /// A contraction must change a counted word of many triples, or the test would not see one.
    #[test]
    #[expect(
        clippy::disallowed_methods,
        reason = "the defect itself is what is looked for"
    )]
    fn a_fused_multiply_add_would_show() {
        let set = operands(1000);
        let changed = set.iter().filter(|o| {
            let [a, b, c] = [o.a, o.b, o.c].map(f32::from_bits);
            a.mul_add(b, c).to_bits() != (a * b + c).to_bits()
        });
        assert!(changed.count() > 500);
    }

    #[test]
    fn operands_keep_their_range() {
        let power_of_two = |exponent: i32| f32::from_bits(((127 + exponent) as u32) << 23);
        for o in operands(5000) {
            for bits in [o.a, o.b, o.c] {
                let magnitude = exact::abs(f32::from_bits(bits));
                assert!(
                    (power_of_two(-42)..=power_of_two(42)).contains(&magnitude),
                    "{magnitude}"
                );
            }
        }
    }
}
