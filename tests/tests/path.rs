//! Paths: two ways to find each light that share it exactly, and sums known in closed form.

use glam::Vec3;
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, ShadingPoint, exact};
use lightbvh_host::render::{RayBvh, power_thresholds};
use lightbvh_kernels::bvh::{BvhPicker, Node, WIDTH};
use lightbvh_kernels::shading::area::{connect, light_density};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::mis::power_heuristic;
use lightbvh_kernels::shading::path::{MAX_BOUNCES, path_radiance};
use lightbvh_kernels::shading::pick::{PickLight, Picked, Power, Uniform};
use lightbvh_kernels::shading::pixel::{Scene, encounter, reflected, see};
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::direct::brute_force;
use lightbvh_tests::generate::Random;
use lightbvh_tests::statistics::{Mean, normal_quantile};

/// Chance that a right renderer fails one comparison.
const TAIL: f64 = 1e-7;
/// Rays start 2^-18 of the coordinates off their surfaces, and f32 rounds: a relative error left out of the test.
const RENDERER_ERROR: f64 = 1e-3;

/// Finds no light: every light is then found by sampled directions alone.
struct Nothing;

impl PickLight for Nothing {
    fn pick(&self, _point: &ShadingPoint, _random: u32) -> Picked {
        Picked {
            light: NONE,
            pmf: 0.0,
        }
    }

    fn pmf(&self, _point: &ShadingPoint, _light: u32, _mesh: u32) -> f32 {
        0.0
    }
}

fn matte(albedo: f32) -> Material {
    Material {
        albedo: [albedo; 3],
        specular: 0.0,
        exponent_log2: 0,
    }
}

fn glossy(albedo: f32, specular: f32, exponent_log2: u32) -> Material {
    Material {
        albedo: [albedo; 3],
        specular,
        exponent_log2,
    }
}

/// Triangles, the first of them lights, all of one material.
struct World {
    bvh: RayBvh,
    lights: Vec<EmissiveTriangle>,
    materials: Vec<Material>,
}

impl World {
    fn new(lights: Vec<EmissiveTriangle>, others: &[[[f32; 3]; 3]], material: Material) -> Self {
        let mut surfaces: Vec<SurfaceTriangle> = lights
            .iter()
            .zip(0..)
            .map(|(l, light)| SurfaceTriangle {
                p: l.p,
                material: 0,
                light,
            })
            .collect();
        surfaces.extend(others.iter().map(|&p| SurfaceTriangle {
            p,
            material: 0,
            light: NONE,
        }));
        Self {
            bvh: RayBvh::build(&surfaces).expect("a ray BVH"),
            lights,
            materials: vec![material],
        }
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            surfaces: self.bvh.surfaces(),
            materials: &self.materials,
            lights: &self.lights,
        }
    }

    /// The mean over `count` paths along `ray`.
    fn paths<P: PickLight>(&self, picker: &P, ray: &Ray, sky: f32, bounces: u32, count: u32) -> Mean {
        let mut mean = Mean::default();
        for path in 0..count {
            let seed = exact::hash(path ^ bounces << 24);
            let value = path_radiance(&self.scene(), ray, Vec3::splat(sky), picker, bounces, seed);
            mean.add(f64::from(value.x));
        }
        mean
    }

    /// [`paths`](Self::paths) with each picker, and with none.
    fn each_picker(&self, ray: &Ray, bounces: u32, count: u32) -> Vec<(&'static str, Mean)> {
        let triangles = &self.lights[..];
        let lights = Lights::new(triangles.to_vec()).expect("within the domain");
        let uniform = Uniform {
            count: triangles.len() as u32,
        };
        let thresholds = power_thresholds(triangles).expect("a power");
        let power = Power {
            thresholds: &thresholds,
        };
        let one = LightBvh::<Node, WIDTH>::single_level(&lights, &BuildParams::default()).with_leaves();
        let two = LightBvh::<Node, WIDTH>::two_level(&lights, &BuildParams::default()).with_leaves();
        let [one, two] = [&one, &two].map(|bvh| BvhPicker {
            tree: bvh.tree(),
            two_level: bvh.is_two_level(),
        });
        vec![
            ("uniform", self.paths(&uniform, ray, 0.0, bounces, count)),
            ("power", self.paths(&power, ray, 0.0, bounces, count)),
            ("single-level", self.paths(&one, ray, 0.0, bounces, count)),
            ("two-level", self.paths(&two, ray, 0.0, bounces, count)),
            ("directions alone", self.paths(&Nothing, ray, 0.0, bounces, count)),
        ]
    }
}

