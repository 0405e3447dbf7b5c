//! Refit without levels, by the kernels: the words of the level-by-level passes on the CPU and on every device, and an end
//! whatever the steps say.

use lightbvh::climb::{Plan, Start, Step};
use lightbvh::scene::RebuildParams;
use lightbvh::{BuildParams, Edit, EmissiveTriangle, Heuristic, InstanceId, Lights, MeshId, exact};
use lightbvh_host::backend::{Backend, Bvh, CpuBackend, DeviceBackend, LightScene, Sampler};
use lightbvh_host::vulkan::{Options, Pass};
use lightbvh_host::workload::build;
use lightbvh_kernels::bvh::Node;
use lightbvh_kernels::refit::{RefitPush, refit_climb, refit_climb_top};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::edits::add_mesh;
use lightbvh_tests::generate::{self, Random, moved};
use lightbvh_tests::placing;
use std::time::Duration;

/// Refits of each tree, to three sets of lights in turn: an arrival that goes wrong in one run shows in its words, and a
/// counter that does not come back to zero in those of the next.
const RUNS: usize = 50;

fn words<T: bytemuck::Pod>(values: &[T]) -> &[u32] {
    bytemuck::cast_slice(values)
}

/// The nodes after a refit level by level.
fn by_levels(bvh: &Bvh, lights: &Lights) -> Vec<Node> {
    let mut bvh = bvh.clone();
    bvh.refit(lights);
    bvh.nodes().to_vec()
}

/// One node; as many levels as trails allow; thousands of small trees; all at one place; one large tree.
fn trees() -> Vec<(&'static str, Bvh, Lights)> {
    let small = |count, per_mesh, seed| {
        Lights::new(generate::small_triangles(count, per_mesh, 50.0, 0.5, true, seed)).expect("lights")
    };
    // Each light at half the distance of the one before: a chain.
    let halving = |meshes: u32, triangles: u32| {
        let light = |i: u32| {
            let (m, t) = (i / triangles, i % triangles);
            let (x, y) = (exact::pow2(20 - m as i32), exact::pow2(20 - t as i32));
            let size = y * 0.125;
            EmissiveTriangle {
                p: [[x, y, 0.0], [x, y + size, 0.0], [x, y, size]],
                radiance: [1.0; 3],
                mesh: m,
                flags: 1,
            }
        };
        Lights::new((0..meshes * triangles).map(light).collect()).expect("lights")
    };
    let default = BuildParams::default();
    let chain = BuildParams {
        heuristic: Heuristic::Sah,
        buckets: 2,
    };
    let mut trees = Vec::new();
    let mut add = |name, lights: Lights, params: &BuildParams| {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            trees.push((name, build(&lights, sampler, params), lights.clone()));
        }
    };
    add("one light", small(1, 1, 1), &default);
    add("four lights", small(4, 4, 2), &default);
    add("chains", halving(48, 48), &chain);
    add("4000 meshes of 3", small(12_000, 3, 3), &default);
    add("30000 lights", small(30_000, 300, 4), &default);
    trees
}

#[test]
fn the_cpu_climbs_to_the_words_of_the_levels() {
    for (name, bvh, lights) in trees() {
        let mut cpu = CpuBackend::new(bvh.clone(), lights.clone());
        for seed in 0..3 {
            let later = moved(&lights, seed);
            let climbed = cpu.refit_once(&later).expect("a refit").value;
            assert!(words(&climbed) == words(&by_levels(&bvh, &later)), "{name}");
        }
    }
}

#[test]
fn devices_climb_to_the_words_of_the_levels_each_time() {
    on_each_device(Options::default(), |device| {
        for (name, bvh, lights) in trees() {
            if name == "chains" {
                assert!(bvh.depth() > 20, "{name}: only {} levels", bvh.depth());
            }
            let sets = [0, 1, 2].map(|seed| moved(&lights, seed));
            let expected = sets.each_ref().map(|later| by_levels(&bvh, later));
            assert!(words(&expected[0]) != words(&expected[1]));
            let mut backend = DeviceBackend::new(device, &bvh, &lights).expect("an upload");
            for run in 0..RUNS {
                let k = run % sets.len();
                let climbed = backend.refit_once(&sets[k]).expect("a refit").value;
                assert!(
                    words(&climbed) == words(&expected[k]),
                    "{} {name}, {} levels, run {run}",
                    device.name(),
                    if bvh.is_two_level() { 2 } else { 1 }
                );
            }
            // Both ways leave the same behind: bounds of bottom levels too, which are not among the nodes.
            let climbed = backend.refit(&sets[1]).expect("a refit").value;
            assert!(words(&climbed) == words(&expected[1]), "{} {name}", device.name());
        }
    });
}

