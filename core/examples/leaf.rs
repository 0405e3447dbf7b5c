//! A leaf that lets light through: both of its sides receive, each its own part.
//!
//! `cargo run --release -p lightbvh --example leaf` (seconds). Prints the squared error of one light, chosen by an importance
//! that knows both sides, and checks that the mean is right.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{Transmissive, TransmissivePoint};
use lightbvh::{Defensive, EmissiveTriangle, LightBvh, Moments, ShadingPoint, Transform};

const TRIALS: u32 = 100_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Lamps that shine from both sides, all around.
    let lamp = EmissiveTriangle {
        p: [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: EmissiveTriangle::TWO_SIDED,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    for k in 0..300 {
        let at = [1, 2, 3].map(|axis| 6.0 * unit_f32(hash(3 * k + axis)) - 3.0);
        bvh.add_instance(mesh, Transform::at(at))?;
    }
    bvh.refit();

    // Seen from above: a tenth of what comes from there is reflected, a third of what comes from below passes.
    let leaf = TransmissivePoint {
        point: ShadingPoint {
            p: [0.1, 0.2, 0.3],
            n: [0.0, 1.0, 0.0],
        },
        front: 0.1,
        back: 0.33,
    }
    .checked()?;
    let lights = bvh.world_lights();
    let right: f64 = lights.iter().map(|light| received(light, &leaf)).sum();

    let told = bvh.by::<Defensive<Transmissive<Moments>, 6>>();
    let (mut mean, mut square) = (0.0, 0.0);
    for trial in 0..TRIALS {
        let sampled = told.sample(&leaf, hash(trial));
        let value = received(&lights[sampled.light as usize], &leaf) / f64::from(sampled.pmf) / right;
        mean += value / f64::from(TRIALS);
        square += (value - 1.0).powi(2) / f64::from(TRIALS);
    }
    let sure = 5.0 * (square / f64::from(TRIALS)).sqrt();
    println!("squared error {square:.4}, mean {mean:.4} ± {sure:.4}");
    assert!((mean - 1.0).abs() < sure, "biased");
    Ok(())
}

/// What the leaf takes of a small lamp, its middle for all of it, luminance.
fn received(light: &EmissiveTriangle, leaf: &TransmissivePoint) -> f64 {
    let on = light.point([0.5; 2]);
    let to: [f64; 3] = [0, 1, 2].map(|k| f64::from(on.p[k]) - f64::from(leaf.point.p[k]));
    let d2: f64 = to.iter().map(|x| x * x).sum();
    let cosine = |n: [f32; 3]| (0..3).map(|k| f64::from(n[k]) * to[k]).sum::<f64>() / d2.sqrt();
    let incident = cosine(leaf.point.n);
    let part = if incident > 0.0 { leaf.front } else { leaf.back };
    f64::from(on.radiance[0]) * f64::from(part) * incident.abs() * cosine(on.normal).abs()
        / (d2 * f64::from(on.density))
}
