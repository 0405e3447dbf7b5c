//! Maps against arithmetic in `f64`; every limit on both of its sides.

extern crate std;

use super::*;
use crate::exact::{self, hash, pow2};
use crate::kit::{Random, narrow, normalize};
use crate::vector::length_squared;

fn map(columns: [[f32; 3]; 3], translation: [f32; 3]) -> Transform {
    Transform { columns, translation }
}

/// Entries from −2 to 2, translation from −20 to 20.
fn random(seed: u32) -> Transform {
    let random = &mut Random(hash(seed));
    let columns = [0; 3].map(|_| (random.vector() * 2.0).to_array());
    map(columns, (random.vector() * 20.0).to_array())
}

fn diagonal(x: f32, y: f32, z: f32) -> Transform {
    map([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], [0.0; 3])
}

fn wide(columns: &[[f32; 3]; 3]) -> [[f64; 3]; 3] {
    columns.map(|column| column.map(f64::from))
}

fn norm(columns: &[[f64; 3]; 3]) -> f64 {
    columns.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

fn determinant(columns: &[[f32; 3]; 3]) -> f64 {
    let [a, b, c] = wide(columns);
    dot(a, cross(b, c))
}

/// The columns of A times the columns of B.
fn product(a: &[[f32; 3]; 3], b: &[[f32; 3]; 3]) -> [[f64; 3]; 3] {
    let (a, b) = (wide(a), wide(b));
    core::array::from_fn(|column| core::array::from_fn(|row| (0..3).map(|k| a[k][row] * b[column][k]).sum()))
}

/// How far a matrix is from the identity, entry by entry.
fn off_identity(columns: &[[f64; 3]; 3]) -> f64 {
    let mut most = 0.0f64;
    for column in 0..3 {
        for row in 0..3 {
            let expected = f64::from(u8::from(row == column));
            most = most.max((columns[column][row] - expected).abs());
        }
    }
    most
}

#[test]
fn inverses_of_random_maps() {
    let mut mirrored = 0;
    for seed in 0..2000 {
        let transform = random(seed);
        let instance = transform.instance(1.0);
        assert_eq!(instance.columns, transform.columns);
        assert_eq!(instance.translation, transform.translation);
        // Each entry of the inverse is rounded once, by 2^-24 of itself; a product's entry is a sum over a row times a column,
        // at most the product of the norms. 1 % for the arithmetic in f64.
        let norms = norm(&wide(&instance.columns)) * norm(&wide(&instance.inverse));
        let most = 1.01 * f64::from(pow2(-24)) * norms;
        for found in [
            product(&instance.columns, &instance.inverse),
            product(&instance.inverse, &instance.columns),
        ] {
            let off = off_identity(&found);
            assert!(off <= most, "{seed}: {off} > {most}");
            assert!(norms > 160.0 || off < 1e-5, "{seed}: {off}");
        }
        let per_inverse = f64::from(instance.per_inverse) * norm(&wide(&instance.inverse));
        assert!((per_inverse - SQRT_3).abs() < 1e-6, "{seed}");
        assert_eq!(
            instance.mirrored,
            u32::from(determinant(&transform.columns) < 0.0),
            "{seed}"
        );
        mirrored += instance.mirrored;
    }
    // Half of all maps mirror: 1000 ± 5 standard deviations of 22.4.
    assert!((888..=1112).contains(&mirrored), "{mirrored}");
}

/// Its square is the mean of the squared area that a unit area of each of three perpendicular planes becomes.
#[test]
fn the_flux_factor_is_the_mean_change_of_area() {
    for seed in 0..500 {
        let [a, b, c] = wide(&random(seed).columns);
        let areas = [cross(b, c), cross(c, a), cross(a, b)].map(|n| dot(n, n));
        let expected = (areas.iter().sum::<f64>() / 3.0).sqrt();
        // Colours count by their luminance.
        for (color, luminance) in [
            ([0.25; 3], 0.25),
            ([0.2, 0.5, 0.9], 0.4651),
            ([0.0, 0.0, 3.0], 0.2166),
        ] {
            let found = f64::from(random(seed).instance_by(color, true).flux);
            assert!(
                (found / (luminance * expected) - 1.0).abs() < 1e-6,
                "{seed}: {found}"
            );
        }
    }
    // A similarity changes every area alike.
    assert_eq!(diagonal(3.0, -3.0, 3.0).instance(1.0).flux, 9.0);
    // A flattened mesh keeps what lay in the plane.
    let flat = diagonal(2.0, 2.0, 0.0).instance(1.0).flux;
    assert!(exact::abs(flat - 4.0 / exact::sqrt(3.0)) < 1e-6, "{flat}");
    // Whatever shines in the mesh shines in the world, in the range of the flux.
    for scale in [0.0, pow2(-70), pow2(-60), pow2(-51), pow2(40)] {
        let flux = diagonal(scale, scale, scale).instance(1.0).flux;
        let expected = if scale < pow2(-50) { pow2(-100) } else { pow2(80) };
        assert_eq!(flux, expected, "{scale}");
        assert_eq!(diagonal(scale, scale, scale).instance(0.0).flux, 0.0);
    }
}

#[test]
fn extremes_stay_in_the_range_of_the_words() {
    let (large, small) = (pow2(40), pow2(-60));
    for exponent in -60..=40 {
        let scale = pow2(exponent);
        let instance = diagonal(scale, -scale, scale).instance(1.0);
        let inverse = pow2(-exponent);
        assert_eq!(instance.inverse, diagonal(inverse, -inverse, inverse).columns);
        assert_eq!(instance.mirrored, 1);
    }
    let one = [1.0, 0.0, -1.0];
    let maps = [
        diagonal(large, 1.0, small),
        diagonal(large, large, small),
        diagonal(small, small, large),
        diagonal(0.0, 0.0, 0.0),
        diagonal(0.0, 0.0, large),
        diagonal(small.next_down(), 0.0, 0.0),
        diagonal(f32::from_bits(1), f32::from_bits(1), f32::from_bits(1)),
        map([[large; 3]; 3], [-large; 3]),
        map([[small; 3]; 3], [f32::from_bits(1); 3]),
        map([one, one, one], [0.0; 3]),
        map([one, one, [0.0, 1.0, 0.0]], [0.0; 3]),
        map([one, one.map(|x| x * 3.0), [0.0; 3]], [0.0; 3]),
        // Of full rank by a hair.
        map([one, [1.0, 0.0, (-1.0f32).next_up()], [0.0, 1.0, 0.0]], [0.0; 3]),
        map(
            [one.map(|x| x * large), [1.0, 1.0, 1.0], one.map(|x| x * small)],
            [0.0; 3],
        ),
    ];
    for (i, transform) in maps.iter().enumerate() {
        for radiance in [0.0, 1.0, pow2(-40), pow2(40)] {
            let instance = transform.instance(radiance);
            let entry = |x: f32, most: f32| x.to_bits() == 0 || (small..=most).contains(&exact::abs(x));
            assert!(
                instance.columns.iter().flatten().all(|&x| entry(x, large)),
                "{i}: {instance:?}"
            );
            assert!(
                instance.inverse.iter().flatten().all(|&x| entry(x, pow2(60))),
                "{i}: {instance:?}"
            );
            assert!(
                instance.per_inverse.is_finite() && instance.per_inverse >= 0.0,
                "{i}"
            );
            let shines = (pow2(-100)..=pow2(100)).contains(&instance.flux);
            assert!(shines == (radiance > 0.0), "{i}: {instance:?}");
        }
    }
    // A singular map mirrors nothing: triangles keep the order of their vertices.
    for transform in &maps[9..12] {
        assert_eq!(transform.instance(1.0).mirrored, 0);
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
                let refused = transform.check(0.0).err().map(|error| std::format!("{error}"));
                assert_eq!(refused.is_none(), exact::abs(value) == most);
                let name = match column {
                    3 => std::format!("translation[{row}] is"),
                    _ => std::format!("columns[{column}][{row}] is"),
                };
                assert!(refused.is_none_or(|said| said.starts_with(&name)), "{name}");
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
        assert_eq!(transform.check(2.0), Ok(()));
        let error = transform.check(2.001).expect_err("farther");
        let said = std::format!("{error}");
        assert!(said.contains("moves a mesh is 1.09992"), "{said}");
    }
}

/// Every way to write a map down gives the same one.
#[test]
fn maps_are_made_of_what_engines_have() {
    let made = random(5);
    let [a, b, c] = made.columns;
    let t = made.translation;
    assert_eq!(Transform::from_cols([a, b, c, t]), made);
    let row = |k: usize| [a[k], b[k], c[k], t[k]];
    assert_eq!(Transform::from_rows([row(0), row(1), row(2)]), made);
    let columns = [a, b, c].map(Vec3::from);
    let glam = Affine3A::from_mat3_translation(
        glam::Mat3::from_cols(columns[0], columns[1], columns[2]),
        t.into(),
    );
    assert_eq!(Transform::from(glam), made);
    // A quarter of a turn about z, after the scale and before the way.
    let turn = [
        0.0,
        0.0,
        core::f32::consts::FRAC_1_SQRT_2,
        core::f32::consts::FRAC_1_SQRT_2,
    ];
    let made = Transform::from_trs([1.0, 2.0, 3.0], turn, [2.0, 3.0, 4.0]);
    let expected = [[0.0, 2.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 0.0, 4.0]];
    for (found, expected) in made.columns.iter().flatten().zip(expected.iter().flatten()) {
        assert!(exact::abs(found - expected) < 1e-6, "{made:?}");
    }
    assert_eq!(made.translation, [1.0, 2.0, 3.0]);
}

/// −Z goes to the direction, +Y towards up, and the map is a rotation, also where there is no up.
#[test]
fn maps_look_along_their_direction() {
    let ups = [
        [0.0, 1.0, 0.0],
        [0.3, -2.0, 0.1],
        [0.0; 3],
        [0.0, 0.0, -5.0],
        [0.9, 1.5, 2.1],
    ];
    for direction in [
        [0.0, 0.0, -5.0],
        [0.0, -1.0, 0.0],
        [3.0, 4.0, -1.0],
        [0.0; 3],
        [0.3, 0.5, 0.7],
        [1.0e20, 0.0, 0.0],
        [0.0, 1.0e-24, 0.0],
    ] {
        for up in ups {
            let made = Transform::look_along([7.0, 8.0, 9.0], direction, up);
            let [x, y, z] = made.columns.map(Vec3::from);
            for unit in [x, y, z] {
                assert!(exact::abs(length_squared(unit) - 1.0) < 1e-5, "{made:?}");
            }
            assert!(length_squared(crate::vector::cross(x, y) - z) < 1e-9, "{made:?}");
            assert!(crate::vector::dot(y, up.into()) > -1e-3, "{made:?}");
            let to = match direction == [0.0; 3] {
                true => -z,
                false => narrow(normalize(direction.map(f64::from))),
            };
            assert!(length_squared(to + z) < 1e-9, "{made:?}");
            assert_eq!(made.translation, [7.0, 8.0, 9.0]);
        }
    }
    for (direction, up) in [
        ([f32::NAN, 0.0, 0.0], ups[0]),
        (ups[0], [0.0, f32::INFINITY, 0.0]),
    ] {
        assert!(Transform::look_along([0.0; 3], direction, up).check(1.0).is_err());
    }
}