/// One frame's edits: meshes come, deform and go, instances come, move, shine and go.
fn edits(random: &mut Random, scene: &mut LightScene, meshes: &mut Vec<MeshId>, ids: &mut Vec<InstanceId>) {
    let mesh = |random: &mut Random, count: u32| {
        generate::small_triangles(count, count, 2.0, 0.4, random.below(2) == 0, random.bits())
    };
    let mut batch = Vec::new();
    for _ in 0..random.below(5) {
        let kind = placing::kind(random);
        let transform = placing::transform(random, kind, 30.0);
        let known = (!meshes.is_empty()).then(|| meshes[random.below(meshes.len() as u32) as usize]);
        let placed = (!ids.is_empty()).then(|| random.below(ids.len() as u32) as usize);
        match (random.below(8), known, placed) {
            (0, ..) | (_, None, _) => {
                let triangles = mesh(random, 24);
                meshes.extend(
                    scene
                        .update(vec![Edit::AddMesh { triangles }])
                        .expect("a mesh")
                        .meshes,
                );
            }
            (1 | 2, Some(mesh), _) => {
                let add = Edit::AddInstance {
                    mesh,
                    transform,
                    radiance: 1.0 + random.unit(),
                };
                ids.extend(scene.update(vec![add; 3]).expect("instances").instances);
            }
            (3, Some(id), _) => batch.push(Edit::Deform {
                mesh: id,
                triangles: mesh(random, 24),
            }),
            (4, _, Some(at)) if ids.len() > 6 => {
                let gone = ids.swap_remove(at);
                scene
                    .update(vec![Edit::RemoveInstance(gone)])
                    .expect("it was there");
            }
            (5, _, Some(at)) => batch.push(Edit::Shine {
                instance: ids[at],
                radiance: random.unit() + 0.5,
            }),
            (_, _, Some(at)) => batch.push(Edit::Move {
                instance: ids[at],
                transform,
            }),
            _ => {}
        }
    }
    batch.retain(|edit| match edit {
        Edit::Move { instance, .. } | Edit::Shine { instance, .. } => ids.contains(instance),
        _ => true,
    });
    scene.update(batch).expect("sound edits");
}

/// Where only parts of the trees change, those above the changes wait for just them.
#[test]
fn devices_follow_edits_by_climbing() {
    let any = Lights::new(generate::small_triangles(1, 1, 1.0, 1.0, false, 1)).expect("a light");
    on_each_device(Options::default(), |device| {
        let random = &mut Random::new(11);
        let (mut meshes, mut ids) = (Vec::new(), Vec::new());
        let mut scene = LightScene::new(BuildParams::default());
        let triangles = generate::small_triangles(24, 24, 2.0, 0.4, true, 5);
        meshes.push(add_mesh(&mut scene, triangles));
        let add = |random: &mut Random| Edit::AddInstance {
            mesh: meshes[0],
            transform: placing::transform(random, placing::Kind::Rigid, 30.0),
            radiance: 1.0,
        };
        let many = (0..200).map(|_| add(random)).collect();
        ids.extend(scene.update(many).expect("instances").instances);
        scene.refit();
        let mut backend = DeviceBackend::of_scene(device, &scene, &any).expect("an upload");
        for frame in 0..150 {
            edits(random, &mut scene, &mut meshes, &mut ids);
            if frame % 20 == 19 {
                let built = scene.rebuild(&RebuildParams::default()).run();
                scene.adopt(built);
            }
            scene.plan();
            backend.follow_once(&scene, &any).expect("a frame");
            scene.refit();
            let found = backend.nodes().expect("the nodes");
            assert!(
                words(&found) == words(scene.nodes()),
                "{} frame {frame}",
                device.name()
            );
        }
    });
}

