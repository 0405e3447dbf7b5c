//! Light that a thin fog sends along a ray: one lamp, chosen by the ray, and one place for that lamp for each trial.
//!
//! `cargo run --release -p lightbvh --example fog` (seconds). Prints the squared error, and checks that the mean is right.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{RaySegment, Subtended};
use lightbvh::light::LightPoint;
use lightbvh::{Defensive, EmissiveTriangle, LightBvh, ShadingPoint, Transform};

const TRIALS: u32 = 200_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A street of lamps that shine down, and a view along it.
    let lamp = EmissiveTriangle {
        p: [[0.0, 4.0, 0.0], [0.1, 4.0, 0.0], [0.0, 4.0, 0.1]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    for k in 0..100_u8 {
        let side = if k % 2 == 0 { -2.0 } else { 2.0 };
        bvh.add_instance(mesh, Transform::at([f32::from(k), 0.0, side]))?;
    }
    bvh.refit();
    let ray = RaySegment {
        from: [0.0, 1.7, 0.3],
        to: [60.0, 3.0, 0.0],
    }
    .checked()?;

    // The sum over all lamps, small as they are, at 20,000 places.
    let lights = bvh.view().world_lights();
    let length = distance(ray.from, ray.to);
    let mut right = 0.0;
    for light in &lights {
        let on = light.point([0.5; 2]);
        for k in 0..20_000_u16 {
            right += sent(&on, ray.at((f32::from(k) + 0.5) / 20_000.0)) * length / 20_000.0;
        }
    }

    let told = bvh.tree().by::<Defensive<Subtended, 6>>();
    let (mut mean, mut square) = (0.0, 0.0);
    for trial in 0..TRIALS {
        let number = hash(trial);
        let sampled = told.sample(&ray, number);
        let on = lights[sampled.light as usize].point([0.5; 2]);
        let (part, density) = equiangular(&ray, on.p, unit_f32(hash(number ^ 1)));
        // Trace the shadow ray here, from the place to the lamp.
        let value = sent(&on, ray.at(part)) / (f64::from(sampled.pmf) * density) / right;
        mean += value / f64::from(TRIALS);
        square += (value - 1.0).powi(2) / f64::from(TRIALS);
    }
    let sure = 5.0 * (square / f64::from(TRIALS)).sqrt() + 1e-3;
    println!("squared error {square:.4}, mean {mean:.4} ± {sure:.4}");
    assert!((mean - 1.0).abs() < sure, "biased");
    Ok(())
}

/// A part of the ray, and its density over length: even over the angle under which `p` sees the ray (Kulla & Fajardo 2012).
fn equiangular(ray: &RaySegment, p: [f32; 3], u: f32) -> (f32, f64) {
    let length = distance(ray.from, ray.to);
    let dot: f64 = (0..3)
        .map(|k| f64::from(p[k] - ray.from[k]) * f64::from(ray.to[k] - ray.from[k]))
        .sum();
    // Where the ray is nearest, and how far away that is.
    let foot = dot / length;
    let d = (distance(ray.from, p).powi(2) - foot * foot).sqrt();
    let [first, last] = [-foot, length - foot].map(|t| (t / d).atan());
    let t = d * (first + (last - first) * f64::from(u)).tan();
    let density = d / ((last - first) * (d * d + t * t));
    (((foot + t) / length) as f32, density)
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f64 {
    let squares = (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).powi(2));
    squares.sum::<f64>().sqrt()
}

/// What a metre of fog at `p` gets, over the density of the lamp's point: alike in all directions, unattenuated, without shadow.
fn sent(on: &LightPoint, p: [f32; 3]) -> f64 {
    on.irradiance(&ShadingPoint { p, n: [0.0; 3] })[0].into()
}
