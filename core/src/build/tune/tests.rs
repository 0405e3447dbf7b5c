use alloc::string::ToString;
use alloc::vec::Vec;
use core::time::Duration;
use std::vec;

use super::*;
use crate::build::BuildParams;
use crate::bvh::LightBvh;
use crate::kit::triangle;
use crate::light::EmissiveTriangle;
use crate::lights::Lights;
use crate::traverse::Random64;
use crate::{Flux, MomentNode};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn at(x: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, 0.0, 0.0],
        n: UP,
    }
}

/// Lamps in a row that shine down, each brighter than the one before.
fn row(count: u8) -> Lights {
    let lamp = |k: u8| EmissiveTriangle {
        radiance: [1.0 + f32::from(k); 3],
        mesh: u32::from(k),
        ..triangle(
            [[0.0, 3.0, 0.0], [0.2, 3.0, 0.0], [0.0, 3.0, 0.2]].map(|p| [p[0] + f32::from(k), p[1], p[2]]),
        )
    };
    Lights::new((0..count).map(lamp).collect()).expect("within the domain")
}

/// Gives the times in turn, each once.
fn clock(times: &[u64]) -> impl FnMut() -> Duration {
    let mut now = 0;
    let mut times = times.iter().copied().cycle();
    let mut starts = true;
    move || {
        if !starts {
            now += times.next().expect("endless");
        }
        starts = !starts;
        Duration::from_nanos(now)
    }
}

fn measured(time_ns: f64, variance: f64) -> Measured {
    Measured {
        name: time_ns.to_string(),
        candidates: 1,
        sample_ns: time_ns,
        time_ns,
        variance,
    }
}

#[test]
fn the_least_error_in_a_time_and_the_least_time_for_an_error() {
    let table = [measured(100.0, 8.0), measured(150.0, 4.0), measured(1000.0, 0.25)];
    let pick = |budget: Budget| budget.pick(&table).map(|pick| (pick.index, pick.samples));
    // Nine of 8.0, six of 4.0 and none of 0.25 in 999 ns; one more nanosecond fits the last.
    assert_eq!(pick(Budget::Time { ns: 999.0 }), Ok((1, 6)));
    assert_eq!(pick(Budget::Time { ns: 1000.0 }), Ok((2, 1)));
    assert_eq!(pick(Budget::Time { ns: 149.0 }), Ok((0, 1)));
    assert_eq!(
        pick(Budget::Time { ns: 99.0 }),
        Err(TuneError::Time { least_ns: 100.0 })
    );
    // A deviation of 2 takes two of the first, 200 ns, or one of the second.
    assert_eq!(pick(Budget::Error { relative: 2.0 }), Ok((1, 1)));
    assert_eq!(pick(Budget::Error { relative: 0.5 }), Ok((2, 1)));
    assert_eq!(pick(Budget::Error { relative: 3.0 }), Ok((0, 1)));
    for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        for budget in [Budget::Time { ns: value }, Budget::Error { relative: value }] {
            assert!(matches!(pick(budget), Err(TuneError::Budget { .. })), "{value}");
        }
    }
    let none = Budget::Time { ns: 1.0 }.pick(&[]);
    assert_eq!(none, Err(TuneError::NoConfigurations));
}

#[test]
fn the_first_of_equals_is_picked() {
    let table = [measured(100.0, 1.0), measured(100.0, 1.0)];
    assert_eq!(
        Budget::Error { relative: 0.1 }
            .pick(&table)
            .map(|pick| pick.index),
        Ok(0)
    );
    assert_eq!(
        Budget::Time { ns: 500.0 }.pick(&table).map(|pick| pick.index),
        Ok(0)
    );
}

