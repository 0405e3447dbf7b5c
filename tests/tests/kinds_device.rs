//! Lights of every kind in one tree, on every device: refits, samples, pmfs and points on lights.

use bytemuck::bytes_of;
use lightbvh::importance::DefaultImportance;
use lightbvh::light::{
    AnyLight, BoxLight, DiscLight, PointLight, ProfileLight, RectangleLight, SphereLight, SpotLight,
};
use lightbvh::{Bvh, Edit, EmissiveTriangle, LightPoint, Random64, SampledLight, ShadingPoint};
use lightbvh_gpu::{KernelSet, query_push};
use lightbvh_host::backend::{Mirrored, nodes_in_use};
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::bvh::AnyNode;
use lightbvh_kernels::kinds::light_point_for;
use lightbvh_kernels::query::{PointsPush, Query};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::{Random, across};
use lightbvh_tests::placing::{self, Kind};

type Scene = Bvh<AnyNode, DefaultImportance, 8>;

const QUERIES: usize = 2000;

/// A light of kind `number % 8`, somewhere within `reach` of its mesh's origin.
fn light(random: &mut Random, number: usize, reach: f32) -> AnyLight {
    let mut vector = |reach: f32| [0; 3].map(|_| random.between(-reach, reach));
    let (p, shine, mesh) = (vector(reach), vector(2.0).map(|x| x.abs() + 0.1), 0);
    let (a, b, c) = (vector(0.5), vector(0.5), vector(0.5));
    let axis = random.direction();
    let flags = random.below(2) * EmissiveTriangle::TWO_SIDED;
    match number % 8 {
        0 => EmissiveTriangle {
            p: [
                p,
                [p[0] + a[0], p[1] + a[1], p[2] + a[2]],
                [p[0] + b[0], p[1] + b[1], p[2] + b[2]],
            ],
            radiance: shine,
            mesh,
            flags,
        }
        .into(),
        1 => PointLight {
            p,
            intensity: shine,
            // Every other one.
            range: if number & 8 == 0 {
                0.0
            } else {
                0.5 * reach + a[0].abs()
            },
            mesh,
        }
        .into(),
        2 => SpotLight {
            p,
            intensity: shine,
            range: if number & 8 == 0 {
                0.0
            } else {
                0.5 * reach + a[0].abs()
            },
            axis,
            cos_inner: 0.9,
            cos_outer: 0.5,
            mesh,
        }
        .into(),
        3 => SphereLight {
            p,
            radius: 0.05 + a[0].abs(),
            radiance: shine,
            mesh,
        }
        .into(),
        4 => RectangleLight {
            p,
            half: [a, b],
            radiance: shine,
            mesh,
            flags,
        }
        .into(),
        5 => DiscLight {
            p,
            half: [a, b],
            radiance: shine,
            mesh,
            flags,
        }
        .into(),
        6 => ProfileLight {
            p,
            intensity: shine,
            axis,
            across: across(axis),
            cos_outer: -0.25,
            whole: 0.7,
            mean_cosine: 0.5,
            mesh,
            flags: flags * ProfileLight::MIRRORED,
        }
        .into(),
        _ => BoxLight {
            p,
            half: [a, b, c],
            radiance: shine,
            mesh,
        }
        .into(),
    }
}

fn mesh(random: &mut Random, lights: usize) -> Vec<AnyLight> {
    (0..lights).map(|number| light(random, number, 4.0)).collect()
}

/// All words in use are the scene's.
fn assert_is(held: &Mirrored<'_, AnyNode, 8>, scene: &Scene, what: &str) {
    let (used, name) = (scene.plan_of_everything(), held.device().name());
    let nodes = held.nodes().expect("a read");
    let own = [scene.nodes(), scene.top_nodes()].concat();
    for node in nodes_in_use(scene) {
        let (found, expected) = (nodes[node as usize], own[node as usize]);
        assert_eq!(
            bytes_of(&found),
            bytes_of(&expected),
            "{name} {what}: node {node}"
        );
    }
    let roots = held.roots().expect("a read");
    for &root in &used.roots {
        let (found, expected) = (roots[root as usize], scene.roots()[root as usize]);
        assert_eq!(
            bytes_of(&found),
            bytes_of(&expected),
            "{name} {what}: root {root}"
        );
    }
}

