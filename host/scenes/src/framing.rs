//! The camera of a scene that brings none.
//!
//! Points on surfaces stand for what there is to see, each weighted by the square root of its light. Candidates stand around them
//! and between surfaces; the one that sees the most wins. The work is at most 6,200 shadow rays, and 74,000 rays between 192 candidates and 384 points, in the same order in every run.

use glam::{DVec3, Vec3};
use lightbvh::ShadingPoint;
use lightbvh::light::{AnyLight, Light};
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle, closest_hit};

use super::camera::{View, looking};
use super::frame::Frame;
use super::ray_bvh::RayBvh;
use super::scene_light::SceneLight;

/// Points, each with two sides, and the lights that each asks.
const POINTS: usize = 192;
const LIGHTS: usize = 16;

/// Weight of a back against a front, of all dark fronts against all that is lit, of a candidate between surfaces.
const BACK: f64 = 0.2;
const DARK: f64 = 0.05;
const INSIDE: f64 = 0.6;

/// Candidates around a box: degrees above the horizon and weight; half diagonals away and weight.
const ABOVE: [(f64, f64); 3] = [(18.0, 1.0), (5.0, 0.92), (34.0, 0.88)];
const AWAY: [(f64, f64); 3] = [(1.3, 0.9), (1.7, 1.0), (2.37, 0.95)];

/// Vertical field of view: 50 degrees, a natural view on a screen.
const YFOV: f32 = 0.872_664_6;

/// One side of a surface; `size` is in metres.
struct Point {
    p: DVec3,
    n: DVec3,
    size: f64,
    weight: f64,
}

/// The view of a frame.
pub(super) fn view(frame: &Frame) -> View {
    let surfaces = &frame.triangles;
    let vertices = || surfaces.iter().flat_map(|own| own.p).map(wide);
    let low = vertices().reduce(DVec3::min).unwrap_or_default();
    let high = vertices().reduce(DVec3::max).unwrap_or_default();
    let first = around(low, high, DVec3::new(0.35, 0.3, 1.0).normalize(), 2.37);
    let mut best = (0.0, first);
    let Ok(rays) = RayBvh::build(surfaces) else {
        return best.1;
    };
    let size = low.distance(high);
    let points = points(frame, &rays, size);
    let mean: DVec3 = points.iter().map(|own| own.weight * own.p).sum();
    let square = |own: &Point| own.weight * (own.p - mean) * (own.p - mean);
    let most = 2.0 * points.iter().map(square).sum::<DVec3>().map(f64::sqrt);
    let lit = (low.max(mean - most), high.min(mean + most), 0.85);
    let mut candidates = between(&points, &rays, size);
    for (low, high, of_box) in [(low, high, 1.0), lit] {
        for (k, (above, of_height)) in (0..8).flat_map(|k| ABOVE.map(|above| (k, above))) {
            // The front is preferred: models of glTF face +Z.
            let towards = direction(if above < 10.0 { 0.0 } else { 19.0 } + 45.0 * f64::from(k), above);
            let counts = of_box * of_height * if towards.z < -0.1 { 0.8 } else { 1.0 };
            candidates.extend(AWAY.map(|(away, of_way)| (around(low, high, towards, away), counts * of_way)));
        }
    }
    for (view, counts) in candidates {
        let score = counts * seen(&points, &rays, &view, 0.025 * size);
        if score > best.0 {
            best = (score, view);
        }
    }
    best.1
}

/// A camera that looks at the middle of a box, from the direction `towards`, `distance` half diagonals away; at 2.37 of them the
/// sphere around the box touches the image's upper and lower edge.
fn around(low: DVec3, high: DVec3, towards: DVec3, distance: f64) -> View {
    let radius = (0.5 * low.distance(high)).max(1e-3);
    let eye = 0.5 * (low + high) + distance * radius * towards;
    looking(eye.into(), (-towards).into(), [0.0, 1.0, 0.0], YFOV)
}

