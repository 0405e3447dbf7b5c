//! ReSTIR's expectation: every step that claims to be unbiased converges to the sum over all lights, in scenes that stand
//! still and in scenes where lights, occluders and the camera move and lights come and go; the biased combination does not.

use std::sync::Arc;

use glam::Vec3;
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, exact};
use lightbvh_host::backend::{
    Backend, Bvh, Combination, CpuBackend, LightRemap, Restir, RestirFrame, RestirOptions, Sampler,
    SceneArrays,
};
use lightbvh_host::render::{RayBvh, View, camera};
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::direct::{Reference, brute_force};
use lightbvh_tests::generate::Random;
use lightbvh_tests::statistics::{Mean, normal_quantile};
use rayon::prelude::*;

const WHITE: Material = Material {
    albedo: [1.0; 3],
    specular: 0.0,
    exponent_log2: 0,
};
const WIDTH: u32 = 10;
const HEIGHT: u32 = 7;
/// Frames of each history; the last one is looked at.
const FRAMES: usize = 4;
/// Independent histories.
const HISTORIES: u32 = 6000;
/// Chance that a right renderer fails one comparison.
const TAIL: f64 = 1e-7;
/// Shadow rays start 2^-18 of the coordinates off their surfaces, and f32 rounds: a relative error left out of the test.
const RENDERER_ERROR: f64 = 1e-3;

struct Shot {
    arrays: Arc<SceneArrays>,
    bvh: Bvh,
    remap: Option<LightRemap>,
}

/// The world at a time: 24 lights above a ceiling with holes, and fences on a floor.
struct World {
    lights: Vec<EmissiveTriangle>,
    walls: Vec<[[f32; 3]; 3]>,
    eye: [f32; 3],
}

impl World {
    fn new(time: f32) -> Self {
        let random = &mut Random::new(11);
        let triangle = |random: &mut Random, low: [f32; 3], high: [f32; 3], size: [f32; 3]| {
            let corner: [f32; 3] = std::array::from_fn(|k| random.between(low[k], high[k]));
            let velocity: [f32; 3] = std::array::from_fn(|k| time * size[k] * random.between(-0.3, 0.3));
            let mut vertex =
                || std::array::from_fn(|k| corner[k] + velocity[k] + size[k] * random.between(-1.0, 1.0));
            [vertex(), vertex(), vertex()]
        };
        let lights = (0..24)
            .map(|i: u32| {
                let size = if i.is_multiple_of(5) { 1.2 } else { 0.4 };
                let p = triangle(random, [0.0, 4.0, 0.0], [8.0, 6.0, 8.0], [size; 3]);
                let radiance = exact::pow2(random.below(7) as i32 - 3);
                EmissiveTriangle {
                    p,
                    radiance: [radiance; 3],
                    mesh: i,
                    flags: u32::from(i.is_multiple_of(2)),
                }
            })
            .collect();
        let mut walls: Vec<_> = (0..9)
            .map(|_| triangle(random, [1.0, 2.4, 1.0], [7.0, 2.8, 7.0], [1.6, 0.0, 1.6]))
            .collect();
        walls.extend((0..5).map(|_| triangle(random, [2.5, 0.2, 2.5], [5.5, 0.5, 5.5], [0.5, 0.5, 0.5])));
        let far = 40.0;
        walls.push([[-far, 0.0, -far], [-far, 0.0, far], [far, 0.0, far]]);
        walls.push([[-far, 0.0, -far], [far, 0.0, far], [far, 0.0, -far]]);
        Self {
            lights,
            walls,
            eye: [4.0 + 0.1 * time, 2.0, 4.0 - 0.05 * time],
        }
    }

