//! Builds, refits and picks of single trees.

use lightbvh::climb::{Plan, parents};
use lightbvh::{
    BuildParams, CompactNode, EmissiveTriangle, Eq4, FluxOverDistance, FullNode, Heuristic, ImportanceModel,
    Instance, LightBvh, LightNode, Lights, MeshLeaf, ShadingPoint, exact,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle, moved};

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
