//! The camera of a scene that brings none: it frames what is lit.
//!
//! Points on the surfaces and on the lights, spread evenly over area and flux, say what is lit and how well: with shadow rays, each
//! side of a surface by itself. The part of space that holds nearly all of it is looked at from some places around and in it, and
//! that place is taken from which most of it is seen. The number of rays is bounded, and small for small scenes.

use glam::Vec3;
use lightbvh_kernels::shading::ray::Ray;
use lightbvh_kernels::shading::trace::{NONE, any_hit};

use super::camera::{DEFAULT_YFOV, view_of_box};
use super::frame::Frame;
use crate::render::{RayBvh, View};
use crate::vector::{dot, normal, sub};

/// Points on surfaces, at most and at least.
const POINTS: (usize, usize) = (32, 512);

/// Points on lights, at most.
const LIGHTS: usize = 16;

/// Part of what is lit that may be outside of the image on each side of each axis: a lamp's far end, a distant wall.
const OUTSIDE: f64 = 0.02;

/// Directions that the camera is tried in, degrees around the upward axis and above the horizon; the first from the front, a
/// little to the right.
const AROUND: [f64; 8] = [19.0, -26.0, 64.0, -71.0, 109.0, -116.0, 154.0, 199.0];
const ABOVE: [f64; 2] = [16.0, 40.0];

/// Distances that it is tried at, in radii of what is lit, and what a place so far away counts: the whole is rather seen than a part.
/// The first one has all of it in the image.
const DISTANCES: [(f64, f64); 3] = [(2.37, 1.0), (0.95, 0.8), (0.5, 0.7)];

/// A point on a surface, and how bright each of its sides is.
struct Point {
    p: [f64; 3],
    n: [f64; 3],
    front: f64,
    back: f64,
}

impl Point {
    fn brightness(&self) -> f64 {
        self.front.max(self.back)
    }
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
    let clear = |a: [f64; 3], b: [f64; 3]| {
        let d = sub(b, a);
        let [from, along] =
            [[0, 1, 2].map(|i| a[i] + 1e-3 * d[i]), d].map(|v| Vec3::from(v.map(|x| x as f32)));
        !any_hit(&rays.surfaces(), &Ray::new(from, along, 0.998), NONE)
    };
    let points = lit_points(frame, whole, &clear);
    let mean = points.iter().map(Point::brightness).sum::<f64>() / points.len().max(1) as f64;
    if !(mean > 0.0 && mean.is_finite()) {
        return fallback;
    }
    // A lamp is a thousand times as bright as what it lights; seen, both count much the same.
    let shown = |brightness: f64| brightness / (brightness + mean);
    let (low, high) = part_that_holds(&points, shown);
    let narrow = libm::cos(0.5 * f64::from(DEFAULT_YFOV));
    let mut best = (0.0, fallback);
    for (distance, counts) in DISTANCES {
        for direction in directions() {
            let view = view_of_box(low, high, direction, distance);
            let eye = view.eye.map(f64::from);
            let forward = direction.map(|x| -x);
            let mut score = 0.0;
            for point in &points {
                let d = sub(point.p, eye);
                let length = dot(d, d).sqrt();
                let side = if dot(d, point.n) < 0.0 {
                    point.front
                } else {
                    point.back
                };
                if side > 0.0 && dot(d, forward) > narrow * length && clear(eye, point.p) {
                    score += shown(side);
                }
            }
            if score * counts > best.0 {
                best = (score * counts, view);
            }
        }
    }
    best.1
}

/// Unit vectors towards the camera.
fn directions() -> impl Iterator<Item = [f64; 3]> {
    ABOVE.into_iter().flat_map(|above| {
        AROUND.into_iter().map(move |around| {
            let [around, above] = [around, above].map(f64::to_radians);
            let flat = libm::cos(above);
            [
                libm::sin(around) * flat,
                libm::sin(above),
                libm::cos(around) * flat,
            ]
        })
    })
}

