//! Maps against arithmetic by hand; every limit on both of its sides.

extern crate std;

use super::vector::square_root;
use super::*;
use crate::exact::{hash, pow2, unit_f32};

#[test]
fn square_roots_are_those_of_the_hardware() {
    for i in 0..2000 {
        let x = (f64::from(i) * 0.37 - 300.0).exp2();
        let relative = square_root(x) / std::primitive::f64::sqrt(x) - 1.0;
        assert!(relative.abs() < 1e-15, "{x}: {relative}");
    }
    assert_eq!((square_root(0.0), square_root(-1.0)), (0.0, 0.0));
}

fn map(columns: [[f32; 3]; 3], translation: [f32; 3]) -> Transform {
    Transform { columns, translation }
}

/// Entries from −2 to 2, translation from −20 to 20.
fn random(seed: u32) -> Transform {
    let mut state = hash(seed);
    let mut unit = || {
        state = hash(state);
        4.0 * unit_f32(state) - 2.0
    };
    map(
        [0; 3].map(|_| [0; 3].map(|_| unit())),
        [0; 3].map(|_| 10.0 * unit()),
    )
}

fn diagonal(x: f32, y: f32, z: f32) -> Transform {
    map([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], [0.0; 3])
}

/// A mesh so large and smooth that rounding is nothing to it.
const SMOOTH: Extent = Extent {
    radius: 1.0,
    finest: f64::INFINITY,
};

#[test]
fn points_and_determinants() {
    let shear = map(
        [[1.0, 2.0, 3.0], [5.0, 7.0, 11.0], [13.0, 17.0, 19.0]],
        [100.0, 200.0, 300.0],
    );
    assert_eq!(shear.point([1.0, 0.0, 0.0]), [101.0, 202.0, 303.0]);
    assert_eq!(shear.point([0.5, 2.0, -3.0]), [71.5, 164.0, 266.5]);
    // 1 (7·19 − 17·11) − 5 (2·19 − 17·3) + 13 (2·11 − 7·3)
    assert_eq!(shear.determinant(), 24.0);
    let tiny = map([[pow2(-60); 3]; 3], [0.0; 3]);
    assert_eq!(
        tiny.point([pow2(-60); 3]).map(f32::to_bits),
        [0; 3],
        "below 2^-100"
    );

    let triangle = EmissiveTriangle {
        p: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        radiance: [1.0, 2.0, 3.0],
        mesh: 4,
        flags: 1,
    };
    let baked = diagonal(2.0, 3.0, 4.0).bake(&triangle);
    let p = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
    assert_eq!(baked, EmissiveTriangle { p, ..triangle });
    let mirrored = diagonal(2.0, -3.0, 4.0).bake(&triangle);
    let p = [[2.0, 0.0, 0.0], [0.0, 0.0, 4.0], [0.0, -3.0, 0.0]];
    assert_eq!(mirrored, EmissiveTriangle { p, ..triangle });
    // Flattened, a triangle keeps its order.
    let flat = diagonal(2.0, 0.0, 4.0).bake(&triangle);
    let p = [[2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 4.0]];
    assert_eq!(flat.p, p);
}

#[test]
fn what_was_baked_is_undone() {
    for seed in 0..500 {
        let (baked, now) = (random(2 * seed), random(2 * seed + 1));
        if baked.determinant().abs() < 0.1 {
            continue;
        }
        let since = now.since(&baked).expect("not singular");
        for p in [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.3, -2.0, 5.0],
        ] {
            let (found, expected) = (since.point(baked.point(p)), now.point(p));
            for k in 0..3 {
                let off = exact::abs(found[k] - expected[k]);
                assert!(off < 0.02, "{seed} {p:?}: {found:?}, expected {expected:?}");
            }
        }
    }
    let now = random(1);
    // Almost in one plane: the volume of the columns as a share of the product of their lengths.
    for (volume, can) in [(1.0, true), (2e-9, true), (0.5e-9, false), (0.0, false)] {
        for sign in [1.0, -1.0] {
            let thin = [[3.0, 0.0, 0.0], [5.0, 5.0 * volume, 0.0], [0.0, 0.0, 7.0 * sign]];
            assert_eq!(now.since(&map(thin, [0.0; 3])).is_some(), can, "{volume}");
        }
    }
}

