//! Direct lighting by sampled lights converges to the sum over all lights, for every sampler.

use glam::Vec3;
use lightbvh::light::uniform_point;
use lightbvh::{
    BuildParams, EmissiveTriangle, Heuristic, LightBvh, Lights, Random64, SampledLight, ShadingPoint, exact,
};
use lightbvh_host::render::{RayBvh, power_thresholds};
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::numbers::Part;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::{Samples, Scene, Seen, reflected};
use lightbvh_kernels::shading::skin::Spot;
use lightbvh_kernels::shading::sky::NoSky;
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
fn each_picker(lights: &Lights, mut test: impl FnMut(&str, &dyn PickLight)) {
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
    test("uniform", &uniform);
    test("power", &power);
    test("single-level", &one);
    test("two-level", &two);
}

/// Whatever picks.
struct By<'a>(&'a dyn PickLight);

impl PickLight for By<'_> {
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        self.0.pick(point, random)
    }

    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        self.0.pmf(point, light, instance)
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

/// What rays hit.
fn surfaces(lights: &Lights, occluders: &[[[f32; 3]; 3]]) -> Vec<SurfaceTriangle> {
    let surface = |p: [[f32; 3]; 3], light: u32, instance: u32| SurfaceTriangle {
        p,
        material: 0,
        light,
        instance,
    };
    let dark = occluders.iter().map(|&p| surface(p, NONE, NONE));
    let bright = lights.triangles().iter().zip(0..);
    dark.chain(bright.map(|(t, i)| surface(t.p, i, t.mesh))).collect()
}

/// The renderer's estimate at surfaces, against brute force.
fn surfaces_converge(seed: u32, walls: bool) {
    let random = &mut Random::new(seed);
    let lights = lights(random);
    let occluders = if walls { occluders(random) } else { Vec::new() };
    let surfaces = surfaces(&lights, &occluders);
    let bvh = RayBvh::build(&surfaces).expect("a ray BVH");
    let scene = Scene {
        sky: NoSky,
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
            spot: Spot {
                triangle: NONE,
                at: [0.0; 2],
            },
            tint: Vec3::ONE,
        };
        each_picker(&lights, |name, pick| {
            for (count, candidates, scattered) in
                [(1, 1, 0), (4, 1, 0), (1, 5, 0), (3, 5, 0), (2, 1, 1), (1, 3, 2)]
            {
                let mut mean = Mean::default();
                // Every third sample of three times as many, the first or the last few of more: each by itself has the same mean.
                let of = if scattered > 0 { 3 } else { 1 };
                let all = count + candidates % 4;
                for sample in 0..SAMPLES / (count * (candidates + scattered)) {
                    let seed = exact::hash(sample ^ i << 20);
                    let samples = Samples {
                        count,
                        first: (all - count) * (sample / of % 2),
                        all,
                        candidates,
                        scattered,
                        part: Part {
                            index: sample % of,
                            of,
                        },
                    };
                    let value = reflected(&scene, &seen, &By(pick), samples, seed);
                    mean.add(f64::from(value.x) * std::f64::consts::PI);
                }
                lit += u32::from(agrees(
                    &format!("{name}, {count}, each one of {candidates} and {scattered}, at {point:?}"),
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

/// Of a gloss no closed form is at hand: with directions that the surface reflects into the mean is that of lights as picked,
/// and where most of it is one light in a mirror the error is a fraction, with a quarter of the shadow rays.
#[test]
fn scattered_candidates_agree_with_lights_as_picked() {
    let random = &mut Random::new(4);
    let lights = lights(random);
    let occluders = occluders(random);
    let bvh = RayBvh::build(&surfaces(&lights, &occluders)).expect("a ray BVH");
    let listed = listed(lights.triangles().len() as u32);
    let tree = LightBvh::two_level(&lights, &BuildParams::default());
    let (mut lit, mut won) = (0, 0);
    for (exponent_log2, specular) in [(0, 0.25), (4, 0.5), (8, 1.0), (12, 1.0)] {
        let material = Material {
            albedo: [0.5, 0.25, 0.0],
            specular,
            exponent_log2,
        };
        let scene = Scene {
            sky: NoSky,
            surfaces: bvh.surfaces(),
            materials: &[material],
            emitters: Emitters {
                triangles: lights.triangles(),
                instances: &listed,
            },
        };
        for i in 0..8 {
            // Towards a light, by the mirror.
            let point = point(random, i);
            let towards = &lights.triangles()[random.below(40) as usize];
            let wi = (towards.vertex(0) - point.position()).normalize();
            let n = point.normal();
            let wo = n * (2.0 * n.dot(wi)) - wi;
            if n.dot(wi) <= 0.0 {
                continue;
            }
            let seen = Seen {
                point,
                wo,
                material: 0,
                direct: Vec3::ZERO,
                spot: Spot {
                    triangle: NONE,
                    at: [0.0; 2],
                },
                tint: Vec3::ONE,
            };
            let mean_of = |samples: Samples| {
                let mut mean = Mean::default();
                for sample in 0..8_000 {
                    let seed = exact::hash(sample ^ i << 20);
                    let value = reflected(&scene, &seen, &tree.tree(), samples, seed);
                    mean.add(f64::from(value.x) + f64::from(value.z));
                }
                mean
            };
            let plain = mean_of(Samples::of(4));
            for (candidates, scattered) in [(1, 1), (4, 1), (0, 3)] {
                let with = mean_of(Samples {
                    candidates,
                    scattered,
                    ..Samples::of(1)
                });
                let what = format!("2^{exponent_log2}, {candidates} and {scattered} at {point:?} from {wo}");
                lit += u32::from(agrees(&what, &with, plain.mean(), plain.error()));
                won += u32::from(with.error() < 0.3 * plain.error());
            }
        }
    }
    assert!(
        lit >= 60 && won >= 6,
        "{lit} lit, {won} with less than a third of the error"
    );
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
                let picked = pick.pick(&point, exact::hash(seed).into());
                let light = &lights.triangles()[picked.light as usize];
                let [p0, p1, p2] = light.p.map(Vec3::from);
                let uv = [1, 2].map(|k| exact::unit_f32(exact::hash(seed.wrapping_add(k))));
                let y = uniform_point(p0, p1 - p0, p2 - p0, uv[0], uv[1]);
                let area = Triangle::new(light).area();
                mean.add(arriving(&point, light, vector(y.to_array())) * area / f64::from(picked.pmf));
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
