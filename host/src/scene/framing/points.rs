//! What there is to see in a frame, as points on sides of surfaces.
//!
//! - Light is sent out from points spread evenly over the flux of all lamps; where it lands is lit, but for what shines itself.
//! - Surfaces are asked at points whether they lie under the sky, or in the sun.
//! - Lamps are to be seen themselves, and so is, a little, what is dark: the body of a car whose headlamps shine.
//!
//! What a triangle counts is the cube root of the light that it reflects: a plain of two triangles is a large thing, but there
//! is no more to see in it than in a few of the hundreds that a house has.

use lightbvh::ShadingPoint;
use lightbvh::light::{AnyLight, Light};
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use super::super::frame::Frame;
use super::lamps;
use super::room::Room;
use super::spread::{along, anywhere, area, cosine, inside, sequence, spread, unit, within};
use crate::vector::{dot, normal, sub};

/// Rays that light is sent out on, at least and at most, and how many for each triangle.
const SENT: (usize, usize, usize) = (64, 384, 4);

/// Points on surfaces, likewise.
const SURFACE: (usize, usize, usize) = (32, 192, 4);

/// Triangles whose vertices are to be in the image, at most.
const CORNERS: usize = 1024;

/// Directions that stand for an environment map.
const SKY: usize = 12;

/// What all lamps count against all places that they light: enough to be in the image, not so much that nothing else need be.
const LIGHTS_COUNT: f64 = 0.15;

/// What all surfaces count, dark ones too, against all that is lit.
const SURFACE_COUNTS: f64 = 0.3;

/// A point's own size is its distance from so many of the others, one of so many: of what fills an image it is a tenth of the
/// image's height.
const NEIGHBOURS: usize = 24;

/// A point on a side of a surface.
pub(super) struct Point {
    pub p: [f64; 3],
    /// Towards the side that is meant; zero where both are.
    pub n: [f64; 3],
    /// What it counts; all together count one.
    pub weight: f64,
    /// Metres; how large what it stands for is.
    pub size: f64,
    /// Whether it shines, or light falls on it.
    pub is_lit: bool,
}

/// What there is to see; nothing where there is neither light nor surface.
pub(super) fn points(frame: &Frame, room: &Room, size: f64) -> Vec<Point> {
    let step = 1e-6 * size;
    let suns = suns(frame);
    let mut fluxes = lamps::fluxes(frame, room, size, !suns.is_empty());
    let (far, near) = lamps::take_far(frame, &mut fluxes);
    let (sent, flux) = sent(frame, room, &fluxes, step);
    let surface = on_surfaces(frame);
    let (sky, of_sky) = under_sky(room, &surface, &suns, &far, step);
    let mut all = Vec::new();
    // As everywhere, by the cube root of their light.
    let (landed, heaven) = (libm::cbrt(flux), libm::cbrt(of_sky));
    add(&mut all, sent, landed);
    add(&mut all, sky, heaven);
    let lit: f64 = all.iter().map(|point| point.weight).sum();
    let on_lamps = lamps::points(frame, &near);
    add(
        &mut all,
        on_lamps,
        if lit > 0.0 { LIGHTS_COUNT * lit } else { 1.0 },
    );
    let lit: f64 = all.iter().map(|point| point.weight).sum();
    let surface = surface.into_iter().map(|(_, _, point)| point).collect();
    add(
        &mut all,
        surface,
        if lit > 0.0 { SURFACE_COUNTS * lit } else { 1.0 },
    );
    let sum: f64 = all.iter().map(|point| point.weight).sum();
    for point in &mut all {
        point.weight /= sum;
    }
    all
}

