//! The words themselves: of builds, refits, samples, scenes and reservoirs over fixed inputs. Other tests say what must hold
//! whatever the words are; this one notices when a change gives others. Equal bits are this crate's promise, so a change that
//! is meant belongs under "Changes to bits" in `CHANGELOG.md`, with the new digests here.

use bytemuck::{Pod, cast_slice};
use glam::Vec3;
use lightbvh::climb::{Plan, parents};
use lightbvh::cone::{Cone, normalized};
use lightbvh::importance::Cluster;
use lightbvh::reservoir::{LightSample, Resampling, Reservoir, target};
use lightbvh::scene::RebuildParams;
use lightbvh::{
    BuildParams, CompactNode, Edit, EmissiveTriangle, Eq4, FluxOverDistance, FullNode, Heuristic,
    ImportanceModel, Instance, LightBounds, LightBvh, LightNode, Lights, MeshLeaf, Receiver, Scene,
    ShadingPoint, Transform, exact,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle, moved};

/// FNV-1a, 64 bits, word by word.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
    }

    fn float(&mut self, x: f32) {
        // Whose bits no standard settles.
        assert!(!x.is_nan());
        self.word(x.to_bits());
    }

    fn words<T: Pod>(&mut self, values: &[T]) {
        self.word(values.len() as u32);
        cast_slice::<T, u32>(values)
            .iter()
            .for_each(|&word| self.word(word));
    }

    fn vector(&mut self, v: Vec3) {
        v.to_array().into_iter().for_each(|x| self.float(x));
    }

    fn bounds(&mut self, b: &LightBounds) {
        [b.min, b.max, b.axis].into_iter().for_each(|v| self.vector(v));
        [b.cos_theta_o, b.cos_theta_e, b.phi]
            .into_iter()
            .for_each(|x| self.float(x));
    }

    #[track_caller]
    fn is(self, known: u64, what: &str) {
        assert!(
            self.0 == known,
            "{what}: 0x{:016x} is not the known 0x{known:016x}",
            self.0
        );
    }
}

/// Small lights in clusters, some two-sided, some bright; a few of every extreme kind.
fn lights() -> Lights {
    let mut random = Random::new(17);
    let mut triangles = generate::small_triangles(400, 9, 20.0, 0.5, true, 17);
    for (i, triangle) in triangles.iter_mut().enumerate() {
        triangle.flags = u32::from(i % 5 == 0);
        if i % 7 == 0 {
            triangle.radiance = triangle.radiance.map(|x| x * exact::pow2(i as i32 % 31 - 15));
        }
        if i % 50 == 3 {
            triangle.radiance = [0.0; 3];
        }
        if i % 50 == 4 {
            triangle.p = [triangle.p[0]; 3];
        }
    }
    let mesh = triangles[399].mesh + 1;
    triangles.extend((0..40).map(|_| {
        let triangle = extreme_triangle(&mut random);
        EmissiveTriangle {
            mesh,
            // They are to fade and brighten by up to 8.
            radiance: triangle.radiance.map(|x| x.min(exact::pow2(90))),
            ..triangle
        }
    }));
    Lights::new(triangles).expect("lights")
}

/// On and about the lights, near, far, and in volumes.
fn points() -> Vec<ShadingPoint> {
    let mut random = Random::new(23);
    let mut points: Vec<ShadingPoint> = (0..40).map(|_| generate::point(&mut random, 20.0)).collect();
    for (i, t) in lights().triangles().iter().enumerate().step_by(23) {
        let away = random.direction();
        let distance = exact::pow2(i as i32 % 20 - 12);
        points.push(ShadingPoint {
            p: std::array::from_fn(|k| t.p[1][k] + away[k] * distance),
            n: random.direction(),
        });
    }
    points.push(ShadingPoint {
        p: [1e9, -2e9, 3e9],
        n: [0.0, 1.0, 0.0],
    });
    points.push(ShadingPoint {
        p: [0.0; 3],
        n: [0.0; 3],
    });
    points
}

