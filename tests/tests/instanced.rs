//! Lights read through their instances are the lights that stand in the world: images of both are equal to the bit, on devices too.

use lightbvh::{Edit, EmissiveTriangle, INVALID, InstanceId, LightBvh, Lights, MeshId, Transform};
use lightbvh_host::backend::{Backend, CpuBackend, DeviceBackend, Follow, Integrator, Sampler, SceneArrays};
use lightbvh_host::render::{RayBvh, View, camera, render, render_path};
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::emitters::Emitters;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::small_triangles;

const SIZE: (u32, u32) = (32, 18);
const PARAMS: RenderParams = RenderParams {
    width: SIZE.0,
    height: SIZE.1,
    samples: 4,
    first: 0,
    all: 0,
    candidates: 3,
    scattered: 0,
    part: 0,
    parts: 1,
    seed: 11,
    jitter: 2,
    background: [0.1, 0.2, 0.3],
};

/// Two meshes of small lights, and where they stand at `time`: turned, mirrored, sheared, dimmed, one turned off.
fn edits(ids: &[InstanceId], time: f32) -> Vec<Edit> {
    (0..)
        .zip(ids)
        .map(|(k, &instance)| {
            let side = if k % 3 == 1 { -1.0 } else { 1.0 };
            let (sin, cos) = (0.7 * k as f32 + 0.2 * time).sin_cos();
            Edit::SetTransform {
                instance,
                transform: Transform {
                    columns: [
                        [side * cos, 0.0, sin],
                        [0.1 * k as f32, 1.0, 0.0],
                        [-side * sin, 0.0, cos * 1.5],
                    ],
                    translation: [
                        3.0 * (k % 4) as f32 - 4.5,
                        2.5 + 0.1 * time,
                        -2.0 * (k / 4) as f32,
                    ],
                },
            }
        })
        .collect()
}

/// `count` lights of a mesh, of bright ones.
fn lights(count: u32) -> Vec<EmissiveTriangle> {
    let mut triangles = small_triangles(count, count, 1.0, 0.4, false, count);
    for triangle in &mut triangles {
        triangle.radiance = triangle.radiance.map(|channel| 20.0 * channel);
        triangle.flags = triangle.p[0][0].to_bits() & 1;
    }
    triangles
}

fn world() -> (LightBvh, [MeshId; 2], Vec<InstanceId>) {
    let mut bvh = LightBvh::default();
    let meshes = [5, 9].map(|count| bvh.add_mesh(lights(count)).expect("within the domain"));
    let ids: Vec<_> = (0..12_usize)
        .map(|k| {
            bvh.add_instance(meshes[k % 2], Transform::IDENTITY)
                .expect("a place")
        })
        .collect();
    bvh.apply(edits(&ids, 0.0)).expect("affine maps");
    let radiance = |k: usize, radiance| Edit::SetRadiance {
        instance: ids[k],
        radiance,
    };
    bvh.apply(vec![radiance(3, 0.25), radiance(7, 0.0)])
        .expect("factors");
    bvh.refit();
    (bvh, meshes, ids)
}

/// A floor under the lights of `bvh`, which can be seen too.
fn arrays(bvh: &LightBvh) -> SceneArrays {
    let lights = bvh.world_lights();
    let quad = [
        [[-9.0, 0.0, 6.0], [9.0, 0.0, 6.0], [9.0, 0.0, -9.0]],
        [[-9.0, 0.0, 6.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]],
    ];
    let mut surfaces: Vec<_> = quad
        .map(|p| SurfaceTriangle {
            p,
            material: 0,
            light: NONE,
            instance: NONE,
        })
        .into();
    surfaces.extend((0..).zip(&lights).map(|(light, triangle)| SurfaceTriangle {
        p: triangle.p,
        material: 0,
        light,
        instance: triangle.mesh,
    }));
    let view = View {
        eye: [0.0, 3.0, 9.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.995, -0.1],
        forward: [0.0, -0.1, -0.995],
        yfov: 1.0,
    };
    let material = Material {
        albedo: [0.7, 0.6, 0.5],
        specular: 0.2,
        exponent_log2: 4,
    };
    SceneArrays::new(
        RayBvh::build(&surfaces).expect("within the grid"),
        vec![material],
        Lights::new(lights).expect("within the domain"),
        camera(&view, SIZE.0, SIZE.1),
    )
}

