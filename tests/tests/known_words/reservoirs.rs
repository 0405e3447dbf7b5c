//! Reservoirs: candidates, merges and the two ends.

use lightbvh::reservoir::{LightSample, Resampling, Reservoir, target};
use lightbvh_tests::generate::{self, Random};

use super::digest::Digest;

#[test]
fn reservoirs() {
    let mut random = Random::new(47);
    let mut digest = Digest::new();
    let mut others: Vec<Reservoir> = vec![Reservoir::EMPTY];
    for i in 0..2000 {
        let mut stream = Resampling::EMPTY;
        let mut balance = 0.0;
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
            let other = others[random.below(others.len() as u32) as usize].limited(20 + i);
            let own = target(generate::log_uniform(&mut random, -5, 5));
            stream.merge(&other, own, i, random.bits());
            balance += own * other.count as f32;
        }
        let (equal, balanced) = (
            stream.finish_equal(),
            stream.finish_balanced(stream.target, balance),
        );
        digest.words(&[equal, balanced, equal.occluded()]);
        others.push(equal);
        others.push(balanced);
    }
    digest.is(0x7bbb_93e1_35c5_0664, "reservoirs");
}
