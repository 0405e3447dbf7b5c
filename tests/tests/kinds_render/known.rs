//! Irradiance that theory tells of each kind of light, and of skies.

use super::*;
use crate::textures::{add, plain_floor, reflects};

/// Irradiance at a point of the floor at `x` from below the lamp, which hangs `h` above it.
fn known(kind: AnalyticKind, h: f64, x: f64) -> f64 {
    let d = (h * h + x * x).sqrt();
    let cosine = h / d;
    match kind {
        AnalyticKind::Point => cosine / (d * d),
        AnalyticKind::Spot { inner, outer } => {
            let (ci, co) = (f64::from(inner).cos(), f64::from(outer).cos());
            let t = ((cosine - co) / (ci - co)).clamp(0.0, 1.0);
            t * t * cosine / (d * d)
        }
        // All of it above the horizon.
        AnalyticKind::Sphere { radius } => PI * f64::from(radius).powi(2) * cosine / (d * d),
        // By quadrature; the lamp's -Z points down, so both normals are vertical.
        AnalyticKind::Rectangle { half } => over(half.map(f64::from), |u, v| [u, v, 1.0], h, x),
        AnalyticKind::Disc { half } => over(
            half.map(f64::from),
            |u, v| [u, v, if u * u + v * v <= 1.0 { 1.0 } else { 0.0 }],
            h,
            x,
        ),
        AnalyticKind::Box { half } => {
            let half = half.map(f64::from);
            let n = 60;
            let step = |i: usize| 2.0 * (i as f64 + 0.5) / f64::from(n as u32) - 1.0;
            let volume = 8.0 * half[0] * half[1] * half[2] / (n as f64).powi(3);
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    for k in 0..n {
                        let p = [half[0] * step(i) - x, half[1] * step(j), h + half[2] * step(k)];
                        let squared = p.iter().map(|x| x * x).sum::<f64>();
                        sum += volume * p[2] / squared.powf(1.5);
                    }
                }
            }
            sum
        }
        AnalyticKind::Directional | AnalyticKind::Profile { .. } => unreachable!("it is not among these"),
    }
}

/// Irradiance of unit radiance from a horizontal surface of `half` sizes; `shape` says where it is.
fn over(half: [f64; 2], shape: impl Fn(f64, f64) -> [f64; 3], h: f64, x: f64) -> f64 {
    let n = 800;
    let step = |i: usize| 2.0 * (i as f64 + 0.5) / f64::from(n as u32) - 1.0;
    let area = 4.0 * half[0] * half[1] / (n as f64).powi(2);
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let [u, v, weight] = shape(step(i), step(j));
            let (dx, dz) = (half[0] * u - x, half[1] * v);
            let squared = dx * dx + dz * dz + h * h;
            sum += weight * area * h * h / (squared * squared);
        }
    }
    sum
}

#[test]
fn each_kind_has_the_known_irradiance() {
    for kind in ALL {
        for x in [0.0, 1.1] {
            let (h, intensity) = (2.5, 3.0);
            let mut data = plain_floor([x as f32, 1.0]);
            add(&mut data, down([0.0, h as f32, 0.0]), kind, intensity as f32);
            reflects(data, [intensity * known(kind, h, x); 3], [0.5; 3], 1e-3);
        }
    }
}

/// The sky of a uniform map lights an open floor as theory says, and as a background does by paths; a sun does by its cosine.
#[test]
fn skies_have_the_known_irradiance() {
    let sun = AnalyticKind::Directional;
    for angle in [0.0_f32, 0.9] {
        // Turned from straight down about x.
        let (sine, cosine) = (0.5 * (angle - std::f32::consts::FRAC_PI_2)).sin_cos();
        let transform = Transform::Trs {
            translation: [0.0; 3],
            rotation: [sine, 0.0, 0.0, cosine],
            scale: [1.0; 3],
        };
        let mut data = plain_floor([0.0, 1.0]);
        add(&mut data, transform, sun, 2.0);
        reflects(data, [2.0 * f64::from(angle).cos(); 3], [0.5; 3], 2e-3);
    }
    let mut data = plain_floor([0.0, 1.0]);
    data.environment = Some(Arc::new(Environment::from_fn(4, |_| [1.5; 3]).expect("a map")));
    reflects(data, [1.5 * PI; 3], [0.5; 3], 2e-3);
    // A small bright patch, which both ways find: weights share it.
    let mut data = plain_floor([0.0, 1.0]);
    let patch = |[x, y, z]: [f32; 3]| {
        let is_bright = x > 0.2 && x < 0.4 && y > 0.7 && z.abs() < 0.1;
        [if is_bright { 200.0 } else { 0.1 }; 3]
    };
    let map = Environment::from_fn(64, patch).expect("a map");
    let mut e = 0.0;
    let n = 2000;
    for i in 0..n {
        for j in 0..4 * n {
            // Even over the hemisphere's cosine: E = π times the mean radiance.
            let (u, v) = (
                (i as f64 + 0.5) / f64::from(n),
                (j as f64 + 0.5) / f64::from(4 * n),
            );
            let (r, angle) = (u.sqrt(), 2.0 * PI * v);
            let d = [r * angle.cos(), (1.0 - u).sqrt(), r * angle.sin()].map(|x| x as f32);
            e += f64::from(map.map().radiance(d)[1]) * PI / (f64::from(n) * f64::from(4 * n));
        }
    }
    data.environment = Some(Arc::new(map));
    reflects(data, [e; 3], [0.5; 3], 2e-3);
}