/// Adds points that together count `sum`.
fn add(all: &mut Vec<Point>, mut more: Vec<Point>, sum: f64) {
    more.retain(|point| point.weight > 0.0);
    let own: f64 = more.iter().map(|point| point.weight).sum();
    let near = 1 + more.len() / NEIGHBOURS;
    for i in 0..more.len() {
        let mut distances: Vec<f64> = more
            .iter()
            .map(|other| sub(other.p, more[i].p))
            .map(|d| dot(d, d))
            .collect();
        let at = near.min(distances.len() - 1);
        let (_, distance, _) = distances.select_nth_unstable_by(at, f64::total_cmp);
        more[i].size = distance.sqrt();
    }
    all.extend(more.into_iter().map(|point| Point {
        weight: point.weight * sum / own,
        ..point
    }));
}

pub(super) fn luminance(rgb: [f32; 3]) -> f64 {
    rgb.iter().map(|&channel| f64::from(channel)).sum::<f64>() / 3.0
}

/// Part of light that a material reflects.
fn reflects(frame: &Frame, material: u32) -> f64 {
    frame.materials.get(material as usize).map_or(0.0, |material| {
        luminance(material.albedo) + f64::from(material.specular)
    })
}

/// Where the light of lamps lands, and how much is reflected there.
fn sent(frame: &Frame, room: &Room, flux: &[f64], step: f64) -> (Vec<Point>, f64) {
    let count = (SENT.2 * frame.triangles.len()).clamp(SENT.0, SENT.1);
    let each = flux.iter().sum::<f64>() / count as f64;
    let mut landed: Vec<(usize, Point)> = Vec::new();
    for (index, i) in spread(flux, count) {
        let (start, n) = lamps::point_on(frame, index, i);
        let (n, of_side) = lamps::side(frame, index, i, n);
        let d = match lamps::cone(frame, index) {
            Some(cosine) => within(n, cosine, i),
            None if n == [0.0; 3] => anywhere(i),
            None => cosine(n, i),
        };
        let start = along(start, step, d);
        let Some(met) = room.meet(start, d) else {
            continue;
        };
        let is_back = met.is_back(d);
        // What shines is seen by its own light: the inside of a glowing bulb is no place that is lit.
        let shines = frame.triangles[met.triangle].light != NONE;
        let counts = if is_back { room.back(met.material) } else { 1.0 };
        let point = Point {
            p: along(start, met.t, d),
            n: if is_back { met.n.map(|x| -x) } else { met.n },
            weight: if shines { 0.0 } else { each }
                * reflects(frame, met.material)
                * counts
                * of_side
                * lamps::left_at(frame, index, met.t),
            size: 0.0,
            is_lit: true,
        };
        landed.push((met.triangle, point));
    }
    // One triangle's light, then its cube root, shared out.
    landed.sort_by_key(|(triangle, _)| *triangle);
    let mut sum = 0.0;
    for own in landed.chunk_by_mut(|a, b| a.0 == b.0) {
        let light: f64 = own.iter().map(|(_, point)| point.weight).sum();
        sum += light;
        for (_, point) in own {
            point.weight = if light > 0.0 {
                point.weight / light * libm::cbrt(light)
            } else {
                0.0
            };
        }
    }
    (landed.into_iter().map(|(_, point)| point).collect(), sum)
}

/// All triangles, and the cube roots of their areas.
fn surfaces(frame: &Frame) -> (Vec<&SurfaceTriangle>, Vec<f64>) {
    let all: Vec<_> = frame.triangles.iter().chain(&frame.clear).collect();
    let roots = all.iter().map(|triangle| libm::cbrt(area(&triangle.p)));
    let roots = roots.collect();
    (all, roots)
}

/// Vertices that are in the image where nothing is cut: all of few triangles, those furthest along each axis, and of many
/// triangles some, large ones rather than small ones.
pub(super) fn corners(frame: &Frame) -> Vec<[f32; 3]> {
    let (all, roots) = surfaces(frame);
    if all.len() <= CORNERS {
        return all.iter().flat_map(|triangle| triangle.p).collect();
    }
    let chosen = spread(&roots, CORNERS).flat_map(|(index, _)| all[index].p);
    let furthest = (0..3).flat_map(|axis| {
        let along = |p: &[f32; 3], q: &[f32; 3]| p[axis].total_cmp(&q[axis]);
        let vertices = || all.iter().flat_map(|triangle| triangle.p);
        [vertices().min_by(along), vertices().max_by(along)]
    });
    chosen.chain(furthest.flatten()).collect()
}

