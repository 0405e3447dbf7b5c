//! Sampling against an exhaustive oracle: the probabilities of all lights, evaluated one by one.

use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, Heuristic, INVALID, ImportanceModel,
    LightNode, LightTree, Lights, Random64, SampledLight, ShadingPoint, Summary,
};
use lightbvh_host::stability::geometry::contribution;
use lightbvh_tests::each_layout;
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{all_pmfs, assert_sum_is_one, leaves, pmf_of};
use lightbvh_tests::statistics::{chi_squared, chi_squared_quantile};
use proptest::prelude::*;

fn built<N: LightNode<W>, const W: usize>(lights: &Lights, params: &BuildParams, two: bool) -> Bvh<N, (), W> {
    if two {
        Bvh::two_level(lights, params)
    } else {
        Bvh::single_level(lights, params)
    }
}

fn flux<N: LightNode<W>, const W: usize>(triangle: &EmissiveTriangle) -> f32 {
    N::Summary::of_triangle(triangle).phi()
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

/// Every light with flux has a probability, wherever the point is and whichever way it looks; they sum to one; and samples come
/// with them, to the bit.
fn check<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &Lights,
    params: &BuildParams,
    two: bool,
    seed: u32,
) {
    let random = &mut Random::new(seed);
    let bvh = built::<N, W>(lights, params, two);
    let shines: Vec<bool> = lights
        .triangles()
        .iter()
        .map(|light| flux::<N, W>(light) > 0.0)
        .collect();
    let any = shines.contains(&true);
    for _ in 0..4 {
        let point = generate::point(random, 10.0);
        let pmfs = all_pmfs::<N, I, W>(&bvh, lights, &point);
        if any {
            assert_sum_is_one::<N, I, W>(pmfs.iter().copied(), &point);
        }
        for (light, (&pmf, &shines)) in pmfs.iter().zip(&shines).enumerate() {
            let expected = shines || I::UNIFORM_HALVINGS > 0;
            assert_eq!(pmf > 0.0, expected, "{} {W}: light {light} at {point:?}", N::NAME);
        }
        let count = pmfs.len() as u32;
        assert_eq!(pmf_of::<_, I, _>(&bvh, lights, &point, count), 0.0);
        for _ in 0..32 {
            let sampled = bvh.by::<I>().sample(&point, number(random));
            assert!(!any || sampled.light < count, "no light at {point:?}");
            let expected = pmfs.get(sampled.light as usize).copied().unwrap_or(0.0);
            assert_eq!(
                sampled.pmf.to_bits(),
                expected.to_bits(),
                "{} {W}: light {} at {point:?}",
                N::NAME,
                sampled.light
            );
            assert_eq!(sampled.pmf > 0.0, sampled.light != INVALID);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pmfs_and_samples(lights in generate::lights(150), seed: u32, two: bool, sah: bool) {
        let heuristic = if sah { Heuristic::Sah } else { BuildParams::default().heuristic };
        let params = BuildParams { heuristic, ..BuildParams::default() };
        each_layout!(check(&lights, &params, two, seed));
    }
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
            for (light, triangle) in (0..).zip(lights.triangles()) {
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
            let light = |bits: u64| bvh.by::<Defensive<Eq4, H>>().sample(&point, bits).light;
            assert_eq!(light(0), if two { bvh.tree().instances[0].first } else { 0 });
            assert_eq!(light(end - 1), 99);
            let first = leaves(&bvh.tree())
                .into_iter()
                .find(|&(i, _)| flux::<CompactNode<4>, 4>(&lights.triangles()[i as usize]) > 0.0);
            assert_eq!(Some(light(end)), first.map(|(triangle, _)| triangle));
        }
    }
    for two in [false, true] {
        share::<1>(two);
        share::<5>(two);
        share::<20>(two);
    }
}

/// Where nothing shines nothing is sampled, and every probability is zero.
#[test]
fn darkness() {
    fn dark<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
        let mut triangles = generate::small_triangles(40, 5, 10.0, 0.5, true, 3);
        triangles
            .iter_mut()
            .for_each(|triangle| triangle.radiance = [0.0; 3]);
        let lights = Lights::new(triangles).expect("lights");
        let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
        let random = &mut Random::new(4);
        for _ in 0..50 {
            let point = generate::point(random, 10.0);
            let bits = random.bits();
            let sampled = bvh.by::<I>().sample(&point, bits);
            if I::UNIFORM_HALVINGS == 0 || bits >> (32 - I::UNIFORM_HALVINGS) > 0 {
                assert_eq!(sampled, SampledLight::NONE);
            }
            let pmf = pmf_of::<_, I, _>(&bvh, &lights, &point, random.below(40));
            assert_eq!(pmf > 0.0, I::UNIFORM_HALVINGS > 0);
        }
    }
    each_layout!(dark(false));
    each_layout!(dark(true));
}

