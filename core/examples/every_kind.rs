//! A room with lights of every kind in one tree, and one light sample of it.
//!
//! `cargo run --release -p lightbvh --example every_kind` (seconds). Prints what share of the samples each kind gets and what a
//! point receives of it, and checks that the sum is right.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::light::{
    AnyLight, BoxLight, DiscLight, Light, PointLight, RectangleLight, SphereLight, SpotLight,
};
use lightbvh::node::{Lit, SpotMomentNode};
use lightbvh::{Bvh, Defensive, EmissiveTriangle, Moments, ShadingPoint, Transform};

/// Nodes over lights of any kind that know the cones of spots. Where a scene has one kind alone, its own type in place of
/// `AnyLight` is smaller, and `MomentNode` in place of `SpotMomentNode` where it has no spots. A node knows the cone of spots
/// that share it with no others: those of many lamps want a mesh of their own, bright ones a light BVH of their own
/// (docs/walk.md, section 8).
type Room = Bvh<Lit<SpotMomentNode<8>, AnyLight>, Defensive<Moments, 6>, 8>;

const TRIALS: u32 = 200_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (p, mesh, flags) = ([0.0; 3], 0, 0);
    let flat = [[0.3, 0.0, 0.0], [0.0, 0.0, 0.2]];
    // Each shines from its own origin downwards, or all around; an instance puts it into the room.
    let kinds: [(&str, AnyLight); 7] = [
        (
            "triangle",
            EmissiveTriangle {
                p: [[0.0; 3], [0.4, 0.0, 0.0], [0.0, 0.0, 0.4]],
                radiance: [20.0; 3],
                mesh,
                flags,
            }
            .into(),
        ),
        (
            "point",
            PointLight {
                p,
                intensity: [3.0; 3],
                range: 0.0,
                mesh,
            }
            .into(),
        ),
        (
            "spot",
            SpotLight {
                p,
                intensity: [40.0; 3],
                range: 6.0,
                axis: [0.0, -1.0, 0.0],
                cos_inner: 0.95,
                cos_outer: 0.9,
                mesh,
            }
            .into(),
        ),
        (
            "sphere",
            SphereLight {
                p,
                radius: 0.1,
                radiance: [30.0; 3],
                mesh,
            }
            .into(),
        ),
        (
            "rectangle",
            RectangleLight {
                p,
                half: flat,
                radiance: [8.0; 3],
                mesh,
                flags,
            }
            .into(),
        ),
        (
            "disc",
            DiscLight {
                p,
                half: flat,
                radiance: [8.0; 3],
                mesh,
                flags,
            }
            .into(),
        ),
        (
            "box",
            BoxLight {
                p,
                half: [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]],
                radiance: [9.0; 3],
                mesh,
            }
            .into(),
        ),
    ];

    let mut room = Room::default();
    for (k, (_, light)) in (0_u8..).zip(kinds) {
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
    let mut shares = [0.0; 7];
    let (mut mean, mut square) = (0.0, 0.0);
    let mut received = [0.0; 7];
    for trial in 0..TRIALS {
        let sampled = room.sample(&point, hash(trial));
        let Some(light) = room.triangle(sampled.light, sampled.instance) else {
            continue;
        };
        let uv = [1, 2].map(|k| unit_f32(hash(trial ^ (k << 28))));
        let value = arriving(&light, &point, uv) / f64::from(sampled.pmf);
        let kind = sampled.instance as usize / 40;
        shares[kind] += 1.0 / f64::from(TRIALS);
        received[kind] += value / f64::from(TRIALS);
        mean += value / f64::from(TRIALS);
        square += value * value / f64::from(TRIALS);
    }
    for ((name, _), (share, received)) in kinds.iter().zip(shares.iter().zip(received)) {
        println!(
            "{name:9}: {:5.1} % of the samples, {received:.4} W/m²",
            100.0 * share
        );
    }

    // All lights, many points of each.
    let lights = room.world_lights();
    let right: f64 = lights
        .iter()
        .flat_map(|light| {
            (0..1000)
                .map(move |k| [3 * k + 1, 3 * k + 2].map(|x| unit_f32(hash(x))))
                .map(move |uv| (light, uv))
        })
        .map(|(light, uv)| arriving(light, &point, uv) / 1000.0)
        .sum();
    let sure = 5.0 * ((square - mean * mean) / f64::from(TRIALS)).sqrt() + 0.01 * right;
    println!(
        "together {mean:.4} W/m², summed over all {} lights {right:.4}",
        lights.len()
    );
    assert!((mean - right).abs() < sure, "{mean} {right}");
    Ok(())
}

/// Irradiance at `point` by one point of a light, nothing in between, red, W/m².
fn arriving(light: &AnyLight, point: &ShadingPoint, uv: [f32; 2]) -> f64 {
    f64::from(light.point_for(point.position(), uv).irradiance(point)[0])
}
