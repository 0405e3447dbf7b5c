//! Several samples: stratified numbers, batches, spaced numbers.

use super::*;

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
    stratified_numbers_pay::<MomentNode<8>, Moments, 8>(false);
    stratified_numbers_pay::<MomentNode<8>, Moments, 8>(true);
}

/// Batches and spaced numbers are single samples, uniform choices among them; what is longer than the shortest list is left alone.
fn several_are_single_samples<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    let bvh = built::<N, W>(&scene(200, 41), &BuildParams::default(), two);
    let tree = bvh.by::<I>();
    let random = &mut Random::new(42);
    let untouched = SampledLight {
        light: 7,
        instance: 5,
        pmf: -1.0,
    };
    for count in 0..=40_usize {
        let points: Vec<ShadingPoint> = (0..count).map(|_| generate::point(random, 10.0)).collect();
        let numbers: Vec<Random64> = (0..count).map(|_| number(random)).collect();
        let shortest = count.saturating_sub(5);
        let mut sampled = vec![untouched; count + 3];
        tree.sample_batch(&points, &numbers[..shortest], &mut sampled);
        for k in 0..shortest {
            assert_eq!(sampled[k], tree.sample(&points[k], numbers[k]), "{k} of {count}");
        }
        assert!(sampled[shortest..].iter().all(|&found| found == untouched));
        let (point, number) = (generate::point(random, 10.0), number(random));
        let (first, of) = (random.below(70), random.below(150));
        let mut sampled = vec![SampledLight::NONE; count];
        tree.sample_spaced(&point, number, first, of, &mut sampled);
        for (k, found) in (first..).zip(sampled) {
            assert_eq!(found, tree.sample(&point, number.spaced(k, of)), "{k} of {of}");
        }
    }
}

#[test]
fn batches_and_spaced_numbers() {
    several_are_single_samples::<CompactNode<4>, Defensive<Eq4, 5>, 4>(false);
    several_are_single_samples::<MomentNode<8>, Moments, 8>(true);
}
