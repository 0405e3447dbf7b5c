//! Models with less in them: nodes without mean normals, no data for refits. That those nodes have the bits of others, the tests of
//! moments in `core/src` show.

use lightbvh::bvh::StaticBvh;
use lightbvh::exact::hash;
use lightbvh::{
    BuildParams, Bvh, Defensive, EmissiveTriangle, MomentNode, Moments, SampledLight, ShadingPoint,
    TwoSidedMomentNode,
};

use crate::kit::{Random, room};

type Default8 = Bvh<MomentNode<8>, Defensive<Moments, 6>, 8>;

/// Lights that shine from one side lose nothing but variance.
#[test]
fn two_sided_moments_lose_no_light() {
    let random = &mut Random(3);
    let lights = room(random);
    let bvh = Bvh::<TwoSidedMomentNode<8>, Moments, 8>::two_level(&lights, &BuildParams::default());
    bvh.validate().expect("nodes are what refit makes");
    for _ in 0..100 {
        let point = random.point(8.0);
        let of = |(light, own): (u32, &EmissiveTriangle)| bvh.pmf(&point, light, own.mesh);
        let pmfs: Vec<f32> = (0..).zip(lights.triangles()).map(of).collect();
        assert!(pmfs.iter().all(|&pmf| pmf > 0.0), "{point:?}");
        let sum: f64 = pmfs.into_iter().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum} at {point:?}");
    }
}

/// A static light BVH says the same in fewer bytes, also without an instance that was removed just before.
#[test]
fn static_light_bvhs_say_the_same() {
    for seed in 0..20 {
        let random = &mut Random(1000 * seed);
        let mut bvh = Default8::two_level(&room(random), &BuildParams::BALANCED);
        let bright = EmissiveTriangle {
            radiance: [1.0e6; 3],
            ..random.triangle()
        };
        let mesh = bvh.add_mesh(vec![bright; 9]).expect("bright lamps");
        let placed = [0; 3].map(|_| bvh.add_instance(mesh, random.similarity(9.0, 1.0)));
        bvh.refit();
        bvh.remove_instance(placed[1].clone().expect("a mesh"))
            .expect("it is there");
        let still: StaticBvh<_, _, 8> = bvh.clone().into_static();
        bvh.refit();
        assert_eq!(still.bytes(), bvh.bytes());
        // Not even the triangles.
        assert!(still.bytes() + 56 * bvh.triangles().len() <= bvh.memory());
        let points: Vec<ShadingPoint> = (0..24).map(|_| random.point(9.0)).collect();
        let numbers: Vec<_> = (0..24_u32).map(|k| hash(seed + k).into()).collect();
        let mut batch = vec![SampledLight::NONE; points.len()];
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
    let random = &mut Random(1);
    let bvh = Default8::single_level(&room(random), &BuildParams::default());
    let (still, point) = (bvh.clone().into_static(), random.point(5.0));
    for light in 0..200 {
        let pmfs = [bvh.pmf(&point, light, 0), still.pmf(&point, light, 0)];
        assert_eq!(pmfs[0].to_bits(), pmfs[1].to_bits());
    }
}
