//! Receivers and lights with masks, on every device.

use bytemuck::{Pod, bytes_of};
use lightbvh::importance::LinkedPoint;
use lightbvh::light::LinkedTriangle;
use lightbvh::{Bvh, Edit, EmissiveTriangle, Random64, SampledLight, ShadingPoint};
use lightbvh_gpu::{KernelSet, LinkedQuery, query_push};
use lightbvh_host::backend::{Mirrored, nodes_in_use};
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::receivers::{LinkedImportance, LinkedNode};
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

/// Answers of the device equal those of the CPU.
fn assert_equal<T: Pod>(what: &str, found: &[T], expected: &[T]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(bytes_of(found), bytes_of(expected), "{what}: query {k}");
    }
}

/// All words in use are the tree's, frame after frame.
fn assert_nodes<N: lightbvh::node::Node<8>, I>(held: &Mirrored<'_, N, 8>, bvh: &Bvh<N, I, 8>) {
    let nodes = held.nodes().expect("a read");
    let own = [bvh.nodes(), bvh.top_nodes()].concat();
    for node in nodes_in_use(bvh) {
        let what = format!("{}: node {node}", held.device().name());
        assert_equal(&what, &nodes[node as usize..][..1], &own[node as usize..][..1]);
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
            scene.refit();
            held.follow(&scene).expect("a frame");
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
                .map(|(receiver, &number)| scene.sample(receiver, number))
                .collect();
            let sampled: Vec<SampledLight> = ask(&held, KernelSet::LINKED.sample, &asked);
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
                .map(|k| scene.tree().pmf(&receivers[k], which(k).0, which(k).1))
                .collect();
            let pmfs: Vec<f32> = ask(&held, KernelSet::LINKED.pmf, &asked);
            assert_equal("pmf_linked", &pmfs, &expected);
            assert!(pmfs.contains(&0.0) && pmfs.iter().any(|&pmf| pmf > 0.0));
        }
        // Masks 0 and 16 have no light.
        assert_eq!(dark, sampled_in_all * 2 / 5);
    });
}

fn ask<T: Pod, Q: Pod, N: lightbvh::node::Node<8>>(
    held: &Mirrored<'_, N, 8>,
    kernel: &lightbvh_gpu::Kernel,
    queries: &[Q],
) -> Vec<T> {
    let asked = held.device().upload(queries).expect("an upload");
    let push = query_push(queries.len() as u32, held.words());
    held.ask(
        kernel,
        queries.len(),
        bytes_of(&push),
        &[("queries", asked.bind())],
    )
    .expect("the answers")
}