#[test]
fn times_are_the_least_of_the_clocks() {
    let lights = row(5);
    let points = [at(1.0), at(2.0)];
    let tree = LightBvh::single_level(&lights, &BuildParams::BALANCED);
    let mut tuning = Tuning::new(&points, &Diffuse, 50.0).expect("sound");
    tuning
        .add("a", &tree, 1)
        .expect("one")
        .add("b", &tree, 4)
        .expect("four");
    // 4096 samples a round; the first round of each is interrupted.
    let times = clock(&[
        900_000, 9_000_000, 409_600, 819_200, 409_600, 819_200, 409_600, 819_200, 500_000, 900_000,
    ]);
    let measured = tuning.measure(times).expect("lit");
    let found: Vec<_> = measured.iter().map(|of| (of.sample_ns, of.time_ns)).collect();
    assert_eq!(found, [(100.0, 150.0), (200.0, 250.0)]);
    assert_eq!(measured[1].candidates, 4);
}

/// The variance of one candidate against the estimates themselves, for an importance with much of it.
#[test]
fn the_variance_is_that_of_the_estimates() {
    let lights = row(12);
    let points = [at(2.5)];
    let tree = Bvh::<MomentNode<8>, Flux, 8>::single_level(&lights, &BuildParams::BALANCED);
    struct Half;
    impl Lighting for Half {
        fn light(&self, point: &ShadingPoint, light: &EmissiveTriangle) -> f64 {
            Diffuse.light(point, light)
        }
        fn seen(&self, _: &ShadingPoint, light: &EmissiveTriangle) -> f64 {
            if light.p[0][0] as u32 % 2 == 0 { 0.5 } else { 1.0 }
        }
    }
    let mut tuning = Tuning::new(&points, &Half, 0.0).expect("sound");
    tuning
        .add("flux", &tree, 1)
        .expect("one")
        .add("1 of 4", &tree, 4)
        .expect("four");
    let found = tuning.measure(clock(&[1])).expect("lit");
    // With the shadow ray's own luck, over evenly spread numbers.
    let light_of = |k: u32| lights.triangles()[k as usize];
    let mean: f64 = (0..12)
        .map(|k| {
            let light = light_of(k);
            let seen = if k % 2 == 0 { 0.5 } else { 1.0 };
            Diffuse.light(&points[0], &light) * seen
        })
        .sum();
    let count = 1 << 16;
    let mut square = 0.0;
    for k in 0..count {
        let sampled = tree.sample(&points[0], Random64::from(0_u32).spaced(k, count));
        let of = Diffuse.light(&points[0], &light_of(sampled.light)) / f64::from(sampled.pmf);
        let seen = if sampled.light % 2 == 0 { 0.5 } else { 1.0 };
        square += of * of * seen / f64::from(count);
    }
    let expected = (square - mean * mean) / (2.0 * mean * mean);
    assert!(expected > 0.2, "{expected}");
    let error = found[0].variance / expected - 1.0;
    assert!(error.abs() < 1e-3, "{} {expected}", found[0].variance);
    // Resampling four leaves less, but not less than what half-seen lights leave.
    assert!(found[1].variance < 0.7 * found[0].variance, "{found:?}");
    assert!(found[1].variance > 0.01, "{found:?}");
}