/// Steps of random words, and steps in circles.
fn hostile_steps(random: &mut Random, nodes: u32) -> Vec<Step> {
    let count = 1 + random.below(300);
    let circles = random.below(2) == 0;
    (0..count)
        .map(|i| {
            let mut index = |end: u32| match random.below(8) {
                0 => random.bits(),
                1 => end,
                _ => random.below(end),
            };
            let (node, parent) = (index(nodes), index(count));
            Step {
                node,
                parent: if circles { (i + 1) % count } else { parent },
                children: if circles { 1 } else { random.below(4) },
            }
        })
        .collect()
}

#[test]
fn hostile_steps_end() {
    let lights = Lights::new(generate::small_triangles(60, 5, 10.0, 1.0, true, 8)).expect("lights");
    let bvh = build(&lights, Sampler::TwoLevel, &BuildParams::default());
    let random = &mut Random::new(3);
    let cases: Vec<(Plan, RefitPush)> = (0..200)
        .map(|_| {
            let steps = hostile_steps(random, bvh.nodes().len() as u32);
            let first = [0, random.below(9), random.bits()][random.below(3) as usize];
            let count = steps.len() as u32 + 70;
            let mut index = |end: u32| match random.below(8) {
                0 => random.bits(),
                _ => random.below(end + 1),
            };
            let starts = (0..count - 20).map(|_| Start {
                first: index(30),
                end: index(40),
                step: index(count),
            });
            let starts = starts.collect();
            let leaves = (0..30).map(|_| index(bvh.nodes().len() as u32)).collect();
            let plan = Plan {
                starts,
                leaves,
                steps,
            };
            (plan, RefitPush { first, count })
        })
        .collect();
    for (
        Plan {
            starts,
            leaves,
            steps,
        },
        push,
    ) in &cases
    {
        let mut nodes = bvh.nodes().to_vec();
        // Too few counters are no way out of the array either.
        let mut arrivals = vec![0; steps.len() - steps.len() / 3];
        for i in 0..push.count {
            let id = glam::UVec3::new(i, 0, 0);
            let (triangles, meshes) = (lights.triangles(), bvh.tree().meshes);
            refit_climb(
                id,
                push,
                starts,
                leaves,
                steps,
                &mut arrivals,
                triangles,
                &mut nodes,
            );
            refit_climb_top(
                id,
                push,
                starts,
                leaves,
                steps,
                &mut arrivals,
                meshes,
                bvh.roots(),
                &mut nodes,
            );
        }
    }
    let limit = Options {
        time_limit: Duration::from_secs(60),
        ..Options::default()
    };
    on_each_device(limit, |device| {
        let (bottom, top) = (
            device.kernel("refit_climb").expect("a kernel"),
            device.kernel("refit_climb_top").expect("a kernel"),
        );
        let nodes = device.upload(bvh.nodes()).expect("an upload");
        let triangles = device.upload(lights.triangles()).expect("an upload");
        let meshes = device.upload(bvh.tree().meshes).expect("an upload");
        let roots = device.upload(bvh.roots()).expect("an upload");
        for (
            Plan {
                starts,
                leaves,
                steps,
            },
            push,
        ) in &cases
        {
            let arrivals = vec![0_u32; steps.len() - steps.len() / 3];
            let (steps, arrivals) = (device.upload(steps), device.upload(&arrivals));
            let (steps, arrivals) = (steps.expect("an upload"), arrivals.expect("an upload"));
            let (s, a, n) = (steps.bind(), arrivals.bind(), nodes.bind());
            let (starts, leaves) = (device.upload(starts), device.upload(leaves));
            let (starts, leaves) = (starts.expect("an upload"), leaves.expect("an upload"));
            let (b, l) = (starts.bind(), leaves.bind());
            let mut pass = Pass::new();
            let push_words = bytemuck::bytes_of(push);
            pass.dispatch(
                &bottom,
                &[b, l, s, a, triangles.bind(), n],
                push_words,
                push.count,
            );
            let by_instance = [b, l, s, a, meshes.bind(), roots.bind(), n];
            pass.dispatch(&top, &by_instance, push_words, push.count);
            device.run(&pass).expect("an end");
        }
        // And the device goes on as before.
        let mut backend = DeviceBackend::new(device, &bvh, &lights).expect("an upload");
        let later = moved(&lights, 1);
        let climbed = backend.refit_once(&later).expect("a refit").value;
        assert!(
            words(&climbed) == words(&by_levels(&bvh, &later)),
            "{}",
            device.name()
        );
    });
}
