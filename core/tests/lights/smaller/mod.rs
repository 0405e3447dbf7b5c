//! Models with less in them say the same: two-sided moments, no trails, no data for refits.

mod scenes;
mod static_meshes;

use bytemuck::cast_slice;
use lightbvh::bvh::StaticBvh;
use lightbvh::exact::hash;
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, EmissiveTriangle, Lights, MomentNode, Moments, Node,
    TwoSidedMomentNode,
};

use self::scenes::{mesh, points, scene, transform};
use crate::kit::Random;

/// Every word but those of the row of normals, of which one constant is known; every pmf, every sample.
fn equal_words<const W: usize>(seed: u32, params: BuildParams) {
    type D = Defensive<Moments, 6>;
    let full = scene::<MomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    let less = scene::<TwoSidedMomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    assert_eq!(full.nodes().len(), less.nodes().len());
    assert_eq!(full.top_nodes().len(), less.top_nodes().len());
    let of_full = full.nodes().iter().chain(full.top_nodes());
    for (full, less) in of_full.zip(less.nodes().iter().chain(less.top_nodes())) {
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
        let params = BuildParams::BALANCED;
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
            assert!(with.nodes() == without.nodes() && with.top_nodes() == without.top_nodes());
            for point in points(seed + step, &with.world_lights()) {
                let number = random.below(1 << 24) << 8;
                assert_eq!(with.sample(&point, number), without.sample(&point, number));
                assert_eq!(
                    with.sample_many::<_, 4>(&point, number),
                    without.sample_many::<_, 4>(&point, number)
                );
            }
        }
    }
}

/// An instance removed before the light BVH comes to rest takes no samples of those that stay.
#[test]
fn static_light_bvhs_forget_what_was_removed() {
    let mut bvh = scene::<MomentNode<8>, Moments, 8>(3, 0, BuildParams::BALANCED);
    let triangles = vec![EmissiveTriangle {
        p: [[0.0, 5.0, 0.0], [0.0, 5.0, 1.0], [1.0, 5.0, 0.0]],
        radiance: [1.0e6; 3],
        mesh: 0,
        flags: 0,
    }];
    let added = [
        Edit::AddMesh { triangles },
        Edit::AddInstance {
            mesh: lightbvh::MeshId::added(0),
            transform: lightbvh::Transform::IDENTITY,
            radiance: 1.0,
        },
    ];
    let instance = bvh.apply(added.into()).expect("a bright lamp").instances[0];
    bvh.refit();
    bvh.remove_instance(instance).expect("it is there");
    let still: StaticBvh<_, _, 8> = bvh.clone().into_static();
    bvh.refit();
    for point in points(3, &bvh.world_lights()) {
        for number in 0..64_u32 {
            let sampled = still.sample(&point, hash(number));
            assert_eq!(sampled, bvh.sample(&point, hash(number)));
            assert!(sampled.pmf > 0.0);
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
    let bvh = Bvh::<MomentNode<8>, D, 8>::single_level(&lights, &BuildParams::default());
    let (still, point) = (bvh.clone().into_static(), points(1, lights.triangles())[0]);
    for light in 0..50 {
        assert_eq!(
            bvh.pmf(&point, light, 0).to_bits(),
            still.pmf(&point, light, 0).to_bits()
        );
    }
}