#[test]
fn many_lights_are_measured_by_trials_alike() {
    let points: Vec<ShadingPoint> = (0..8).map(|k| at(f32::from(k as u8))).collect();
    let lights = row(60);
    let tree = Bvh::<MomentNode<8>, Flux, 8>::single_level(&lights, &BuildParams::BALANCED);
    let one = measure::Sampling {
        bvh: &tree,
        candidates: 1,
    };
    struct Many<'a>(measure::Sampling<'a, MomentNode<8>, Flux, 8>);
    impl Configuration for Many<'_> {
        fn candidates(&self) -> u32 {
            self.0.candidates()
        }
        fn run(&self, points: &[ShadingPoint], passes: u32, round: u32) {
            self.0.run(points, passes, round);
        }
        fn draw(&self, point: &ShadingPoint, number: Random64, found: &mut [crate::SampledLight]) {
            self.0.draw(point, number, found);
        }
        fn pmf(&self, _: &ShadingPoint, _: u32, _: u32) -> f32 {
            panic!("too many to ask")
        }
        fn triangle(&self, sampled: &crate::SampledLight) -> Option<EmissiveTriangle> {
            self.0.triangle(sampled)
        }
        fn world_lights(&self) -> Vec<EmissiveTriangle> {
            panic!("too many to list")
        }
        fn count(&self) -> usize {
            1 << 30
        }
    }
    let exact = variances(&one, &points, &Diffuse).expect("lit");
    let tried = variances(&Many(one), &points, &Diffuse).expect("lit");
    // 8 points with 512 trials each.
    assert!((tried / exact - 1.0).abs() < 0.25, "{tried} {exact}");
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let lights = row(3);
    let tree = LightBvh::two_level(&lights, &BuildParams::BALANCED);
    let none = Tuning::new(&[], &Diffuse, 1.0).err();
    assert_eq!(none, Some(TuneError::NoPoints));
    let points = [at(0.0), at(f32::NAN)];
    let outside = Tuning::new(&points, &Diffuse, 1.0).err().expect("outside");
    assert!(outside.to_string().starts_with("point 1: "), "{outside}");
    for ns in [-1.0, f64::NAN, f64::INFINITY] {
        let error = Tuning::new(&points[..1], &Diffuse, ns).err();
        assert!(matches!(error, Some(TuneError::ShadowRay { .. })), "{ns}");
    }
    let mut tuning = Tuning::new(&points[..1], &Diffuse, 1.0).expect("sound");
    assert_eq!(tuning.measure(clock(&[1])), Err(TuneError::NoConfigurations));
    for candidates in [0, MAX_CANDIDATES + 1] {
        let error = tuning.add("", &tree, candidates).err();
        assert_eq!(error, Some(TuneError::Candidates { candidates }));
    }
    // Above the lamps, which shine down.
    let above = [ShadingPoint {
        p: [0.0, 9.0, 0.0],
        n: UP,
    }];
    let mut tuning = Tuning::new(&above, &Diffuse, 1.0).expect("sound");
    tuning.add("", &tree, 1).expect("one");
    assert_eq!(tuning.measure(clock(&[1])), Err(TuneError::Dark));
    let mut tuning = Tuning::new(&points[..1], &Diffuse, 1.0).expect("sound");
    tuning.add("", &tree, 1).expect("one");
    assert_eq!(tuning.measure(|| Duration::ZERO), Err(TuneError::Clock));
}

/// Whatever light a caller names, variances are numbers.
#[test]
fn great_light_has_a_variance() {
    struct Great;
    impl Lighting for Great {
        fn light(&self, _: &ShadingPoint, light: &EmissiveTriangle) -> f64 {
            if light.p[0][0] < 5.0 { f64::MAX } else { 1.0 }
        }
    }
    let lights = row(12);
    let tree = Bvh::<MomentNode<8>, Flux, 8>::single_level(&lights, &BuildParams::BALANCED);
    let points = [at(2.5)];
    let mut tuning = Tuning::new(&points, &Great, 0.0).expect("sound");
    tuning
        .add("1", &tree, 1)
        .expect("one")
        .add("4", &tree, 4)
        .expect("four");
    let found = tuning.measure(clock(&[1])).expect("lit");
    // Half of the lights have all of it.
    assert!(
        found.iter().all(|of| (0.01..10.0).contains(&of.variance)),
        "{found:?}"
    );
}

#[test]
fn builders_are_tried_within_a_budget() {
    let lights = row(40);
    let points = [at(3.0), at(30.0)];
    // 15 configurations; all take the same time but the last, which takes none to speak of.
    let mut times = vec![40_960_000; 15];
    times[14] = 1;
    let within = |budget| BuildParams::within(budget, &lights, &points, &Diffuse, 0.0, clock(&times));
    let error = within(Budget::Error { relative: 1e-3 }).expect("lit");
    assert_eq!((error.params, error.candidates), (BuildParams::BEST, 16));
    assert_eq!(error.measured.len(), 15);
    assert_eq!(error.pick.index, 14);
    let none = within(Budget::Time { ns: 1e-9 });
    assert!(matches!(none, Err(TuneError::Time { .. })), "{none:?}");
}
