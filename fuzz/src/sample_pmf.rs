//! Probabilities against samples.

use arbitrary::{Result, Unstructured};
use lightbvh::{
    Bvh, CompactNode, Defensive, Eq4, INVALID, ImportanceModel, LightNode, Lights, MomentNode, Moments,
    Random64, ShadingPoint,
};

use crate::{Forms, input};

/// Lights and points: every light with flux has a probability, they sum to one, and samples come with them.
pub fn sample_pmf(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let points = [
            input::point(u, lights.triangles())?,
            input::point(u, lights.triangles())?,
        ];
        let random: u32 = u.arbitrary()?;
        for form in forms.of(data, 3) {
            match form {
                0 => {
                    let bvh = Bvh::<CompactNode<2>, (), 2>::two_level(&lights, &params);
                    distributions::<_, Eq4, 2>(&bvh, &lights, &points, random);
                }
                1 => {
                    let bvh = Bvh::<CompactNode<4>, (), 4>::single_level(&lights, &params);
                    distributions::<_, Eq4, 4>(&bvh, &lights, &points, random);
                }
                _ => {
                    let bvh = Bvh::<MomentNode<8>, (), 8>::two_level(&lights, &params);
                    distributions::<_, Defensive<Moments, 6>, 8>(&bvh, &lights, &points, random);
                }
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

fn distributions<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    points: &[ShadingPoint],
    random: u32,
) {
    let shines: Vec<bool> = lights.triangles().iter().map(input::shines::<N, W>).collect();
    for point in points {
        let count = lights.triangles().len() as u32;
        let pmfs: Vec<f32> = (0..count)
            .map(|light| input::pmf_of::<_, I, _>(bvh, lights, point, light))
            .collect();
        for (pmf, shines) in pmfs.iter().zip(&shines) {
            assert!((0.0..=1.0).contains(pmf));
            assert_eq!(*pmf > 0.0, *shines || I::UNIFORM_HALVINGS > 0);
        }
        let sampled = |number: Random64| {
            let sampled = bvh.by::<I>().sample(point, number);
            if sampled.light == INVALID {
                assert!(!shines.contains(&true) && sampled.pmf == 0.0, "{sampled:?}");
            } else {
                assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
            }
        };
        if shines.contains(&true) {
            input::sum_is_one(&pmfs, I::UNIFORM_HALVINGS, point);
        }
        for i in 0..8_u32 {
            sampled(random.wrapping_add(i.wrapping_mul(0x9e37_79b9)).into());
        }
        // The ends of the range, which no rounding may carry beyond.
        for bits in [
            0,
            u64::MAX,
            u64::MAX << 32,
            u64::MAX >> 32,
            1 << 63,
            (1 << 63) - 1,
        ] {
            sampled(bits.into());
        }
    }
}
