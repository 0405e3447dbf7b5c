//! Receivers that say more than a point, on every device: lights with masks, surfaces with two sides, pieces of rays.

use bytemuck::{Pod, bytes_of};
use lightbvh::importance::{LinkedPoint, RaySegment, SegmentSample, TransmissivePoint};
use lightbvh::light::LinkedTriangle;
use lightbvh::{
    Bvh, Edit, EmissiveTriangle, INVALID, LightBvh, LightPoint, Random64, SampledLight, ShadingPoint,
};
use lightbvh_gpu::{KernelSet, LinkedQuery, SegmentQuery, TransmissiveQuery, query_push};
use lightbvh_host::backend::Mirrored;
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::receivers::{LinkedImportance, LinkedNode, SegmentImportance, TransmissiveImportance};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::Random;
use lightbvh_tests::placing::{self, Kind};

const QUERIES: usize = 3000;

const KINDS: [Kind; 5] = [
    Kind::Rigid,
    Kind::Similar,
    Kind::Affine,
    Kind::Flat,
    Kind::Extreme,
];

fn triangle(random: &mut Random) -> EmissiveTriangle {
    let p = [0; 3].map(|_| random.between(-4.0, 4.0));
    let mut near = || {
        let by = [0; 3].map(|_| random.between(-0.5, 0.5));
        [p[0] + by[0], p[1] + by[1], p[2] + by[2]]
    };
    let (b, c) = (near(), near());
    EmissiveTriangle {
        p: [p, b, c],
        radiance: [random.between(0.1, 5.0); 3],
        mesh: 0,
        flags: random.below(2) * EmissiveTriangle::TWO_SIDED,
    }
}

fn point(random: &mut Random, k: usize) -> ShadingPoint {
    ShadingPoint {
        p: [0; 3].map(|_| random.between(-30.0, 30.0)),
        n: if k.is_multiple_of(3) {
            [0.0; 3]
        } else {
            random.direction()
        },
    }
}

fn segment(random: &mut Random, k: usize) -> RaySegment {
    let from = [0; 3].map(|_| random.between(-30.0, 30.0));
    let length = [0.0, 1e-4, 1.0, 60.0][k % 4];
    let d = random.direction();
    let to = [0, 1, 2].map(|axis: usize| from[axis] + length * d[axis]);
    RaySegment { from, to }
}

/// Answers of the device equal those of the CPU.
fn assert_equal<T: Pod>(what: &str, found: &[T], expected: &[T]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(bytes_of(found), bytes_of(expected), "{what}: query {k}");
    }
}

/// All words in use are the tree's, frame after frame.
fn assert_nodes<N: lightbvh::node::Node<8>, I>(held: &Mirrored<'_, N, 8>, bvh: &Bvh<N, I, 8>) {
    let used = bvh.plan_of_everything();
    let nodes = held.nodes().expect("a read");
    for &node in used.bottom.nodes().iter().chain(used.top.nodes()) {
        let what = format!("{}: node {node}", held.device().name());
        assert_equal(
            &what,
            &nodes[node as usize..][..1],
            &bvh.tree().nodes[node as usize..][..1],
        );
    }
}

