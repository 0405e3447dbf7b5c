//! Where beams are in the world.

use super::*;
use crate::Transform;
use crate::kit::{Random, narrow};

/// If the map moves a mesh back from far away, its beam still holds all places.
#[test]
fn a_beam_holds_what_a_map_brings_back() {
    let mut random = Random(7);
    let mut brought_back = 0;
    for round in 0..20_000 {
        let far = 10.0_f64.powf(f64::from(random.unit()) * 6.0);
        let scale = 10.0_f64.powf(f64::from(random.unit()) * 4.0 - 2.0);
        let rows = random.axes().map(|row| row.map(|x| (x * scale) as f32));
        let p: [f32; 3] = core::array::from_fn(|_| ((f64::from(random.signed())) * far / scale) as f32);
        let turned = |p: [f32; 3]| -> [f64; 3] {
            core::array::from_fn(|i| (0..3).map(|j| f64::from(rows[i][j]) * f64::from(p[j])).sum())
        };
        // Back to within a part of the way.
        let left = far * 10.0_f64.powf(-6.0 * f64::from(random.unit()));
        let back = turned(p).map(|x| (left * (f64::from(random.signed())) - x) as f32);
        let instance = Transform {
            columns: core::array::from_fn(|j| rows.map(|row| row[j])),
            translation: back,
        }
        .instance(1.0);
        let beam = Beam {
            axis: Vec3::new(0.0, 0.0, -1.0),
            cos_theta_e: 0.9,
            c: Vec3::from(p),
            radius: 0.0,
        };
        let found = beam.to_world(&instance);
        assert!(found.is_narrow(), "{round}");
        let stands = turned(p);
        let squared: f64 = (0..3)
            .map(|i| stands[i] + f64::from(back[i]) - f64::from([found.c.x, found.c.y, found.c.z][i]))
            .map(|x| x * x)
            .sum();
        // What the walk allows for where the point is beside it, and the sum of errors of which it is to be a part.
        let allowed = f64::from(found.radius) + 4.0 * f64::from(rounding_at(found.c));
        assert!(squared.sqrt() <= allowed, "{round}: {} {allowed}", squared.sqrt());
        let limits = Limits {
            beam,
            end: 5.0,
            ..Limits::NONE
        };
        let longer = f64::from(limits.to_world(&instance, found.c).end) - 5.0;
        let allowed = longer + 4.0 * f64::from(rounding_at(found.c)) + 1.0e-6;
        assert!(squared.sqrt() <= allowed, "{round}: {} {allowed}", squared.sqrt());
        brought_back += usize::from(found.radius > 0.0);
    }
    assert!(brought_back > 5_000, "{brought_back}");
    // What stands where it was put keeps its cone whole.
    let still = Beam {
        axis: Vec3::new(0.0, 0.0, -1.0),
        cos_theta_e: 0.9,
        c: Vec3::new(0.5, 0.25, 1.0),
        radius: 0.0,
    };
    let instance = Transform::at([1000.0, 20.0, -3.0]).instance(1.0);
    assert_eq!(still.to_world(&instance).radius, 0.0);
}

/// The sum of the angle between the axes and the beam's own, hardly widened.
#[test]
fn cosine_about_holds_all_directions() {
    let (mut random, mut seen) = (Random(5), [0; 2]);
    for _ in 0..20_000 {
        let [x, y, _] = random.axes();
        let towards = |angle: f64| narrow([0, 1, 2].map(|k| x[k] * angle.cos() + y[k] * angle.sin()));
        let [between, own] = [0; 2].map(|_| 1.4 * f64::from(random.unit() * random.unit()));
        let beam = Beam {
            axis: towards(between),
            cos_theta_e: own.cos() as f32,
            ..Beam::ANYWHERE
        };
        let found = f64::from(beam.cosine_about(towards(0.0) * (0.1 + 0.9 * random.unit())));
        let sum = between + own;
        let is_right = match found > 0.0 {
            true => found <= sum.cos() && found.acos() - sum < 4e-3,
            false => found == -1.0 && sum.cos() < 0.01,
        };
        assert!(is_right, "{between} {own}: {found}");
        seen[usize::from(found > 0.0)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 500), "{seen:?}");
}

/// Columns of lengths `lengths` times `scale`, turned, with `by` of the first axis added to the second, of the second to the
/// third, of the third to the first.
fn map(random: &mut Random, scale: f64, lengths: [f64; 3], by: [f64; 3]) -> Transform {
    let turn = random.axes();
    let columns = core::array::from_fn(|j| {
        let (k, share) = match j {
            1 => (0, by[0]),
            2 => (1, by[1]),
            _ => (2, by[2]),
        };
        core::array::from_fn(|i| (scale * lengths[j] * (turn[i][j] + share * turn[i][k])) as f32)
    });
    Transform {
        columns,
        translation: [0.5, -8.0, 3.0],
    }
}

/// Maps that change angles are told from those that do not, whichever axes they change.
#[test]
fn maps_that_are_uneven_are_known() {
    let mut random = Random(11);
    for _ in 0..200 {
        for scale in [1e-6, 0.01, 1.0, 37.0, 1e6] {
            let even = map(&mut random, scale, [1.0; 3], [0.0; 3]).instance(1.0);
            assert!(even.is_even(), "{scale}");
            // 2^-21 of the origin's greatest coordinate, in the mesh's lengths.
            let expected = 8.0 * 2.0_f64.powi(-21) / scale;
            let found = f64::from(even.space().slack);
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{scale}: {found}, expected {expected}"
            );
            // Ranges are lengths of the world, rounded up.
            let longer = f64::from(even.space().per_metre) * scale;
            assert!((1.0..1.002).contains(&longer), "{scale}: {longer}");
            let off = 2.0_f64.powi(-10);
            for axis in 0..3 {
                let mut lengths = [1.0; 3];
                lengths[axis] += off;
                let mut by = [0.0; 3];
                by[axis] = off;
                for (lengths, by) in [(lengths, [0.0; 3]), ([1.0; 3], by)] {
                    let uneven = map(&mut random, scale, lengths, by).instance(1.0);
                    assert!(!uneven.is_even(), "{scale}: {lengths:?} {by:?}");
                    assert_eq!(uneven.space().slack, -1.0);
                }
            }
            // The third is as long as the first, the second is not, and both of the others are as the second.
            for lengths in [[1.0, 1.0 + off, 1.0], [1.0 + off, 1.0, 1.0]] {
                assert!(!map(&mut random, scale, lengths, [0.0; 3]).instance(1.0).is_even());
            }
        }
    }
}
