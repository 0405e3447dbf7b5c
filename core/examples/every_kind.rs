//! A room with lights of every kind in one tree, and one light sample of it.
//!
//! `cargo run --release -p lightbvh --example every_kind` (seconds). Prints what share of the samples each kind gets and what a
//! point receives of it.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::light::{AnyLight, DiscLight, Light, PointLight, RectangleLight, SphereLight, SpotLight};
use lightbvh::node::{Lit, SpotMomentNode};
use lightbvh::{Bvh, Defensive, EmissiveTriangle, Moments, ShadingPoint, Transform};

/// Nodes over lights of any kind that know the cones of spots. Where a scene has one kind alone, its own type in place of
/// `AnyLight` is smaller, and `MomentNode` in place of `SpotMomentNode` where it has no spots. A node knows the cone of spots
/// that share it with no others: those of many lamps want a mesh of their own, bright ones a light BVH of their own
/// (docs/walk.md, section 8).
type Room = Bvh<Lit<SpotMomentNode<8>, AnyLight>, Defensive<Moments, 6>, 8>;

const TRIALS: u32 = 200_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let half = [[0.3, 0.0, 0.0], [0.0, 0.0, 0.2]];
    let radiance = [8.0; 3];
    // Each shines from its own origin downwards, or all around; an instance puts it into the room.
    let kinds = [
        AnyLight::from(EmissiveTriangle {
            p: [[0.0; 3], [0.4, 0.0, 0.0], [0.0, 0.0, 0.4]],
            radiance,
            ..EmissiveTriangle::DARK
        }),
        AnyLight::from(PointLight {
            intensity: [3.0; 3],
            ..PointLight::DARK
        }),
        AnyLight::from(SpotLight {
            intensity: [40.0; 3],
            range: 6.0,
            axis: [0.0, -1.0, 0.0],
            cos_inner: 0.95,
            cos_outer: 0.9,
            ..SpotLight::DARK
        }),
        AnyLight::from(SphereLight {
            radius: 0.1,
            radiance,
            ..SphereLight::DARK
        }),
        AnyLight::from(RectangleLight {
            half,
            radiance,
            ..RectangleLight::DARK
        }),
        AnyLight::from(DiscLight {
            half,
            radiance,
            ..DiscLight::DARK
        }),
    ];

    let mut room = Room::default();
    for (k, light) in (0_u8..).zip(kinds) {
        // Checked as it enters: cones inside out, radii of 0 and numbers that are none are errors that say which.
        let mesh = room.add_mesh(vec![light])?;
        for row in 0..40_u8 {
            let [x, z] = [k, row].map(|x| 1.5 * f32::from(x));
            room.add_instance(mesh, Transform::at([x, 3.0, z - 20.0]))?;
        }
    }
    room.refit();
    room.validate()?;

    let point = ShadingPoint {
        p: [4.0, 0.0, 1.0],
        n: [0.0, 1.0, 0.0],
    };
    let mut shares = [0.0; 6];
    let mut received = [0.0; 6];
    for trial in 0..TRIALS {
        let sampled = room.sample(&point, hash(trial));
        let Some(light) = room.triangle(sampled.light, sampled.instance) else {
            continue;
        };
        let uv = [1, 2].map(|k| unit_f32(hash(trial ^ (k << 28))));
        // Of one point of the light, nothing in between, red, W/m².
        let arriving = light.point_for(point.position(), uv).irradiance(&point)[0];
        let kind = sampled.instance as usize / 40;
        shares[kind] += 1.0 / TRIALS as f32;
        received[kind] += arriving / sampled.pmf / TRIALS as f32;
    }
    let names = ["triangle", "point", "spot", "sphere", "rectangle", "disc"];
    for (name, (share, received)) in names.iter().zip(shares.iter().zip(received)) {
        println!(
            "{name:9}: {:5.1} % of the samples, {received:.4} W/m²",
            100.0 * share
        );
    }
    Ok(())
}
