//! The camera of a scene that brings none: it frames what is lit.
//!
//! Light is sent out from points spread evenly over the flux of all lights; where it lands, and the lights themselves, are what there
//! is to see. The part of space that holds nearly all of it is looked at from some places around and in it, and that place is taken from
//! which most of it is seen. The number of rays is bounded, and small for small scenes.

use glam::Vec3;
use lightbvh::light::{AnyLight, Light, SpotLight};
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_kernels::shading::trace::{LANES, NONE, any_hit, closest_hit};

use super::camera::{DEFAULT_YFOV, view_of_box};
use super::frame::Frame;
use super::scene_light::SceneLight;
use crate::render::{RayBvh, View};
use crate::vector::{cross, dot, normal, sub};

/// Rays that light is sent out on, at least and at most, and how many for each triangle.
const SENT: (usize, usize, usize) = (64, 384, 4);

/// Points on lights, at most.
const LIGHTS: usize = 64;

/// What all lights count against all places that they light: enough to be in the image, not so much that nothing else need be.
const LIGHTS_COUNT: f64 = 0.15;

/// Part of what is to be seen that may be outside of the image on each side of each axis: a lamp's far end, a distant wall.
const OUTSIDE: f64 = 0.02;

/// Directions that the camera is tried in, degrees around the upward axis and above the horizon; the first from the front, a
/// little to the right. From below floors hide what is lit on them, and nobody looks from there; of what shows as well from behind, the
/// front is wanted.
const AROUND: [f64; 8] = [19.0, -26.0, 64.0, -71.0, 109.0, -116.0, 154.0, 199.0];
const ABOVE: [(f64, f64); 3] = [(16.0, 1.0), (40.0, 1.0), (-25.0, 0.6)];

/// Distances that it is tried at, in radii of what is to be seen, and what a place so far away counts: the whole is rather seen than a
/// part, but from inside where nearly all is hidden from without. The first one has all of it in the image.
const DISTANCES: [(f64, f64); 3] = [(2.37, 1.0), (0.95, 0.48), (0.5, 0.42)];

/// A point on a side of a surface.
struct Point {
    p: [f64; 3],
    /// Towards the side that is lit; zero where both are.
    n: [f64; 3],
    /// What it counts.
    weight: f64,
}

/// The view of a frame by its triangles, lights and materials.
pub(super) fn view(frame: &Frame) -> View {
    let whole = bounds(frame.triangles.iter().flat_map(|triangle| triangle.p));
    let whole = whole.unwrap_or(([0.0; 3], [0.0; 3]));
    let fallback = view_of_box(whole.0, whole.1, [0.35, 0.3, 1.0], DISTANCES[0].0);
    // A scene that rays cannot be traced in is refused when it is rendered.
    let Ok(rays) = RayBvh::build(&frame.triangles) else {
        return fallback;
    };
    let points = points(frame, &rays, sub(whole.1, whole.0));
    if points.is_empty() {
        return fallback;
    }
    let (low, high) = part_that_holds(&points);
    let narrow = libm::cos(0.5 * f64::from(DEFAULT_YFOV));
    let mut best = (0.0, fallback);
    for (distance, counts) in DISTANCES {
        for (direction, of_direction) in directions() {
            let view = view_of_box(low, high, direction, distance);
            let eye = view.eye.map(f64::from);
            let forward = view.forward.map(f64::from);
            let mut score = 0.0;
            for Point { p, n, weight } in &points {
                let d = sub(*p, eye);
                let seen = dot(d, *n) <= 0.0 && dot(d, forward) > narrow * dot(d, d).sqrt();
                if seen && clear(&rays, eye, *p) {
                    score += weight * counts * of_direction;
                }
            }
            if score > best.0 {
                best = (score, view);
            }
        }
    }
    best.1
}

/// Whether nothing lies between two points.
fn clear(rays: &RayBvh, from: [f64; 3], to: [f64; 3]) -> bool {
    let ray = Ray::new(narrowed(from), narrowed(sub(to, from)), 0.999);
    !any_hit(&rays.surfaces(), &ray, NONE)
}

fn narrowed(v: [f64; 3]) -> Vec3 {
    Vec3::from(v.map(|x| x as f32))
}

