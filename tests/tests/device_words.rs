//! Each set of kernels that is shipped, on every device: refits, samples, pmfs and points on lights have the CPU's bits, frame after
//! frame.

use std::fmt::Debug;

use bytemuck::{Pod, bytes_of};
use lightbvh::device::bvh::follow;
use lightbvh::device::point::Receiver;
use lightbvh::importance::{Cell, DefaultImportance, ImportanceModel, LinkedPoint};
use lightbvh::light::Light;
use lightbvh::node::Node;
use lightbvh::refit::world_light;
use lightbvh::{
    BuildParams, Bvh, Edit, Eq4, Heuristic, INVALID, LightNode, LightPoint, Lights, Random64, SampledLight,
    ShadingPoint,
};
use lightbvh_gpu::{CellQuery, EQ4, Kernel, KernelSet, LinkedQuery, MOMENTS, Query, query_push};
use lightbvh_host::backend::{Mirrored, held};
use lightbvh_host::vulkan::{Device, Options};
use lightbvh_kernels::bvh::{AnyNode, Node as MomentsNode, PaperNode};
use lightbvh_kernels::query::PointsPush;
use lightbvh_kernels::receivers::{LinkedImportance, LinkedNode};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::{Random, moved, split};
use lightbvh_tests::placing;
use lightbvh_tests::scenes::Any;

use crate::deep::shrinking;
use crate::known_words::trees;

const QUERIES: usize = 2000;

/// A receiver, and what kernels are asked for it.
trait Ask: Receiver + Debug {
    type Query: Pod;
    fn at(point: ShadingPoint, random: &mut Random) -> Self;
    fn query(self, words: [u32; 2]) -> Self::Query;
}

impl Ask for ShadingPoint {
    type Query = Query;

    fn at(point: ShadingPoint, _: &mut Random) -> Self {
        point
    }
    fn query(self, words: [u32; 2]) -> Query {
        let [high, low] = words;
        Query::sample(self, Random64 { high, low })
    }
}

impl Ask for Cell {
    type Query = CellQuery;

    fn at(point: ShadingPoint, random: &mut Random) -> Self {
        let half = [0; 3].map(|_| random.between(0.0, 2.0));
        let shorter = random.unit();
        Self {
            center: point.p,
            half,
            n: point.n.map(|x| x * shorter),
        }
    }
    fn query(self, words: [u32; 2]) -> CellQuery {
        CellQuery { cell: self, words }
    }
}

impl Ask for LinkedPoint<ShadingPoint> {
    type Query = LinkedQuery;

    fn at(point: ShadingPoint, random: &mut Random) -> Self {
        let mask = [1, 6, 0, u32::MAX, 16][random.below(5) as usize];
        Self { point, mask }
    }
    fn query(self, words: [u32; 2]) -> LinkedQuery {
        let [light, instance] = words;
        LinkedQuery::pmf(self, light, instance)
    }
}

/// A tree on a device, with the kernels over it.
struct Held<'d, N: Node<W>, const W: usize> {
    arrays: Mirrored<'d, N, W>,
    kernels: KernelSet,
}

impl<'d, N: Node<W>, const W: usize> Held<'d, N, W> {
    fn new(device: &'d Device, kernels: KernelSet) -> Self {
        let arrays = Mirrored::new(device, kernels).expect("arrays");
        Self { arrays, kernels }
    }

    /// The answers of a kernel that walks the tree.
    fn ask<T: Pod, P: Ask>(&self, kernel: &Kernel, receivers: &[P], words: &[[u32; 2]]) -> Vec<T> {
        let asked = receivers.iter().zip(words).map(|(&own, &words)| own.query(words));
        let asked: Vec<P::Query> = asked.collect();
        let asked = self.arrays.device().upload(&asked).expect("an upload");
        let push = query_push(words.len() as u32, self.arrays.words());
        let others = [("queries", asked.bind())];
        let answers = self.arrays.ask(kernel, words.len(), bytes_of(&push), &others);
        answers.expect("the answers").value
    }