fn tree<N: LightNode<W>, L: MeshLeaf, const W: usize>(digest: &mut Digest, bvh: &LightBvh<N, W, L>) {
    let tree = bvh.tree();
    digest.words(tree.nodes);
    digest.words(tree.meshes);
    digest.words(tree.trails);
    digest.words(bvh.roots());
    [
        tree.root,
        tree.trail_words,
        bvh.depth(),
        bvh.bytes() as u32,
        bvh.refit_bytes() as u32,
    ]
    .into_iter()
    .for_each(|word| digest.word(word));
    for levels in [bvh.bottom_levels(), bvh.top_levels()] {
        digest.words(levels.nodes());
        levels.ranges().for_each(|range| digest.word(range.end as u32));
    }
    digest.bounds(&bvh.bounds());
}

fn picks<I: ImportanceModel, N: LightNode<W>, L: MeshLeaf, const W: usize>(
    digest: &mut Digest,
    bvh: &LightBvh<N, W, L>,
    lights: &Lights,
) {
    let mut random = Random::new(29);
    for point in points() {
        for _ in 0..6 {
            let sampled = bvh.sample::<I>(&point, random.bits());
            digest.word(sampled.light);
            digest.float(sampled.pmf);
        }
        for _ in 0..6 {
            let light = random.below(lights.triangles().len() as u32);
            digest.float(bvh.pmf::<I>(lights, &point, light));
        }
    }
}

/// Builds, plans of climbing refits, refits and picks: digests of each.
fn bvh<N: LightNode<W>, const W: usize>(known: [u64; 4]) {
    let what = |step| format!("{} of width {W}, {step}", N::NAME);
    let lights = lights();
    let later = moved(&lights, 31);
    let (mut built, mut planned, mut refitted, mut picked) =
        (Digest::new(), Digest::new(), Digest::new(), Digest::new());
    for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
        for buckets in [2, 16, 32] {
            let params = BuildParams { heuristic, buckets };
            for two in [false, true] {
                let mut bvh = if two {
                    LightBvh::<N, W>::two_level(&lights, &params)
                } else {
                    LightBvh::<N, W>::single_level(&lights, &params)
                };
                tree(&mut built, &bvh);
                if buckets != 16 {
                    continue;
                }
                let mut plan = Plan::default();
                let all = (0..bvh.nodes().len() as u32).collect();
                planned.word(plan.add(&parents(bvh.nodes()), all, bvh.bottom_levels().nodes().to_vec()));
                planned.words(&plan.starts);
                planned.words(&plan.leaves);
                planned.words(&plan.steps);
                picks::<Eq4, N, _, W>(&mut picked, &bvh, &lights);
                bvh.refit(&later);
                tree(&mut refitted, &bvh);
                picks::<Eq4, N, _, W>(&mut picked, &bvh, &later);
                picks::<FluxOverDistance, N, _, W>(&mut picked, &bvh, &later);
                let leaves = bvh.with_leaves::<Instance>();
                tree(&mut refitted, &leaves);
                picks::<Eq4, N, _, W>(&mut picked, &leaves, &later);
            }
        }
    }
    built.is(known[0], &what("built"));
    planned.is(known[1], &what("planned"));
    refitted.is(known[2], &what("refitted"));
    picked.is(known[3], &what("sampled"));
}

#[test]
fn compact_nodes() {
    bvh::<CompactNode<2>, 2>([
        0x18ed_1a96_299d_7d28,
        0x67c3_c803_f53e_4df6,
        0x078e_cdb7_04ab_e781,
        0xf81e_f6a6_3ba6_04ce,
    ]);
    bvh::<CompactNode<4>, 4>([
        0x22c8_f077_1b61_b44a,
        0xa54c_de62_448d_95e5,
        0x6b08_9def_174c_1f3f,
        0xdf2f_f2de_92df_4295,
    ]);
    bvh::<CompactNode<16>, 16>([
        0x3de9_6922_e2da_5205,
        0xae08_c081_e4b6_eb19,
        0xeac7_acfb_76a6_8c51,
        0xc188_9de5_f7a9_e45f,
    ]);
}

