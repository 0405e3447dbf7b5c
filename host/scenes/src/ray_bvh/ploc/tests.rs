use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::ploc::PlocBuilder;

use super::*;
use crate::Scene;

/// What `obvhs` builds, and its own sort.
fn theirs(triangles: &[Triangle]) -> Bvh2 {
    let params = BvhBuildParams::fast_build();
    PlocBuilder::with_capacity(triangles.len()).build(
        params.ploc_search_distance,
        triangles,
        (0..triangles.len() as u32).collect(),
        params.sort_precision,
        params.search_depth_threshold,
    )
}

fn words(bvh: &Bvh2) -> Vec<[u32; 8]> {
    let word = |node: &Bvh2Node| {
        let ([a, b, c], [d, e, f]) = (node.min.to_array(), node.max.to_array());
        let [a, b, c, d, e, f] = [a, b, c, d, e, f].map(f32::to_bits);
        [a, b, c, d, e, f, node.prim_count, node.first_index]
    };
    bvh.nodes.iter().map(word).collect()
}

fn triangle(corners: [[f32; 3]; 3]) -> Triangle {
    let [v0, v1, v2] = corners.map(Vec3A::from);
    Triangle { v0, v1, v2 }
}

/// About `count` triangles of a sphere.
fn sphere(count: usize) -> Vec<Triangle> {
    let side = ((count / 2) as f64).sqrt() as usize;
    let at = |[row, column]: [usize; 2]| {
        let [polar, around] = [row, 2 * column].map(|k| k as f64 / side as f64 * std::f64::consts::PI);
        let ring = libm::sin(polar);
        [
            ring * libm::cos(around),
            libm::cos(polar),
            ring * libm::sin(around),
        ]
        .map(|c| c as f32)
    };
    let squares = (0..side * side).map(|k| [k / side, k % side]);
    let halves = |[i, j]: [usize; 2]| {
        [
            [[i, j], [i + 1, j], [i + 1, j + 1]],
            [[i, j], [i + 1, j + 1], [i, j + 1]],
        ]
        .map(|t| triangle(t.map(at)))
    };
    squares.flat_map(halves).collect()
}

/// Triangles around one corner of a strip.
fn fan(count: usize) -> Vec<Triangle> {
    let at = |k: usize| [k as f32 / count as f32, 0.0, if k % 2 == 1 { 1.0 } else { 0.5 }];
    (1..=count)
        .map(|k| triangle([[0.0; 3], at(k), at(k + 1)]))
        .collect()
}

#[test]
fn ordinary_trees_are_those_of_obvhs() {
    let street = Scene::open("street").expect("built in").frame(0);
    let street: Vec<_> = street.triangles.iter().map(|t| triangle(t.p)).collect();
    // Ten in each place, which are sorted as they may.
    let copies: Vec<_> = sphere(26_000).into_iter().flat_map(|t| [t; 10]).collect();
    assert!(copies.len() > SORTED_BY_STD);
    for triangles in [street, sphere(100_000), copies, sphere(2)] {
        let (own, theirs) = (build(&triangles), theirs(&triangles));
        assert!(!own.is_hard());
        assert!(words(&own.bvh) == words(&theirs));
        assert_eq!(own.bvh.primitive_indices, theirs.primitive_indices);
        assert_eq!(own.bvh.max_depth, theirs.max_depth);
        assert!(
            own.looks <= 16 * triangles.len(),
            "{} {}",
            own.looks,
            triangles.len()
        );
    }
}

/// Work grows with the triangles where rounds merge one pair each, and the tree holds all.
#[test]
fn work_is_bounded() {
    let nested = |count: usize| {
        (1..=count)
            .map(|k| k as f32)
            .map(|r| triangle([[-r, -r, 0.0], [r, -r, 0.0], [0.0, r, 0.0]]))
            .collect()
    };
    let row = |count: usize| {
        (0..count)
            .map(|k| k as f32)
            .map(|x| triangle([[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 1.0, 0.0]]))
            .collect()
    };
    for count in [4000, 64_000] {
        let all: [Vec<Triangle>; 3] = [fan(count), nested(count), row(count)];
        for triangles in all {
            let built = build(&triangles);
            assert!(built.is_hard());
            assert!(built.looks <= most_looks(count) + 3 * count, "{}", built.looks);
            built.bvh.validate(&triangles, false, false);
        }
    }
    assert!(!build(&fan(1000)).is_hard());
}