fn light(p: [[f32; 3]; 3], radiance: f32, mesh: u32, flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: [radiance; 3],
        mesh,
        flags,
    }
}

/// The two triangles of a parallelogram; their front is where `u`, `v` run counter-clockwise.
fn quad(corner: [f32; 3], u: [f32; 3], v: [f32; 3]) -> [[[f32; 3]; 3]; 2] {
    let [c, u, v] = [corner, u, v].map(Vec3::from);
    let [a, b, d] = [(c + u).into(), (c + u + v).into(), (c + v).into()];
    [[corner, a, b], [corner, b, d]]
}

/// A cube from 0 to 4 m seen from inside: the fronts of its six sides.
fn cube() -> Vec<[[f32; 3]; 3]> {
    let (x, y, z) = ([4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]);
    [
        quad([0.0; 3], z, x),
        quad(y, x, z),
        quad([0.0; 3], x, y),
        quad(z, y, x),
        quad([0.0; 3], y, z),
        quad(x, z, y),
    ]
    .concat()
}

fn agree(what: &str, a: &Mean, b: f64, b_error: f64) {
    let tolerance = normal_quantile(TAIL) * a.error().hypot(b_error) + RENDERER_ERROR * b;
    assert!(
        (a.mean() - b).abs() <= tolerance,
        "{what}: {} ± {}, expected {b} ± {b_error}",
        a.mean(),
        a.error()
    );
    // A comparison that allows everything shows nothing.
    assert!(tolerance < 0.1 * b, "{what}: {b} ± {tolerance}");
}

#[test]
fn the_weights_of_both_ways_sum_to_one() {
    let mut random = Random::new(1);
    let mut draw = || exact::pow2(random.below(205) as i32 - 100) * (1.0 + random.unit());
    for i in 0..1_000_000 {
        let a = draw();
        let b = if i % 2 == 0 {
            draw()
        } else {
            a * (0.5 + draw().fract())
        };
        let (wa, wb) = (power_heuristic(a, b), power_heuristic(b, a));
        // Three roundings of 2^-25 each: of the sum below, which both share, and of the two quotients.
        let sum = f64::from(wa) + f64::from(wb);
        assert!((sum - 1.0).abs() <= 3.0 * 2f64.powi(-25), "{a} {b}: {sum}");
        assert!((0.0..=1.0).contains(&wa));
        let expected = {
            let r = f64::from(b) / f64::from(a);
            1.0 / (1.0 + r * r)
        };
        assert!((f64::from(wa) - expected).abs() <= 2f64.powi(-22), "{a} {b}");
    }
    for x in [exact::pow2(-100), 1.0, exact::pow2(104)] {
        assert_eq!((power_heuristic(x, 0.0), power_heuristic(0.0, x)), (1.0, 0.0));
        assert_eq!(power_heuristic(x, x), 0.5);
    }
    assert_eq!(power_heuristic(0.0, 0.0), 1.0);
}