#[test]
fn full_nodes() {
    bvh::<FullNode<2>, 2>([
        0x9945_4bd5_37a6_75b3,
        0x67c3_c803_f53e_4df6,
        0x0791_4c02_d365_6bff,
        0x9268_de88_94d2_f2a5,
    ]);
    bvh::<FullNode<8>, 8>([
        0xa101_bf00_cb01_8456,
        0xaaa3_4277_3872_027e,
        0x5e17_20b0_d419_9ac7,
        0xe182_c61c_9225_0124,
    ]);
}

#[test]
fn bounds_and_unions() {
    let mut random = Random::new(37);
    let mut digest = Digest::new();
    for _ in 0..20_000 {
        let [a, b] = [0; 2].map(|_| LightBounds::of_triangle(&extreme_triangle(&mut random)));
        digest.bounds(&a);
        let both = a.merge(&b);
        digest.bounds(&both);
        let third = LightBounds::of_triangle(&extreme_triangle(&mut random));
        digest.bounds(&third.merge(&both));
        digest.bounds(&both.merge(&third));
        let mut cone = || Cone {
            axis: normalized(Vec3::from(random.direction())),
            cos_theta_o: match random.below(4) {
                0 => 1.0,
                1 => 1.0 - generate::log_uniform(&mut random, -24, -2),
                2 => generate::log_uniform(&mut random, -24, -2) - 1.0,
                _ => random.between(-1.0, 1.0),
            },
        };
        let (one, other) = (cone(), cone());
        let near = Cone {
            axis: normalized(one.axis + other.axis * exact::pow2(-12)),
            ..other
        };
        for union in [
            one.union(a.cone()),
            one.union(other),
            one.union(near),
            near.union(one),
        ] {
            digest.vector(union.axis);
            digest.float(union.cos_theta_o);
        }
    }
    digest.is(0x2a97_3490_f7dc_0e0a, "bounds");
}

#[test]
fn arithmetic() {
    let mut random = Random::new(41);
    let mut digest = Digest::new();
    for _ in 0..200_000 {
        let x = generate::log_uniform(&mut random, -60, 60);
        let y = generate::log_uniform(&mut random, -60, 60);
        for value in [
            exact::div(x, y),
            exact::div_emulated(x, y),
            exact::div_emulated(x, x * 4.0),
            exact::div_emulated(-x, x.next_up()),
            exact::sqrt(x),
            exact::sqrt_emulated(x),
            exact::recip(x),
            exact::recip_rough(x),
            exact::rsqrt(x),
            exact::rsqrt_rough(x),
            exact::significand(x),
            exact::pow2(exact::exponent(x)),
            exact::unit_f32(exact::hash(x.to_bits())),
        ] {
            digest.float(value);
        }
    }
    digest.is(0x6b77_41b8_c5eb_1e06, "arithmetic");
}

/// Instances of every scale and brightness, and receivers brought into their space.
#[test]
fn instances() {
    let mut random = Random::new(53);
    let mut digest = Digest::new();
    for i in 0..4000 {
        let transform = place(&mut random);
        let scale = exact::pow2(random.below(38) as i32 - 19);
        let instance = Instance {
            first: random.below(100),
            first_triangle: random.below(100),
            columns: transform.columns.map(|column| column.map(|x| x * scale)),
            translation: transform.translation,
            per_scale: 1.0 / scale,
            flux: generate::log_uniform(&mut random, -100, 98),
            radiance: [0.0, 1.0, 1e-3, 1e9][random.below(4) as usize],
            error: [0.0, 1e-6, 1e-3][random.below(3) as usize] * scale,
            tilt: [1e-5, 1e-3, 0.1][random.below(3) as usize],
            mirrored: random.below(2),
            ..Instance::world(1, 2)
        };
        let triangle = extreme_triangle(&mut random);
        let mut local = LightBounds::of_triangle(&triangle);
        if i % 2 == 0 {
            local.phi = generate::log_uniform(&mut random, -100, 125);
        }
        digest.bounds(&instance.to_world(&local));
        let small = generate::small_triangles(1, 1, 2.0, 0.4, false, i)[0];
        digest.words(&[instance.triangle(&small, i)]);
        digest.words(&instance.vertex(triangle.p[0]));
        digest.word(instance.light_of(i));
        digest.word(instance.triangle_of(i));
        let reach = exact::pow2(random.below(60) as i32 - 20);
        let point = generate::point(&mut random, reach);
        for receiver in [instance.inside(&point), Instance::outside(&point)] {
            digest.vector(receiver.position());
            digest.vector(receiver.normal());
            [receiver.slack(), receiver.near_squared(), receiver.tilt()]
                .into_iter()
                .for_each(|x| digest.float(x));
            importances(&mut digest, &mut random, &receiver);
        }
        importances(&mut digest, &mut random, &point);
    }
    digest.is(0x9291_451f_2130_4b09, "instances");
}

