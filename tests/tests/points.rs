//! The domain of shading points: what `checked` accepts is sampled, what is beyond all bounds stops a
//! debug build.

use lightbvh::point::{MAX_REACH, NORMAL_TOLERANCE};
use lightbvh::{BuildParams, Bvh, CompactNode, Eq4, Lights, PointError, ShadingPoint, exact};
use lightbvh_tests::generate::{Random, small_triangles};
use lightbvh_tests::oracle::{all_pmfs, assert_sum_is_one};

type Tree = Bvh<CompactNode<4>, Eq4, 4>;

fn lamps() -> (Lights, Tree) {
    let lights = Lights::new(small_triangles(40, 4, 5.0, 0.3, true, 11)).expect("within the domain");
    let bvh = Bvh::two_level(&lights, &BuildParams::default());
    (lights, bvh)
}

/// Every point that `checked` accepts has probabilities that sum to one, and a sample.
#[test]
fn accepted_points_are_sampled() {
    let (lights, bvh) = lamps();
    let random = &mut Random::new(5);
    let mut accepted = 0;
    for _ in 0..4000 {
        let scale = exact::pow2(random.below(150) as i32 - 105);
        let length = 1.0 + random.between(-1.1, 1.1) * 0.5 * NORMAL_TOLERANCE;
        let n = if random.below(5) == 0 {
            [0.0; 3]
        } else {
            random.direction().map(|x| x * length)
        };
        let point = ShadingPoint {
            p: random.direction().map(|x| x * scale),
            n,
        };
        let Ok(point) = point.checked() else { continue };
        accepted += 1;
        let pmfs = all_pmfs::<_, Eq4, 4>(&bvh, &lights, &point);
        let sampled = bvh.sample(&point, random.bits());
        assert_sum_is_one::<CompactNode<4>, Eq4, 4>(pmfs.iter().copied(), &point);
        assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
    }
    assert!((2000..4000).contains(&accepted), "{accepted} points accepted");
}

#[test]
fn errors_say_what_was_found() {
    let point = |p, n| ShadingPoint { p, n }.checked().expect_err("refused");
    let far = point([0.0, 2e12, 0.0], [0.0; 3]);
    assert_eq!(far, PointError::Coordinate { axis: 1, value: 2e12 });
    assert!(
        far.to_string().contains("coordinate y") && far.to_string().contains("2^40"),
        "{far}"
    );
    let long = point([0.0; 3], [2.0, 0.0, 0.0]);
    assert!(
        long.to_string().contains("(2, 0, 0)") && long.to_string().contains("length 1"),
        "{long}"
    );
}

/// What no guarantee covers.
fn beyond() -> Vec<ShadingPoint> {
    let up = [0.0, 1.0, 0.0];
    let at = |p, n| ShadingPoint { p, n };
    vec![
        at([f32::NAN, 0.0, 0.0], up),
        at([0.0, f32::INFINITY, 0.0], up),
        at([0.0, 0.0, MAX_REACH.next_up()], up),
        at([0.0; 3], [0.0, 0.5, 0.0]),
        at([0.0; 3], [f32::NAN; 3]),
    ]
}

#[cfg(debug_assertions)]
#[test]
fn points_beyond_all_bounds_stop_a_debug_build() {
    let stops = |f: &dyn Fn()| {
        let message = std::panic::catch_unwind(std::panic::AssertUnwindSafe(f)).expect_err("a panic");
        let message = message.downcast_ref::<String>().expect("a message").clone();
        assert!(message.starts_with("not a shading point"), "{message}");
    };
    let (_, bvh) = lamps();
    for point in &beyond() {
        stops(&|| {
            let _ = bvh.sample(point, 1u32);
        });
        stops(&|| {
            let _ = bvh.pmf(point, 0, 0);
        });
    }
}

/// The wider bound of what debug builds let through: rows of `lightbvh stability` go as far.
#[test]
fn points_up_to_the_last_bound_are_sampled() {
    let (_, bvh) = lamps();
    for p in [[MAX_REACH, -MAX_REACH, 0.0], [1e15; 3]] {
        let point = ShadingPoint { p, n: [0.0; 3] };
        assert!(point.checked().is_err());
        assert!(bvh.sample(&point, 3u32).pmf > 0.0);
    }
    // What is beyond all bounds is beyond this one too.
    assert!(beyond().iter().all(|point| point.checked().is_err()));
}
