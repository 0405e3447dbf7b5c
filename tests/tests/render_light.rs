//! Light: estimates against closed forms, shadows only where something is between.

use glam::{DVec3, Vec3};
use lightbvh::light::uniform_point;
use lightbvh::{EmissiveTriangle, Instance, ShadingPoint};
use lightbvh_host::render::{RayBvh, View, camera, render};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::area::{connect, offset_distance};
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::Uniform;
use lightbvh_kernels::shading::pixel::{Samples, Scene, reflected, see};
use lightbvh_kernels::shading::sky::NoSky;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::in_cube;

const WHITE: Material = Material {
    albedo: [1.0; 3],
    specular: 0.0,
    exponent_log2: 0,
};
const RADIANCE: [f32; 3] = [3.0, 2.0, 1.0];

fn light(p: [[f32; 3]; 3], flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: RADIANCE,
        mesh: 0,
        flags,
    }
}

/// A lamp 2 m above the floor that shines down, and turned over, up.
fn lamp(down: bool, flags: u32) -> EmissiveTriangle {
    let [a, b, c] = [[-0.7, 2.0, -0.4], [0.8, 2.1, -0.3], [0.1, 1.8, 0.9]];
    light(if down { [a, b, c] } else { [a, c, b] }, flags)
}

/// Irradiance at `p` with normal `n` for radiance 1 from a triangle wholly above the horizon: half the sum over the
/// edges of the angle each subtends times the cosine between `n` and the normal of its plane with `p` (J. H. Lambert,
/// Photometria, 1760).
fn lambert(p: Vec3, n: Vec3, triangle: &[[f32; 3]; 3]) -> f64 {
    let (p, n) = (p.as_dvec3(), n.as_dvec3());
    let to: Vec<DVec3> = triangle
        .iter()
        .map(|&v| (Vec3::from(v).as_dvec3() - p).normalize())
        .collect();
    let edge = |i: usize| {
        let (a, b) = (to[i], to[(i + 1) % 3]);
        a.dot(b).acos() * n.dot(a.cross(b).normalize())
    };
    (0.5 * (edge(0) + edge(1) + edge(2))).abs()
}

/// The mean of `f` over a regular grid of `side` x `side` midpoints.
fn quadrature(side: u32, mut f: impl FnMut([f32; 2]) -> Vec3) -> DVec3 {
    let at = |i: u32| (i as f32 + 0.5) / side as f32;
    let mut sum = DVec3::ZERO;
    for i in 0..side {
        for j in 0..side {
            sum += f([at(i), at(j)]).as_dvec3();
        }
    }
    sum / f64::from(side * side)
}

fn floor(x: f32, z: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, 0.0, z],
        n: [0.0, 1.0, 0.0],
    }
}

#[test]
fn area_samples_are_uniform_over_the_triangle() {
    let (p0, e1, e2) = (
        Vec3::new(1.0, 2.0, 3.0),
        Vec3::new(2.0, 0.5, 0.0),
        Vec3::new(-1.0, 1.0, 4.0),
    );
    let mean = quadrature(512, |[u, v]| uniform_point(p0, e1, e2, u, v));
    let centroid = (p0 + (e1 + e2) / 3.0).as_dvec3();
    assert!((mean - centroid).length() < 2e-3, "{mean} {centroid}");
    // All inside; and the part near the first vertex (a + b < 1/2) has a quarter of the area and so of the samples.
    let mut near = 0;
    quadrature(512, |[u, v]| {
        let q = uniform_point(Vec3::ZERO, Vec3::X, Vec3::Y, u, v);
        assert!(q.x >= 0.0 && q.y >= 0.0 && q.x + q.y <= 1.0);
        near += u32::from(q.x + q.y < 0.5);
        q
    });
    assert!((f64::from(near) / f64::from(512 * 512) - 0.25).abs() < 2e-3);
}

#[test]
fn the_estimate_of_one_light_is_lambert_s() {
    for (x, z) in [(0.0, 0.0), (1.5, -0.7), (-4.0, 3.0)] {
        let point = floor(x, z);
        for (lamp, sees) in [(lamp(true, 0), 1.0), (lamp(false, 0), 0.0), (lamp(false, 1), 1.0)] {
            let mean = quadrature(256, |uv| {
                connect(&point, Vec3::Y, &WHITE, &lamp, 0.25, uv).contribution
            });
            let irradiance = lambert(point.position(), point.normal(), &lamp.p);
            for (mean, radiance) in mean.to_array().into_iter().zip(RADIANCE) {
                let expected = sees * irradiance * f64::from(radiance) / std::f64::consts::PI / 0.25;
                assert!((mean - expected).abs() <= 2e-4 * expected, "{mean} {expected}");
            }
        }
    }
}