/// Where light lands, and where it comes from.
fn points(frame: &Frame, rays: &RayBvh, size: [f64; 3]) -> Vec<Point> {
    let luminance = |rgb: [f32; 3]| rgb.iter().map(|&channel| f64::from(channel)).sum::<f64>() / 3.0;
    let triangles = frame
        .emissive
        .iter()
        .map(|light| area(&light.p) * luminance(light.radiance));
    // As triangles' are: without π.
    let others = frame
        .others
        .iter()
        .map(|light| light.flux() / std::f64::consts::PI);
    let flux: Vec<f64> = triangles.chain(others).collect();
    let mut points = Vec::new();
    let sent = (SENT.2 * frame.triangles.len()).clamp(SENT.0, SENT.1);
    let step = 1e-6 * dot(size, size).sqrt();
    for (index, i) in spread(&flux, sent) {
        let (start, n) = point_on(frame, index, i);
        // Every other ray from the back.
        let n = if is_two_sided(frame, index) && i % 2 == 1 {
            n.map(|x| -x)
        } else {
            n
        };
        let d = if n == [0.0; 3] { anywhere(i) } else { cosine(n, i) };
        let start = [0, 1, 2].map(|axis| start[axis] + step * d[axis]);
        let hit = closest_hit(&rays.surfaces(), &Ray::new(narrowed(start), narrowed(d), FAR));
        let (block, lane) = (hit.triangle as usize / LANES, hit.triangle as usize % LANES);
        let Some(triangle) = rays.blocks.get(block).and_then(|block| block.get(lane)) else {
            continue;
        };
        let reflects = frame
            .materials
            .get(triangle.material as usize)
            .map_or(0.0, |material| {
                luminance(material.albedo) + f64::from(material.specular)
            });
        let n = unit(normal(triangle.p));
        points.push(Point {
            p: [0, 1, 2].map(|axis| start[axis] + f64::from(hit.t) * d[axis]),
            n: if dot(n, d) > 0.0 { n.map(|x| -x) } else { n },
            weight: reflects,
        });
    }
    let lit: f64 = points.iter().map(|point| point.weight).sum();
    points.retain(|point| point.weight > 0.0);
    let count = LIGHTS.min(4 * flux.len());
    let all = if lit > 0.0 { LIGHTS_COUNT * lit } else { 1.0 };
    let weight = all / count.max(1) as f64;
    points.extend(spread(&flux, count).map(|(index, i)| {
        let (p, n) = point_on(frame, index, i);
        let n = if is_two_sided(frame, index) { [0.0; 3] } else { n };
        Point { p, n, weight }
    }));
    points
}

/// The `i`-th of points of a light, and its normal there: none of what has no surface, but the axis of a spot.
fn point_on(frame: &Frame, index: usize, i: usize) -> ([f64; 3], [f64; 3]) {
    match frame.emissive.get(index) {
        Some(light) => (inside(&light.p, i), unit(normal(light.p))),
        None => {
            let light = &frame.others[index - frame.emissive.len()];
            let [u, v, w, _] = sequence(i);
            // Of a sphere, the side that a receiver in this direction would see.
            let towards = anywhere(i).map(|x| x as f32);
            let center = light.centroid();
            let reach = light.bounds().max - light.bounds().min;
            let far = 4.0 * (reach.x + reach.y + reach.z) + 1.0;
            let from = Vec3::from(center) + Vec3::from(towards) * far;
            let at = light.point_for(
                from,
                [u as f32, if light.kind() == AnyLight::BOX { w } else { v } as f32],
            );
            let n = match SpotLight::try_from(*light) {
                Ok(spot) => spot.axis,
                Err(_) => at.normal,
            };
            (at.p.map(f64::from), n.map(f64::from))
        }
    }
}

fn is_two_sided(frame: &Frame, index: usize) -> bool {
    match frame.emissive.get(index) {
        Some(light) => light.is_two_sided(),
        None => frame.others[index - frame.emissive.len()].is_two_sided(),
    }
}

/// The `i`-th of directions, all alike.
fn anywhere(i: usize) -> [f64; 3] {
    let [_, _, u, v] = sequence(i);
    let (angle, z) = (std::f64::consts::TAU * u, 1.0 - 2.0 * v);
    let flat = (1.0 - z * z).sqrt();
    [libm::cos(angle) * flat, z, libm::sin(angle) * flat]
}

