//! Scenes whose trees become deeper than a word of trail is long, while shallow ones are there already.

use lightbvh::{
    Bvh, CompactNode, EmissiveTriangle, Eq4, FullNode, Heuristic, ImportanceModel, LightNode, ShadingPoint,
    Transform, exact,
};
use lightbvh_tests::edits::{add_instance, add_mesh};
use lightbvh_tests::generate::{self, Random, split};
use lightbvh_tests::oracle::assert_sum_is_one;

/// Each light at half the distance from the origin of the one before.
fn halving(count: i32) -> Vec<EmissiveTriangle> {
    let light = |i: i32| {
        let x = exact::pow2(20 - i);
        EmissiveTriangle {
            p: [[x, 0.0, 0.0], [x, 0.125 * x, 0.0], [x, 0.0, 0.125 * x]],
            radiance: [exact::pow2(2 * i - 20); 3],
            mesh: 0,
            flags: 1,
        }
    };
    (0..count).map(light).collect()
}

fn check<N: LightNode<W>, const W: usize>()
where
    Eq4: ImportanceModel<N, W>,
{
    let mut scene = Bvh::<N, (), W>::new(split(Heuristic::Sah, 2));
    let mut random = Random::new(1);
    let mut instances = Vec::new();
    for (count, words) in [(5, 1), (60, 2), (7, 2)] {
        let triangles = if count < 60 {
            generate::small_triangles(count as u32, 100, 1.0, 0.1, false, 3)
        } else {
            halving(count)
        };
        let mesh = add_mesh(&mut scene, triangles);
        let place = Transform::at([0.0, 0.0, count as f32]);
        instances.push(add_instance(&mut scene, mesh, place));
        scene.refit();
        let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
        assert_eq!(scene.tree().trail_words, words, "{} levels", stats.depth);
        assert_eq!(
            scene.tree().trails.len(),
            scene.triangles().len() * words as usize
        );
        for _ in 0..20 {
            let point = ShadingPoint {
                n: [0.0; 3],
                ..generate::point(&mut random, 4.0)
            };
            let mut pmfs = Vec::new();
            for &id in &instances {
                for light in scene.lights_of(id).expect("it is there") {
                    pmfs.push(scene.by::<Eq4>().pmf(&point, light, id.index()));
                }
            }
            assert_sum_is_one::<N, Eq4, W>(pmfs, &point);
            let sampled = scene.by::<Eq4>().sample(&point, random.bits());
            let pmf = instances
                .iter()
                .map(|&id| scene.by::<Eq4>().pmf(&point, sampled.light, id.index()));
            assert_eq!(pmf.fold(0.0, f32::max).to_bits(), sampled.pmf.to_bits());
        }
    }
}

#[test]
fn width_2() {
    check::<CompactNode<2>, 2>();
    check::<FullNode<2>, 2>();
}

#[test]
fn width_4() {
    check::<CompactNode<4>, 4>();
}