/// Points spread evenly over the area of all surfaces, lit by points spread evenly over the flux of all lights.
fn lit_points(
    frame: &Frame,
    (low, high): ([f64; 3], [f64; 3]),
    clear: &impl Fn([f64; 3], [f64; 3]) -> bool,
) -> Vec<Point> {
    // No closer than this counts: else a point beside a lamp would be all that is lit.
    let near = 1e-4 * dot(sub(high, low), sub(high, low));
    let luminance = |rgb: [f32; 3]| rgb.iter().map(|&channel| f64::from(channel)).sum::<f64>() / 3.0;
    let flux: Vec<f64> = frame
        .emissive
        .iter()
        .map(|light| area(&light.p) * luminance(light.radiance))
        .collect();
    let lamps: Vec<([f64; 3], [f64; 3], bool)> = spread(&flux, LIGHTS.min(flux.len()))
        .map(|(index, i)| {
            let light = &frame.emissive[index];
            (inside(&light.p, i), unit(normal(light.p)), light.is_two_sided())
        })
        .collect();
    let areas: Vec<f64> = frame.triangles.iter().map(|triangle| area(&triangle.p)).collect();
    let count = areas.len().clamp(POINTS.0, POINTS.1);
    let point = |(index, i): (usize, usize)| {
        let triangle = &frame.triangles[index];
        let (p, n) = (inside(&triangle.p, i), unit(normal(triangle.p)));
        let mut sides = [0.0; 2];
        for &(lamp, axis, two_sided) in &lamps {
            let d = sub(lamp, p);
            let squared = dot(d, d).max(near);
            let from = -dot(d, axis) / squared.sqrt();
            let from = if two_sided { from.abs() } else { from.max(0.0) };
            let to = dot(d, n) / squared.sqrt();
            if from > 0.0 && to != 0.0 && clear(lamp, p) {
                sides[usize::from(to < 0.0)] += from * to.abs() / squared;
            }
        }
        let reflects = frame
            .materials
            .get(triangle.material as usize)
            .map_or(0.0, |material| {
                luminance(material.albedo) + f64::from(material.specular)
            });
        let per_lamp = flux.iter().sum::<f64>() / lamps.len().max(1) as f64;
        let [mut front, mut back] = sides.map(|side| side * reflects * per_lamp / std::f64::consts::PI);
        if let Some(light) = frame.emissive.get(triangle.light as usize) {
            front += luminance(light.radiance);
            back += if light.is_two_sided() {
                luminance(light.radiance)
            } else {
                0.0
            };
        }
        Point { p, n, front, back }
    };
    spread(&areas, count).map(point).collect()
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

/// The `i`-th of points spread over a triangle (R. Martin Roberts' sequence, by the plastic number, folded).
fn inside(p: &[[f32; 3]; 3], i: usize) -> [f64; 3] {
    let (u, v) = (
        (0.5 + 0.754_877_666_246_692_8 * i as f64) % 1.0,
        (0.5 + 0.569_840_290_998_053_2 * i as f64) % 1.0,
    );
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let [a, b, c] = p.map(|vertex| vertex.map(f64::from));
    [0, 1, 2].map(|axis| a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]))
}

/// The box that leaves [`OUTSIDE`] of what is shown out on each side of each axis.
fn part_that_holds(points: &[Point], shown: impl Fn(f64) -> f64) -> ([f64; 3], [f64; 3]) {
    let total: f64 = points.iter().map(|point| shown(point.brightness())).sum();
    let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
    for axis in 0..3 {
        let mut along: Vec<(f64, f64)> = points
            .iter()
            .map(|point| (point.p[axis], shown(point.brightness())))
            .collect();
        along.sort_by(|a, b| a.0.total_cmp(&b.0));
        low[axis] = reached(along.iter(), OUTSIDE * total);
        high[axis] = reached(along.iter().rev(), OUTSIDE * total);
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
