//! Lights in one plane with other surfaces: directions that a surface reflects into meet what else lies there, shadow rays do not.

use glam::Vec3;
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, ShadingPoint, exact};
use lightbvh_host::render::RayBvh;
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pixel::{Samples, Scene, Seen, reflected};
use lightbvh_kernels::shading::skin::Spot;
use lightbvh_kernels::shading::sky::NoSky;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::statistics::{Mean, normal_quantile};

const SAMPLES: u32 = 30_000;
/// Chance that a right estimate fails one comparison.
const TAIL: f64 = 1e-6;

type Corners = [[f32; 3]; 3];

/// 4 m up, seen from below.
const LAMP: Corners = [[-1.0, 4.0, -1.0], [1.5, 4.0, -1.0], [-1.0, 4.0, 1.5]];
const CEILING: Corners = [[-9.0, 4.0, -9.0], [30.0, 4.0, -9.0], [-9.0, 4.0, 30.0]];

fn turned([a, b, c]: Corners) -> Corners {
    [a, c, b]
}

fn raised(p: Corners, by: f32) -> Corners {
    p.map(|[x, y, z]| [x, y + by, z])
}

/// Means with `scattered` directions against those without, at a rough and at a glossy floor.
fn agree(what: &str, lamps: &[Corners], dark: &[Corners]) {
    let lamp = |&p: &Corners| EmissiveTriangle {
        p,
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    let lights = Lights::new(lamps.iter().map(lamp).collect()).expect("within the domain");
    let surface = |p: Corners, light: u32| SurfaceTriangle {
        p,
        material: 0,
        light,
        instance: if light == NONE { NONE } else { 0 },
    };
    let dark = dark.iter().map(|&p| surface(p, NONE));
    let bright = lamps.iter().zip(0..).map(|(&p, light)| surface(p, light));
    let surfaces: Vec<SurfaceTriangle> = dark.chain(bright).collect();
    let bvh = RayBvh::build(&surfaces).expect("a ray BVH");
    let tree = LightBvh::single_level(&lights, &BuildParams::default());
    for (exponent_log2, specular) in [(0, 0.0), (5, 0.8)] {
        let scene = Scene {
            sky: NoSky,
            surfaces: bvh.surfaces(),
            materials: &[Material {
                albedo: [0.5; 3],
                specular,
                exponent_log2,
            }],
            emitters: Emitters {
                triangles: lights.triangles(),
                instances: &listed(lights.triangles().len() as u32),
            },
        };
        let seen = Seen {
            point: ShadingPoint {
                p: [0.25, 0.0, 0.5],
                n: [0.0, 1.0, 0.0],
            },
            wo: Vec3::new(0.1, 1.0, 0.2).normalize(),
            material: 0,
            direct: Vec3::ZERO,
            spot: Spot {
                triangle: NONE,
                at: [0.0; 2],
            },
            tint: Vec3::ONE,
        };
        let mean_of = |candidates: u32, scattered: u32| {
            let mut mean = Mean::default();
            for sample in 0..SAMPLES {
                let samples = Samples {
                    candidates,
                    scattered,
                    ..Samples::of(1)
                };
                let value = reflected(&scene, &seen, &tree.tree(), samples, exact::hash(sample));
                mean.add(f64::from(value.x));
            }
            mean
        };
        let plain = mean_of(1, 0);
        assert!(plain.mean() > 0.0, "{what}");
        for (candidates, scattered) in [(1, 1), (1, 4), (4, 2)] {
            let with = mean_of(candidates, scattered);
            let tolerance = normal_quantile(TAIL) * plain.error().hypot(with.error()) + 1e-3 * plain.mean();
            assert!(
                (with.mean() - plain.mean()).abs() <= tolerance,
                "{what}, 2^{exponent_log2}, {candidates} and {scattered}: {} ± {}, expected {} ± {}",
                with.mean(),
                with.error(),
                plain.mean(),
                plain.error()
            );
        }
    }
}

#[test]
fn a_panel_flush_with_a_ceiling() {
    agree("flush", &[LAMP], &[CEILING]);
    agree("just above", &[raised(LAMP, 2e-6)], &[CEILING]);
}

#[test]
fn lamps_back_to_back() {
    agree("front first", &[LAMP, turned(LAMP)], &[]);
    agree("back first", &[turned(LAMP), LAMP], &[]);
}

#[test]
fn a_lamp_twice() {
    agree("twice", &[LAMP, LAMP], &[]);
}

/// What is far enough before the light hides it from both.
#[test]
fn a_panel_behind_a_ceiling_is_dark() {
    let half: Corners = [[-9.0, 3.9, -9.0], [0.3, 3.9, -9.0], [0.3, 3.9, 30.0]];
    agree("half hidden", &[LAMP], &[half]);
}
