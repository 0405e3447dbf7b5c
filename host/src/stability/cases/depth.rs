//! Deep trees: lights at halving distances, which a builder by surface area peels off one by one.

use lightbvh::{BuildParams, EmissiveTriangle, Heuristic, ShadingPoint, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::facing_x;

pub(super) fn cases() -> Vec<Case> {
    let params = BuildParams {
        buckets: 2,
        ..BuildParams::paper(Heuristic::Sah)
    };
    let points = || {
        let random = &mut Random::new(61);
        let point = |_| {
            let d = exact::pow2(20 - random.below(60) as i32);
            ShadingPoint {
                p: random.direction().map(|x| x * d),
                n: [0.0; 3],
            }
        };
        (0..24).map(point).collect::<Vec<_>>()
    };
    let in_both = Case::new("halving distances in two levels", deep_in_both(48))
        .built(params)
        .at(points());
    let more = Case::new(
        "more halvings than a trail has levels",
        (0..130).map(halving).collect(),
    );
    vec![in_both, more.built(params).at(points())]
}

/// Mesh lights at halving distances along x, the triangles of each at halving distances along y.
fn deep_in_both(count: u32) -> Vec<EmissiveTriangle> {
    let light = |i: u32| {
        let (m, t) = (i / count, i % count);
        let (x, y) = (exact::pow2(20 - m as i32), exact::pow2(20 - t as i32));
        facing_x([x, y, 0.0], y * 0.125, 1.0, m, 1)
    };
    (0..count * count).map(light).collect()
}

/// Light `i`, at half the distance from the origin of the one before.
fn halving(i: u32) -> EmissiveTriangle {
    let x = exact::pow2(38 - i as i32);
    facing_x([x, 0.0, 0.0], (x * 0.125).max(exact::pow2(-40)), 1.0, 0, 1)
}