#[test]
fn no_light_comes_from_behind_below_or_nowhere() {
    let below = ShadingPoint {
        p: [0.0, 5.0, 0.0],
        n: [0.0, 1.0, 0.0],
    };
    let volume = ShadingPoint {
        p: [0.0; 3],
        n: [0.0; 3],
    };
    let flat = light([[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [2.0, 1.0, 0.0]], 1);
    let on_it = ShadingPoint {
        p: [-0.7, 2.0, -0.4],
        n: [0.0, 1.0, 0.0],
    };
    for (point, light, pmf, uv) in [
        (below, lamp(true, 1), 1.0, [0.3, 0.3]),
        (volume, lamp(true, 0), 1.0, [0.3, 0.3]),
        (floor(0.0, 0.0), flat, 1.0, [0.3, 0.3]),
        (floor(0.0, 0.0), lamp(true, 0), 0.0, [0.3, 0.3]),
        (on_it, lamp(true, 1), 1.0, [0.0, 0.0]),
    ] {
        let connection = connect(&point, Vec3::Y, &WHITE, &light, pmf, uv);
        assert_eq!(connection.contribution.to_array().map(f32::to_bits), [0; 3]);
        assert!(connection.target.is_finite());
    }
}

struct Room {
    bvh: RayBvh,
    lights: Vec<EmissiveTriangle>,
    instances: [Instance; 1],
}

impl Room {
    /// A floor under lights, and a wall if asked for, between the floor's middle and the first light.
    fn new(lights: Vec<EmissiveTriangle>, wall: bool) -> Self {
        let mut triangles = vec![
            [[-9.0, 0.0, -9.0], [-9.0, 0.0, 9.0], [9.0, 0.0, 9.0]],
            [[-9.0, 0.0, -9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0]],
        ];
        if wall {
            triangles.push([[-9.0, 1.0, -9.0], [-9.0, 1.0, 9.0], [9.0, 1.0, 9.0]]);
            triangles.push([[-9.0, 1.0, -9.0], [9.0, 1.0, 9.0], [9.0, 1.0, -9.0]]);
        }
        let mut surfaces: Vec<_> = triangles
            .into_iter()
            .map(|p| SurfaceTriangle {
                p,
                material: 0,
                light: NONE,
                instance: NONE,
            })
            .collect();
        surfaces.extend(lights.iter().zip(0..).map(|(l, light)| SurfaceTriangle {
            p: l.p,
            material: 0,
            light,
            instance: 0,
        }));
        Self {
            bvh: RayBvh::build(&surfaces).unwrap(),
            instances: listed(lights.len() as u32),
            lights,
        }
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            sky: NoSky,
            surfaces: self.bvh.surfaces(),
            materials: &[WHITE],
            emitters: Emitters {
                triangles: &self.lights,
                instances: &self.instances,
            },
        }
    }
}

/// Looks along `forward` from `eye` through a field of view so narrow that an image is all but one point.
fn narrow(eye: [f32; 3], forward: [f32; 3]) -> View {
    View {
        eye,
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, 1.0],
        forward,
        yfov: 1e-4,
    }
}

fn params(samples: u32) -> RenderParams {
    RenderParams {
        width: 4,
        height: 4,
        samples,
        first: 0,
        all: 0,
        candidates: 1,
        scattered: 0,
        part: 0,
        parts: 1,
        seed: 1,
        jitter: 2,
        background: [0.5, 0.25, 0.125],
    }
}

/// The mean over the image of a renderer's pixels.
fn mean(pixels: &[[f32; 3]]) -> DVec3 {
    pixels.iter().map(|&p| Vec3::from(p).as_dvec3()).sum::<DVec3>() / pixels.len() as f64
}

