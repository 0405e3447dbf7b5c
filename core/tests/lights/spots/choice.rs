//! Points beside a cone stop choosing its spot, points in it choose it as often as it is bright.

use super::*;
use glam::Vec3;
use lightbvh::light::{AnyLight, Light, PointLight, SpotLight};
use lightbvh::{BuildParams, Lights, ShadingPoint};

/// Sum of squares of what a sample gives over the square of what all lights give: 1 is perfect.
fn second_moment<L: Light>(lights: &[L], point: &ShadingPoint, pmf: impl Fn(usize) -> f32) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (k, light) in lights.iter().enumerate() {
        let at = light.point_for(Vec3::from(point.p), [0.5; 2]);
        let d: [f64; 3] = core::array::from_fn(|k| f64::from(at.p[k]) - f64::from(point.p[k]));
        let squared: f64 = d.iter().map(|x| x * x).sum();
        let cosine = d.iter().zip(point.n).map(|(x, n)| x * f64::from(n)).sum::<f64>() / squared.sqrt();
        let f = f64::from(at.radiance[0]) * cosine.max(0.0) / squared;
        sum += f;
        if f > 0.0 {
            squares += f * f / f64::from(pmf(k));
        }
    }
    squares / (sum * sum)
}

/// A room with bulbs and a bright narrow spot: beside its cone the bulbs are chosen.
#[test]
fn points_beside_a_cone_choose_what_lights_them() {
    let random = &mut Random(12);
    for angle in [5.0_f32, 15.0, 30.0, 60.0] {
        let mut own: Vec<AnyLight> = (0..8)
            .map(|_| {
                PointLight {
                    p: [4.0 * random.signed(), 4.0 * random.signed(), 3.0],
                    intensity: [1.0; 3],
                    range: 0.0,
                    mesh: 0,
                }
                .into()
            })
            .collect();
        own.push(
            SpotLight {
                p: [0.0, 0.0, 3.5],
                intensity: [2000.0; 3],
                range: 0.0,
                axis: [0.0, 0.0, -1.0],
                cos_inner: angle.to_radians().cos(),
                cos_outer: angle.to_radians().cos(),
                mesh: 0,
            }
            .into(),
        );
        let lights = Lights::new(own.clone()).expect("in the domain");
        let with = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
        let without = Plain::<AnyLight>::single_level(&lights, &BuildParams::default());
        let (mut beside, mut within) = ([0.0, 0.0, 0.0_f64], [0.0, 0.0, 0.0_f64]);
        for _ in 0..400 {
            let p = [5.0 * random.signed(), 5.0 * random.signed(), 0.0];
            let point = ShadingPoint {
                p,
                n: [0.0, 0.0, 1.0],
            };
            let is_within = sent(&own[8], p) > 0.0;
            let sums = if is_within { &mut within } else { &mut beside };
            sums[0] += second_moment(&own, &point, |k| with.pmf(&point, k as u32, u32::MAX)).ln();
            sums[1] += second_moment(&own, &point, |k| without.pmf(&point, k as u32, u32::MAX)).ln();
            sums[2] += 1.0;
        }
        let mean = |sums: [f64; 3]| [(sums[0] / sums[2]).exp(), (sums[1] / sums[2]).exp(), sums[2]];
        println!("{angle}°: beside {:?}, within {:?}", mean(beside), mean(within));
        let [found, was, count] = mean(beside);
        assert!(count > 10.0);
        assert!(found < 2.0, "{angle}: {found}, without {was}");
        let [found, was, count] = mean(within);
        assert!(
            count < 1.0 || found < 1.01 * was,
            "{angle}: {found}, without {was}"
        );
    }
}

/// In its cone a spot counts as what it is there: as bright as a bulb that sends as much, at its side or among spots around it.
#[test]
fn points_in_a_cone_see_how_bright_it_is() {
    for angle in [2.0_f32, 10.0, 25.0, 50.0] {
        let cosine = angle.to_radians().cos();
        let spot = |x: f32| -> AnyLight {
            SpotLight {
                p: [x, 0.0, 4.0],
                intensity: [5.0; 3],
                range: 0.0,
                axis: [0.0, 0.0, -1.0],
                cos_inner: cosine,
                cos_outer: cosine,
                mesh: 0,
            }
            .into()
        };
        let bulb = |x: f32| -> AnyLight {
            PointLight {
                p: [x, 0.0, 4.0],
                intensity: [5.0; 3],
                range: 0.0,
                mesh: 0,
            }
            .into()
        };
        // The spot at 2 m to one side of the point below, the bulb at 2 m to the other.
        let share = |own: Vec<AnyLight>, x: f32| {
            let lights = Lights::new(own).expect("in the domain");
            let bvh = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
            let point = ShadingPoint {
                p: [x, 0.0, 0.0],
                n: [0.0, 0.0, 1.0],
            };
            f64::from(bvh.pmf(&point, 0, u32::MAX))
        };
        let alone = share(vec![spot(0.0), bulb(0.01)], 0.0);
        println!("{angle}°: {alone}");
        assert!((0.33..0.67).contains(&alone), "{angle}: {alone}");
        // Beneath a row of spots a point is in one cone of many: they count for no more than a few bulbs.
        let row: Vec<AnyLight> = core::iter::once(bulb(0.0))
            .chain((0..64).map(|k| spot(10.0 + k as f32)))
            .collect();
        if angle < 5.0 {
            let lone = share(row, 41.5);
            println!("row: {lone}");
            // 0.012; without the depth of the set 0.0005.
            assert!(lone > 0.005, "{lone}");
        }
    }
}