#[test]
fn masks_leave_out_the_same_lights_on_every_device() {
    on_each_device(Options::default(), |device| {
        let random = &mut Random::new(5);
        let mut scene = Bvh::<LinkedNode, LinkedImportance, 8>::default();
        let lights = |random: &mut Random, count: usize| -> Vec<LinkedTriangle> {
            let light = |_| LinkedTriangle {
                light: triangle(random),
                mask: 1 << random.below(4),
            };
            (0..count).map(light).collect()
        };
        let counts = [1, 30, 300];
        let meshes = counts.map(|count| scene.add_mesh(lights(random, count)).expect("a mesh"));
        let add = (0..60).map(|k| Edit::AddInstance {
            mesh: meshes[k % 3],
            transform: placing::transform(random, KINDS[k % 5], 30.0),
            radiance: 1.0,
        });
        let add = add.collect();
        let ids = scene.apply(add).expect("instances").instances;
        let mut held = Mirrored::new(device, KernelSet::LINKED).expect("arrays");
        let (mut sampled_in_all, mut dark) = (0, 0);
        for frame in 0..4 {
            if frame > 0 {
                let moved = (0..10).map(|k| Edit::SetTransform {
                    instance: ids[(7 * frame + k) % 60],
                    transform: placing::transform(random, KINDS[k % 5], 30.0),
                });
                let mut edits: Vec<_> = moved.collect();
                edits.push(Edit::SetTriangles {
                    mesh: meshes[frame % 3],
                    triangles: lights(random, counts[frame % 3]),
                });
                scene.apply(edits).expect("edits");
            }
            scene.plan();
            held.follow(&scene).expect("a frame");
            scene.refit();
            assert_nodes(&held, &scene);

            let receivers: Vec<_> = (0..QUERIES)
                .map(|k| LinkedPoint {
                    point: point(random, k),
                    mask: [1, 6, 0, u32::MAX, 16][k % 5],
                })
                .collect();
            let numbers: Vec<Random64> = receivers.iter().map(|_| random.bits().into()).collect();
            let asked: Vec<_> = receivers
                .iter()
                .zip(&numbers)
                .map(|(&receiver, &number)| LinkedQuery::sample(receiver, number))
                .collect();
            let expected: Vec<_> = receivers
                .iter()
                .zip(&numbers)
                .map(|(receiver, &number)| scene.sample_for(receiver, number))
                .collect();
            let sampled: Vec<SampledLight> = ask(&held, &scene, KernelSet::LINKED.sample, &asked);
            assert_equal("sample_linked", &sampled, &expected);
            for (receiver, sample) in receivers.iter().zip(&sampled) {
                match scene.triangle(sample.light, sample.instance) {
                    Some(light) => assert_ne!(light.mask & receiver.mask, 0, "{receiver:?}"),
                    None => dark += 1,
                }
                sampled_in_all += 1;
            }

            // Some ask for a light that another one sampled, which they may have no bit of.
            let which = |k: usize| {
                let sample = sampled[if k.is_multiple_of(4) { (k + 1) % QUERIES } else { k }];
                (sample.light, sample.instance)
            };
            let asked: Vec<_> = (0..QUERIES)
                .map(|k| LinkedQuery::pmf(receivers[k], which(k).0, which(k).1))
                .collect();
            let expected: Vec<f32> = (0..QUERIES)
                .map(|k| scene.tree().pmf_for(&receivers[k], which(k).0, which(k).1))
                .collect();
            let pmfs: Vec<f32> = ask(&held, &scene, KernelSet::LINKED.pmf, &asked);
            assert_equal("pmf_linked", &pmfs, &expected);
            assert!(pmfs.contains(&0.0) && pmfs.iter().any(|&pmf| pmf > 0.0));
        }
        // Masks 0 and 16 have no light.
        assert_eq!(dark, sampled_in_all * 2 / 5);
    });
}

fn ask<T: Pod, Q: Pod, N: lightbvh::node::Node<8>, I>(
    held: &Mirrored<'_, N, 8>,
    bvh: &Bvh<N, I, 8>,
    kernel: &lightbvh_gpu::Kernel,
    queries: &[Q],
) -> Vec<T> {
    let asked = held.device().upload(queries).expect("an upload");
    let push = query_push(queries.len() as u32, &bvh.tree());
    held.ask(
        kernel,
        queries.len(),
        bytes_of(&push),
        &[("queries", asked.bind())],
    )
    .expect("the answers")
}