/// Points on the fronts of surfaces, with the area that each stands for and its material; triangles are chosen by the cube
/// roots of their areas.
fn on_surfaces(frame: &Frame) -> Vec<(f64, u32, Point)> {
    let (all, roots) = surfaces(frame);
    let count = (SURFACE.2 * all.len()).clamp(SURFACE.0, SURFACE.1);
    let each = roots.iter().sum::<f64>() / count as f64;
    let points = spread(&roots, count).map(|(index, i)| {
        let p = &all[index].p;
        let point = Point {
            p: inside(p, i),
            n: unit(normal(*p)),
            weight: 1.0,
            size: 0.0,
            is_lit: false,
        };
        let material = all[index].material;
        (
            roots[index].powi(2) * each * reflects(frame, material).max(0.05),
            material,
            point,
        )
    });
    points.collect()
}

/// Which of the points on surfaces, or of those on their backs, see the sky, a sun, or a lamp that stands off, and how much
/// they reflect.
fn under_sky(
    room: &Room,
    surface: &[(f64, u32, Point)],
    suns: &[([f64; 3], f64)],
    far: &[AnyLight],
    step: f64,
) -> (Vec<Point>, f64) {
    let (mut points, mut sum) = (Vec::new(), 0.0);
    let has_none = suns.is_empty() && far.is_empty();
    for (area, material, point) in if has_none { &[] } else { surface } {
        for (n, counts) in [(point.n, 1.0), (point.n.map(|x| -x), room.back(*material))] {
            let start = along(point.p, step, n);
            let of_suns: f64 = suns
                .iter()
                .map(|(towards, irradiance)| (towards, irradiance * dot(n, *towards)))
                .filter(|&(towards, irradiance)| irradiance > 0.0 && room.is_open(start, *towards))
                .map(|(_, irradiance)| irradiance)
                .sum();
            let receiver = ShadingPoint {
                p: start.map(|x| x as f32),
                n: n.map(|x| x as f32),
            };
            let of_lamps: f64 = far
                .iter()
                .map(|lamp| lamp.point_for(receiver.position(), [0.5; 2]))
                .map(|at| (at.p.map(f64::from), luminance(at.irradiance(&receiver))))
                .filter(|&(at, irradiance)| irradiance > 0.0 && room.is_clear(start, at))
                .map(|(_, irradiance)| irradiance)
                .sum();
            let irradiance = of_suns + of_lamps;
            sum += irradiance * area * counts / std::f64::consts::PI;
            points.push(Point {
                p: point.p,
                n,
                weight: libm::cbrt(irradiance) * counts,
                size: 0.0,
                is_lit: true,
            });
        }
    }
    (points, sum)
}

/// Directions towards the light from without end, and the irradiance that comes from each. An environment map is some suns.
fn suns(frame: &Frame) -> Vec<([f64; 3], f64)> {
    // The first one stands for the map, which is asked itself.
    let suns = frame.sky.suns().iter().skip(1);
    let suns = suns.map(|sun| (sun.direction.map(f64::from), luminance(sun.irradiance)));
    let mut all: Vec<_> = suns.filter(|&(_, irradiance)| irradiance > 0.0).collect();
    if let Some(map) = frame.sky.environment() {
        all.extend((0..SKY).filter_map(|i| {
            let [u, v, ..] = sequence(i).map(|x| x as f32);
            let chosen = ((i as f64 + 0.5) / SKY as f64 * 4_294_967_296.0) as u32;
            let sample = map.sample(chosen, [u, v]);
            let irradiance = luminance(sample.radiance) / (f64::from(sample.density) * SKY as f64);
            (irradiance > 0.0 && irradiance.is_finite())
                .then(|| (sample.direction.map(f64::from), irradiance))
        }));
    }
    all
}