/// Of a set of lights about as far from the receiver as it is large.
fn importances<R: Receiver>(digest: &mut Digest, random: &mut Random, receiver: &R) {
    let size = generate::log_uniform(random, -30, 30);
    let distance = size * generate::log_uniform(random, -2, 4);
    let away = Vec3::from(random.direction()) * distance;
    let half_sine = [0.0, random.unit(), 1.0][random.below(3) as usize];
    let extent = Vec3::new(random.unit(), random.unit(), random.unit()) * size;
    let cluster = Cluster {
        center: receiver.position() + away,
        extent,
        radius_squared: (extent.x * extent.x + extent.y * extent.y) + extent.z * extent.z,
        axis: normalized(Vec3::from(random.direction())),
        cos_theta_o: 1.0 - 2.0 * half_sine * half_sine,
        sin_theta_o: 2.0 * half_sine * exact::sqrt(1.0 - half_sine * half_sine),
        cos_theta_e: 0.0,
        phi: [0.0, 1.0, generate::log_uniform(random, -100, 125)][random.below(3) as usize],
    };
    for importance in [
        Eq4::importance(&cluster, receiver),
        FluxOverDistance::importance(&cluster, receiver),
    ] {
        digest.float(importance.significand);
        digest.word(importance.exponent as u32);
    }
    digest.word(u32::from(Eq4::reaches(&cluster, receiver)));
}

/// Maps without trigonometry: turns by 3:4:5 triangles, scales, mirrorings, and some that are no similarity.
fn place(random: &mut Random) -> Transform {
    let (c, s) = (0.6, 0.8);
    let turn: [[f32; 3]; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]],
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ][random.below(4) as usize];
    let scale = [1.0, 0.5, 3.0, -1.0][random.below(4) as usize];
    let uneven = [1.0, 1.0, 1.0, 2.0, 0.25, 0.0][random.below(6) as usize];
    let mut columns = turn.map(|column| column.map(|x| x * scale));
    columns[1] = columns[1].map(|x| x * uneven);
    Transform {
        columns,
        translation: [0; 3].map(|_| random.between(-20.0, 20.0)),
    }
}

