//! Reservoirs: candidates and their end.

use lightbvh::reservoir::{Resampling, target};
use lightbvh_tests::generate::{self, Random};

use super::digest::Digest;

#[test]
fn reservoirs() {
    let mut random = Random::new(47);
    let mut digest = Digest::new();
    for _ in 0..2000 {
        let mut stream = Resampling::EMPTY;
        // A light, an instance, and two numbers.
        let mut chosen = [u32::MAX, u32::MAX, 0, 0];
        for _ in 0..1 + random.below(6) {
            let sample = [
                random.below(1000),
                random.below(50),
                random.unit().to_bits(),
                random.unit().to_bits(),
            ];
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
            if stream.candidate(target(luminance), pmf, random.bits()) {
                chosen = sample;
            }
        }
        digest.words(&[chosen]);
        digest.words(&[stream.weight()]);
    }
    digest.is(0x5f81_6004_9037_7131, "reservoirs");
}
