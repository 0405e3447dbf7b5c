//! Trees that are dead almost everywhere: every inner child has importance, few lights have. Each light that can be reached
//! is found, however many dead ends lie before it, and gets the probability of those that pass theirs on to it.

use std::cell::RefCell;

use glam::Vec3;
use lightbvh::importance::{Cluster, Importance};
use lightbvh::{
    BuildParams, FullNode, ImportanceModel, LightBvh, LightNode, Lights, MeshLeaf, Receiver, ShadingPoint,
};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::sum_tolerance;

thread_local! {
    /// Corners of the lights that can be reached.
    static REACHABLE: RefCell<Vec<Vec3>> = const { RefCell::new(Vec::new()) };
}

/// Importance 1 for every child but lights, which have it where they are told to.
struct Told;

impl ImportanceModel for Told {
    fn importance<R: Receiver>(cluster: &Cluster, _: &R) -> Importance {
        // The lights are smaller, and farther from each other.
        let light = cluster.extent.max_element() < 1e-3;
        let told = |&at: &Vec3| (cluster.center - at).length() < 0.01;
        let reached = !light || REACHABLE.with_borrow(|all| all.iter().any(told));
        Importance {
            significand: if reached { 1.0 } else { 0.0 },
            exponent: 0,
        }
    }
}

const ANYWHERE: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0; 3],
};

/// One light in each unit cube of a grid of 8³, in meshes of 16.
fn lights() -> Lights {
    let mut random = Random::new(1);
    let mut triangles = generate::small_triangles(512, 16, 1.0, 1e-4, false, 2);
    for (i, triangle) in triangles.iter_mut().enumerate() {
        let cell = [i % 8, i / 8 % 8, i / 64].map(|k| k as f32 + random.between(0.3, 0.7));
        let corner = triangle.p[0];
        triangle.p = triangle
            .p
            .map(|p| std::array::from_fn(|k| p[k] - corner[k] + cell[k]));
        // Random directions: no inner child shrinks to a light's size, for no two lights touch.
        triangle.radiance = [1.0; 3];
    }
    Lights::new(triangles).expect("lights")
}

fn check<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    bvh: &LightBvh<N, W, L>,
    lights: &Lights,
    count: usize,
) {
    let mut random = Random::new(count as u32);
    for _ in 0..4 {
        let told: Vec<u32> = (0..count).map(|_| random.below(512)).collect();
        REACHABLE.set(
            told.iter()
                .map(|&i| lights.triangles()[i as usize].vertex(0))
                .collect(),
        );
        let pmfs: Vec<f32> = (0..512).map(|i| bvh.pmf::<Told>(lights, &ANYWHERE, i)).collect();
        for (i, &pmf) in (0..).zip(&pmfs) {
            assert_eq!(pmf > 0.0, told.contains(&i), "light {i} of {told:?}: {pmf}");
        }
        let sum: f64 = pmfs.iter().map(|&pmf| f64::from(pmf)).sum();
        // Adopted probabilities come one by one, each rounded.
        let tolerance = 64.0 * sum_tolerance(bvh.depth());
        assert!((sum - 1.0).abs() < tolerance, "{told:?}: sum {sum}");
        for _ in 0..50 {
            let sampled = bvh.sample::<Told>(&ANYWHERE, random.bits());
            assert!(told.contains(&sampled.light), "{sampled:?} of {told:?}");
            assert_eq!(
                sampled.pmf.to_bits(),
                pmfs[sampled.light as usize].to_bits(),
                "{sampled:?}"
            );
        }
    }
}

fn of_width<N: LightNode<W>, const W: usize>() {
    let lights = lights();
    let params = BuildParams::default();
    for count in [1, 2, 5, 60] {
        check(&LightBvh::<N, W>::single_level(&lights, &params), &lights, count);
        check(&LightBvh::<N, W>::two_level(&lights, &params), &lights, count);
    }
}

#[test]
fn width_2() {
    of_width::<FullNode<2>, 2>();
}

#[test]
fn width_4() {
    of_width::<FullNode<4>, 4>();
}

#[test]
fn width_16() {
    of_width::<FullNode<16>, 16>();
}