    /// The frame with the lights `order`, which stood as `before` in the frame before.
    fn shot(&self, order: &[u32], before: Option<&[u32]>) -> Shot {
        let lights: Vec<_> = (0..)
            .zip(order)
            .map(|(k, &i)| EmissiveTriangle {
                mesh: instance_of(k),
                ..self.lights[i as usize]
            })
            .collect();
        let surface = |p: [[f32; 3]; 3], light: u32| SurfaceTriangle {
            p,
            material: 0,
            light,
            instance: instance_of(light),
        };
        let mut surfaces: Vec<_> = self.walls.iter().map(|&p| surface(p, NONE)).collect();
        surfaces.extend(lights.iter().zip(0..).map(|(t, i)| surface(t.p, i)));
        let view = View {
            eye: self.eye,
            right: [1.0, 0.0, 0.0],
            up: [0.0, 0.0, -1.0],
            forward: [0.0, -1.0, 0.0],
            yfov: 1.0,
        };
        let arrays = SceneArrays::new(
            RayBvh::build(&surfaces).expect("a ray BVH"),
            vec![WHITE],
            Lights::new(lights).expect("within the domain"),
            camera(&view, WIDTH, HEIGHT),
        );
        let position = |k: u32| order.iter().position(|&i| i == k).map_or(NONE, |i| i as u32);
        Shot {
            bvh: LightBvh::two_level(&arrays.lights, &BuildParams::default()),
            arrays: Arc::new(arrays),
            remap: before.map(|before| {
                let name = |light: u32| [light, instance_of(light)];
                let kept = (0..).zip(before).map(|(i, &k)| (name(i), name(position(k))));
                LightRemap::new(before.len(), order.len(), kept)
            }),
        }
    }
}

/// Two lights make an instance.
fn instance_of(light: u32) -> u32 {
    light / 2
}

/// Frames that all show the same.
fn still() -> Vec<Shot> {
    let all: Vec<u32> = (0..24).collect();
    (0..FRAMES).map(|_| World::new(0.0).shot(&all, None)).collect()
}

/// Frames in which everything moves, the lights change places, and the last frame has lights that were not there before,
/// and lacks one that was.
fn moving() -> Vec<Shot> {
    let all: Vec<u32> = (0..24).collect();
    let early: Vec<u32> = all.iter().copied().filter(|i| i % 6 != 1).rev().collect();
    let late: Vec<u32> = all.iter().copied().filter(|&i| i != 10).collect();
    let orders = [&all, &early, &early, &late];
    (0..FRAMES)
        .map(|n| {
            let before = n.checked_sub(1).map(|n| orders[n].as_slice());
            World::new(n as f32).shot(orders[n], before)
        })
        .collect()
}

fn frame(shot: &Shot, seed: u32) -> RestirFrame<'_> {
    RestirFrame {
        scene: &shot.arrays,
        width: WIDTH,
        height: HEIGHT,
        seed,
        jitter: 3,
        background: [0.0; 3],
        remap: shot.remap.as_ref(),
    }
}

/// The next frame of `restir`.
fn render(restir: &mut Restir, shot: &Shot, seed: u32) -> Vec<[f32; 3]> {
    let mut backend = CpuBackend::<Standard, 8>::new(shot.bvh.clone());
    backend.restir(restir, &frame(shot, seed)).expect("a frame").value
}

/// Direct light of every pixel of the last frame by brute force.
fn references(shots: &[Shot], time: f32) -> Vec<Reference> {
    let last = &shots[FRAMES - 1];
    let options = RestirOptions::new(Sampler::Power, Combination::Unbiased);
    let mut restir = Restir::new(options);
    render(&mut restir, last, 0);
    let surfaces = restir.state().expect("a state").0;
    let world = World::new(time);
    let random = &mut Random::new(5);
    surfaces
        .iter()
        .map(|s| {
            assert!(Vec3::from(s.point.n).length() > 0.9, "a pixel without a surface");
            assert_eq!(s.direct, [0.0; 3]);
            brute_force(&s.point, last.arrays.lights.triangles(), &world.walls, 20, random)
        })
        .collect()
}

