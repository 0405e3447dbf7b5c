//! Exact arithmetic, and reservoirs: candidates and their end. Summaries, unions, maps of instances and weights are in the words of
//! trees and scenes.

use lightbvh::exact;
use lightbvh::reservoir::{LightSample, Resampling, target};
use lightbvh_tests::generate::{self, Random};

use super::digest::Digest;

#[test]
fn arithmetic() {
    let mut random = Random::new(41);
    let mut digest = Digest::new();
    for _ in 0..200_000 {
        let x = generate::log_uniform(&mut random, -60, 60);
        let y = generate::log_uniform(&mut random, -60, 60);
        for value in [
            exact::div(x, y),
            exact::div_emulated(x, y),
            exact::div_emulated(x, x * 4.0),
            exact::div_emulated(-x, x.next_up()),
            exact::sqrt(x),
            exact::sqrt_emulated(x),
            exact::recip(x),
            exact::recip_rough(x),
            exact::rsqrt(x),
            exact::rsqrt_rough(x),
            exact::significand(x),
            exact::pow2(exact::exponent(x)),
            exact::unit_f32(exact::hash(x.to_bits())),
        ] {
            digest.float(value);
        }
    }
    digest.is(0x6b77_41b8_c5eb_1e06, "arithmetic");
}

#[test]
fn reservoirs() {
    let mut random = Random::new(47);
    let mut digest = Digest::new();
    for _ in 0..2000 {
        let mut stream = Resampling::EMPTY;
        for _ in 0..1 + random.below(6) {
            let sample = LightSample {
                light: random.below(1000),
                instance: random.below(50),
                uv: [random.unit(), random.unit()],
            };
            let luminance = if random.below(5) == 0 {
                0.0
            } else {
                generate::log_uniform(&mut random, -60, 60)
            };
            let pmf = if random.below(5) == 0 {
                0.0
            } else {
                generate::log_uniform(&mut random, -50, -1)
            };
            stream.candidate(sample, target(luminance), pmf, random.bits());
        }
        let found = stream.finish();
        digest.words(&[found.sample]);
        digest.words(&[found.weight]);
    }
    digest.is(0x5f81_6004_9037_7131, "reservoirs");
}
