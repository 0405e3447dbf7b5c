//! Models with less in them say the same: two-sided moments, no trails, no data for refits.

use bytemuck::cast_slice;
use lightbvh::bvh::StaticBvh;
use lightbvh::exact::{self, hash, pow2, unit_f32};
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, EmissiveTriangle, InstanceId, LightNode, Lights, MomentNode, Moments,
    ShadingPoint, Transform, TwoSidedMomentNode,
};

struct Random(u32);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        unit_f32(hash(self.0))
    }

    fn below(&mut self, count: u32) -> u32 {
        ((self.unit() * count as f32) as u32).min(count - 1)
    }

    fn vector(&mut self, size: f32) -> [f32; 3] {
        [0; 3].map(|_| (2.0 * self.unit() - 1.0) * size)
    }
}

/// Triangles of sizes and fluxes far apart, some without area or radiance, in a cube of 2 `size`; `flags` as given.
fn mesh(random: &mut Random, size: f32, count: u32, flags: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let at = random.vector(size);
        let edge = size * pow2(-(random.below(20) as i32));
        let vertex = |random: &mut Random| {
            let away = random.vector(edge);
            [0, 1, 2].map(|k| at[k] + away[k])
        };
        let b = vertex(random);
        let c = if random.below(12) == 0 { b } else { vertex(random) };
        let radiance = match random.below(8) {
            0 => 0.0,
            _ => pow2(random.below(70) as i32 - 35),
        };
        // So thin that no normal is known of it: as good as two-sided.
        let needle = flags != 0 && random.below(10) == 0;
        EmissiveTriangle {
            p: if needle { thin(edge) } else { [at, b, c] },
            radiance: [radiance; 3],
            mesh: 0,
            flags: if needle { 0 } else { flags },
        }
    };
    (0..count).map(triangle).collect()
}

/// A cross product of 2^-70 of the longer edge squared.
fn thin(edge: f32) -> [[f32; 3]; 3] {
    [[0.0; 3], [edge, 0.0, 0.0], [0.0, edge * pow2(-70), 0.0]]
}

fn transform(random: &mut Random, size: f32) -> Transform {
    let columns = match random.below(3) {
        0 => Transform::IDENTITY.columns,
        // Any map, flat ones too.
        1 => [0; 3].map(|_| random.vector(2.0)),
        _ => [random.vector(1.0), [0.0; 3], random.vector(1.0)],
    };
    Transform {
        columns,
        translation: random.vector(4.0 * size),
    }
}

/// The same meshes, instances and moves in any light BVH.
fn scene<N: LightNode<W>, I, const W: usize>(seed: u32, flags: u32, params: BuildParams) -> Bvh<N, I, W> {
    let random = &mut Random(seed.wrapping_mul(7919));
    let size = pow2(random.below(60) as i32 - 30);
    let mut bvh = Bvh::new(params);
    let mut instances: Vec<InstanceId> = Vec::new();
    for _ in 0..1 + random.below(3) {
        let count = 1 + random.below(60);
        let own = bvh
            .add_mesh(mesh(random, size, count, flags))
            .expect("within the domain");
        for _ in 0..1 + random.below(4) {
            let edit = Edit::AddInstance {
                mesh: own,
                transform: transform(random, size),
                radiance: [1.0, 0.25, 0.0][random.below(3) as usize],
            };
            instances.extend(bvh.apply(vec![edit]).expect("an instance").instances);
        }
    }
    bvh.refit();
    // Refits, and a top level that edits have patched.
    for id in instances {
        if random.below(3) == 0 {
            bvh.set_transform(id, transform(random, size))
                .expect("within the domain");
        }
    }
    bvh.refit();
    bvh
}

fn points(seed: u32, lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random(seed.wrapping_mul(104_729));
    let point = |_| {
        let near = lights[random.below(lights.len() as u32) as usize].p[0];
        let size = near.into_iter().map(exact::abs).fold(pow2(-30), exact::max);
        let away = random.vector(size);
        let n = match random.below(4) {
            0 => [0.0; 3],
            _ => {
                let v = random.vector(1.0);
                let length = exact::sqrt(v.iter().map(|x| x * x).sum::<f32>());
                v.map(|x| x / length)
            }
        };
        let p = [0, 1, 2].map(|k| near[k] + away[k]);
        ShadingPoint { p, n }.checked().expect("a shading point")
    };
    (0..24).map(point).collect()
}

/// Every word but those of the row of normals, of which one constant is known; every pmf, every sample.
fn equal_words<const W: usize>(seed: u32, params: BuildParams) {
    type D = Defensive<Moments, 6>;
    let full = scene::<MomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    let less = scene::<TwoSidedMomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    assert_eq!(full.nodes().len(), less.nodes().len());
    for (full, less) in full.nodes().iter().zip(less.nodes()) {
        let (a, b): (&[u32], &[u32]) = (
            cast_slice(std::slice::from_ref(full)),
            cast_slice(std::slice::from_ref(less)),
        );
        assert_eq!((a.len(), b.len()), (6 * W, 5 * W));
        assert_eq!(a[..3 * W], b[..3 * W]);
        assert_eq!(a[4 * W..], b[3 * W..]);
        for (slot, &normal) in a[3 * W..4 * W].iter().enumerate() {
            let shines = full.summary(slot).phi > 0.0;
            assert_eq!(normal, if shines { !0 } else { 0 }, "{seed}, slot {slot}");
            if shines {
                assert_eq!(full.summary(slot), less.summary(slot));
            }
        }
    }
    assert_eq!(full.instances(), less.instances());
    let roots = |words: &[lightbvh::refit::BlasRoot]| cast_slice::<_, u32>(words).to_vec();
    assert_eq!(roots(full.roots()), roots(less.roots()));
    less.validate()
        .unwrap_or_else(|violation| panic!("{seed}: {violation}"));
    let world = full.world_lights();
    for (k, point) in (0..).zip(points(seed, &world)) {
        for (light, triangle) in (0..).zip(&world) {
            let [a, b] = [
                full.pmf(&point, light, triangle.mesh),
                less.pmf(&point, light, triangle.mesh),
            ];
            assert_eq!(
                a.to_bits(),
                b.to_bits(),
                "{seed}, {point:?}, light {light}: {a:e} and {b:e}"
            );
        }
        for number in 0..20_u32 {
            let number = hash(seed ^ hash(1000 * k + number));
            assert_eq!(full.sample(&point, number), less.sample(&point, number));
        }
    }
}

