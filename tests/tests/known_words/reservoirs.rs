//! Reservoirs: candidates and their end.

use lightbvh::reservoir::{LightSample, Resampling, target};
use lightbvh_tests::generate::{self, Random};

use super::digest::Digest;

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
