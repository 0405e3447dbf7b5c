//! Light comes from the front of lights alone, and no surface shadows itself.

use glam::Vec3;
use lightbvh::light::uniform_point;
use lightbvh::{EmissiveTriangle, ShadingPoint};
use lightbvh_host::render::{View, camera, render};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::area::offset_distance;
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::pick::Uniform;
use lightbvh_kernels::shading::pixel::see;
use lightbvh_kernels::shading::ray::Ray;
use lightbvh_kernels::shading::trace::{NONE, any_hit};
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::in_cube;
use lightbvh_tests::world::{World, light, matte};

/// A lamp 2 m above the floor that shines down, and turned over, up.
fn lamp(down: bool, flags: u32) -> EmissiveTriangle {
    let [a, b, c] = [[-0.7, 2.0, -0.4], [0.8, 2.1, -0.3], [0.1, 1.8, 0.9]];
    light(if down { [a, b, c] } else { [a, c, b] }, 2.0, 0, flags)
}

fn floor(x: f32, z: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, 0.0, z],
        n: [0.0, 1.0, 0.0],
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
    let flat = light([[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [2.0, 1.0, 0.0]], 2.0, 0, 1);
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
        let connection = light.connect(point, Vec3::Y, matte(1.0), pmf, uv);
        assert_eq!(connection.contribution.to_array().map(f32::to_bits), [0; 3]);
        assert!(connection.direction.is_finite());
    }
}

#[test]
fn lights_are_seen_from_their_front_only_and_nothing_gives_the_background() {
    let params = RenderParams {
        width: 4,
        height: 4,
        samples: 1,
        first: 0,
        all: 0,
        candidates: 1,
        part: 0,
        parts: 1,
        seed: 1,
        jitter: 2,
        background: [0.5, 0.25, 0.125],
    };
    for (eye, forward, flags, expected) in [
        // From below, the lamp shows its front.
        ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0], 0, [2.0; 3]),
        ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0], 0, [0.0; 3]),
        ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0], 1, [2.0; 3]),
        ([0.0, 5.0, 0.0], [0.0, 1.0, 0.0], 1, [0.5, 0.25, 0.125]),
    ] {
        let world = World::new(vec![lamp(true, flags)], &[], matte(1.0));
        // So narrow that an image is all but one point.
        let view = View {
            eye,
            right: [1.0, 0.0, 0.0],
            up: [0.0, 0.0, 1.0],
            forward,
            yfov: 1e-4,
        };
        let camera = camera(&view, 4, 4);
        let pixels = render(&world.scene(), &camera, &params, &Uniform { count: 1 });
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
        let world = World::new(Vec::new(), &[p], matte(1.0));
        let scene = world.scene();
        let corner = world.bvh.blocks[0].get(0).unwrap().p.map(Vec3::from);
        let aim = uniform_point(
            corner[0],
            corner[1] - corner[0],
            corner[2] - corner[0],
            random.unit(),
            random.unit(),
        );
        let eye = Vec3::from(in_cube(&mut random, scale * 20.0));
        let ray = Ray::new(eye, (aim - eye).normalize(), 1e9);
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
                let ray = Ray::new(seen.point.position(), direction, 1e6);
                shadowed += u32::from(any_hit(&scene.surfaces, &ray, NONE));
            }
        }
    }
    assert_eq!(shadowed, 0);
}