#[test]
fn two_sided_moments_have_the_bits_of_moments() {
    for seed in 0..60 {
        let params = [BuildParams::BALANCED, BuildParams::FAST, BuildParams::BEST][seed as usize % 3];
        equal_words::<8>(seed, params);
        equal_words::<4>(seed + 1000, params);
        equal_words::<16>(seed + 2000, params);
    }
}

/// Lights that shine from one side lose nothing but variance.
#[test]
fn two_sided_moments_lose_no_light() {
    for seed in 0..20 {
        let bvh = scene::<TwoSidedMomentNode<8>, Moments, 8>(seed, 0, BuildParams::BALANCED);
        bvh.validate()
            .unwrap_or_else(|violation| panic!("{seed}: {violation}"));
        let world = bvh.world_lights();
        for point in points(seed, &world) {
            let mut sum = 0.0;
            for (light, triangle) in (0..).zip(&world) {
                let pmf = bvh.pmf(&point, light, triangle.mesh);
                let shines = lightbvh::LightBounds::of_triangle(triangle).phi > 0.0;
                // World triangles round away area; what a mesh has of it, its tree holds.
                assert!(pmf > 0.0 || !shines, "{seed}, {point:?}, light {light}");
                sum += f64::from(pmf);
            }
            let dark = bvh.summary().phi == 0.0;
            assert!((sum - f64::from(u8::from(!dark))).abs() < 1e-6, "{seed}: {sum}");
        }
    }
}

/// A light BVH without trails goes on by edits as one with them, and says the same.
#[test]
fn samples_need_no_trails() {
    for seed in 0..20 {
        let mut with = scene::<MomentNode<8>, Moments, 8>(seed, seed % 2, BuildParams::BALANCED);
        let mut without = with.clone().without_trails();
        assert!(with.bytes() - without.bytes() >= 4 * with.triangles().len());
        assert!(without.memory() + 4 * with.triangles().len() <= with.memory());
        let random = &mut Random(seed);
        for step in 0..4 {
            let added = mesh(random, 1.0, 30, 0);
            let place = transform(random, 1.0);
            let edits = || {
                vec![
                    Edit::AddMesh {
                        triangles: added.clone(),
                    },
                    Edit::AddInstance {
                        mesh: lightbvh::MeshId::added(0),
                        transform: place,
                        radiance: 1.0,
                    },
                ]
            };
            with.apply(edits()).expect("a mesh");
            without.apply(edits()).expect("a mesh");
            with.refit();
            without.refit();
            without
                .validate()
                .unwrap_or_else(|violation| panic!("{seed}, {step}: {violation}"));
            assert!(with.nodes() == without.nodes());
            for point in points(seed + step, &with.world_lights()) {
                let number = random.below(1 << 24) << 8;
                assert_eq!(with.sample(&point, number), without.sample(&point, number));
                assert_eq!(
                    with.sample_many::<4>(&point, number),
                    without.sample_many::<4>(&point, number)
                );
            }
        }
    }
}

#[test]
fn static_light_bvhs_say_the_same_in_fewer_bytes() {
    type D = Defensive<Moments, 6>;
    for seed in 0..20 {
        let bvh = scene::<MomentNode<8>, D, 8>(seed, seed % 2, BuildParams::BALANCED);
        let still: StaticBvh<_, _, 8> = bvh.clone().into_static();
        assert_eq!(still.bytes(), bvh.bytes());
        // Not even the triangles.
        assert!(still.bytes() + 56 * bvh.triangles().len() <= bvh.memory());
        let world = bvh.world_lights();
        let points = points(seed, &world);
        let numbers: Vec<_> = (0..24_u32).map(|k| hash(seed + k).into()).collect();
        let mut batch = vec![lightbvh::SampledLight::NONE; points.len()];
        still.sample_batch(&points, &numbers, &mut batch);
        for ((point, &number), sampled) in points.iter().zip(&numbers).zip(batch) {
            assert_eq!(bvh.sample(point, number), still.sample(point, number));
            assert_eq!(sampled, still.sample(point, number));
            assert_eq!(
                bvh.sample_many::<3>(point, number),
                still.sample_many::<3>(point, number)
            );
            assert_eq!(
                still.pmf(point, sampled.light, sampled.instance).to_bits(),
                sampled.pmf.to_bits()
            );
        }
    }
    // A single level names no instance.
    let lights = Lights::new(mesh(&mut Random(1), 1.0, 50, 0)).expect("within the domain");
    let bvh = Bvh::<MomentNode<8>, D, 8>::single_level(&lights, &BuildParams::default());
    let (still, point) = (bvh.clone().into_static(), points(1, lights.triangles())[0]);
    for light in 0..50 {
        assert_eq!(
            bvh.pmf(&point, light, 0).to_bits(),
            still.pmf(&point, light, 0).to_bits()
        );
    }
}
