//! Points on sampled lights, on the CPU and on every device.

use lightbvh::instance::world_light;
use lightbvh::{
    BuildParams, INVALID, Instance, LightBvh, LightPoint, Lights, Random64, SampledLight, ShadingPoint,
};
use lightbvh_host::vulkan::{Device, Options, Pass};
use lightbvh_kernels::query::{PointsPush, light_point};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::edits::mesh;
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::placing::{self, Kind};

const COUNT: usize = 3000;

/// Samples of a tree, then ones that nothing is behind.
fn samples(bvh: &LightBvh, random: &mut Random) -> Vec<SampledLight> {
    let point = ShadingPoint {
        p: [1.0, 2.0, 3.0],
        n: [0.0; 3],
    };
    let mut samples: Vec<_> = (0..COUNT)
        .map(|_| bvh.sample(&point, Random64::from(random.bits())))
        .collect();
    for _ in 0..200 {
        samples.push(SampledLight {
            light: random.bits() >> random.below(32),
            instance: random.bits() >> random.below(32),
            pmf: 0.5,
        });
    }
    samples.push(SampledLight {
        light: INVALID,
        instance: INVALID,
        pmf: 0.0,
    });
    samples
}

fn on_device(
    device: &Device,
    bvh: &LightBvh,
    instances: &[Instance],
    samples: &[SampledLight],
    numbers: &[[f32; 2]],
) -> Vec<LightPoint> {
    let kernel = device.kernel("light_points").expect("a kernel");
    let triangles = device.upload(bvh.triangles()).expect("an upload");
    let instances = device.upload(instances).expect("an upload");
    let picked = device.upload(samples).expect("an upload");
    let uv = device.upload(numbers).expect("an upload");
    let output = device.output::<LightPoint>(samples.len()).expect("an output");
    let push = PointsPush {
        count: samples.len() as u32,
    };
    let mut pass = Pass::new();
    pass.dispatch(
        &kernel,
        &[
            triangles.bind(),
            instances.bind(),
            picked.bind(),
            uv.bind(),
            output.bind(),
        ],
        bytemuck::bytes_of(&push),
        push.count,
    );
    device.run(&pass).expect("a run");
    output.read().expect("the results")
}

#[test]
fn points_on_sampled_lights_agree_with_every_device() {
    let random = &mut Random::new(31);
    let mut moving = LightBvh::default();
    let meshes: Vec<_> = (0..5)
        .map(|_| moving.add_mesh(mesh(random)).expect("a mesh"))
        .collect();
    let ids: Vec<_> = (0..60)
        .map(|i| {
            let transform = placing::transform(random, Kind::ALL[i % 6], 50.0);
            moving
                .add_instance(meshes[i % 5], transform)
                .expect("an instance")
        })
        .collect();
    moving.refit();
    let lights = Lights::new(generate::small_triangles(500, 10, 20.0, 0.5, true, 5)).expect("lights");
    let single = LightBvh::single_level(&lights, &BuildParams::default());
    let numbers: Vec<[f32; 2]> = (0..COUNT + 201).map(|_| [random.unit(), random.unit()]).collect();

    for bvh in [&moving, &single] {
        let samples = samples(bvh, random);
        let instances = bvh.tree().instances;
        let expected: Vec<LightPoint> = samples
            .iter()
            .zip(&numbers)
            .map(|(sample, &uv)| light_point(bvh.triangles(), instances, sample, uv))
            .collect();
        // Trees of one level do not look at the instance.
        let names = |sample: &&SampledLight| !bvh.is_single_level() || sample.instance == INVALID;
        for sample in samples.iter().filter(names) {
            let world = world_light(bvh.triangles(), instances, sample.light, sample.instance);
            match bvh.triangle(sample.light, sample.instance) {
                Some(triangle) => assert_eq!(world, triangle),
                None => assert_eq!((world.radiance, world.mesh), ([0.0; 3], INVALID), "{sample:?}"),
            }
        }
        assert!(expected.iter().filter(|at| at.density > 0.0).count() > COUNT / 2);
        on_each_device(Options::default(), |device| {
            let found = on_device(device, bvh, instances, &samples, &numbers);
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!(
                    bytemuck::bytes_of(found),
                    bytemuck::bytes_of(expected),
                    "{i}: {:?}",
                    samples[i]
                );
            }
        });
    }
    // What moves is an instance's record, not the triangles.
    let samples = samples(&moving, random);
    let before = moving.triangles().to_vec();
    for &id in &ids {
        let transform = placing::transform(random, Kind::Similar, 50.0);
        moving.set_transform(id, transform).expect("there");
    }
    moving.refit();
    assert_eq!(moving.triangles(), before);
    on_each_device(Options::default(), |device| {
        let found = on_device(device, &moving, moving.instances(), &samples, &numbers);
        for ((found, sample), &uv) in found.iter().zip(&samples).zip(&numbers) {
            let expected = moving
                .triangle(sample.light, sample.instance)
                .map(|light| light.point(uv));
            if let Some(expected) = expected {
                assert_eq!(
                    bytemuck::bytes_of(found),
                    bytemuck::bytes_of(&expected),
                    "{sample:?}"
                );
            }
        }
    });
}
