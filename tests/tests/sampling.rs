//! Sampling against an exhaustive oracle: the probabilities of all lights, evaluated one by one.

use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, ImportanceModel, LightNode, Lights,
    MomentNode, Moments, Random64, SampledLight, ShadingPoint, Summary,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{built, leaves, pmf_of};

mod several;

fn flux<N: LightNode<W>, const W: usize>(triangle: &EmissiveTriangle) -> f32 {
    N::Summary::of_light(triangle).phi()
}

/// Any 64 bits, as often as not the least or the greatest of those that begin alike.
fn number(random: &mut Random) -> Random64 {
    let (high, low) = (random.bits(), random.bits());
    let low = [low, low, 0, u32::MAX][random.below(4) as usize];
    let high = match random.below(16) {
        0 => 0,
        1 => u32::MAX,
        _ => high,
    };
    Random64 { high, low }
}

/// A share of 2^-H of the numbers chooses among all lights alike: out of the meshes alike, then out of a mesh's lights alike.
#[test]
fn a_defensive_mixture_keeps_the_uniform_share() {
    fn share<const H: u32>(two: bool) {
        let mut triangles = generate::small_triangles(100, 7, 10.0, 0.5, true, 3);
        // Lights that no importance thinks much of, and dark ones.
        for (i, triangle) in triangles.iter_mut().enumerate() {
            let factor = [1.0, 1e-28, 0.0][i % 3];
            triangle.radiance = triangle.radiance.map(|x| x * factor);
        }
        let lights = Lights::new(triangles).expect("lights");
        let bvh = built::<CompactNode<4>, 4>(&lights, &BuildParams::default(), two);
        let share = 0.5f64.powi(H as i32);
        let mut random = Random::new(H);
        for _ in 0..20 {
            let point = generate::point(&mut random, 10.0);
            for (light, triangle) in (0..).zip(lights.all()) {
                let uniform = if two {
                    1.0 / lights.mesh_count() as f64 / lights.mesh(triangle.mesh as usize).len() as f64
                } else {
                    0.01
                };
                let pmf = f64::from(pmf_of::<_, Defensive<Eq4, H>, _>(&bvh, &lights, &point, light));
                // Two divisions and a sum, each within 2^-24. By the tree's own share a probability lies between none
                // and 1 − 2^-H of all.
                let least = share * uniform * (1.0 - 3.0 * 2f64.powi(-24));
                assert!(pmf >= least, "{pmf} below {least}");
                if triangle.radiance == [0.0; 3] {
                    let most = share * uniform * (1.0 + 3.0 * 2f64.powi(-24));
                    assert!(pmf <= most, "{pmf} above {most}");
                }
            }
            // The first 2^-H of the numbers choose uniformly, the others by importance.
            let end = 1u64 << (64 - H);
            let light = |bits: u64| bvh.tree().by::<Defensive<Eq4, H>>().sample(&point, bits).light;
            assert_eq!(light(0), if two { bvh.tree().instances[0].first } else { 0 });
            assert_eq!(light(end - 1), 99);
            let first = leaves(&bvh.tree())
                .into_iter()
                .find(|&(i, _)| flux::<CompactNode<4>, 4>(&lights.all()[i as usize]) > 0.0);
            assert_eq!(Some(light(end)), first.map(|(triangle, _)| triangle));
        }
    }
    for two in [false, true] {
        share::<1>(two);
        share::<5>(two);
        share::<20>(two);
    }
}

/// Lights by their place in the order of the slots; the order of numbers is that of the lights.
fn places<N: LightNode<W>, const W: usize>(bvh: &Bvh<(N, ()), W>, lights: &Lights) -> Vec<usize> {
    let mut places = vec![usize::MAX; lights.all().len()];
    for (place, (triangle, _)) in leaves(&bvh.tree()).into_iter().enumerate() {
        places[triangle as usize] = place;
    }
    assert!(!places.contains(&usize::MAX), "a light without a leaf");
    places
}

fn scene(count: u32, seed: u32) -> Lights {
    let mut triangles = generate::small_triangles(count, 17, 10.0, 0.5, true, seed);
    for (i, triangle) in triangles.iter_mut().enumerate() {
        if i % 11 == 5 {
            triangle.radiance = [0.0; 3];
        }
        if i % 13 == 7 {
            triangle.radiance = triangle.radiance.map(|x| x * 1e-4);
        }
    }
    Lights::new(triangles).expect("lights")
}

/// The light is a monotone function of the number, so that its numbers are an interval; and the interval is the pmf of all
/// numbers, exactly. The interval's ends are found by bisection over the 2^64 numbers.
fn numbers_are_ordered<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    if I::UNIFORM_HALVINGS > 0 {
        return;
    }
    let lights = scene(150, 21);
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    let places = places(&bvh, &lights);
    let random = &mut Random::new(22);
    for _ in 0..3 {
        let point = generate::point(random, 10.0);
        let place = |bits: u64| places[bvh.tree().by::<I>().sample(&point, bits).light as usize];
        let mut numbers: Vec<u64> = (0..4000)
            .map(|_| u64::from(random.bits()) << 32 | u64::from(random.bits()))
            .collect();
        numbers.extend([0, u64::MAX]);
        numbers.sort_unstable();
        let sampled: Vec<usize> = numbers.iter().map(|&bits| place(bits)).collect();
        assert!(sampled.is_sorted(), "{} {W} at {point:?}", N::NAME);
        // The same by the upper half, whose lower half a hash fills in.
        let halves: Vec<usize> = numbers
            .iter()
            .map(|&bits| places[bvh.tree().by::<I>().sample(&point, (bits >> 32) as u32).light as usize])
            .collect();
        assert!(halves.is_sorted(), "{} {W} at {point:?}", N::NAME);

        let mut order: Vec<u32> = (0..lights.all().len() as u32).collect();
        order.sort_unstable_by_key(|&light| places[light as usize]);
        // The first number of a light from `place` on; 2^64 behind the last.
        let first = |wanted: usize| -> u128 {
            let (mut low, mut high) = (0u128, 1u128 << 64);
            while low < high {
                let middle = low + (high - low) / 2;
                if place(middle as u64) >= wanted {
                    high = middle;
                } else {
                    low = middle + 1;
                }
            }
            low
        };
        let ends: Vec<u128> = (0..=order.len()).map(first).collect();
        for (wanted, &light) in order.iter().enumerate() {
            let interval = ends[wanted + 1] - ends[wanted];
            let pmf = pmf_of::<_, I, _>(&bvh, &lights, &point, light);
            // Exact in f64: 24 bits times a power of two. Where it is no whole number, the numbers run out of bits, and the
            // interval's two ends are cut off below 2^-64 of all.
            let expected = f64::from(pmf) * 2f64.powi(64);
            let off = (interval as f64 - expected).abs();
            let most = if expected.fract() == 0.0 && expected >= 2f64.powi(22) {
                0.0
            } else {
                1.0
            };
            assert!(
                off <= most,
                "{} {W}: light {light} has {interval} numbers, expected {expected}, at {point:?}",
                N::NAME
            );
        }
    }
}

#[test]
fn numbers_are_lights_in_order() {
    each_layout!(numbers_are_ordered(false));
    each_layout!(numbers_are_ordered(true));
}