    /// Follows `bvh`, and compares everything; returns the samples.
    fn compare<I: ImportanceModel<N, W, P>, P: Ask>(
        &mut self,
        bvh: &Bvh<(N, ()), W>,
        points: &[ShadingPoint],
        random: &mut Random,
    ) -> Vec<(P, SampledLight)> {
        self.arrays.follow(bvh).expect("a frame");
        let (device, tree) = (self.arrays.device(), bvh.tree().by::<I>());
        for (own, found) in held(bvh).iter().zip(self.arrays.held(bvh).expect("a read")) {
            same(device, own.record.name, &found.words, &own.words);
        }
        let receivers: Vec<P> = points.iter().map(|&point| P::at(point, random)).collect();
        let numbers: Vec<[u32; 2]> = points.iter().map(|_| [random.bits(), random.bits()]).collect();
        let sampled: Vec<SampledLight> = self.ask(self.kernels.sample, &receivers, &numbers);
        let expected: Vec<_> = receivers
            .iter()
            .zip(&numbers)
            .map(|(own, &[high, low])| tree.sample(own, Random64 { high, low }))
            .collect();
        same(device, self.kernels.sample.name, &sampled, &expected);

        // Some ask for a light that another one sampled.
        let which = |k: usize| {
            sampled[if k.is_multiple_of(4) {
                (k + 1) % sampled.len()
            } else {
                k
            }]
        };
        let asked: Vec<_> = (0..points.len())
            .map(|k| [which(k).light, which(k).instance])
            .collect();
        let pmfs: Vec<f32> = self.ask(self.kernels.pmf, &receivers, &asked);
        let expected: Vec<_> = receivers
            .iter()
            .zip(&asked)
            .map(|(own, &[light, instance])| tree.pmf(own, light, instance))
            .collect();
        same(device, self.kernels.pmf.name, &pmfs, &expected);

        // And samples that nothing is behind.
        let mut picked = sampled.clone();
        for (k, sample) in picked.iter_mut().enumerate().filter(|(k, _)| k % 16 == 0) {
            let word = |random: &mut Random| random.bits() >> random.below(32);
            *sample = SampledLight {
                light: if k % 64 == 0 { INVALID } else { word(random) },
                instance: word(random),
                pmf: 0.5,
            };
        }
        let uv: Vec<[f32; 2]> = picked.iter().map(|_| [random.unit(), random.unit()]).collect();
        let queries: Vec<P::Query> = receivers.iter().map(|own| own.query([0; 2])).collect();
        let [queries, samples, numbers] = [
            device.upload(&queries).expect("an upload").bind(),
            device.upload(&picked).expect("an upload").bind(),
            device.upload(&uv).expect("an upload").bind(),
        ];
        let count = picked.len() as u32;
        let others = [("queries", queries), ("samples", samples), ("numbers", numbers)];
        let kernel = self.kernels.light_points;
        let found: Vec<LightPoint> = self
            .arrays
            .ask(kernel, picked.len(), bytes_of(&PointsPush { count }), &others)
            .expect("the answers")
            .value;
        let expected: Vec<_> = (0..picked.len())
            .map(|k| {
                let SampledLight { light, instance, .. } = picked[k];
                let own = world_light(bvh.view().lights(), tree.instances, light, instance);
                let on = own.point_for(points[k].position(), uv[k]);
                assert!(light != INVALID || on.density == 0.0, "{on:?} of no light");
                on
            })
            .collect();
        same(device, kernel.name, &found, &expected);
        receivers.into_iter().zip(sampled).collect()
    }
}

fn same<T: Pod>(device: &Device, what: &str, found: &[T], expected: &[T]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(
            bytes_of(found),
            bytes_of(expected),
            "{}: {what} {k}",
            device.name()
        );
    }
}

/// On every device that is exact.
fn on_exact(test: impl Fn(&Device)) {
    on_each_device(Options::default(), |device| {
        if device.self_test().expect("a verdict").exact {
            test(device);
        } else {
            eprintln!("{}: not exact, its words are its own", device.name());
        }
    });
}

/// A receiver, and the light that was sampled for it, with the mask of its instance.
type Seen<P, L> = (P, Option<(L, u32)>);