/// Mean of each pixel, and of the whole image over its reference, over all histories.
fn measure(options: RestirOptions, shots: &[Shot], references: &[Reference]) -> (Vec<Mean>, Mean) {
    let whole: f64 = references.iter().map(|r| r.sum).sum();
    let images: Vec<_> = (0..HISTORIES)
        .into_par_iter()
        .map(|history| {
            let mut restir = Restir::new(options);
            let mut image = Vec::new();
            for (number, shot) in (0..).zip(shots) {
                let seed = exact::hash(history * FRAMES as u32 + number);
                image = render(&mut restir, shot, seed);
            }
            image
        })
        .collect();
    let mut pixels = vec![Mean::default(); references.len()];
    let mut total = Mean::default();
    for image in &images {
        let mut sum = 0.0;
        for (mean, value) in pixels.iter_mut().zip(image) {
            let value = f64::from(value[0]) * std::f64::consts::PI;
            mean.add(value);
            sum += value;
        }
        total.add(sum / whole);
    }
    (pixels, total)
}

/// Every pixel and the whole image have the mean that brute force finds.
fn converges(what: &str, options: RestirOptions, shots: &[Shot], references: &[Reference]) {
    let (pixels, total) = measure(options, shots, references);
    let deviations = normal_quantile(TAIL);
    let whole: f64 = references.iter().map(|r| r.sum).sum();
    let error = references.iter().map(|r| r.error * r.error).sum::<f64>().sqrt() / whole;
    println!(
        "{what} {:?}: {:.5} ± {:.5} (reference ± {error:.5})",
        options.source,
        total.mean(),
        total.error()
    );
    assert!(
        (total.mean() - 1.0).abs() <= deviations * total.error().hypot(error) + RENDERER_ERROR,
        "{what} {options:?}: the image is {} ± {} of its reference ± {error}",
        total.mean(),
        total.error()
    );
    let mut lit = 0;
    for (pixel, (found, reference)) in pixels.iter().zip(references).enumerate() {
        let tolerance = deviations * found.error().hypot(reference.error) + RENDERER_ERROR * reference.sum;
        assert!(
            (found.mean() - reference.sum).abs() <= tolerance,
            "{what} {options:?} pixel {pixel}: {} ± {}, expected {reference:?}",
            found.mean(),
            found.error()
        );
        lit += u32::from(reference.sum > 0.0);
    }
    assert!(lit * 2 > WIDTH * HEIGHT, "nearly all in the dark: {lit}");
}

const SOURCES: [Sampler; 2] = [Sampler::Power, Sampler::TwoLevel];

fn options(source: Sampler, combination: Combination) -> RestirOptions {
    RestirOptions {
        candidates: 3,
        radius: 3,
        ..RestirOptions::new(source, combination)
    }
}

#[test]
fn each_unbiased_step_converges() {
    for (what, shots, time) in [("still", still(), 0.0), ("moving", moving(), 3.0)] {
        let references = references(&shots, time);
        for source in SOURCES {
            let usual = options(source, Combination::Unbiased);
            for (step, history, spatial_passes) in [
                ("initial", 0, 0),
                ("over pixels", 0, 1),
                ("over pixels twice", 0, 2),
                ("over time", usual.history, 0),
                ("over time and pixels", usual.history, usual.spatial_passes),
            ] {
                if history == 0 && time > 0.0 {
                    continue;
                }
                let shots = if history == 0 { &shots[..1] } else { &shots };
                let options = RestirOptions {
                    history,
                    spatial_passes,
                    ..usual
                };
                converges(&format!("{step}, {what}"), options, shots, &references);
            }
        }
    }
}

/// What the biased combination is called: the same measurement finds its bias, so the tests above would find one.
#[test]
fn the_biased_combination_is_biased() {
    let shots = still();
    let references = references(&shots, 0.0);
    for source in SOURCES {
        let options = options(source, Combination::Biased);
        let (_, total) = measure(options, &shots, &references);
        println!("biased {source:?}: {:.5} ± {:.5}", total.mean(), total.error());
        let deviations = normal_quantile(TAIL);
        assert!(
            total.mean() < 1.0 - deviations * total.error() - RENDERER_ERROR,
            "{source:?}: {} ± {} of the light is found: no bias to speak of",
            total.mean(),
            total.error()
        );
    }
}
