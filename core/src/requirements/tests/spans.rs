//! Extents against ranks of whole numbers.

use std::vec::Vec;

use super::super::Extent;
use super::super::extent::Span;
use super::below;
use crate::exact::pow2;
use crate::kit::Random;

/// The rank of the differences from the first point, by minors in `i128`.
fn expected(points: &[[i64; 3]]) -> Extent {
    let wide = |p: &[i64; 3]| p.map(i128::from);
    let from: Vec<[i128; 3]> = points
        .iter()
        .map(|p| [0, 1, 2].map(|k| wide(p)[k] - wide(&points[0])[k]))
        .collect();
    let cross = |a: &[i128; 3], b: &[i128; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let mut rank = 0;
    for a in &from {
        rank = rank.max(usize::from(*a != [0; 3]));
        for b in &from {
            let ab = cross(a, b);
            rank = rank.max(if ab == [0; 3] { 0 } else { 2 });
            for c in &from {
                let det = ab[0] * c[0] + ab[1] * c[1] + ab[2] * c[2];
                rank = rank.max(if det == 0 { 0 } else { 3 });
            }
        }
    }
    [Extent::Point, Extent::Collinear, Extent::Planar, Extent::Spatial][rank]
}

fn found(points: &[[f32; 3]]) -> Extent {
    let mut span = Span::default();
    points.iter().for_each(|&p| span.add(p));
    span.extent()
}

#[test]
fn extents_are_ranks() {
    let mut seen = [0; 4];
    for seed in 0..4000_u32 {
        let random = &mut Random(seed * 101);
        let whole = |random: &mut Random, most: i64| {
            [0; 3].map(|_| ((f64::from(random.signed())) * most as f64) as i64)
        };
        let dimensions = below(random, 4) as usize;
        let axes = [whole(random, 30), whole(random, 30), whole(random, 30)];
        let origin = whole(random, 1 << 18);
        let points: Vec<[i64; 3]> = (0..5)
            .map(|_| {
                let mut p = origin;
                for axis in &axes[..dimensions] {
                    let along = ((f64::from(random.signed())) * 500.0) as i64;
                    p = [0, 1, 2].map(|k| p[k] + along * axis[k]);
                }
                p
            })
            .collect();
        // Any scale of the domain; coordinates below 2^20 are exact.
        let scale = pow2(below(random, 110) as i32 - 90);
        let scaled: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32 * scale)).collect();
        let rank = expected(&points);
        assert_eq!(found(&scaled), rank, "{points:?} by {scale:e}");
        seen[rank as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}

/// What `f32` and `f64` would lose: a height of 2^-100 m over a plane of 2^40 m.
#[test]
fn the_least_height_over_the_greatest_plane_counts() {
    let (far, near) = (pow2(40), pow2(-100));
    let plane = [[far, 0.0, 0.0], [0.0, far, 0.0], [-far, -far, 0.0]];
    assert_eq!(found(&plane), Extent::Planar);
    let over = [plane[0], plane[1], plane[2], [1.0, 1.0, near]];
    assert_eq!(found(&over), Extent::Spatial);
    let line = [[0.0; 3], [far, far, far], [-far, -far, -far]];
    assert_eq!(found(&line), Extent::Collinear);
    let off = [line[0], line[1], line[2], [near, 0.0, 0.0]];
    assert_eq!(found(&off), Extent::Planar);
    // A zero of either sign is one place.
    assert_eq!(found(&[[0.0; 3], [-0.0; 3]]), Extent::Point);
}