/// Lights by their place in the order of the slots; the order of numbers is that of the lights.
fn places<N: LightNode<W>, const W: usize>(bvh: &Bvh<N, (), W>, lights: &Lights) -> Vec<usize> {
    let mut places = vec![usize::MAX; lights.triangles().len()];
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
        let place = |bits: u64| places[bvh.by::<I>().sample(&point, bits).light as usize];
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
            .map(|&bits| places[bvh.by::<I>().sample(&point, (bits >> 32) as u32).light as usize])
            .collect();
        assert!(halves.is_sorted(), "{} {W} at {point:?}", N::NAME);

        let mut order: Vec<u32> = (0..lights.triangles().len() as u32).collect();
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

/// Frequencies of 10^5 samples per point match the evaluated probabilities (χ², tail 1e-6 for each of the tests).
fn frequencies_match<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    const SAMPLES: u32 = 100_000;
    let lights = scene(300, 7);
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    let mut random = Random::new(99);
    for _ in 0..4 {
        let point = generate::point(&mut random, 10.0);
        let pmfs = all_pmfs::<N, I, W>(&bvh, &lights, &point);
        let expected: Vec<f64> = pmfs.into_iter().map(f64::from).collect();
        let mut observed = vec![0; expected.len()];
        for _ in 0..SAMPLES {
            observed[bvh.by::<I>().sample(&point, random.bits()).light as usize] += 1;
        }
        let (statistic, degrees) = chi_squared(&observed, &expected);
        let threshold = chi_squared_quantile(degrees, 1e-6);
        assert!(
            statistic < threshold,
            "{} {W}: χ² {statistic} of {degrees} degrees, threshold {threshold}, at {point:?}",
            N::NAME
        );
    }
}

#[test]
fn frequencies() {
    each_layout!(frequencies_match(false));
    each_layout!(frequencies_match(true));
}

/// All 2^32 words: a light's numbers are an interval, so it is returned for as many words as its probability says, but for one
/// that the interval begins within and one that it ends within. χ² of frequencies is far below that of independent ones then.
#[test]
#[ignore = "4.3 billion samples: half an hour of processor time"]
fn all_words() {
    use rayon::prelude::*;
    let lights = scene(1000, 31);
    let bvh = Bvh::<CompactNode<4>, (), 4>::two_level(&lights, &BuildParams::default());
    let point = ShadingPoint {
        p: [4.0, 1.0, 5.0],
        n: [0.0, 1.0, 0.0],
    };
    let pmfs = all_pmfs::<CompactNode<4>, Eq4, 4>(&bvh, &lights, &point);
    let count = |piece: u32| {
        let mut counts = vec![0u64; pmfs.len()];
        let points = [point; 4096];
        let mut sampled = [SampledLight::NONE; 4096];
        for block in 0..1u32 << 8 {
            let first = piece << 20 | block << 12;
            let numbers: [Random64; 4096] = std::array::from_fn(|k| Random64::from(first | k as u32));
            bvh.by::<Eq4>().sample_batch(&points, &numbers, &mut sampled);
            sampled.iter().for_each(|one| counts[one.light as usize] += 1);
        }
        counts
    };
    let none = || vec![0u64; pmfs.len()];
    let add = |a: Vec<u64>, b: Vec<u64>| a.iter().zip(&b).map(|(a, b)| a + b).collect();
    let observed: Vec<u64> = (0..1u32 << 12).into_par_iter().map(count).reduce(none, add);
    assert_eq!(observed.iter().sum::<u64>(), 1 << 32);
    for (light, (&observed, &pmf)) in observed.iter().zip(&pmfs).enumerate() {
        let off = observed as f64 - f64::from(pmf) * 2f64.powi(32);
        assert!(
            off.abs() <= 2.0,
            "light {light} of pmf {pmf} is off by {off} words"
        );
    }
    let expected: Vec<f64> = pmfs.iter().map(|&pmf| f64::from(pmf)).collect();
    let (statistic, degrees) = chi_squared(&observed, &expected);
    let threshold = chi_squared_quantile(degrees, 1e-6);
    assert!(
        statistic < threshold,
        "χ² {statistic} of {degrees} degrees, threshold {threshold}"
    );
}

