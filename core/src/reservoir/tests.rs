use super::*;

fn sample(light: u32) -> LightSample {
    LightSample {
        light,
        instance: light / 2,
        uv: [0.25, 0.75],
    }
}

fn reservoir(light: u32, weight: f32, count: u32) -> Reservoir {
    Reservoir {
        sample: sample(light),
        weight,
        count,
    }
}

/// Every one of the 2^23 numbers that decide: a weight is taken by its share of them, to one.
#[test]
fn a_weight_is_taken_by_its_share_of_all_random_numbers() {
    for (before, weight) in [
        (1.0_f32, 1.0_f32),
        (1.0, 3.0),
        (7.0, 0.1),
        (1e20, 3e18),
        (0.0, 5.0),
        (5.0, 0.0),
    ] {
        let start = Resampling {
            weight_sum: before,
            sample: sample(1),
            ..Resampling::EMPTY
        };
        let mut taken = 0_u32;
        for number in 0..1_u32 << 23 {
            let mut stream = start;
            stream.update(sample(2), weight, 1.0, 0, number << 9);
            taken += u32::from(stream.sample.light == 2);
        }
        let share = f64::from(weight) / (f64::from(before) + f64::from(weight));
        let expected = share * f64::from(1 << 23);
        assert!(
            (f64::from(taken) - expected).abs() <= 1.0,
            "{before} {weight}: {taken} {expected}"
        );
    }
}

/// Algorithm 3 over every combination of random numbers that matters: thresholds fall on the eighths that `random` steps
/// through, so the mean over all combinations is the expectation itself, Σ f over the candidates' domain.
#[test]
fn candidates_estimate_the_sum_in_expectation() {
    // Four lights with pmf 1/4 each, two candidates; f and targets apart from each other, one target zero with its f.
    let targets = [1.0_f32, 3.0, 4.0, 0.0];
    let f = [2.0, 1.5, 8.0, 0.0];
    let (mut mean, mut combinations) = (0.0, 0.0);
    for first in 0..4_u32 {
        for second in 0..4_u32 {
            // The chance that the second is taken: its share. Counted by 840 = 3 · 5 · 7 · 8 steps, which all shares divide.
            let steps = 840_u32;
            for step in 0..steps {
                let random = ((u64::from(step) << 32).div_ceil(u64::from(steps)) + 512) as u32;
                let mut stream = Resampling::EMPTY;
                stream.candidate(sample(first), targets[first as usize], 0.25, 0);
                stream.candidate(sample(second), targets[second as usize], 0.25, random);
                let found = stream.finish_equal();
                assert_eq!(found.count, 2);
                if found.weight > 0.0 {
                    mean += f[found.sample.light as usize] * f64::from(found.weight);
                }
                combinations += 1.0;
            }
        }
    }
    mean /= combinations;
    let sum: f64 = f.iter().sum();
    assert!((mean / sum - 1.0).abs() < 1e-6, "{mean} {sum}");
}

/// Two receivers see different lights: the balance heuristic keeps the expectation of every light that the own receiver
/// sees, and equal counting loses part of those that only it sees.
#[test]
fn balanced_merging_is_unbiased_where_equal_merging_is_not() {
    // Targets of the receiver and of its neighbour at three lights; the neighbour cannot have light 2.
    let own = [1.0_f32, 2.0, 3.0];
    let other = [2.0_f32, 1.0, 0.0];
    let counts = [1_u32, 4];
    let (mut balanced, mut equal) = ([0.0_f64; 3], [0.0_f64; 3]);
    let steps = 4096_u32;
    // Each reservoir holds light i with probability 1 / n, so W = n there: a right contribution weight.
    for mine in 0..3_u32 {
        for theirs in 0..2_u32 {
            for step in 0..steps {
                let random = (step << 20) + (1 << 19);
                let mut stream = Resampling::EMPTY;
                stream.merge(&reservoir(mine, 3.0, counts[0]), own[mine as usize], 0, 0);
                stream.merge(
                    &reservoir(theirs, 2.0, counts[1]),
                    own[theirs as usize],
                    1,
                    random,
                );
                let y = stream.sample.light as usize;
                let sum = own[y] * counts[0] as f32 + other[y] * counts[1] as f32;
                let source = if stream.source == 0 { own[y] } else { other[y] };
                let chance = 1.0 / (6.0 * f64::from(steps));
                balanced[y] += chance * f64::from(stream.finish_balanced(source, sum).weight);
                equal[y] += chance * f64::from(stream.finish_equal().weight);
            }
        }
    }
    for light in 0..3 {
        // Half a step of 2^-12 in each threshold.
        assert!((balanced[light] - 1.0).abs() < 2e-3, "{balanced:?}");
    }
    assert!(
        equal[2] < 0.5,
        "light 2 is lost in part by equal counting: {equal:?}"
    );
}

#[test]
fn counts_are_kept_and_limited() {
    let mut stream = Resampling::EMPTY;
    stream.merge(&reservoir(1, 1.0, 600).limited(20 * 16), 1.0, 0, 0);
    assert_eq!(stream.count, 320);
    stream.merge(&reservoir(2, 1.0, 5).occluded(), 1.0, 1, 0);
    assert_eq!((stream.count, stream.sample.light), (325, 1));
    stream.merge(&reservoir(3, 1.0, u32::MAX), 1.0, 1, 0);
    assert_eq!(stream.count, MAX_COUNT);
    stream.candidate(sample(4), 1.0, 0.5, 0);
    assert_eq!(stream.count, MAX_COUNT);
}

/// At the corners of all ranges together, every number is zero or normal and finite, and within its range.
#[test]
fn no_corner_of_the_domain_leaves_it() {
    let targets = [0.0, 1e-38, 1e-30, MIN_TARGET, 1.0, MAX_TARGET, 1e30, f32::MAX].map(target);
    let weights = [0.0, MIN_WEIGHT, 1.0, MAX_WEIGHT];
    let counts = [0, 1, 640, MAX_COUNT, u32::MAX];
    let pmfs = [0.0, 1e-38, MIN_PMF, 0.3, 1.0];
    let normal = |x: f32| x == 0.0 || x.is_normal();
    for t0 in targets {
        for pmf in pmfs {
            for w in weights {
                for count in counts {
                    for t1 in targets {
                        for random in [0, u32::MAX] {
                            let mut stream = Resampling::EMPTY;
                            stream.candidate(sample(1), t0, pmf, random);
                            stream.merge(&reservoir(2, w, count), t1, 1, random);
                            stream.merge(&reservoir(3, w, count), t1, 1, random);
                            assert!(normal(stream.weight_sum) && stream.weight_sum <= MAX_WEIGHT_SUM);
                            let balance = t1 * MAX_COUNT as f32 + t0;
                            for found in [
                                stream.finish_equal(),
                                stream.finish_balanced(t1, balance),
                                stream.finish_balanced(t0, balance),
                            ] {
                                let weight = found.weight;
                                assert!(weight == 0.0 || (MIN_WEIGHT..=MAX_WEIGHT).contains(&weight));
                                assert!(found.count <= MAX_COUNT);
                            }
                        }
                    }
                }
            }
        }
    }
    assert_eq!(Resampling::EMPTY.finish_equal(), Reservoir::EMPTY);
    assert_eq!(Resampling::EMPTY.finish_balanced(1.0, 1.0), Reservoir::EMPTY);
}