fn scene<N: LightNode<W>, const W: usize>(known: u64) {
    let mut random = Random::new(43);
    let mut digest = Digest::new();
    let mut scene = Scene::<N, W>::default();
    let mut meshes = Vec::new();
    for i in 0..6 {
        let triangles = generate::small_triangles(30 + i, 100, 2.0, 0.3, i % 2 == 0, i);
        meshes.push((
            scene
                .update(vec![Edit::AddMesh { triangles }])
                .expect("a mesh")
                .meshes[0],
            30 + i,
        ));
    }
    let mut ids = Vec::new();
    for frame in 0..30 {
        let mut batch: Vec<Edit> = (0..random.below(12))
            .map(|_| Edit::AddInstance {
                mesh: meshes[random.below(6) as usize].0,
                transform: place(&mut random),
                radiance: [0.0, 1.0, 0.25, 1000.0][random.below(4) as usize],
            })
            .collect();
        for &instance in &ids {
            match random.below(12) {
                0 => batch.push(Edit::Shine {
                    instance,
                    radiance: random.unit() + 0.5,
                }),
                1..=3 => batch.push(Edit::Move {
                    instance,
                    transform: place(&mut random),
                }),
                _ => {}
            }
        }
        if frame % 3 == 1 {
            let (mesh, count) = meshes[random.below(6) as usize];
            let size = random.between(1.0, 9.0);
            let triangles = generate::small_triangles(count, 100, size, 0.5, false, frame);
            batch.push(Edit::Deform { mesh, triangles });
        }
        if ids.len() > 10 {
            for _ in 0..random.below(6) {
                batch.push(Edit::RemoveInstance(
                    ids.swap_remove(random.below(ids.len() as u32) as usize),
                ));
            }
        }
        // What is removed was perhaps moved before in the batch; the other way round it would be unknown.
        ids.extend(scene.update(batch).expect("sound edits").instances);
        let work = scene.plan().clone();
        for list in [
            &work.written_nodes,
            &work.written_triangles,
            &work.written_trails,
            &work.written_instances,
        ] {
            digest.word(list.len() as u32);
            list.iter()
                .for_each(|range| (digest.word(range.start), digest.word(range.end)).0);
        }
        for list in [&work.leaves, &work.roots, &work.instances] {
            digest.words(list);
        }
        digest.words(work.levels.nodes());
        digest.words(work.top.nodes());
        digest.word(work.computed() as u32);
        scene.refit();
        digest.words(scene.nodes());
        digest.words(scene.parents());
        digest.words(scene.roots());
        digest.words(scene.instances());
        digest.words(scene.triangles());
        digest.words(scene.tree().trails);
        digest.words(&scene.world_lights());
        for range in scene.removed_lights() {
            digest.word(range.start);
            digest.word(range.end);
        }
        [
            scene.tree().root,
            scene.light_end(),
            scene.light_count() as u32,
            scene.bytes() as u32,
        ]
        .into_iter()
        .for_each(|word| digest.word(word));
        for _ in 0..30 {
            let point = generate::point(&mut random, 20.0);
            let sampled = scene.sample::<Eq4>(&point, random.bits());
            digest.word(sampled.light);
            digest.float(sampled.pmf);
        }
        let world = scene.world_lights();
        for &id in &ids {
            for light in scene.lights_of(id).expect("it is there") {
                assert_eq!(scene.light(light, id), Some(world[light as usize]));
            }
        }
        for &id in &ids {
            let lights = scene.lights_of(id).expect("it is there");
            let point = generate::point(&mut random, 20.0);
            digest.float(scene.pmf::<Eq4>(&point, lights.start + frame % 30, id));
        }
        if frame % 4 == 3 {
            let rebuilt = scene
                .rebuild(&RebuildParams {
                    top: true,
                    drift: 1.1,
                })
                .run();
            scene.adopt(rebuilt);
        }
    }
    digest.is(known, N::NAME);
}

#[test]
fn scenes() {
    scene::<CompactNode<4>, 4>(0xb4eb_3c23_6173_98b1);
    scene::<FullNode<2>, 2>(0x95b1_e8e9_65c9_926f);
}

#[test]
fn reservoirs() {
    let mut random = Random::new(47);
    let mut digest = Digest::new();
    let mut others: Vec<Reservoir> = vec![Reservoir::EMPTY];
    for i in 0..2000 {
        let mut stream = Resampling::EMPTY;
        let mut balance = 0.0;
        for _ in 0..1 + random.below(6) {
            let sample = LightSample {
                light: random.below(1000),
                uv: [random.unit(), random.unit()],
            };
            let luminance = if random.below(5) == 0 {
                0.0
            } else {
                generate::log_uniform(&mut random, -60, 60)
            };
            let pmf = if random.below(5) == 0 {
                0.0
            } else {
                generate::log_uniform(&mut random, -50, -1)
            };
            stream.candidate(sample, target(luminance), pmf, random.bits());
            let other = others[random.below(others.len() as u32) as usize].limited(20 + i);
            let own = target(generate::log_uniform(&mut random, -5, 5));
            stream.merge(&other, own, i, random.bits());
            balance += own * other.count as f32;
        }
        let (equal, balanced) = (
            stream.finish_equal(),
            stream.finish_balanced(stream.target, balance),
        );
        digest.words(&[equal, balanced, equal.occluded()]);
        others.push(equal);
        others.push(balanced);
    }
    digest.is(0xaa1f_3852_d867_1393, "reservoirs");
}