/// Seven frames of instances under any maps that move, come and go, and of meshes that change and come, beyond the room of every
/// array, with new trees now and then. Two mirrors follow, one of them every third frame. Returns the lights sampled, with their masks,
/// and for whom.
fn frames<N: Node<W>, I: ImportanceModel<N, W, P>, P: Ask, const W: usize>(
    device: &Device,
    kernels: KernelSet,
) -> Vec<Seen<P, N::Light>>
where
    N::Light: Any,
{
    let random = &mut Random::new(77);
    let mut bvh = Bvh::<(N, ()), W>::default();
    let mesh = |random: &mut Random, count: usize| -> Vec<N::Light> {
        let light = |_| {
            let place = [0; 3].map(|_| random.between(-4.0, 4.0));
            let shine = [0; 3].map(|_| random.between(0.1, 5.0));
            N::Light::any(random, place, 0.5, shine)
        };
        (0..count).map(light).collect()
    };
    let place = |random: &mut Random, k: usize| placing::transform(random, placing::Kind::ALL[k % 6], 30.0);
    let counts = [3, 40, 300, 1];
    let meshes = counts.map(|count| bvh.add_mesh(mesh(random, count)).expect("a mesh"));
    let add = |random: &mut Random, k: usize| Edit::AddInstance {
        mesh: meshes[k % 4],
        transform: place(random, k),
        radiance: [1.0, 0.5, 2.0],
        mask: 1 << random.below(4),
    };
    let all = (0..60).map(|k| add(random, k)).collect();
    let mut ids = bvh.apply(all).expect("instances").instances;
    let mut mirrors = [Held::new(device, kernels), Held::new(device, kernels)];
    let mut seen = Vec::new();
    for frame in 0..7 {
        if frame > 0 {
            // Every second one: many short regions.
            let mut edits: Vec<_> = (0..30)
                .map(|k| Edit::SetTransform {
                    instance: ids[(7 * frame + 2 * k) % 60],
                    transform: place(random, k),
                })
                .collect();
            edits.push(Edit::SetLights {
                mesh: meshes[frame % 4],
                lights: mesh(random, counts[frame % 4]),
            });
            let at = (7 * frame + 20) % 60;
            edits.push(Edit::RemoveInstance(ids[at]));
            edits.extend((0..20).map(|k| add(random, frame + k)));
            ids[at] = bvh.apply(edits).expect("edits").instances[0];
            bvh.add_mesh(mesh(random, 100)).expect("a mesh");
        }
        bvh.refit();
        if frame % 3 == 2 {
            bvh.rebuild();
        }
        let points: Vec<_> = (0..QUERIES)
            .map(|k| ShadingPoint {
                p: [0; 3].map(|_| random.between(-30.0, 30.0)),
                n: if k % 3 == 0 { [0.0; 3] } else { random.direction() },
            })
            .collect();
        for (held, every) in mirrors.iter_mut().zip([1, 3]) {
            if frame % every == 0 {
                let sampled = held.compare::<I, P>(&bvh, &points, random).into_iter();
                seen.extend(sampled.map(|(own, sample)| {
                    let light = bvh.view().light(sample.light, sample.instance);
                    let mask = |light| (light, bvh.view().instances()[sample.instance as usize].mask);
                    (own, light.map(mask))
                }));
            }
        }
    }
    seen
}

/// Trees in one level and in two, as built and refitted to other lights; one mirror meets all of them.
fn built<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(device: &Device, kernels: KernelSet) {
    let random = &mut Random::new(31);
    let mut held = Held::new(device, kernels);
    let points: Vec<_> = trees::points().into_iter().cycle().take(1000).collect();
    for (lights, params) in [
        (trees::lights(), BuildParams::default()),
        (shrinking(130, 26, false), split(Heuristic::Sah, 2)),
    ] {
        let later = moved(&lights, 31);
        for build in [Bvh::<(N, ()), W>::single_level, Bvh::two_level] as [fn(&Lights, &BuildParams) -> _; 2]
        {
            let mut bvh = build(&lights, &params);
            held.compare::<I, ShadingPoint>(&bvh, &points, random);
            follow(&mut bvh, &later).expect("as many lights");
            held.compare::<I, ShadingPoint>(&bvh, &points, random);
        }
    }
}

#[test]
fn triangles_by_moments() {
    on_exact(|device| {
        frames::<MomentsNode, DefaultImportance, ShadingPoint, 8>(device, MOMENTS);
        built::<MomentsNode, DefaultImportance, 8>(device, MOMENTS);
    });
}

#[test]
fn triangles_for_cells() {
    on_exact(|device| {
        frames::<MomentsNode, DefaultImportance, Cell, 8>(device, KernelSet::CELLS);
    });
}

#[test]
fn triangles_by_eq_4() {
    on_exact(|device| {
        frames::<PaperNode, Eq4, ShadingPoint, 4>(device, EQ4);
        built::<PaperNode, Eq4, 4>(device, EQ4);
    });
}

#[test]
fn lights_of_every_kind() {
    on_exact(|device| {
        let seen = frames::<AnyNode, DefaultImportance, ShadingPoint, 8>(device, KernelSet::ANY);
        let mut kinds = [0; 6];
        for (_, light) in seen {
            light
                .into_iter()
                .for_each(|(own, _)| kinds[own.kind() as usize] += 1);
        }
        assert!(kinds.iter().all(|&count| count > 100), "{kinds:?}");
    });
}

#[test]
fn lights_with_masks() {
    on_exact(|device| {
        let seen =
            frames::<LinkedNode, LinkedImportance, LinkedPoint<ShadingPoint>, 8>(device, KernelSet::LINKED);
        for (receiver, light) in seen {
            // Masks 0 and 16 have no light.
            let common = light.map(|(_, mask)| mask & receiver.mask);
            assert_eq!(
                common.is_some(),
                ![0, 16].contains(&receiver.mask),
                "{receiver:?}"
            );
            assert_ne!(common, Some(0), "{receiver:?}");
        }
    });
}