#[test]
fn leaves_and_fog_choose_the_same_lights_on_every_device() {
    on_each_device(Options::default(), |device| {
        let random = &mut Random::new(6);
        let mut scene = LightBvh::default();
        let meshes = [1, 30, 300].map(|count| {
            let lights = (0..count).map(|_| triangle(random)).collect();
            scene.add_mesh(lights).expect("a mesh")
        });
        let add = (0..60).map(|k| Edit::AddInstance {
            mesh: meshes[k % 3],
            transform: placing::transform(random, KINDS[k % 5], 30.0),
            radiance: 1.0,
        });
        let add = add.collect();
        scene.apply(add).expect("instances");
        let mut held = Mirrored::new(device, KernelSet::TRANSMISSIVE).expect("arrays");
        scene.plan();
        held.follow(&scene).expect("a frame");
        scene.refit();
        assert_nodes(&held, &scene);
        let numbers: Vec<Random64> = (0..QUERIES).map(|_| random.bits().into()).collect();

        let leaves: Vec<_> = (0..QUERIES)
            .map(|k| TransmissivePoint {
                point: point(random, k),
                front: [0.0, 1.0, 0.3, 0.0][k % 4],
                back: [0.0, 0.0, 0.7, 1e-5][k % 4],
            })
            .collect();
        let told = scene.by::<TransmissiveImportance>();
        let expected: Vec<_> = (0..QUERIES)
            .map(|k| told.sample_for(&leaves[k], numbers[k]))
            .collect();
        let asked: Vec<_> = (0..QUERIES)
            .map(|k| TransmissiveQuery::sample(leaves[k], numbers[k]))
            .collect();
        let set = &KernelSet::TRANSMISSIVE;
        let sampled: Vec<SampledLight> = ask(&held, &scene, set.sample, &asked);
        assert_equal("sample_transmissive", &sampled, &expected);
        let asked: Vec<_> = (0..QUERIES)
            .map(|k| TransmissiveQuery::pmf(leaves[k], sampled[k].light, sampled[k].instance))
            .collect();
        let pmfs: Vec<f32> = ask(&held, &scene, set.pmf, &asked);
        let expected: Vec<f32> = sampled.iter().map(|sample| sample.pmf).collect();
        assert_equal("pmf_transmissive", &pmfs, &expected);

        let rays: Vec<_> = (0..QUERIES).map(|k| segment(random, k)).collect();
        let told = scene.by::<SegmentImportance>();
        let expected: Vec<_> = (0..QUERIES)
            .map(|k| told.sample_for(&rays[k], numbers[k]))
            .collect();
        let asked: Vec<_> = (0..QUERIES)
            .map(|k| SegmentQuery::sample(rays[k], numbers[k]))
            .collect();
        let set = &KernelSet::SEGMENT;
        let sampled: Vec<SampledLight> = ask(&held, &scene, set.sample, &asked);
        assert_equal("sample_segment", &sampled, &expected);
        let which: Vec<_> = (0..QUERIES)
            .map(|k| SegmentQuery::pmf(rays[k], sampled[k].light, sampled[k].instance))
            .collect();
        let pmfs: Vec<f32> = ask(&held, &scene, set.pmf, &which);
        let expected: Vec<f32> = sampled.iter().map(|sample| sample.pmf).collect();
        assert_equal("pmf_segment", &pmfs, &expected);

        // A place on each ray, for light from a point on its lamp.
        let lamps: Vec<LightPoint> = sampled
            .iter()
            .filter(|sample| sample.light != INVALID)
            .filter_map(|sample| scene.triangle(sample.light, sample.instance))
            .map(|light| light.point([0.25, 0.5]))
            .collect();
        assert_eq!(lamps.len(), QUERIES);
        let parts: Vec<f32> = (0..QUERIES).map(|_| random.unit()).collect();
        let expected: Vec<SegmentSample> = (0..QUERIES)
            .map(|k| rays[k].sample(lamps[k].p.into(), parts[k]))
            .collect();
        let kernel = lightbvh_gpu::Kernel::named("segment_places").expect("a kernel");
        let [queries, points, numbers] = [
            device.upload(&asked).expect("an upload").bind(),
            device.upload(&lamps).expect("an upload").bind(),
            device.upload(&parts).expect("an upload").bind(),
        ];
        let found: Vec<SegmentSample> = held
            .ask(
                kernel,
                QUERIES,
                bytes_of(&(QUERIES as u32)),
                &[("queries", queries), ("points", points), ("parts", numbers)],
            )
            .expect("places");
        assert_equal("segment_places", &found, &expected);
        assert!(found.iter().filter(|place| place.density > 0.0).count() > QUERIES / 3);
    });
}