/// What is found at a sampled point of a light, and what a ray in that direction finds, have the same two densities.
#[test]
fn both_ways_tell_the_same_densities() {
    let mut random = Random::new(2);
    let mut met = 0;
    for i in 0..50_000_u32 {
        let mut vertex = |y: f32| [random.between(-1.0, 1.0), y, random.between(-1.0, 1.0)];
        let y = 0.5 + (i % 7) as f32;
        let lamp = light([vertex(y), vertex(y + 0.3), vertex(y + 0.1)], 1.0, 0, i & 1);
        let world = World::new(vec![lamp], &[], matte(0.5));
        let material = glossy(random.unit(), random.unit(), i % 12);
        let point = ShadingPoint {
            p: [random.between(-0.5, 0.5), 0.0, random.between(-0.5, 0.5)],
            n: [0.0, 1.0, 0.0],
        };
        let mut wo = random.direction();
        wo[1] = wo[1].abs();
        let wo = Vec3::from(wo);
        let pmf = exact::pow2(-(random.below(20) as i32)) * (0.5 + 0.5 * random.unit());
        let uv = [random.unit(), random.unit()];
        let connection = connect(&point, wo, &material, &lamp, pmf, uv);
        if connection.contribution.x > 0.0 {
            let d = connection.target - point.position();
            let ray = Ray::new(point.position(), d.normalize(), FAR);
            let other = encounter(&world.scene(), &ray, Vec3::ZERO);
            // At the rim of the triangle rounding may carry the ray past it.
            if other.light == 0 {
                met += 1;
                let m = Vec3::from(lamp.p[1]) - Vec3::from(lamp.p[0]);
                let m = m.cross(Vec3::from(lamp.p[2]) - Vec3::from(lamp.p[0])).normalize();
                let cosine = f64::from(m.dot(ray.direction).abs());
                let by_light = f64::from(light_density(ray.direction * other.distance, &lamp, pmf));
                let scattering = material.scatter(Vec3::Y, ray.direction, wo);
                // The ends of both rays differ by the offset off the light, 2^-18 of the coordinates, which at a cosine
                // is that much further along; the rest is rounding of a few 2^-24.
                let size = f64::from(y + 1.0) * 2f64.powi(-18);
                let tilt = (size + 2f64.powi(-21)) / f64::from(d.length()) / cosine;
                let light_error = 4.0 * tilt + 2f64.powi(-16);
                let ratio = by_light / f64::from(connection.density);
                assert!((ratio - 1.0).abs() <= light_error, "{ratio} {light_error}");
                // pmf |d|^2 / (A cos), in f64 from the triangle itself.
                let [p0, p1, p2] = lamp.p.map(|v| Vec3::from(v).as_dvec3());
                let d64 = d.as_dvec3();
                let facing = (p1 - p0).cross(p2 - p0).dot(d64.normalize()).abs() / 2.0;
                let expected = f64::from(pmf) * d64.length_squared() / facing;
                let ratio = f64::from(connection.density) / expected;
                assert!((ratio - 1.0).abs() <= light_error, "{ratio} {light_error}");
                let k = f64::from(1_u32 << material.exponent_log2);
                let half = (ray.direction + wo).normalize().dot(Vec3::Y);
                let gloss_error = 2.0 * k * tilt / f64::from(half) + 4.0 * tilt / f64::from(ray.direction.y);
                let ratio = f64::from(scattering.density) / f64::from(connection.scattering_density);
                if gloss_error < 0.1 {
                    assert!(
                        (ratio - 1.0).abs() <= 2.0 * gloss_error + 2f64.powi(-16),
                        "{ratio} {gloss_error}"
                    );
                    // A weight moves by at most half the relative error of the ratio of its densities.
                    let sum = power_heuristic(connection.density, connection.scattering_density)
                        + power_heuristic(scattering.density, by_light as f32);
                    let error = light_error + 2.0 * gloss_error + 2f64.powi(-15);
                    assert!((f64::from(sum) - 1.0).abs() <= error, "{sum} {error}");
                }
            }
        }
    }
    assert!(met > 15_000, "{met}");
}

