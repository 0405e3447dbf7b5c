//! Direct lighting by sampled lights converges to the sum over all lights, for every sampler and number of candidates.

use glam::Vec3;
use lightbvh::{EmissiveTriangle, ShadingPoint, exact};
use lightbvh_host::workload::render_params;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::direct::reflected;
use lightbvh_tests::direct::brute_force;
use lightbvh_tests::generate::Random;
use lightbvh_tests::statistics::Mean;
use lightbvh_tests::world::{Corners, World, agrees, matte, seen};

/// Light samples for each picker at each point.
const SAMPLES: u32 = 40_000;

/// Forty lights around a room of 10 m: small and large, dim and bright by 2^16, a third of them two-sided, facing
/// anywhere, in mesh lights of four.
fn lights(random: &mut Random) -> Vec<EmissiveTriangle> {
    let light = |i: u32| {
        let corner = [
            random.between(0.0, 10.0),
            random.between(4.0, 8.0),
            random.between(0.0, 10.0),
        ];
        let size = if i.is_multiple_of(5) { 2.0 } else { 0.3 };
        let mut vertex = || corner.map(|c| c + random.between(-size, size));
        let p = [vertex(), vertex(), vertex()];
        let radiance = exact::pow2(random.below(17) as i32 - 8);
        EmissiveTriangle {
            p,
            radiance: [radiance; 3],
            mesh: i / 4,
            flags: u32::from(i.is_multiple_of(3)),
        }
    };
    (0..40).map(light).collect()
}

/// Points below the lights, on surfaces of every slant; some between them.
fn point(random: &mut Random, i: u32) -> ShadingPoint {
    let height = if i % 3 == 2 {
        random.between(3.0, 6.0)
    } else {
        random.between(0.0, 2.0)
    };
    ShadingPoint {
        p: [random.between(0.0, 10.0), height, random.between(0.0, 10.0)],
        n: if i.is_multiple_of(2) {
            [0.0, 1.0, 0.0]
        } else {
            random.direction()
        },
    }
}

/// A ceiling with holes between the points and the lights.
fn occluders(random: &mut Random) -> Vec<Corners> {
    (0..12)
        .map(|_| {
            let corner = [
                random.between(-1.0, 9.0),
                random.between(2.5, 3.0),
                random.between(-1.0, 9.0),
            ];
            let mut vertex = || {
                [
                    corner[0] + random.between(-2.0, 2.0),
                    corner[1],
                    corner[2] + random.between(-2.0, 2.0),
                ]
            };
            [vertex(), vertex(), vertex()]
        })
        .collect()
}

/// The renderer's estimate at surfaces, against brute force.
fn surfaces_converge(seed: u32, walls: bool) {
    let random = &mut Random::new(seed);
    let lights = lights(random);
    let occluders = if walls { occluders(random) } else { Vec::new() };
    let world = World::new(lights, &occluders, matte(1.0));
    let mut lit = 0;
    for i in 0..8 {
        let point = point(random, i);
        let reference = brute_force(&point, &world.lights, &occluders, 24, random);
        let seen = seen(point, Vec3::from(point.n));
        world.each_picker(|name, pick| {
            for (count, candidates, of) in [(1, 1, 1), (4, 1, 1), (1, 5, 1), (3, 5, 1), (2, 1, 3), (1, 3, 3)]
            {
                let mut mean = Mean::default();
                // Every third sample of three times as many, the first or the last few of more: each by itself has the same mean.
                let all = count + candidates % 4;
                for sample in 0..SAMPLES / (count * candidates) {
                    let seed = exact::hash(sample ^ i << 20);
                    let params = RenderParams {
                        first: (all - count) * (sample / of % 2),
                        all,
                        candidates,
                        part: sample % of,
                        parts: of,
                        ..render_params((1, 1), count, 0, [0.0; 3])
                    };
                    let value = reflected(&world.scene(), &seen, &pick, &params, seed);
                    mean.add(f64::from(value.x) * std::f64::consts::PI);
                }
                let what = format!("{name}, {count}, each one of {candidates}, at {point:?}");
                agrees(&what, &mean, reference.sum, reference.error);
                lit += u32::from(reference.sum > 0.0);
            }
        });
    }
    assert!(lit >= 64, "nearly all in the dark: {lit}");
}

#[test]
fn surfaces_without_occluders() {
    surfaces_converge(1, false);
}

#[test]
fn surfaces_behind_occluders() {
    surfaces_converge(2, true);
}