#[test]
fn entries_and_reach_are_limited() {
    let most = MAX_COORDINATE;
    for column in 0..4 {
        for row in 0..3 {
            for value in [most, -most, most.next_up(), f32::NAN, f32::NEG_INFINITY] {
                let mut transform = diagonal(0.0, 0.0, 0.0);
                let [a, b, c] = &mut transform.columns;
                [a, b, c, &mut transform.translation][column][row] = value;
                // Of no size, so that nothing is too far.
                let point = Extent {
                    radius: 0.0,
                    ..SMOOTH
                };
                match transform.check(&point) {
                    Ok(()) => assert_eq!(exact::abs(value), most),
                    Err(TransformError::Entry {
                        row: r,
                        column: c,
                        value: v,
                    }) => {
                        assert_eq!((r, c, v.to_bits()), (row, column, value.to_bits()));
                        assert!(exact::abs(value) != most);
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
    // Each of the four parts reaches a fourth of the way.
    let quarter = 0.25 * most;
    for row in 0..3 {
        let mut transform = diagonal(0.0, 0.0, 0.0);
        for column in &mut transform.columns {
            column[row] = -0.5 * quarter;
        }
        transform.translation[row] = quarter;
        let extent = |radius| Extent { radius, ..SMOOTH };
        assert_eq!(transform.check(&extent(2.0)), Ok(()));
        let error = transform.check(&extent(2.001)).expect_err("farther");
        let TransformError::TooFar { metres } = error else {
            panic!("{error}");
        };
        assert!(exact::abs(metres / most - 1.000_375) < 1e-6, "{metres}");
    }
}

#[test]
fn extents() {
    let triangle = |p| EmissiveTriangle {
        p,
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    // Legs of 3 and 4: the height on the side of 5 is 2.4. Moved away from the origin to −(0, 0, 12).
    let right = triangle([[0.0, 0.0, -12.0], [3.0, 0.0, -12.0], [0.0, 4.0, -12.0]]);
    let of = |triangles: &[EmissiveTriangle]| Extent::of(triangles);
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
    let turned = |k: usize| triangle(core::array::from_fn(|i| right.p[(i + k) % 3]));
    for k in 0..3 {
        let extent = of(&[turned(k)]);
        assert!(close(extent.radius, square_root(160.0)), "{extent:?}");
        assert!(close(extent.finest, 2.4), "{extent:?}");
    }
    let flat = triangle([[0.0; 3], [20.0, 0.0, 0.0], [10.0, 0.0, 0.0]]);
    let dark = EmissiveTriangle {
        radiance: [0.0; 3],
        ..triangle([[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]])
    };
    let both_sides = EmissiveTriangle {
        flags: 1,
        ..triangle([[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]])
    };
    for uncounted in [flat, dark, both_sides] {
        assert_eq!(of(&[uncounted]).finest, f64::INFINITY);
    }
    // The greatest of one, the least of another, whatever their order, and however many threads there are.
    let small = triangle([[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]]);
    for triangles in [[right, flat, dark, small], [small, dark, flat, right]] {
        let many: alloc::vec::Vec<_> = triangles.iter().cycle().take(10_000).copied().collect();
        for extent in [of(&triangles), of(&many)] {
            assert_eq!(extent.radius, 20.0);
            assert!(close(extent.finest, square_root(0.125)), "{extent:?}");
        }
    }
    assert_eq!((of(&[]).radius, of(&[]).finest), (0.0, f64::INFINITY));
}

#[test]
fn similarities_have_their_words() {
    let extent = Extent {
        radius: 3.0,
        finest: 0.5,
    };
    // A turn by the triangle 3:4:5 and a scale of 2; an entry below 2^-26 of that, and one that is not.
    let small = 2.0 * pow2(-27);
    let kept = 2.0 * pow2(-25);
    let columns = [[1.2, 1.6, small], [-1.6, 1.2, kept], [0.0, 0.0, 2.0]];
    let shared = map(columns, [10.0, -20.0, pow2(-120)]);
    let instance = shared.similarity(&extent, 0.25).expect("a similarity");
    assert_eq!(
        instance.columns,
        [[1.2, 1.6, 0.0], [-1.6, 1.2, kept], [0.0, 0.0, 2.0]]
    );
    assert_eq!(instance.translation, [10.0, -20.0, 0.0]);
    let close = |a: f32, b: f64| (f64::from(a) / b - 1.0).abs() < 1e-6;
    assert!(close(instance.per_scale, 0.5), "{instance:?}");
    assert!(close(instance.flux, 1.0), "{instance:?}");
    assert_eq!((instance.radiance, instance.mirrored), (0.25, 0));
    // Twice the reach of 6, and the farthest coordinate of 20.
    let error = 32.0 / 4_194_304.0;
    assert!(close(instance.error, error), "{instance:?}");
    assert!(
        close(instance.tilt, 1.0 / 262_144.0 + 4.0 * error / (2.0 * 0.5)),
        "{instance:?}"
    );
    let mut mirrored = shared;
    mirrored.columns[2][2] = -2.0;
    assert_eq!(
        mirrored.similarity(&extent, 1.0).expect("a similarity").mirrored,
        1
    );
    for translation in [[-20.0, 1.0, 2.0], [1.0, 20.0, -2.0], [2.0, 1.0, -20.0]] {
        let moved = Transform {
            translation,
            ..shared
        };
        let instance = moved.similarity(&extent, 1.0).expect("a similarity");
        assert!(close(instance.error, error), "{instance:?}");
    }
}

#[test]
fn similarities_are_told_from_others() {
    let shared = |transform: &Transform| transform.similarity(&SMOOTH, 1.0).is_some();
    assert!(shared(&Transform::IDENTITY));
    // Scales from 2^-19 to 2^19.
    for (scale, can) in [
        (pow2(19), true),
        (pow2(-19), true),
        (pow2(19) * 1.001, false),
        (pow2(-19) * 0.999, false),
        (0.0, false),
    ] {
        assert_eq!(shared(&diagonal(scale, scale, scale)), can, "{scale}");
        assert_eq!(shared(&diagonal(-scale, scale, -scale)), can, "{scale}");
    }
    // Products of columns off by 2^-21 of their squares: one column longer by x has a square longer by 2x, of which a
    // third raises the mean.
    for k in 0..3 {
        let stretched = |x: f32| {
            let mut transform = diagonal(3.0, 3.0, 3.0);
            transform.columns[k][k] *= 1.0 + x;
            shared(&transform)
        };
        assert!(stretched(pow2(-22)) && stretched(-pow2(-22)));
        assert!(!stretched(pow2(-20)) && !stretched(-pow2(-20)));
    }
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let sheared = |x: f32| {
            let mut transform = diagonal(3.0, 3.0, 3.0);
            transform.columns[i][j] = 3.0 * x;
            shared(&transform)
        };
        assert!(sheared(0.9 * pow2(-21)) && sheared(-0.9 * pow2(-21)));
        assert!(!sheared(1.1 * pow2(-21)) && !sheared(-1.1 * pow2(-21)));
    }
    // What rounding may turn by an eighth of a radian: 2^-22 (2 r + t) · 4 / h, and 2^-18 by itself.
    let tilted = |farthest: f32, finest: f64| {
        let moved = Transform::at([0.0, farthest, 0.0]);
        let extent = Extent {
            radius: 0.0009765625,
            finest,
        };
        moved.similarity(&extent, 1.0).is_some()
    };
    assert!(tilted(1000.0, 0.00764) && !tilted(1000.0, 0.00762));
    // Of 2^-30 m in the world, at least.
    let sized = |scale: f32, radius: f64| {
        let extent = Extent {
            radius,
            finest: f64::INFINITY,
        };
        diagonal(scale, scale, scale).similarity(&extent, 1.0).is_some()
    };
    let least = f64::from(pow2(-30));
    assert!(sized(1.0, least) && sized(4.0, least / 4.0) && sized(0.25, 4.0 * least));
    assert!(!sized(1.0, 0.999 * least) && !sized(4.0, 0.999 * least / 4.0) && !sized(0.25, 3.999 * least));
}
