//! Direct lighting by sampled lights converges to the sum over all lights, for every sampler.

use glam::Vec3;
use lightbvh::light::uniform_point;
use lightbvh::{BuildParams, EmissiveTriangle, Heuristic, LightBvh, Lights, Random64, ShadingPoint, exact};
use lightbvh_host::render::{RayBvh, power_thresholds};
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::{Scene, Seen, reflected};
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::direct::{arriving, brute_force};
use lightbvh_tests::generate::Random;
use lightbvh_tests::oracle::{Triangle, vector};
use lightbvh_tests::statistics::{Mean, normal_quantile};

const WHITE: Material = Material {
    albedo: [1.0; 3],
    specular: 0.0,
    exponent_log2: 0,
};

/// Light samples for each picker at each point.
const SAMPLES: u32 = 40_000;
/// Chance that a right picker fails one comparison.
const TAIL: f64 = 1e-7;
/// Shadow rays start 2^-18 of the coordinates off their surfaces, and f32 rounds: a relative error left out of the test.
const RENDERER_ERROR: f64 = 1e-3;

/// Forty lights around a room of 10 m: small and large, dim and bright by 2^16, a third of them two-sided, facing
/// anywhere, in mesh lights of four.
fn lights(random: &mut Random) -> Lights {
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
    Lights::new((0..40).map(light).collect()).expect("within the domain")
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
fn occluders(random: &mut Random) -> Vec<[[f32; 3]; 3]> {
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

/// Calls `test` with each picker.
fn each_picker(lights: &Lights, mut test: impl FnMut(&str, &dyn Fn(&ShadingPoint, Random64) -> (u32, f32))) {
    let triangles = lights.triangles();
    let uniform = Uniform {
        count: triangles.len() as u32,
    };
    let thresholds = power_thresholds(triangles).expect("a power");
    let power = Power {
        thresholds: &thresholds,
    };
    let sah = BuildParams {
        heuristic: Heuristic::Sah,
        ..BuildParams::default()
    };
    let one = LightBvh::single_level(lights, &BuildParams::default());
    let two = LightBvh::two_level(lights, &sah);
    let [one, two] = [&one, &two].map(|bvh| bvh.tree());
    let call = |p: &dyn Fn(&ShadingPoint, Random64) -> lightbvh::SampledLight, point: &ShadingPoint, r| {
        let picked = p(point, r);
        (picked.light, picked.pmf)
    };
    test("uniform", &|point, r| call(&|p, r| uniform.pick(p, r), point, r));
    test("power", &|point, r| call(&|p, r| power.pick(p, r), point, r));
    test("single-level", &|point, r| call(&|p, r| one.pick(p, r), point, r));
    test("two-level", &|point, r| call(&|p, r| two.pick(p, r), point, r));
}

/// A picker that is a closure.
struct By<'a>(&'a dyn Fn(&ShadingPoint, Random64) -> (u32, f32));

impl PickLight for By<'_> {
    fn pick(&self, point: &ShadingPoint, random: Random64) -> lightbvh::SampledLight {
        let (light, pmf) = (self.0)(point, random);
        lightbvh::SampledLight {
            light,
            instance: lightbvh::INVALID,
            pmf,
        }
    }

    fn pmf(&self, _point: &ShadingPoint, _light: u32, _mesh: u32) -> f32 {
        unreachable!("direct lighting asks for no probability")
    }
}

/// Whether a mean agrees with the reference; returns whether it was of anything but darkness.
fn agrees(what: &str, found: &Mean, reference: f64, reference_error: f64) -> bool {
    let deviations = normal_quantile(TAIL);
    let tolerance = deviations * found.error().hypot(reference_error) + RENDERER_ERROR * reference;
    assert!(
        (found.mean() - reference).abs() <= tolerance,
        "{what}: {} ± {}, expected {reference} ± {reference_error}",
        found.mean(),
        found.error()
    );
    reference > 0.0
}

/// The renderer's estimate at surfaces, against brute force.
fn surfaces_converge(seed: u32, walls: bool) {
    let random = &mut Random::new(seed);
    let lights = lights(random);
    let occluders = if walls { occluders(random) } else { Vec::new() };
    let surface = |p: [[f32; 3]; 3], light: u32| SurfaceTriangle {
        p,
        material: 0,
        light,
        instance: light,
    };
    let mut surfaces: Vec<_> = occluders.iter().map(|&p| surface(p, NONE)).collect();
    surfaces.extend(lights.triangles().iter().zip(0..).map(|(t, i)| surface(t.p, i)));
    let bvh = RayBvh::build(&surfaces).expect("a ray BVH");
    let scene = Scene {
        surfaces: bvh.surfaces(),
        materials: &[WHITE],
        emitters: Emitters {
            triangles: lights.triangles(),
            instances: &listed(lights.triangles().len() as u32),
        },
    };

    let mut lit = 0;
    for i in 0..8 {
        let point = point(random, i);
        let reference = brute_force(&point, lights.triangles(), &occluders, 24, random);
        let seen = Seen {
            point,
            wo: Vec3::from(point.n),
            material: 0,
            direct: Vec3::ZERO,
        };
        each_picker(&lights, |name, pick| {
            for (samples, candidates) in [(1, 1), (4, 1), (1, 5), (3, 5)] {
                let mut mean = Mean::default();
                for sample in 0..SAMPLES / (samples * candidates) {
                    let seed = exact::hash(sample ^ i << 20);
                    let value = reflected(&scene, &seen, &By(pick), samples, candidates, seed);
                    mean.add(f64::from(value.x) * std::f64::consts::PI);
                }
                lit += u32::from(agrees(
                    &format!("{name}, {samples}, each one of {candidates}, at {point:?}"),
                    &mean,
                    reference.sum,
                    reference.error,
                ));
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

/// Volumes: the renderer shades surfaces only, but a light BVH samples for points without a normal too. What arrives
/// there from a sampled light over its pmf has the mean of all lights.
#[test]
fn volumes() {
    let random = &mut Random::new(3);
    let lights = lights(random);
    for i in 0..8 {
        let point = ShadingPoint {
            n: [0.0; 3],
            ..point(random, i)
        };
        // Every light visible: the other lights' shadows are left out on both sides.
        let mut sum = 0.0;
        let mut variance = 0.0;
        for light in lights.triangles() {
            let one = brute_force(&point, std::slice::from_ref(light), &[], 24, random);
            sum += one.sum;
            variance += one.error * one.error;
        }
        each_picker(&lights, |name, pick| {
            let mut mean = Mean::default();
            for sample in 0..SAMPLES {
                let seed = exact::hash(sample ^ i << 20);
                let (light, pmf) = pick(&point, exact::hash(seed).into());
                let light = &lights.triangles()[light as usize];
                let [p0, p1, p2] = light.p.map(Vec3::from);
                let uv = [1, 2].map(|k| exact::unit_f32(exact::hash(seed.wrapping_add(k))));
                let y = uniform_point(p0, p1 - p0, p2 - p0, uv[0], uv[1]);
                let area = Triangle::new(light).area();
                mean.add(arriving(&point, light, vector(y.to_array())) * area / f64::from(pmf));
            }
            assert!(agrees(
                &format!("{name} in a volume at {point:?}"),
                &mean,
                sum,
                variance.sqrt()
            ));
        });
    }
}