#[test]
fn images_by_instances_are_those_by_lights_in_the_world() {
    let (bvh, ..) = world();
    let arrays = arrays(&bvh);
    let own = Emitters {
        triangles: bvh.triangles(),
        instances: bvh.tree().instances,
    };
    assert!(
        own.triangles.len() * 4 < arrays.lights.triangles().len(),
        "meshes are shared"
    );
    let (listed, through) = (arrays.view(), arrays.lit_by(own));
    let direct = render(&through, &arrays.camera, &PARAMS, &bvh.tree());
    assert_eq!(direct, render(&listed, &arrays.camera, &PARAMS, &bvh.tree()));
    let paths = render_path(&through, &arrays.camera, &PARAMS, 3, &bvh.tree());
    assert_eq!(
        paths,
        render_path(&listed, &arrays.camera, &PARAMS, 3, &bvh.tree())
    );
    let lit = |image: &[[f32; 3]]| {
        image
            .iter()
            .filter(|p| p[0] > 0.0 && **p != PARAMS.background)
            .count()
    };
    assert!(
        lit(&direct) > 100 && lit(&paths) > 100,
        "a dark image shows nothing"
    );
    // Every light's radiance as a camera sees it, and nothing where there is no such light.
    for (light, triangle) in (0..).zip(arrays.lights.triangles()) {
        let word = |t: EmissiveTriangle| (t.p, t.radiance, t.flags);
        assert_eq!(word(own.light(light, triangle.mesh)), word(*triangle), "{light}");
        let other = (triangle.mesh + 1) % 12;
        assert_eq!(own.light(light, other).radiance, [0.0; 3], "{light}");
    }
}

/// Frames of a moving world, followed by a device that keeps its lights: a frame copies the instances that moved.
#[test]
fn devices_render_lights_that_moved() {
    on_each_device(Options::default(), |device| {
        let (mut bvh, meshes, mut ids) = world();
        let mut cpu = CpuBackend::<Standard, 8>::new(bvh.clone());
        let mut other = DeviceBackend::<Standard, 8>::new(device, &bvh).expect("an upload");
        for number in 0..5_u32 {
            if number > 0 {
                // Only the later half moves; a mesh changes its shape in the last frame.
                let mut moved = edits(&ids, number as f32);
                moved.drain(..6);
                bvh.apply(moved).expect("affine maps");
                // All arrays grow, and no light changes its number.
                if number == 2 {
                    let place = Transform::at([2.0, 2.0, 1.0]);
                    ids.push(bvh.add_instance(meshes[1], place).expect("a place"));
                }
                if number == 4 {
                    let (mesh, mut triangles) = (meshes[0], lights(5));
                    triangles[2].p[1][1] += 0.3;
                    bvh.apply(vec![Edit::SetTriangles { mesh, triangles }])
                        .expect("as many triangles");
                }
                bvh.refit();
                other.follow(&bvh).expect("copies and a refit");
                cpu.follow(&bvh).expect("a copy");
            }
            let scene = arrays(&bvh);
            for integrator in [Integrator::Direct, Integrator::Path { bounces: 2 }] {
                let image = |backend: &mut dyn Backend| {
                    let image = backend.render(&scene, &PARAMS, Sampler::TwoLevel, integrator);
                    image.expect("an image").value
                };
                let expected = image(&mut cpu);
                let what = format!("{} {integrator:?} frame {number}", device.name());
                assert!(expected == image(&mut other), "{what}");
                let lit = expected.iter().filter(|p| p[0] > 0.0 && **p != PARAMS.background);
                assert!(lit.count() > 100, "{what}: nothing is lit");
            }
        }
    });
}

/// Two instances are told apart; one is meant by any name.
#[test]
fn one_instance_is_meant_by_any_name() {
    let (bvh, _, ids) = world();
    let all = bvh.tree().instances;
    let light_of = |k: usize| bvh.lights_of(ids[k]).expect("there").start;
    for count in [1, 2, 3] {
        let emitters = Emitters {
            triangles: bvh.triangles(),
            instances: &all[..count],
        };
        for instance in (0..4).chain((count == 1).then_some(INVALID)) {
            for (k, id) in ids.iter().enumerate().take(3) {
                let own = id.index();
                let found = emitters.light(light_of(k), instance);
                let expected = bvh.triangle(light_of(k), own).expect("a light");
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
