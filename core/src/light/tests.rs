//! Every kind of light against integrals in `f64`: flux, moments, the points that are sampled, what they send, and where
//! instances put them.

extern crate std;

use std::format;

use std::vec::Vec;

use glam::Vec3;

use super::*;
use crate::exact;
use crate::kit::lights::{SHINE, disc, rectangle, sphere, spot};
use crate::kit::{Random, Wide, cross, dot, minus, narrow, normalize, times, wide};
use crate::point::ShadingPoint;
use crate::transform::Transform;
use crate::vector::length_squared;

const PI: f64 = core::f64::consts::PI;

fn luminance() -> f64 {
    0.2126 * 2.0 + 0.7152 * 3.0 + 0.0722 * 5.0
}

fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs().max(1e-9),
        "{what}: {found:e}, expected {expected:e}"
    );
}

/// The mean of the irradiance estimated at a receiver, weighted as luminance, over the middles of a grid of numbers.
fn estimated<L: Light>(light: &L, receiver: &ShadingPoint) -> f64 {
    let (n, mut sum) = (512, 0.0);
    for i in 0..n * n {
        let uv = [i % n, i / n].map(|k| (k as f32 + 0.5) / n as f32);
        let [r, g, b] = light
            .point_for(receiver.position(), uv)
            .irradiance(receiver)
            .map(f64::from);
        sum += 0.2126 * r + 0.7152 * g + 0.0722 * b;
    }
    sum / f64::from(n * n)
}

fn receivers() -> Vec<ShadingPoint> {
    let mut random = Random(7);
    let mut out = Vec::new();
    for k in 0..12 {
        let reach = [2.5, 4.0, 30.0][k % 3];
        let unit = |v: Vec3| narrow(normalize(wide(v)));
        let p = unit(random.vector()) * reach + Vec3::new(1.0, 2.0, -1.0);
        let n = if k % 4 == 3 {
            Vec3::ZERO
        } else {
            // Mostly towards the light.
            unit(random.vector() * 0.5 + (Vec3::new(1.0, 2.0, -1.0) - p) / reach)
        };
        out.push(ShadingPoint {
            p: p.to_array(),
            n: n.to_array(),
        });
    }
    out
}

/// What places with normals on the light send, by sums over small pieces: place, normal, size.
fn integrated(pieces: &[(Wide, Wide, f64)], is_two_sided: bool, receiver: &ShadingPoint) -> f64 {
    let (p, n) = (receiver.p.map(f64::from), receiver.n.map(f64::from));
    let in_volume = dot(n, n) == 0.0;
    let of = |(at, normal, size): &(Wide, Wide, f64)| {
        let d = minus(*at, p);
        let squared = dot(d, d);
        let w = times(d, 1.0 / squared.sqrt());
        let incident = if in_volume { 1.0 } else { dot(n, w).max(0.0) };
        let emitted = match -dot(*normal, w) {
            cosine if is_two_sided => cosine.abs(),
            cosine => cosine.max(0.0),
        };
        incident * emitted / squared * size
    };
    luminance() * pieces.iter().map(of).sum::<f64>()
}

/// Pieces of a parallelogram or an ellipse with these half axes.
fn flat_pieces(p: [f32; 3], half: [[f32; 3]; 2], is_round: bool) -> Vec<(Wide, Wide, f64)> {
    let (p, [a, b]) = (p.map(f64::from), half.map(|h| h.map(f64::from)));
    let across = cross(a, b);
    let area = 4.0 * dot(across, across).sqrt();
    let normal = normalize(across);
    let n = 400;
    let mut out = Vec::new();
    for i in 0..n * n {
        let [x, y] = [i % n, i / n].map(|k| 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
        if is_round && x * x + y * y > 1.0 {
            continue;
        }
        let at = [0, 1, 2].map(|k| p[k] + a[k] * x + b[k] * y);
        out.push((at, normal, area / f64::from(n * n)));
    }
    out
}

fn sphere_pieces(light: &SphereLight) -> Vec<(Wide, Wide, f64)> {
    let (p, r) = (light.p.map(f64::from), f64::from(light.radius));
    let n = 800;
    let mut out = Vec::new();
    for i in 0..n * n {
        let z = 2.0 * (f64::from(i % n) + 0.5) / f64::from(n) - 1.0;
        let angle = 2.0 * PI * (f64::from(i / n) + 0.5) / f64::from(n);
        let ring = (1.0 - z * z).sqrt();
        let normal = [ring * angle.cos(), ring * angle.sin(), z];
        let at = [0, 1, 2].map(|k| p[k] + r * normal[k]);
        out.push((at, normal, 4.0 * PI * r * r / f64::from(n * n)));
    }
    out
}

mod cones;
mod domain;
mod irradiance;
mod moments;
mod ranges;