/// Five lamps over a floor, one behind a wall; a third of them two-sided.
fn hall(material: Material) -> World {
    let mut lamps = Vec::new();
    for (i, (x, z, size, radiance)) in [
        (0.0, 0.0, 1.5, 2.0),
        (2.5, 1.0, 0.8, 5.0),
        (-2.0, 2.0, 2.0, 1.0),
        (-1.0, -3.0, 1.0, 4.0),
        (5.0, -2.0, 1.2, 6.0),
    ]
    .into_iter()
    .enumerate()
    {
        let tilt = 0.3 * i as f32;
        for p in quad([x, 2.5, z], [size, tilt, 0.0], [0.0, 0.2, size]) {
            lamps.push(light(p, radiance, i as u32, u32::from(i % 3 == 0)));
        }
    }
    let mut walls = quad([-9.0, 0.0, -9.0], [0.0, 0.0, 18.0], [18.0, 0.0, 0.0]).to_vec();
    walls.extend(quad([3.5, 0.0, -4.0], [0.0, 4.0, 0.0], [0.0, 0.0, 3.0]));
    World::new(lamps, &walls, material)
}

/// A ray to the floor of the hall from a little above.
fn to_the_floor(x: f32, z: f32) -> Ray {
    let eye = Vec3::new(x - 0.5, 0.8, z + 0.3);
    Ray::new(eye, (Vec3::new(x, 0.0, z) - eye).normalize(), FAR)
}

/// One reflection is direct lighting: by sampled lights alone (the direct renderer), by directions alone, and by both.
#[test]
fn one_bounce_is_direct_lighting() {
    // Under lamps and half behind the wall; the narrow lobe where it shows a lamp's reflection.
    let dull = [(0.5, 0.3), (-1.0, 2.5), (2.5, -1.5)];
    let mirroring = [(-0.8, 1.6), (-2.6, 4.0), (1.2, 2.2)];
    for (material, points) in [
        (matte(0.8), dull),
        (glossy(0.5, 0.3, 3), dull),
        (glossy(0.0, 1.0, 6), mirroring),
    ] {
        let world = hall(material);
        for (x, z) in points {
            let ray = to_the_floor(x, z);
            let seen = see(&world.scene(), &ray, Vec3::ZERO);
            let mut direct = Mean::default();
            let uniform = Uniform {
                count: world.lights.len() as u32,
            };
            for sample in 0..120_000 {
                let value = reflected(&world.scene(), &seen, &uniform, 1, exact::hash(sample));
                direct.add(f64::from(value.x));
            }
            for (name, mean) in world.each_picker(&ray, 1, 120_000) {
                let what = format!("{name} at {x} {z}, {material:?}");
                agree(&what, &mean, direct.mean(), direct.error());
            }
        }
    }
}

/// The same against the sum over all lights by brute force in f64.
#[test]
fn one_bounce_is_the_sum_over_all_lights() {
    let world = hall(matte(1.0));
    let walls = quad([3.5, 0.0, -4.0], [0.0, 4.0, 0.0], [0.0, 0.0, 3.0]);
    let mut random = Random::new(3);
    for (x, z) in [(0.5, 0.3), (-1.0, 2.5), (2.5, -1.5)] {
        let point = ShadingPoint {
            p: [x, 0.0, z],
            n: [0.0, 1.0, 0.0],
        };
        let reference = brute_force(&point, &world.lights, &walls, 48, &mut random);
        let pi = std::f64::consts::PI;
        for (name, mean) in world.each_picker(&to_the_floor(x, z), 1, 120_000) {
            agree(name, &mean, reference.sum / pi, reference.error / pi);
        }
    }
}

