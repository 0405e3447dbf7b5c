//! Probabilities against samples.

use arbitrary::{Result, Unstructured};
use lightbvh::{CompactNode, Eq4, INVALID, LightBvh, LightNode, Lights, ShadingPoint};

use crate::{Forms, input};

/// Lights and points: probabilities sum to one, and samples come with them.
pub fn sample_pmf(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let points = [
            input::point(u, lights.triangles())?,
            input::point(u, lights.triangles())?,
        ];
        let random: u32 = u.arbitrary()?;
        for form in forms.of(data, 2) {
            if form == 0 {
                let bvh = LightBvh::<CompactNode<2>, 2>::two_level(&lights, &params);
                for point in &points {
                    distribution(&bvh, &lights, point, random);
                }
            } else {
                let bvh = LightBvh::<CompactNode<4>, 4>::single_level(&lights, &params);
                for point in &points {
                    distribution(&bvh, &lights, point, random);
                }
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

fn distribution<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    point: &ShadingPoint,
    random: u32,
) {
    let count = lights.triangles().len() as u32;
    let pmfs: Vec<f32> = (0..count)
        .map(|light| bvh.pmf::<Eq4>(lights, point, light))
        .collect();
    let sum: f64 = pmfs.iter().map(|&p| f64::from(p)).sum();
    let reachable = pmfs.iter().any(|&p| p > 0.0);
    // As in the property tests: a few roundings of 2^-24 for each level.
    let tolerance = f64::from(bvh.depth() * 4 + 8) / 16_777_216.0;
    assert!(!reachable || (sum - 1.0).abs() <= tolerance, "sum {sum}");
    for i in 0..8_u32 {
        let sampled = bvh.sample::<Eq4>(point, random.wrapping_add(i.wrapping_mul(0x9e37_79b9)));
        if reachable {
            assert!(sampled.light < count, "{sampled:?}");
            assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
        } else {
            assert_eq!(sampled.light, INVALID);
        }
    }
}