/// What there is to see: of each point the front and the back. All weights together are one.
fn points(frame: &Frame, rays: &RayBvh, size: f64) -> Vec<Point> {
    let surfaces = &frame.triangles;
    let lights: Vec<AnyLight> = frame.lights();
    let flux: Vec<f64> = lights.iter().map(SceneLight::flux).collect();
    let chosen = spread(&flux, 8 * LIGHTS);
    let each = flux.iter().sum::<f64>() / LIGHTS as f64;
    let root = |own: &SurfaceTriangle| libm::cbrt(DVec3::from(crate::vector::normal(own.p)).length());
    let roots: Vec<f64> = surfaces.iter().map(root).collect();
    let triangles = spread(&roots, POINTS.min(8 * roots.len()));
    let count = triangles.len() as f64;
    let root = roots.iter().sum::<f64>() / count;
    let mut all = Vec::new();
    for (k, index) in triangles.into_iter().enumerate() {
        let own = &surfaces[index];
        let [a, b, c] = own.p.map(wide);
        let [u, v] = sequence(k).map(f64::from);
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        // Off the edges, where both sides of a corner may be seen.
        let p = a + (0.01 + 0.97 * u) * (b - a) + (0.01 + 0.97 * v) * (c - a);
        let front = (b - a).cross(c - a).normalize_or_zero();
        for (n, counts) in [(front, 1.0), (-front, BACK)] {
            let start = p + 1e-6 * size * n;
            let [at, towards] = [start, n].map(|v| v.as_vec3().to_array());
            let receiver = ShadingPoint { p: at, n: towards };
            let shining = lights.get(own.light as usize).filter(|_| n == front);
            let shining = shining.map(|own| own.point_for((p + n).as_vec3(), [0.5; 2]).radiance);
            let mut light = luminance(shining.unwrap_or_default());
            for &index in chosen.iter().skip(k % 8).step_by(8) {
                let at = lights[index].point_for(receiver.position(), sequence(k));
                let irradiance = luminance(at.irradiance(&receiver)) * each / flux[index];
                if irradiance > 0.0 && distance(rays, start, wide(at.p) - start, 1.0).is_none() {
                    light += irradiance;
                }
            }
            let (size, weight) = (roots[index] * root.sqrt(), counts * light.min(1e30).sqrt());
            all.push(Point { p, n, size, weight });
        }
    }
    let sum = |all: &[Point]| all.iter().map(|own| own.weight).sum::<f64>();
    let dark = DARK * sum(&all).max(1e-30) / count;
    all.iter_mut().step_by(2).for_each(|front| front.weight += dark);
    let sum = sum(&all);
    all.iter_mut().for_each(|own| own.weight /= sum);
    all
}

/// The weight of what is seen: in the image, on this side, farther than `near`, nothing before it. What is small counts less.
fn seen(points: &[Point], rays: &RayBvh, view: &View, near: f64) -> f64 {
    let [eye, right, up, forward] = [view.eye, view.right, view.up, view.forward].map(wide);
    let tangent = libm::tan(0.5 * f64::from(view.yfov));
    let counts = points.iter().map(|own| {
        let d = own.p - eye;
        let (depth, faces) = (d.dot(forward), -d.normalize_or_zero().dot(own.n));
        let half = depth * tangent;
        let is_in = depth > near && d.dot(right).abs() < 1.5 * half && d.dot(up).abs() < half;
        if !is_in || faces <= 0.0 || distance(rays, eye, d + 1e-5 * d.length() * own.n, 1.0).is_some() {
            return 0.0;
        }
        own.weight * (own.size / (0.065 * half)).min(1.0) * (faces / 0.4).min(1.0)
    });
    counts.sum()
}

/// Candidates in front of walls that look at the opposite side.
fn between(points: &[Point], rays: &RayBvh, size: f64) -> Vec<(View, f64)> {
    let is_wall = |own: &&Point| own.weight > 0.0 && own.n.y.abs() < 0.5;
    let candidates = points.iter().filter(is_wall).enumerate().flat_map(|(k, own)| {
        let d = (1.5 * own.n + direction(137.5 * k as f64, -20.0)).normalize_or_zero();
        let start = own.p + 1e-5 * size * own.n;
        // Where nothing is opposite it is outside.
        let eye = distance(rays, start, d, FAR).map(|across| start + 0.05 * across * d);
        let forward = DVec3::new(d.x, 0.3 * d.y, d.z).normalize_or(DVec3::NEG_Z);
        eye.map(|eye| looking(eye.into(), forward.into(), [0.0, 1.0, 0.0], 1.05))
    });
    candidates.take(48).map(|view| (view, INSIDE)).collect()
}

/// `count` indices, each as often as its weight says; none where there is no weight.
fn spread(weights: &[f64], count: usize) -> Vec<usize> {
    let add = |total: &mut f64, weight: &f64| {
        *total += weight;
        Some(*total)
    };
    let sums: Vec<f64> = weights.iter().scan(0.0, add).collect();
    let total = sums
        .last()
        .copied()
        .filter(|total| *total > 0.0 && total.is_finite());
    let at =
        |i: usize| sums.partition_point(|&sum| sum < total.unwrap_or(0.0) / count as f64 * (i as f64 + 0.5));
    (0..total.map_or(0, |_| count)).map(at).collect()
}

/// The `i`-th of evenly spread pairs (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
fn sequence(i: usize) -> [f32; 2] {
    [0.754_877_666_246_692_8, 0.569_840_290_998_053_3].map(|step| ((0.5 + i as f64 * step) % 1.0) as f32)
}

/// The unit vector at degrees around +Y, from +Z towards +X, and above the horizon.
fn direction(around: f64, above: f64) -> DVec3 {
    let [around, above] = [around, above].map(f64::to_radians);
    DVec3::new(libm::sin(around), libm::tan(above), libm::cos(around)).normalize()
}

/// To the first surface between `from` and so many lengths of `d`.
fn distance(rays: &RayBvh, from: DVec3, d: DVec3, far: f32) -> Option<f64> {
    let ray = Ray::new(from.as_vec3(), d.as_vec3(), far * (1.0 - 1e-6));
    let hit = closest_hit(&rays.surfaces(), &ray);
    (hit.triangle != NONE).then_some(f64::from(hit.t))
}

fn luminance(rgb: [f32; 3]) -> f64 {
    rgb.iter().map(|&channel| f64::from(channel)).sum::<f64>() / 3.0
}

fn wide(v: [f32; 3]) -> DVec3 {
    Vec3::from(v).as_dvec3()
}