/// A floor of 32² equal lamps, and a point above it: what a light contributes varies smoothly from lamp to lamp.
fn floor() -> Lights {
    let lamp = |i: u32| {
        let (x, z) = ((i % 32) as f32, (i / 32) as f32);
        EmissiveTriangle {
            p: [[x, 0.0, z], [x, 0.0, z + 0.5], [x + 0.5, 0.0, z]],
            radiance: [1.0; 3],
            mesh: i / 64,
            flags: 0,
        }
    };
    Lights::new((0..1024).map(lamp).collect()).expect("lights")
}

/// Mean squared error of the mean of 64 estimates, relative to the sum of all; by `numbers`, which gives 64 for each trial.
fn squared_error<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, (), W>,
    lights: &Lights,
    numbers: impl Fn(&mut Random) -> [u32; 64],
) -> f64 {
    const TRIALS: u32 = 400;
    let random = &mut Random::new(77);
    let mut mean = 0.0;
    for _ in 0..TRIALS {
        let point = ShadingPoint {
            p: [
                random.between(4.0, 28.0),
                random.between(1.0, 6.0),
                random.between(4.0, 28.0),
            ],
            n: [0.0; 3],
        };
        let contributions: Vec<f64> = lights
            .triangles()
            .iter()
            .map(|light| contribution(light, &point))
            .collect();
        let sum: f64 = contributions.iter().sum();
        let estimates = numbers(random).map(|number| {
            let sampled = bvh.by::<I>().sample(&point, number);
            contributions[sampled.light as usize] / f64::from(sampled.pmf)
        });
        let off = estimates.iter().sum::<f64>() / 64.0 / sum - 1.0;
        mean += off * off / f64::from(TRIALS);
    }
    mean
}

/// 64 stratified numbers, one in each 64th of the range, against 64 independent ones: the squared error is at least 8 times
/// less. Multiples of the golden ratio, which have no number of samples in mind: at least 4 times less.
fn stratified_numbers_pay<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    if I::UNIFORM_HALVINGS > 0 {
        return;
    }
    let lights = floor();
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    let independent = squared_error::<N, I, W>(&bvh, &lights, |random| [0; 64].map(|_| random.bits()));
    let stratified = squared_error::<N, I, W>(&bvh, &lights, |random| {
        std::array::from_fn(|k| (k as u32) << 26 | random.bits() >> 6)
    });
    let golden = squared_error::<N, I, W>(&bvh, &lights, |random| {
        let start = random.bits();
        std::array::from_fn(|k| start.wrapping_add((k as u32).wrapping_mul(0x9e37_79b9)))
    });
    println!(
        "{} {W}: {independent:e}, {:.1}, {:.1}",
        N::NAME,
        independent / stratified,
        independent / golden
    );
    assert!(
        8.0 * stratified < independent,
        "{stratified:e}, independent {independent:e}"
    );
    assert!(
        4.0 * golden < independent,
        "{golden:e}, independent {independent:e}"
    );
}

#[test]
fn stratified_numbers() {
    each_layout!(stratified_numbers_pay(false));
    each_layout!(stratified_numbers_pay(true));
}

/// Several walks at once are as many walks one by one, however many, and what is longer than the shortest list is left alone.
fn batches_are_single_samples<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    let lights = scene(200, 41);
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    let random = &mut Random::new(42);
    for count in (0..=40).chain([1000]) {
        let points: Vec<ShadingPoint> = (0..count).map(|_| generate::point(random, 10.0)).collect();
        let numbers: Vec<Random64> = (0..count).map(|_| number(random)).collect();
        let untouched = SampledLight {
            light: 7,
            instance: 5,
            pmf: -1.0,
        };
        let mut sampled = vec![untouched; count + 3];
        bvh.by::<I>().sample_batch(&points, &numbers, &mut sampled);
        for k in 0..count {
            let expected = bvh.by::<I>().sample(&points[k], numbers[k]);
            assert_eq!(sampled[k], expected, "{k} of {count}");
        }
        assert_eq!(sampled[count..], [untouched; 3]);
        let shorter = count.saturating_sub(5);
        for (points, numbers, outs) in [
            (shorter, count, count),
            (count, shorter, count),
            (count, count, shorter),
        ]
        .map(|(p, n, o)| (&points[..p], &numbers[..n], o))
        {
            let mut few = vec![untouched; outs];
            bvh.by::<I>().sample_batch(points, numbers, &mut few);
            assert_eq!(few[..shorter], sampled[..shorter]);
            assert!(few[shorter..].iter().all(|&found| found == untouched));
        }
    }
}