#[test]
fn walls_shadow_and_lights_do_not_shadow_themselves() {
    let down = narrow([0.0, 0.5, 0.0], [0.0, -1.0, 0.0]);
    let camera = camera(&down, 4, 4);
    let dark = Room::new(vec![lamp(true, 0)], true);
    let pixels = render(&dark.scene(), &camera, &params(64), &Uniform { count: 1 });
    assert_eq!(mean(&pixels), DVec3::ZERO);

    // A lamp of two triangles that share an edge: no sample may be lost on the neighbour, nor anything gained from it.
    let quad = [
        [-1.0, 2.0, -1.0],
        [1.0, 2.0, -1.0],
        [1.0, 2.0, 1.0],
        [-1.0, 2.0, 1.0],
    ];
    let halves = vec![
        light([quad[0], quad[1], quad[2]], 0),
        light([quad[0], quad[2], quad[3]], 0),
    ];
    let room = Room::new(halves.clone(), false);
    let lit = render(&room.scene(), &camera, &params(4096), &Uniform { count: 2 });
    let nothing = RayBvh::default();
    let alone = Scene {
        sky: NoSky,
        surfaces: nothing.surfaces(),
        ..room.scene()
    };
    let seen = see(&room.scene(), &camera.ray([1, 1], [4, 4], 0, 0), Vec3::ZERO);
    let unshadowed = reflected(&alone, &seen, &Uniform { count: 2 }, Samples::of(1 << 16), 9);
    assert!(
        (mean(&lit).x / f64::from(unshadowed.x) - 1.0).abs() < 1e-2,
        "{} {}",
        mean(&lit),
        unshadowed
    );
}

#[test]
fn lights_are_seen_from_their_front_only_and_nothing_gives_the_background() {
    let params = params(1);
    for (eye, forward, flags, expected) in [
        // From below, the lamp shows its front.
        ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0], 0, [3.0, 2.0, 1.0]),
        ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0], 0, [0.0; 3]),
        ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0], 1, [3.0, 2.0, 1.0]),
        ([0.0, 5.0, 0.0], [0.0, 1.0, 0.0], 1, [0.5, 0.25, 0.125]),
    ] {
        let room = Room::new(vec![lamp(true, flags)], false);
        let pixels = render(
            &room.scene(),
            &camera(&narrow(eye, forward), 4, 4),
            &params,
            &Uniform { count: 1 },
        );
        assert!(pixels.iter().all(|&p| p == expected), "{pixels:?} {expected:?}");
    }
}

/// Whatever the scale and the angle, a point seen on a surface sees everything on its own side of it.
#[test]
fn surfaces_do_not_shadow_themselves() {
    let mut random = Random::new(5);
    let mut shadowed = 0;
    for i in 0..20_000 {
        let scale = 2f32.powi(i % 30 - 15);
        let center = in_cube(&mut random, scale * 10.0);
        let p = [0; 3].map(|_| {
            let offset = in_cube(&mut random, scale);
            [0, 1, 2].map(|k| center[k] + offset[k])
        });
        let bvh = RayBvh::build(&[SurfaceTriangle {
            p,
            material: 0,
            light: NONE,
            instance: NONE,
        }])
        .unwrap();
        let scene: Scene<'_> = Scene {
            sky: NoSky,
            surfaces: bvh.surfaces(),
            materials: &[WHITE],
            emitters: Emitters {
                triangles: &[],
                instances: &[],
            },
        };
        let corner = bvh.blocks[0].get(0).unwrap().p.map(Vec3::from);
        let aim = uniform_point(
            corner[0],
            corner[1] - corner[0],
            corner[2] - corner[0],
            random.unit(),
            random.unit(),
        );
        let eye = Vec3::from(in_cube(&mut random, scale * 20.0));
        let ray = lightbvh_kernels::shading::ray::Ray::new(eye, (aim - eye).normalize(), 1e9);
        let seen = see(&scene, &ray, Vec3::ZERO);
        let n = seen.point.normal();
        if n.length_squared() > 0.0 {
            assert!((n.length() - 1.0).abs() < 1e-6 && n.dot(seen.wo) >= 0.0);
            let off = n.dot(seen.point.position() - corner[0]);
            let expected = offset_distance(corner[0], corner[1], corner[2]);
            assert!(off > 0.4 * expected && off < 1.6 * expected, "{off} {expected}");
            for _ in 0..10 {
                // Directions down to a grazing angle of a thousandth.
                let tangent = Vec3::from(in_cube(&mut random, 1.0)).cross(n).normalize();
                let direction = tangent + n * (random.unit() + 1e-3);
                let ray = lightbvh_kernels::shading::ray::Ray::new(seen.point.position(), direction, 1e6);
                shadowed += u32::from(lightbvh_kernels::shading::trace::any_hit(
                    &scene.surfaces,
                    &ray,
                    NONE,
                ));
            }
        }
    }
    assert_eq!(shadowed, 0);
}
