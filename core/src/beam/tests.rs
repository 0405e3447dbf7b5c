//! Where beams are in the world.

use super::*;
use crate::Transform;
use crate::kit::Random;

/// A rotation by a random unit quaternion, in `f64`.
fn rotation(random: &mut Random) -> [[f64; 3]; 3] {
    let mut q = [0.0_f64; 4];
    let mut squared = 0.0;
    while !(0.01..=1.0).contains(&squared) {
        q = core::array::from_fn(|_| f64::from(random.signed()));
        squared = q.iter().map(|x| x * x).sum();
    }
    let [x, y, z, w] = q.map(|x| x / squared.sqrt());
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - z * w),
            2.0 * (x * z + y * w),
        ],
        [
            2.0 * (x * y + z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - x * w),
        ],
        [
            2.0 * (x * z - y * w),
            2.0 * (y * z + x * w),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// Lamps stood outside of their own beams where a mesh far from its own origin is brought back: two of 34,000 lit lights were told that they do not
/// reach a point.
#[test]
fn a_beam_holds_what_a_map_brings_back() {
    let mut random = Random(7);
    let mut brought_back = 0;
    for round in 0..20_000 {
        let far = 10.0_f64.powf(f64::from(random.unit()) * 6.0);
        let scale = 10.0_f64.powf(f64::from(random.unit()) * 4.0 - 2.0);
        let rows = rotation(&mut random).map(|row| row.map(|x| (x * scale) as f32));
        let p: [f32; 3] = core::array::from_fn(|_| ((f64::from(random.signed())) * far / scale) as f32);
        let turned = |p: [f32; 3]| -> [f64; 3] {
            core::array::from_fn(|i| (0..3).map(|j| f64::from(rows[i][j]) * f64::from(p[j])).sum())
        };
        // Back to within a part of the way.
        let left = far * 10.0_f64.powf(-6.0 * f64::from(random.unit()));
        let back = turned(p).map(|x| (left * (f64::from(random.signed())) - x) as f32);
        let columns = core::array::from_fn(|i| [rows[i][0], rows[i][1], rows[i][2], back[i]]);
        let instance = Transform::from_rows(columns).instance(1.0);
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
