//! Means against sums known in closed form, and against each other.

use glam::Vec3;
use lightbvh::{Random64, SampledLight, ShadingPoint, exact};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::path::{MAX_BOUNCES, path_radiance};
use lightbvh_kernels::shading::pick::{PickLight, Uniform};
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_tests::statistics::{Mean, normal_quantile};
use lightbvh_tests::world::{By, Corners, RENDERER_ERROR, TAIL, World, agrees, glossy, light, matte, quad};

/// Finds no light: every light is then found by sampled directions alone.
struct Nothing;

impl PickLight for Nothing {
    fn pick(&self, _point: &ShadingPoint, _random: Random64) -> SampledLight {
        SampledLight::NONE
    }

    fn pmf(&self, _point: &ShadingPoint, _light: u32, _instance: u32) -> f32 {
        0.0
    }
}

/// The mean over `count` paths along `ray`.
fn paths<P: PickLight>(world: &World, picker: &P, ray: &Ray, sky: f32, bounces: u32, count: u32) -> Mean {
    let mut mean = Mean::default();
    for path in 0..count {
        let seed = exact::hash(path ^ bounces << 24);
        let value = path_radiance(&world.scene(), ray, Vec3::splat(sky), picker, bounces, seed);
        mean.add(f64::from(value.x));
    }
    mean
}

/// [`paths`] with each picker, and with none.
fn by_each_picker(world: &World, ray: &Ray, bounces: u32, count: u32) -> Vec<(&'static str, Mean)> {
    let mut all = Vec::new();
    let mut add = |name, picker: By<'_>| all.push((name, paths(world, &picker, ray, 0.0, bounces, count)));
    world.each_picker(&mut add);
    add("directions alone", By(&Nothing));
    all
}

fn agree(what: &str, found: &Mean, expected: f64, error: f64) {
    let tolerance = agrees(what, found, expected, error);
    // A comparison that allows everything shows nothing.
    assert!(tolerance < 0.1 * expected, "{what}: {expected} ± {tolerance}");
}

/// A cube from 0 to 4 m seen from inside: the fronts of its six sides.
fn cube() -> Vec<Corners> {
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

/// Sampled lights with weights, and directions alone, agree over several reflections on shiny and dull surfaces.
#[test]
fn several_bounces_agree_with_directions_alone() {
    for material in [matte(0.9), glossy(0.7, 0.4, 2)] {
        let world = hall(material);
        let ray = to_the_floor(0.5, 0.3);
        let reference = paths(&world, &Nothing, &ray, 0.0, 5, 200_000);
        for (name, mean) in by_each_picker(&world, &ray, 5, 120_000) {
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
            for (name, mean) in by_each_picker(&world, &ray, bounces, 8_000) {
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
        let mean = paths(&world, &Uniform { count: 0 }, &ray, 3.0, bounces, 1000);
        agree("floor", &mean, 1.8, 0.0);
    }
    let up = Ray::new(Vec3::Y, Vec3::Y, FAR);
    assert_eq!(paths(&world, &Nothing, &up, 3.0, 4, 2).mean(), 3.0);

    let open = World::new(vec![], &cube()[2..], matte(1.0));
    let inside = Ray::new(Vec3::new(1.0, 3.0, 2.2), Vec3::new(0.3, 0.1, 0.5), FAR);
    let mean = paths(&open, &Nothing, &inside, 3.0, MAX_BOUNCES, 20_000);
    let tolerance = normal_quantile(TAIL) * mean.error() + 3.0 * RENDERER_ERROR;
    assert!(mean.mean() <= 3.0 + tolerance, "{}", mean.mean());
    assert!(
        mean.mean() > 2.5,
        "white walls lose nothing but what bounces on: {}",
        mean.mean()
    );
}
