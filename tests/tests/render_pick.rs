//! The choice of a light without a tree: every probability is the exact frequency.

use lightbvh::{EmissiveTriangle, Random64, ShadingPoint};
use lightbvh_host::render::power_thresholds;
use lightbvh_host::scene::SceneLight;
use lightbvh_kernels::shading::pick::{MAX_PICKABLE, PickLight, Power, Uniform};
use lightbvh_kernels::shading::trace::NONE;
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::in_cube;

const ANYWHERE: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0, 1.0, 0.0],
};

const LAMP: EmissiveTriangle = EmissiveTriangle {
    p: [[-0.7, 2.0, -0.4], [0.8, 2.1, -0.3], [0.1, 1.8, 0.9]],
    radiance: [3.0, 2.0, 1.0],
    mesh: 0,
    flags: 0,
};

/// The lights that all 2^24 distinct random numbers lead to, each with its pmf, in order. The pmf picked with is the pmf evaluated,
/// and what is no light has none.
fn every_choice(picker: &impl PickLight, count: u32) -> Vec<(u32, u32, f32)> {
    let mut runs: Vec<(u32, u32, f32)> = Vec::new();
    for random in 0..1_u32 << 24 {
        let picked = picker.pick(&ANYWHERE, Random64::from((random << 8) | (random & 0xff)));
        match runs.last_mut() {
            Some((light, chances, pmf)) if *light == picked.light => {
                assert_eq!(*pmf, picked.pmf);
                *chances += 1;
            }
            _ => runs.push((picked.light, 1, picked.pmf)),
        }
    }
    for &(light, _, pmf) in &runs {
        assert_eq!(picker.pmf(&ANYWHERE, light, 0).to_bits(), pmf.to_bits());
    }
    for beyond in [count, count + 1, MAX_PICKABLE, NONE] {
        assert_eq!(picker.pmf(&ANYWHERE, beyond, 0), 0.0, "{beyond} is no light");
    }
    runs
}

/// Up to the rounding of the 2^24 numbers that are looked at.
#[test]
fn uniform_pmfs_are_the_frequencies() {
    for count in [1, 2, 3, 7, 1000, 65_537, 1 << 20] {
        let choices = every_choice(&Uniform { count }, count);
        assert_eq!(choices.len(), count as usize);
        let least = MAX_PICKABLE / count;
        for (index, &(light, chances, pmf)) in choices.iter().enumerate() {
            assert_eq!(light as usize, index);
            assert!(chances.abs_diff(least) <= 1, "{chances} {least}");
            assert_eq!(pmf, 1.0 / count as f32);
        }
    }
    assert_eq!(Uniform { count: 0 }.pick(&ANYWHERE, 5u32.into()).light, NONE);
}

/// Triangles whose fluxes span twelve orders of magnitude; every fifth is black, every seventh flat.
fn many_lights(count: usize) -> Vec<EmissiveTriangle> {
    let mut random = Random::new(11);
    (0..count)
        .map(|i| {
            let radiance = if i % 5 == 0 {
                0.0
            } else {
                10f32.powf(12.0 * random.unit() - 6.0)
            };
            let p = [
                in_cube(&mut random, 1.0),
                in_cube(&mut random, 1.0),
                in_cube(&mut random, 1.0),
            ];
            let p = if i % 7 == 0 { [p[0], p[1], p[1]] } else { p };
            EmissiveTriangle {
                p,
                radiance: [radiance; 3],
                mesh: 0,
                flags: i as u32 & 1,
            }
        })
        .collect()
}

#[test]
fn power_pmfs_are_the_exact_frequencies_and_sum_to_one() {
    let lights = many_lights(10_000);
    let thresholds = power_thresholds(&lights).unwrap();
    let power = Power {
        thresholds: &thresholds,
    };
    let choices = every_choice(&power, lights.len() as u32);
    let emitters: Vec<usize> = (0..lights.len())
        .filter(|&i| SceneLight::flux(&lights[i]) > 0.0)
        .collect();
    assert_eq!(choices.iter().map(|c| c.0 as usize).collect::<Vec<_>>(), emitters);
    let total: f64 = lights.iter().map(SceneLight::flux).sum();
    let mut sum = 0.0_f64;
    for &(light, chances, pmf) in &choices {
        assert_eq!(f64::from(pmf), f64::from(chances) / f64::from(MAX_PICKABLE));
        sum += f64::from(pmf);
        // One unit for itself, its part of the rest, and less than one by rounding at either end.
        let rest = f64::from(MAX_PICKABLE) - emitters.len() as f64;
        let expected = 1.0 + SceneLight::flux(&lights[light as usize]) / total * rest;
        assert!(
            (f64::from(chances) - expected).abs() < 1.0 + 1e-3,
            "light {light}: {chances} {expected}"
        );
    }
    assert_eq!(sum, 1.0);
}

#[test]
fn power_tables_at_the_edges() {
    let pick = |thresholds: &[u32], random: u32| Power { thresholds }.pick(&ANYWHERE, random.into());
    let one = power_thresholds(&[LAMP]).unwrap();
    assert_eq!((pick(&one, u32::MAX).light, pick(&one, 0).pmf), (0, 1.0));
    let dark = EmissiveTriangle {
        radiance: [0.0; 3],
        ..LAMP
    };
    for hostile in [
        power_thresholds(&[dark, dark]).unwrap(),
        power_thresholds::<EmissiveTriangle>(&[]).unwrap(),
        vec![],
        vec![5],
        vec![u32::MAX; 9],
        vec![9, 8, 7, 6, 5, 4],
        vec![0, u32::MAX],
    ] {
        assert_eq!(pick(&hostile, 0x1234_5678).light, NONE, "{hostile:?}");
    }
}