/// The `i`-th of directions about `n`, as often as a diffuse light sends light there.
fn cosine(n: [f64; 3], i: usize) -> [f64; 3] {
    let [_, _, u, v] = sequence(i);
    let beside = unit(cross(
        n,
        if n[0].abs() < 0.5 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        },
    ));
    let above = cross(n, beside);
    let (angle, flat) = (std::f64::consts::TAU * u, v.sqrt());
    let (x, y, z) = (libm::cos(angle) * flat, libm::sin(angle) * flat, (1.0 - v).sqrt());
    [0, 1, 2].map(|axis| x * beside[axis] + y * above[axis] + z * n[axis])
}

/// The `i`-th of evenly spread points of four numbers: fractions of multiples of the powers of 1 / 1.16730, the root of x⁵ = x + 1
/// (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
fn sequence(i: usize) -> [f64; 4] {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    let powers = [ROOT, ROOT * ROOT, ROOT * ROOT * ROOT, ROOT * ROOT * ROOT * ROOT];
    powers.map(|power| (0.5 + i as f64 / power) % 1.0)
}

/// Unit vectors towards the camera, and what each counts.
fn directions() -> impl Iterator<Item = ([f64; 3], f64)> {
    ABOVE.into_iter().flat_map(|(above, counts)| {
        AROUND.into_iter().map(move |around| {
            let [around, above] = [around, above].map(f64::to_radians);
            let flat = libm::cos(above);
            let towards = [
                libm::sin(around) * flat,
                libm::sin(above),
                libm::cos(around) * flat,
            ];
            let counts_around = if towards[2] < 0.0 { 0.9 } else { 1.0 };
            (towards, counts * counts_around)
        })
    })
}

/// `count` indices, each as often as its weight says, with a running number. None where there is no weight.
fn spread(weights: &[f64], count: usize) -> impl Iterator<Item = (usize, usize)> {
    let total: f64 = weights.iter().sum();
    let (mut index, mut passed) = (0, weights.first().copied().unwrap_or(0.0));
    let count = if total > 0.0 && total.is_finite() {
        count
    } else {
        0
    };
    (0..count).map(move |i| {
        let at = total * (i as f64 + 0.5) / count as f64;
        while passed < at && index + 1 < weights.len() {
            index += 1;
            passed += weights[index];
        }
        (index, i)
    })
}

/// The `i`-th of points spread over a triangle.
fn inside(p: &[[f32; 3]; 3], i: usize) -> [f64; 3] {
    let [u, v, ..] = sequence(i);
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let [a, b, c] = p.map(|vertex| vertex.map(f64::from));
    [0, 1, 2].map(|axis| a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]))
}

/// The box that leaves [`OUTSIDE`] of what is to be seen out on each side of each axis.
fn part_that_holds(points: &[Point]) -> ([f64; 3], [f64; 3]) {
    let part = OUTSIDE * points.iter().map(|point| point.weight).sum::<f64>();
    let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
    for axis in 0..3 {
        let mut along: Vec<(f64, f64)> = points.iter().map(|point| (point.p[axis], point.weight)).collect();
        along.sort_by(|a, b| a.0.total_cmp(&b.0));
        low[axis] = reached(along.iter(), part);
        high[axis] = reached(along.iter().rev(), part);
    }
    (low, high)
}

/// The place at which the weights so far are more than `part`.
fn reached<'a>(mut along: impl Iterator<Item = &'a (f64, f64)>, part: f64) -> f64 {
    let mut sum = 0.0;
    let found = along.find(|(_, weight)| {
        sum += weight;
        sum > part
    });
    found.map_or(0.0, |(place, _)| *place)
}

fn bounds(points: impl Iterator<Item = [f32; 3]>) -> Option<([f64; 3], [f64; 3])> {
    let mut bounds: Option<([f64; 3], [f64; 3])> = None;
    for p in points {
        let p = p.map(f64::from);
        let (low, high) = bounds.get_or_insert((p, p));
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    bounds
}

fn area(p: &[[f32; 3]; 3]) -> f64 {
    let n = normal(*p);
    0.5 * dot(n, n).sqrt()
}

/// At length one; zero stays.
fn unit(v: [f64; 3]) -> [f64; 3] {
    super::transform::unit_or(v, [0.0; 3])
}
