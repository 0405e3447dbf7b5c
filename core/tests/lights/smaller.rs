//! Models with less in them say the same: two-sided moments, no data for refits.

use bytemuck::cast_slice;
use lightbvh::bvh::StaticBvh;
use lightbvh::exact::{self, hash, pow2};
use lightbvh::{
    BuildParams, Bvh, Defensive, EmissiveTriangle, LightNode, Lights, MomentNode, Moments, Node,
    ShadingPoint, Transform, TwoSidedMomentNode,
};

use crate::kit::Random;

type D = Defensive<Moments, 6>;

type Default8 = Bvh<MomentNode<8>, D, 8>;

/// Triangles of sizes and fluxes far apart, some without radiance, in a cube of 2 `size`; `flags` as given.
fn mesh(random: &mut Random, size: f32, count: u32, flags: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let (own, at) = (random.triangle(), random.within(size));
        let edge = size * pow2(-(random.below(20) as i32));
        let brighter = pow2(random.below(70) as i32 - 35);
        EmissiveTriangle {
            p: own.p.map(|v| [0, 1, 2].map(|k| at[k] + v[k] * edge)),
            radiance: own.radiance.map(|x| x * brighter),
            mesh: 0,
            flags,
        }
    };
    (0..count).map(triangle).collect()
}

/// Any map, flat ones too.
fn place(random: &mut Random, size: f32) -> Transform {
    let mut place = random.similarity(4.0 * size, 1.0);
    match random.below(3) {
        0 => place.columns = [0; 3].map(|_| random.within(2.0)),
        1 => place.columns[1] = [0.0; 3],
        _ => {}
    }
    place
}

/// The same meshes, instances and moves in any light BVH.
fn scene<N: LightNode<W>, I, const W: usize>(seed: u32, flags: u32) -> Bvh<N, I, W> {
    let random = &mut Random(seed.wrapping_mul(7919));
    let size = pow2(random.below(60) as i32 - 30);
    let mut bvh = Bvh::new(BuildParams::BALANCED);
    let mut instances = Vec::new();
    for _ in 0..1 + random.below(3) {
        let count = 1 + random.below(60);
        let own = bvh.add_mesh(mesh(random, size, count, flags)).expect("lights");
        for _ in 0..1 + random.below(4) {
            let id = bvh.add_instance(own, place(random, size)).expect("a mesh");
            let factor = [1.0, 0.25, 0.0][random.below(3) as usize];
            bvh.set_radiance(id, [factor; 3]).expect("a factor");
            instances.push(id);
        }
    }
    bvh.refit();
    // Refits, and a top level that edits have patched.
    for id in instances {
        if random.below(3) == 0 {
            bvh.set_transform(id, place(random, size)).expect("there");
        }
    }
    bvh.refit();
    bvh
}

fn points(seed: u32, lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random(seed.wrapping_mul(104_729));
    let point = |_| {
        let near = lights[random.below(lights.len() as u32) as usize].p[0];
        let mut point = random.point(near.into_iter().map(exact::abs).fold(pow2(-30), exact::max));
        (0..3).for_each(|k| point.p[k] += near[k]);
        point.checked().expect("a shading point")
    };
    (0..24).map(point).collect()
}

/// Every word but those of the row of normals, of which one constant is known; every pmf, every sample.
fn equal_words<const W: usize>(seed: u32) {
    let full = scene::<MomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED);
    let less = scene::<TwoSidedMomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED);
    assert_eq!(full.nodes().len(), less.nodes().len());
    assert_eq!(full.top_nodes().len(), less.top_nodes().len());
    let of_full = full.nodes().iter().chain(full.top_nodes());
    for (full, less) in of_full.zip(less.nodes().iter().chain(less.top_nodes())) {
        let a: &[u32] = cast_slice(std::slice::from_ref(full));
        let b: &[u32] = cast_slice(std::slice::from_ref(less));
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
            let a = full.pmf(&point, light, triangle.mesh);
            let b = less.pmf(&point, light, triangle.mesh);
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
        equal_words::<8>(seed);
        equal_words::<4>(seed + 1000);
        equal_words::<16>(seed + 2000);
    }
}

/// Lights that shine from one side lose nothing but variance.
#[test]
fn two_sided_moments_lose_no_light() {
    for seed in 0..20 {
        let bvh = scene::<TwoSidedMomentNode<8>, Moments, 8>(seed, 0);
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

/// A static light BVH says the same in fewer bytes, also without an instance that was removed just before.
#[test]
fn static_light_bvhs_say_the_same() {
    for seed in 0..20 {
        let mut bvh = scene::<MomentNode<8>, D, 8>(seed, seed % 2);
        let bright = EmissiveTriangle {
            radiance: [1.0e6; 3],
            ..Random(seed).triangle()
        };
        let mesh = bvh.add_mesh(vec![bright]).expect("a bright lamp");
        let instance = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
        bvh.refit();
        bvh.remove_instance(instance).expect("it is there");
        let still: StaticBvh<_, _, 8> = bvh.clone().into_static();
        bvh.refit();
        assert_eq!(still.bytes(), bvh.bytes());
        // Not even the triangles.
        assert!(still.bytes() + 56 * bvh.triangles().len() <= bvh.memory());
        let points = points(seed, &bvh.world_lights());
        let numbers: Vec<_> = (0..24_u32).map(|k| hash(seed + k).into()).collect();
        let mut batch = vec![lightbvh::SampledLight::NONE; points.len()];
        still.sample_batch(&points, &numbers, &mut batch);
        for ((point, &number), sampled) in points.iter().zip(&numbers).zip(batch) {
            assert_eq!(bvh.sample(point, number), sampled);
            assert_eq!(still.sample(point, number), sampled);
            assert_eq!(
                bvh.sample_many::<_, 3>(point, number),
                still.sample_many::<_, 3>(point, number)
            );
            assert_eq!(
                still.pmf(point, sampled.light, sampled.instance).to_bits(),
                sampled.pmf.to_bits()
            );
        }
    }
    // A single level names no instance.
    let lights = Lights::new(mesh(&mut Random(1), 1.0, 50, 0)).expect("within the domain");
    let bvh = Default8::single_level(&lights, &BuildParams::default());
    let (still, point) = (bvh.clone().into_static(), points(1, lights.triangles())[0]);
    for light in 0..50 {
        let pmfs = [bvh.pmf(&point, light, 0), still.pmf(&point, light, 0)];
        assert_eq!(pmfs[0].to_bits(), pmfs[1].to_bits());
    }
}
