//! Builds, refits and picks of single trees.

use lightbvh::bvh::Cursor;
use lightbvh::device::bvh::follow;
use lightbvh::{
    Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, FluxOverDistance, Heuristic, ImportanceModel,
    LightNode, Lights, MomentNode, Moments, Random64, SampledLight, ShadingPoint, exact,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle, moved, split};
use lightbvh_tests::oracle::pmf_of;

use super::digest::Digest;

/// Small lights in clusters, some two-sided, some bright; a few of every extreme kind.
pub fn lights() -> Lights {
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
pub fn points() -> Vec<ShadingPoint> {
    let mut random = Random::new(23);
    let mut points: Vec<ShadingPoint> = (0..40).map(|_| generate::point(&mut random, 20.0)).collect();
    for (i, t) in lights().all().iter().enumerate().step_by(23) {
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

fn tree<N: LightNode<W>, const W: usize>(digest: &mut Digest, bvh: &Bvh<(N, ()), W>) {
    let tree = bvh.tree();
    digest.words(tree.nodes);
    digest.words(bvh.view().top_nodes());
    digest.words(tree.links.above);
    digest.words(tree.links.places);
    digest.words(tree.instances);
    digest.words(tree.trails);
    digest.words(bvh.view().roots());
    [
        tree.root,
        tree.trail_words,
        tree.live,
        tree.lights,
        bvh.view().depth(),
        bvh.view().bytes() as u32,
    ]
    .into_iter()
    .for_each(|word| digest.word(word));
    let plan = Cursor::default().plan(bvh);
    for levels in [&plan.bottom, &plan.top] {
        digest.words(levels.nodes());
        levels.ranges().for_each(|range| digest.word(range.end as u32));
    }
    digest.summary(&bvh.view().summary());
}

fn picks<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    digest: &mut Digest,
    bvh: &Bvh<(N, ()), W>,
    lights: &Lights,
) {
    let mut random = Random::new(29);
    for point in points() {
        let numbers: [Random64; 6] = std::array::from_fn(|_| Random64 {
            high: random.bits(),
            low: random.bits(),
        });
        let mut sampled = [SampledLight::NONE; 6];
        bvh.tree()
            .by::<I>()
            .sample_batch(&[point; 6], &numbers, &mut sampled);
        for (number, sampled) in numbers.into_iter().zip(sampled) {
            assert_eq!(bvh.tree().by::<I>().sample(&point, number), sampled);
            digest.word(sampled.light);
            digest.float(sampled.pmf);
        }
        let sampled = bvh.tree().by::<I>().sample(&point, random.bits());
        digest.word(sampled.light);
        for _ in 0..6 {
            let light = random.below(lights.all().len() as u32);
            digest.float(pmf_of::<_, I, _>(bvh, lights, &point, light));
        }
    }
}

/// Builds, refits and picks: digests of each.
fn bvh<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(known: [u64; 3]) {
    let what = |step| format!("{} of width {W}, {step}", N::NAME);
    let lights = lights();
    let later = moved(&lights, 31);
    let (mut built, mut refitted, mut picked) = (Digest::new(), Digest::new(), Digest::new());
    for heuristic in [Heuristic::Sah, Heuristic::Saoh, Heuristic::Ward] {
        for buckets in [2, 16, 32] {
            let params = split(heuristic, buckets);
            for two in [false, true] {
                let mut bvh = if two {
                    Bvh::<(N, ()), W>::two_level(&lights, &params)
                } else {
                    Bvh::<(N, ()), W>::single_level(&lights, &params)
                };
                tree(&mut built, &bvh);
                if buckets != 16 {
                    continue;
                }
                picks::<N, I, W>(&mut picked, &bvh, &lights);
                follow(&mut bvh, &later).expect("as many lights");
                tree(&mut refitted, &bvh);
                picks::<N, I, W>(&mut picked, &bvh, &later);
                picks::<N, FluxOverDistance, W>(&mut picked, &bvh, &later);
            }
        }
    }
    built.is(known[0], &what("built"));
    refitted.is(known[1], &what("refitted"));
    picked.is(known[2], &what("sampled"));
}

#[test]
fn compact_nodes() {
    bvh::<CompactNode<2>, Eq4, 2>([
        0xa123_ece7_983e_00a3,
        0xedde_6b21_9602_798f,
        0x4290_44f4_43e1_6785,
    ]);
    bvh::<CompactNode<4>, Eq4, 4>([
        0x4322_3421_72e1_a753,
        0x0d28_0238_12f9_6417,
        0x047f_da30_841f_a83c,
    ]);
    bvh::<CompactNode<16>, Defensive<Eq4, 5>, 16>([
        0xa950_a6d5_65e4_b812,
        0x1984_eb8e_b84a_4eec,
        0xb89a_4164_7e8f_77b3,
    ]);
}

#[test]
fn moment_nodes() {
    bvh::<MomentNode<4>, Moments, 4>([
        0x431d_cacd_3174_20c0,
        0xcd49_acaa_873f_9cdd,
        0x1448_b4d7_c7ee_b224,
    ]);
    bvh::<MomentNode<8>, Defensive<Moments, 6>, 8>([
        0x4e63_5197_28c9_54ec,
        0x960a_0c68_f616_d477,
        0xa462_a9aa_3687_6688,
    ]);
}