/// Sampled lights with weights, and directions alone, agree over several reflections on shiny and dull surfaces.
#[test]
fn several_bounces_agree_with_directions_alone() {
    for material in [matte(0.9), glossy(0.7, 0.4, 2)] {
        let world = hall(material);
        let ray = to_the_floor(0.5, 0.3);
        let reference = world.paths(&Nothing, &ray, 0.0, 5, 200_000);
        for (name, mean) in world.each_picker(&ray, 5, 120_000) {
            agree(name, &mean, reference.mean(), reference.error());
        }
    }
}

/// In a closed room whose walls all emit L and reflect the part a of what arrives, every point receives the same from
/// everywhere: after n reflections the sum of L a^i up to i = n.
#[test]
fn a_closed_room_has_its_geometric_sum() {
    for albedo in [0.3_f32, 0.7] {
        let lights = cube()
            .into_iter()
            .zip(0..)
            .map(|(p, i)| light(p, 0.5, i / 2, 0))
            .collect();
        let world = World::new(lights, &[], matte(albedo));
        let eye = Vec3::new(1.0, 1.5, 2.2);
        let ray = Ray::new(eye, Vec3::new(0.3, -0.8, 0.5), FAR);
        for bounces in [0, 1, 2, 5, MAX_BOUNCES, u32::MAX] {
            let a = f64::from(albedo);
            let n = bounces.min(MAX_BOUNCES) as i32;
            let expected = 0.5 * (1.0 - a.powi(n + 1)) / (1.0 - a);
            for (name, mean) in world.each_picker(&ray, bounces, 8_000) {
                agree(
                    &format!("{name}, {bounces} bounces of {albedo}"),
                    &mean,
                    expected,
                    0.0,
                );
            }
        }
    }
}

/// Under a sky of constant radiance a floor shows its albedo, and a room open on one side never more than the sky.
#[test]
fn the_sky_is_reflected_by_sampled_directions_only() {
    let floor = quad([-9.0, 0.0, -9.0], [0.0, 0.0, 18.0], [18.0, 0.0, 0.0]);
    let world = World::new(vec![], &floor, matte(0.6));
    let ray = to_the_floor(0.5, 0.3);
    for bounces in [1, 7] {
        let mean = world.paths(&Uniform { count: 0 }, &ray, 3.0, bounces, 1000);
        agree("floor", &mean, 1.8, 0.0);
    }
    let up = Ray::new(Vec3::Y, Vec3::Y, FAR);
    assert_eq!(world.paths(&Nothing, &up, 3.0, 4, 2).mean(), 3.0);

    let open = World::new(vec![], &cube()[2..], matte(1.0));
    let inside = Ray::new(Vec3::new(1.0, 3.0, 2.2), Vec3::new(0.3, 0.1, 0.5), FAR);
    let mean = open.paths(&Nothing, &inside, 3.0, MAX_BOUNCES, 20_000);
    let tolerance = normal_quantile(TAIL) * mean.error() + 3.0 * RENDERER_ERROR;
    assert!(mean.mean() <= 3.0 + tolerance, "{}", mean.mean());
    assert!(
        mean.mean() > 2.5,
        "white walls lose nothing but what bounces on: {}",
        mean.mean()
    );
}

/// Radiances at the ends of the domain, next to each other: nothing becomes infinite.
#[test]
fn extreme_radiances_stay_finite() {
    for radiance in [exact::pow2(-100), 1.0, exact::pow2(100)] {
        let lights: Vec<_> = cube()
            .into_iter()
            .zip(0..)
            .map(|(p, i)| light(p, if i % 3 == 0 { radiance } else { 1.0 }, i / 2, 1))
            .collect();
        for material in [glossy(1.0, 1.0, 0), glossy(0.9, 0.5, 16)] {
            let world = World::new(lights.clone(), &[], material);
            let ray = Ray::new(Vec3::ONE, Vec3::new(0.3, -0.8, 0.5), FAR);
            for (name, mean) in world.each_picker(&ray, MAX_BOUNCES, 500) {
                assert!(mean.mean().is_finite() && mean.mean() > 0.0, "{name}");
            }
        }
    }
}
