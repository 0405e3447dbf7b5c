//! Lights read through their instances are the lights that stand in the world: images of both are equal to the bit.

use lightbvh::{Edit, EmissiveTriangle, INVALID, InstanceId, LightBvh, Transform};
use lightbvh_host::render::{View, camera, render, render_path};
use lightbvh_host::workload::render_params;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::emitters::Emitters;
use lightbvh_kernels::shading::pixel::Scene;
use lightbvh_tests::generate::small_triangles;
use lightbvh_tests::world::{World, glossy, quad};

const SIZE: (u32, u32) = (32, 18);
const BACKGROUND: [f32; 3] = [0.1, 0.2, 0.3];

/// `count` lights of a mesh, of bright ones.
fn lights(count: u32) -> Vec<EmissiveTriangle> {
    let mut triangles = small_triangles(count, count, 1.0, 0.4, false, count);
    for triangle in &mut triangles {
        triangle.radiance = triangle.radiance.map(|channel| 20.0 * channel);
        triangle.flags = triangle.p[0][0].to_bits() & 1;
    }
    triangles
}

/// Two meshes of small lights, six instances each: turned, mirrored, sheared, one dimmed, one turned off.
fn world() -> (LightBvh, Vec<InstanceId>) {
    let mut bvh = LightBvh::default();
    let meshes = [5, 9].map(|count| bvh.add_mesh(lights(count)).expect("within the domain"));
    let add = (0..12_u32).map(|k| {
        let side = if k % 3 == 1 { -1.0 } else { 1.0 };
        let (sin, cos) = (0.7 * k as f32).sin_cos();
        Edit::AddInstance {
            mesh: meshes[k as usize % 2],
            transform: Transform {
                columns: [
                    [side * cos, 0.0, sin],
                    [0.1 * k as f32, 1.0, 0.0],
                    [-side * sin, 0.0, cos * 1.5],
                ],
                translation: [3.0 * (k % 4) as f32 - 4.5, 2.5, -2.0 * (k / 4) as f32],
            },
            radiance: match k {
                3 => [0.25, 0.5, 0.25],
                7 => [0.0; 3],
                _ => [1.0; 3],
            },
            mask: u32::MAX,
        }
    });
    let ids = bvh.apply(add.collect()).expect("affine maps").instances;
    bvh.refit();
    (bvh, ids)
}

#[test]
fn images_by_instances_are_those_by_lights_in_the_world() {
    let (bvh, _) = world();
    // A floor under the lights, which can be seen too.
    let floor = quad([-9.0, 0.0, 6.0], [18.0, 0.0, 0.0], [0.0, 0.0, -15.0]);
    let world = World::new(bvh.view().world_lights(), &floor, glossy(0.6, 0.2, 4));
    let view = View {
        eye: [0.0, 3.0, 9.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.995, -0.1],
        forward: [0.0, -0.1, -0.995],
        yfov: 1.0,
    };
    let camera = camera(&view, SIZE.0, SIZE.1);
    let params = RenderParams {
        candidates: 3,
        ..render_params(SIZE, 4, 11, BACKGROUND)
    };
    let own = Emitters {
        lights: bvh.view().lights(),
        instances: bvh.tree().instances,
    };
    assert!(own.lights.len() * 4 < world.lights.len(), "meshes are shared");
    let (listed, through) = (
        world.scene(),
        Scene {
            emitters: own,
            ..world.scene()
        },
    );
    let direct = render(&through, &camera, &params, &bvh.tree());
    assert_eq!(direct, render(&listed, &camera, &params, &bvh.tree()));
    let paths = render_path(&through, &camera, &params, 3, &bvh.tree());
    assert_eq!(paths, render_path(&listed, &camera, &params, 3, &bvh.tree()));
    let lit = |image: &[[f32; 3]]| image.iter().filter(|p| p[0] > 0.0 && **p != BACKGROUND).count();
    assert!(
        lit(&direct) > 100 && lit(&paths) > 100,
        "a dark image shows nothing"
    );
    // Every light's radiance as a camera sees it, and nothing where there is no such light.
    for (light, triangle) in (0..).zip(&world.lights) {
        let word = |t: EmissiveTriangle| (t.p, t.radiance, t.flags);
        assert_eq!(word(own.light(light, triangle.mesh)), word(*triangle), "{light}");
        let other = (triangle.mesh + 1) % 12;
        assert_eq!(own.light(light, other).radiance, [0.0; 3], "{light}");
    }
}

/// Two instances are told apart; one is meant by any name.
#[test]
fn one_instance_is_meant_by_any_name() {
    let (bvh, ids) = world();
    let all = bvh.tree().instances;
    let light_of = |k: usize| bvh.view().lights_of(ids[k]).expect("there").start;
    for count in [1, 2, 3] {
        let emitters = Emitters {
            lights: bvh.view().lights(),
            instances: &all[..count],
        };
        for instance in (0..4).chain((count == 1).then_some(INVALID)) {
            for (k, id) in ids.iter().enumerate().take(3) {
                let own = id.index();
                let found = emitters.light(light_of(k), instance);
                let expected = bvh.view().light(light_of(k), own).expect("a light");
                let is_meant = (own as usize) < count && (instance == own || count == 1);
                let radiance = if is_meant { expected.radiance } else { [0.0; 3] };
                assert_eq!(
                    found.radiance, radiance,
                    "light of {own}, named {instance}, of {count}"
                );
            }
        }
    }
}
