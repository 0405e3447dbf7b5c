//! Moving lights: meshes far from the origin, mirrored, scaled by 2^-22 to 2^22, sheared.

use glam::{DMat3, DQuat, DVec3};
use lightbvh::{EmissiveTriangle, Transform, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::scattered;

pub(super) fn cases() -> Vec<Case> {
    let turned = |random: &mut Random, scale: DVec3, at: [f32; 3]| {
        let axis = DVec3::from(random.direction().map(f64::from)).normalize();
        let turn = DMat3::from_quat(DQuat::from_axis_angle(axis, f64::from(random.between(-3.0, 3.0))));
        transform(turn * DMat3::from_diagonal(scale), at)
    };
    let random = &mut Random::new(71);
    let mut spread = |count: u32, reach: f32, scale: &dyn Fn(u32) -> DVec3| -> Vec<(usize, Transform, f32)> {
        (0..count)
            .map(|i| {
                let at = [0; 3].map(|_| random.between(-reach, reach));
                ((i % 3) as usize, turned(random, scale(i), at), 1.0)
            })
            .collect()
    };
    let plain = spread(24, 5.0, &|_| DVec3::ONE);
    let mut far = spread(24, 100.0, &|_| DVec3::splat(40.0));
    for (_, map, _) in &mut far {
        map.translation = [0, 1, 2].map(|k| map.translation[k] + [1e7, -1e7, 1e7][k]);
    }
    let mirrored = spread(24, 5.0, &|i| {
        if i.is_multiple_of(2) {
            DVec3::splat(-1.0)
        } else {
            DVec3::new(1.0, 1.0, -1.0)
        }
    });
    let sheared = spread(24, 5.0, &|i| {
        DVec3::new(1.0, 0.25, if i.is_multiple_of(3) { 0.0 } else { 3.0 })
    });
    let beyond = spread(12, 5e7, &|i| {
        DVec3::splat(f64::from(exact::pow2(if i.is_multiple_of(2) { 22 } else { -22 })))
    });
    let dimmed = plain.iter().enumerate().map(|(i, &(mesh, map, _))| {
        (
            mesh,
            map,
            if i.is_multiple_of(5) {
                0.0
            } else {
                exact::pow2(i as i32 * 5 - 60)
            },
        )
    });
    let dimmed: Vec<_> = dimmed.collect();
    let all = [&plain[..], &far, &mirrored, &sheared, &beyond].concat();
    let meshes = || -> Vec<Vec<EmissiveTriangle>> { (0..3).map(|seed| scattered(24, 80 + seed)).collect() };
    [
        ("instances turned and moved", plain),
        ("instances at 1e7 m", far),
        ("instances mirrored", mirrored),
        ("instances sheared and flattened", sheared),
        ("instances scaled by 2^22 and 2^-22", beyond),
        ("instances dimmed and brightened by 2^60, and off", dimmed),
        ("instances of all these kinds", all),
    ]
    .map(|(name, instances)| Case::moving(name, meshes(), instances))
    .into()
}

fn transform(matrix: DMat3, translation: [f32; 3]) -> Transform {
    Transform {
        columns: [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|c| c.to_array().map(|x| x as f32)),
        translation,
    }
}
