//! Builds, refits and picks of single trees.

use lightbvh::build::Effort;
use lightbvh::{
    BuildParams, CompactNode, Defensive, EmissiveTriangle, Eq4, FluxOverDistance, FullNode, Heuristic,
    ImportanceModel, LightBvh, LightNode, Lights, MomentNode, Moments, Random64, SampledLight, ShadingPoint,
    exact,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle, moved, split};

use super::digest::Digest;

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

fn tree<N: LightNode<W>, const W: usize>(digest: &mut Digest, bvh: &LightBvh<N, W>) {
    let tree = bvh.tree();
    digest.words(tree.nodes);
    digest.words(tree.instances);
    digest.words(tree.trails);
    digest.words(bvh.roots());
    [
        tree.root,
        tree.trail_words,
        tree.live,
        tree.lights,
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
    digest.summary(&bvh.summary());
}

fn picks<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    digest: &mut Digest,
    bvh: &LightBvh<N, W>,
    lights: &Lights,
) {
    let mut random = Random::new(29);
    for point in points() {
        let numbers: [Random64; 6] = std::array::from_fn(|_| Random64 {
            high: random.bits(),
            low: random.bits(),
        });
        let mut sampled = [SampledLight::NONE; 6];
        bvh.sample_batch::<I>(&[point; 6], &numbers, &mut sampled);
        for (number, sampled) in numbers.into_iter().zip(sampled) {
            assert_eq!(bvh.sample::<I>(&point, number), sampled);
            digest.word(sampled.light);
            digest.float(sampled.pmf);
        }
        let sampled = bvh.sample::<I>(&point, random.bits());
        digest.word(sampled.light);
        for _ in 0..6 {
            let light = random.below(lights.triangles().len() as u32);
            digest.float(bvh.pmf::<I>(lights, &point, light));
        }
    }
}

/// Builds, refits and picks: digests of each.
fn bvh<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(known: [u64; 3]) {
    let what = |step| format!("{} of width {W}, {step}", N::NAME);
    let lights = lights();
    let later = moved(&lights, 31);
    let (mut built, mut refitted, mut picked) = (Digest::new(), Digest::new(), Digest::new());
    for heuristic in [
        Heuristic::Sah,
        Heuristic::Saoh,
        Heuristic::Ward,
        Heuristic::Morton,
    ] {
        for (buckets, effort) in [(2, Effort::Usual), (16, Effort::Usual), (32, Effort::Most)] {
            let params = BuildParams {
                effort,
                ..split(heuristic, buckets)
            };
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
                picks::<N, I, W>(&mut picked, &bvh, &lights);
                bvh.refit(&later);
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
        0x762c_2c16_4373_3bd7,
        0xfb5a_28db_83f4_9913,
        0x48e6_7282_f42f_30fd,
    ]);
    bvh::<CompactNode<4>, Eq4, 4>([
        0x6a28_b42e_4569_c10d,
        0x8f3e_3f10_121b_a674,
        0xfd91_b366_95d4_62e4,
    ]);
    bvh::<CompactNode<16>, Defensive<Eq4, 5>, 16>([
        0xd7c7_50d6_e18a_c5f5,
        0x2241_f853_e25f_6eb6,
        0xc32e_cb25_93ab_af73,
    ]);
}

#[test]
fn full_nodes() {
    bvh::<FullNode<2>, Eq4, 2>([
        0x362b_e094_d7e6_bf3b,
        0x9007_d3d6_77cf_46de,
        0x3288_aca9_d32a_e0b5,
    ]);
    bvh::<FullNode<8>, Eq4, 8>([
        0xa172_9253_ae37_e973,
        0x5884_909c_55f0_dd19,
        0x4ddc_5f96_2190_c589,
    ]);
}

#[test]
fn moment_nodes() {
    bvh::<MomentNode<4>, Moments, 4>([
        0x3f35_f3a9_587f_5121,
        0x4d47_022c_f3b7_4547,
        0xb724_ac5e_bdd6_1a6b,
    ]);
    bvh::<MomentNode<8>, Defensive<Moments, 6>, 8>([
        0xaa2a_91b1_8600_69b3,
        0xdcf9_0266_ccfe_f568,
        0x7a50_4e7b_ff3d_936c,
    ]);
}
