//! Several samples: batches, spaced numbers.

use super::*;

/// Batches and spaced numbers are single samples, uniform choices among them; what is longer than the shortest list is left alone.
fn several_are_single_samples<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(two: bool) {
    let bvh = built::<N, W>(&scene(200, 41), &BuildParams::default(), two);
    let tree = bvh.tree().by::<I>();
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
