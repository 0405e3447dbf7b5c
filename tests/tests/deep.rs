//! Trees as deep as trails are long. Probabilities in them are rows of `lightbvh stability`.

use lightbvh::device::trail::max_levels;
use lightbvh::{
    BuildParams, Bvh, CompactNode, EmissiveTriangle, Eq4, Heuristic, ImportanceModel, LightNode, Lights,
    ShadingPoint, Transform, exact,
};
use lightbvh_tests::each_node;
use lightbvh_tests::generate::{self, Random, split};
use lightbvh_tests::oracle::sum_is_one;

fn triangle(corner: [f32; 3], size: f32, radiance: f32, mesh: u32) -> EmissiveTriangle {
    let [x, y, z] = corner;
    EmissiveTriangle {
        p: [corner, [x, y + size, z], [x, y, z + size]],
        radiance: [radiance; 3],
        mesh,
        flags: 1,
    }
}

/// `count` lights, each at half the distance from the origin of the one before, in meshes of `per_mesh`.
pub fn shrinking(count: u32, per_mesh: u32, brighter: bool) -> Lights {
    let light = |i: u32| {
        let x = exact::pow2(38 - i as i32);
        // Radiance as the inverse square of the size gives all the same flux, or each twice that of the one before.
        let flux = if brighter { exact::pow2(i as i32 - 60) } else { 1.0 };
        let size = if i > 120 { 0.0 } else { x * 0.125 };
        triangle([x, 0.0, 0.0], size.max(exact::pow2(-40)), flux, i / per_mesh)
    };
    Lights::new((0..count).map(light).collect()).expect("within the domain")
}

/// Boxes one within the other: triangles around the origin, each half as large as the one before.
fn nested(count: u32) -> Lights {
    let light = |i: u32| {
        let s = exact::pow2(38 - i as i32);
        let mut t = triangle([-s; 3], 3.0 * s, 1.0, i);
        t.p[1][0] = s;
        t
    };
    Lights::new((0..count).map(light).collect()).expect("within the domain")
}

/// Mesh lights at halving distances along x, the triangles of each at halving distances along y: deep in both levels.
fn deep_in_both(meshes: u32, triangles: u32) -> Lights {
    let light = |i: u32| {
        let (m, t) = (i / triangles, i % triangles);
        let (x, y) = (exact::pow2(20 - m as i32), exact::pow2(20 - t as i32));
        triangle([x, y, 0.0], y * 0.125, 1.0, m)
    };
    Lights::new((0..meshes * triangles).map(light).collect()).expect("within the domain")
}

/// Valid trees of `lights` within the levels of a trail; the depth of the deepest single level.
fn deepest(lights: &Lights) -> u32 {
    fn within<N: LightNode<W>, const W: usize>(lights: &Lights, params: &BuildParams, deepest: &mut u32) {
        for bvh in [
            Bvh::<(N, ()), W>::two_level(lights, params),
            Bvh::single_level(lights, params),
        ] {
            bvh.view().validate().expect("valid");
            let (depth, is_single) = (bvh.view().depth(), bvh.view().is_single_level());
            let levels = if is_single { 1 } else { 2 };
            assert!(depth <= levels * max_levels(W), "depth {depth}");
            if is_single {
                *deepest = depth.max(*deepest);
            }
        }
    }
    let mut deepest = 0;
    for heuristic in [Heuristic::Sah, Heuristic::Saoh] {
        for buckets in [2, 16] {
            let params = split(heuristic, buckets);
            within::<CompactNode<2>, 2>(lights, &params, &mut deepest);
            each_node!(within(lights, &params, &mut deepest));
        }
    }
    deepest
}

#[test]
fn trees_stay_within_the_levels_of_a_trail() {
    for (lights, least) in [
        (shrinking(78, 1, false), 33),
        (shrinking(78, 78, false), 33),
        (shrinking(78, 9, true), 0),
        // More halvings than a trail has levels: the builder must make the parts equal before it runs out of them.
        (shrinking(130, 130, false), 33),
        (nested(70), 4),
    ] {
        let found = deepest(&lights);
        assert!((least..=64).contains(&found), "{found} levels");
    }
    let lights = deep_in_both(48, 48);
    let bvh = Bvh::<(CompactNode<2>, ()), 2>::two_level(&lights, &split(Heuristic::Sah, 2));
    bvh.view().validate().expect("valid");
    assert!(bvh.view().depth() > 2 * 33, "only {} levels", bvh.view().depth());
    assert_eq!(bvh.tree().trail_words, 2);
}

/// A scene whose trails grow to two words when a deep mesh comes, while shallow ones are there already.
fn grown<N: LightNode<W>, const W: usize>()
where
    Eq4: ImportanceModel<N, W>,
{
    let mut scene = Bvh::<(N, ()), W>::new(split(Heuristic::Sah, 2));
    let mut random = Random::new(1);
    let mut instances = Vec::new();
    for (count, words) in [(5, 1), (60, 2), (7, 2)] {
        let triangles = match count {
            60 => shrinking(count, count, true).all().to_vec(),
            _ => generate::small_triangles(count, 100, 1.0, 0.1, false, 3),
        };
        let mesh = scene.add_mesh(triangles).expect("a mesh");
        let at = Transform::at([0.0, 0.0, count as f32]);
        instances.push(scene.add_instance(mesh, at).expect("an instance"));
        scene.refit();
        scene.view().validate().expect("valid");
        assert_eq!(scene.tree().trail_words, words, "{count} lights");
        let lights = scene.view().lights().len();
        assert_eq!(scene.tree().trails.len(), lights * words as usize);
        for _ in 0..20 {
            let d = exact::pow2(38 - random.below(100) as i32);
            let point = ShadingPoint {
                p: random.direction().map(|x| x * d),
                n: [0.0; 3],
            };
            let tree = scene.tree().by::<Eq4>();
            let sampled = tree.sample(&point, random.bits());
            assert_eq!(
                tree.pmf(&point, sampled.light, sampled.instance).to_bits(),
                sampled.pmf.to_bits()
            );
            let mut pmfs = Vec::new();
            for &id in &instances {
                let lights = scene.view().lights_of(id).expect("there");
                pmfs.extend(lights.map(|light| tree.pmf(&point, light, id.index())));
            }
            sum_is_one(&pmfs, 0, &point);
        }
    }
}

#[test]
fn trails_grow_with_a_deep_mesh() {
    grown::<CompactNode<2>, 2>();
    grown::<CompactNode<4>, 4>();
}