/// Samples, their pmfs and points on their lights have the CPU's words.
fn samples_agree(held: &Mirrored<'_, AnyNode, 8>, scene: &Scene, random: &mut Random) -> [usize; 8] {
    let device = held.device();
    let points: Vec<ShadingPoint> = (0..QUERIES)
        .map(|k| ShadingPoint {
            p: [0; 3].map(|_| random.between(-30.0, 30.0)),
            n: if k % 3 == 0 { [0.0; 3] } else { random.direction() },
        })
        .collect();
    let queries: Vec<Query> = points
        .iter()
        .map(|&point| {
            let number = Random64::from(random.bits());
            Query {
                point,
                words: [number.high, number.low],
            }
        })
        .collect();
    let asked = device.upload(&queries).expect("an upload");
    let push = query_push(QUERIES as u32, held.words());
    let sampled: Vec<SampledLight> = held
        .ask(
            KernelSet::ANY.sample,
            QUERIES,
            bytes_of(&push),
            &[("queries", asked.bind())],
        )
        .expect("the answers");
    let mut kinds = [0; 8];
    for (query, found) in queries.iter().zip(&sampled) {
        let [high, low] = query.words;
        let expected = scene.sample(&query.point, Random64 { high, low });
        assert_eq!(
            bytes_of(found),
            bytes_of(&expected),
            "{}: {query:?}",
            device.name()
        );
        if let Some(light) = scene.triangle(found.light, found.instance) {
            kinds[light.kind() as usize] += 1;
        }
    }
    let which: Vec<Query> = points
        .iter()
        .zip(&sampled)
        .map(|(&point, sample)| Query {
            point,
            words: [sample.light, sample.instance],
        })
        .collect();
    let which = device.upload(&which).expect("an upload");
    let pmfs: Vec<f32> = held
        .ask(
            KernelSet::ANY.pmf,
            QUERIES,
            bytes_of(&push),
            &[("queries", which.bind())],
        )
        .expect("the answers");
    for (pmf, sample) in pmfs.iter().zip(&sampled) {
        assert_eq!(
            pmf.to_bits(),
            sample.pmf.to_bits(),
            "{}: {sample:?}",
            device.name()
        );
    }
    let numbers: Vec<[f32; 2]> = points.iter().map(|_| [random.unit(), random.unit()]).collect();
    let picked = device.upload(&sampled).expect("an upload");
    let uv = device.upload(&numbers).expect("an upload");
    let found: Vec<LightPoint> = held
        .ask(
            KernelSet::ANY.light_points,
            QUERIES,
            bytes_of(&PointsPush {
                count: QUERIES as u32,
            }),
            &[
                ("queries", asked.bind()),
                ("samples", picked.bind()),
                ("numbers", uv.bind()),
            ],
        )
        .expect("the answers");
    for (k, at) in found.iter().enumerate() {
        let expected = light_point_for(
            scene.triangles(),
            scene.instances(),
            &queries[k],
            &sampled[k],
            numbers[k],
        );
        assert_eq!(
            bytes_of(at),
            bytes_of(&expected),
            "{}: {:?}",
            device.name(),
            sampled[k]
        );
    }
    kinds
}

#[test]
fn lights_of_every_kind_agree_with_every_device() {
    on_each_device(Options::default(), |device| {
        let random = &mut Random::new(77);
        let mut scene = Scene::default();
        let meshes: Vec<_> = [3, 40, 300]
            .map(|lights| scene.add_mesh(mesh(random, lights)).expect("a mesh"))
            .into();
        let place = |random: &mut Random, k: usize| placing::transform(random, Kind::ALL[k % 6], 30.0);
        let add: Vec<_> = (0..60)
            .map(|k| Edit::AddInstance {
                mesh: meshes[k % 3],
                transform: place(random, k),
                radiance: 1.0,
            })
            .collect();
        let ids = scene.apply(add).expect("instances").instances;
        let mut held = Mirrored::new(device, KernelSet::ANY).expect("arrays");
        let mut kinds = [0; 8];
        for frame in 0..6 {
            if frame > 0 {
                let mut edits: Vec<_> = (0..10)
                    .map(|k| Edit::SetTransform {
                        instance: ids[(7 * frame + k) % 60],
                        transform: place(random, k),
                    })
                    .collect();
                edits.push(Edit::SetTriangles {
                    mesh: meshes[frame % 3],
                    triangles: mesh(random, [3, 40, 300][frame % 3]),
                });
                scene.apply(edits).expect("edits");
            }
            scene.refit();
            held.follow(&scene).expect("a frame");
            assert_is(&held, &scene, &format!("frame {frame}"));
            let sampled = samples_agree(&held, &scene, random);
            kinds = std::array::from_fn(|k| kinds[k] + sampled[k]);
        }
        assert!(kinds.iter().all(|&count| count > 100), "{kinds:?}");
    });
}