/// Candidates are the samples of numbers at equal distances, in any layout, uniform choices among them.
fn candidates_are_single_samples<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    fn check<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize, const COUNT: usize>(
        bvh: &LightTree<'_, N, I, W>,
        point: &ShadingPoint,
        number: Random64,
    ) {
        let many = bvh.sample_many::<COUNT>(point, number);
        for (k, found) in (0..).zip(many) {
            let expected = bvh.sample(point, number.spaced(k, COUNT as u32));
            assert_eq!(found, expected, "{k} of {COUNT}");
        }
    }
    for count in [1, 3, 200] {
        let bvh = built::<N, W>(&scene(count, 51), &BuildParams::default(), two);
        let bvh = bvh.by::<I>();
        let random = &mut Random::new(52);
        for _ in 0..200 {
            let (point, number) = (generate::point(random, 10.0), number(random));
            check::<N, I, W, 1>(&bvh, &point, number);
            check::<N, I, W, 5>(&bvh, &point, number);
            check::<N, I, W, 64>(&bvh, &point, number);
            let (first, count) = (random.below(70), random.below(150));
            let mut sampled = vec![SampledLight::NONE; random.below(80) as usize];
            bvh.sample_spaced(&point, number, first, count, &mut sampled);
            for (k, found) in (first..).zip(sampled) {
                assert_eq!(
                    found,
                    bvh.sample(&point, number.spaced(k, count)),
                    "{k} of {count}"
                );
            }
        }
    }
}

#[test]
fn candidates() {
    each_layout!(candidates_are_single_samples(false));
    each_layout!(candidates_are_single_samples(true));
}

/// Splitting gives every light to one subtree: with as many subtrees as lights all are certain, with one it is a single sample, and
/// between them the sum of f / pmf is the sum of f in the mean.
fn splitting_is_unbiased<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    const NUMBERS: u32 = 512;
    for count in [1, 3, 60] {
        let lights = scene(count, 53);
        let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
        let random = &mut Random::new(54);
        for _ in 0..8 {
            let point = generate::point(random, 10.0);
            // Near what lights are chosen by, so that no rare light is most of the sum; never of dark ones.
            let pmfs = all_pmfs::<_, I, _>(&bvh, &lights, &point);
            let lit =
                |t: &EmissiveTriangle| f64::from(u8::from(Summary::phi(&N::Summary::of_triangle(t)) > 0.0));
            let f: Vec<f64> = (0..)
                .zip(lights.triangles().iter().zip(pmfs))
                .map(|(light, (triangle, pmf))| f64::from(light % 3 + 1) * lit(triangle) * f64::from(pmf))
                .collect();
            let sum: f64 = f.iter().sum();
            let estimate = |found: &[SampledLight]| -> f64 {
                found.iter().map(|s| f[s.light as usize] / f64::from(s.pmf)).sum()
            };
            let bvh = bvh.by::<I>();
            let (all, found) = bvh.sample_split::<64>(&point, number(random));
            assert!(all[..found].iter().all(|s| s.pmf > 0.0));
            let relative = estimate(&all[..found]) / sum;
            assert!(
                (relative - 1.0).abs() < 1e-6,
                "{found} of {count} lights: {relative}"
            );
            let mut estimates = Vec::new();
            for k in 0..NUMBERS {
                let number = number(random).spaced(k, NUMBERS);
                let (one, found) = bvh.sample_split::<1>(&point, number);
                let expected = bvh.sample(&point, number);
                if I::UNIFORM_HALVINGS == 0 {
                    assert_eq!((found, one[0]), (1, expected));
                }
                let (some, found) = bvh.sample_split::<20>(&point, number);
                assert!(found <= 20 && some[found..].iter().all(|s| *s == SampledLight::NONE));
                estimates.push(estimate(&some[..found]) / sum);
            }
            let mean = estimates.iter().sum::<f64>() / f64::from(NUMBERS);
            let variance = estimates.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(NUMBERS);
            let deviation = (variance / f64::from(NUMBERS)).sqrt();
            assert!(
                (mean - 1.0).abs() <= 5.0 * deviation + 1e-6,
                "{count}: {mean} +- {deviation}"
            );
        }
    }
}

#[test]
fn splitting() {
    each_layout!(splitting_is_unbiased(false));
    each_layout!(splitting_is_unbiased(true));
}

#[test]
fn batches() {
    each_layout!(batches_are_single_samples(false));
    each_layout!(batches_are_single_samples(true));
}
