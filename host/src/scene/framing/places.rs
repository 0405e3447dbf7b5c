//! Places that a camera may stand at.

use super::super::camera::{DEFAULT_YFOV, looking};
use super::fit::{self, Axes};
use super::points::Point;
use super::room::Room;
use super::spread::{along, anywhere, unit};
use crate::render::View;
use crate::vector::sub;

/// Cameras are upright.
const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// A place, and what it counts beside others from which as much is seen.
pub(super) struct Candidate {
    pub view: View,
    pub counts: f64,
    /// Whether it may be among the surfaces, not beyond all.
    pub is_inside: bool,
}

/// Directions from without, in degrees around the upward axis and above the horizon, and what each counts. The first ones from
/// the front, a little to the right; then straight at each side, as signs and open boxes want it. From below floors hide what
/// is lit on them, and nobody looks from there. From high above all looks like a map.
const AROUND: [f64; 8] = [19.0, -26.0, 64.0, -71.0, 109.0, -116.0, 154.0, 199.0];
const STRAIGHT: [f64; 4] = [0.0, 90.0, -90.0, 180.0];
const ABOVE: [(&[f64], f64, f64); 4] = [
    (&AROUND, 18.0, 1.0),
    (&STRAIGHT, 5.0, 0.92),
    (&AROUND, 34.0, 0.88),
    (&AROUND, -25.0, 0.5),
];

/// Of what shows as well from behind, the front is wanted: glTF's models face +Z. Those of some programs face +X.
const BEHIND: f64 = 0.8;
const LEFT: f64 = 0.95;

/// Parts of all points, and of lit ones, that may lie beyond each side of the image, and what a place so near counts: something
/// far off may be given up, but what is cut looks wrong.
const PART: (f64, f64) = (0.01, 0.84);
const LIT_PARTS: [(f64, f64); 3] = [(0.02, 0.78), (0.1, 0.66), (0.2, 0.6)];

/// Places between surfaces, directions from each, degrees above the horizon; and what they count: the whole is rather seen from
/// without, but a room from inside.
const INSIDE: usize = 20;
const TURNS: usize = 8;
const DOWN: f64 = -7.0;
const INSIDE_COUNTS: f64 = 0.64;

/// Parts of the way from the middle to a place from which all is seen that nearer places stand at.
const WAY: [f64; 2] = [0.4, 0.7];

/// Vertical field of view of a camera in a room, radians: 60 degrees, as pictures of rooms are taken.
const INSIDE_YFOV: f32 = std::f32::consts::FRAC_PI_3;

/// Part of the way back to the wall that a camera stands at, and how high between floor and ceiling.
const BACK: f64 = 0.9;
const HEIGHT: f64 = 0.55;

/// Places around what is to be seen, each as near as it can be. `corners` are vertices that are in the image where nothing is
/// cut, `size` metres how large all is.
pub(super) fn around(points: &[Point], corners: &[[f32; 3]], size: f64) -> Vec<Candidate> {
    let corners: Vec<_> = corners.iter().map(|p| (p.map(f64::from), 1.0)).collect();
    let weighed = |point: &Point| (point.p, point.weight);
    let lit: Vec<_> = points.iter().filter(|point| point.is_lit).map(weighed).collect();
    let points: Vec<_> = points.iter().map(weighed).collect();
    let tangent = libm::tan(0.5 * f64::from(DEFAULT_YFOV));
    let whole = std::iter::once((&corners, 0.0, 1.0));
    let fits: Vec<_> = whole
        .chain(std::iter::once((&points, PART.0, PART.1)))
        .chain(LIT_PARTS.iter().map(|&(part, counts)| (&lit, part, counts)))
        .collect();
    let mut all = Vec::new();
    for (towards, of_direction) in directions() {
        let forward = towards.map(|x| -x);
        let axes = axes(forward);
        for &(what, part, counts) in &fits {
            let Some(eye) = fit::eye(what, &axes, tangent, part) else {
                continue;
            };
            // Of one point there is no nearest place.
            let eye = along(eye, -(1e-3 * size).max(1e-6), forward);
            all.push(Candidate {
                view: looking(eye, forward, UP, DEFAULT_YFOV),
                counts: counts * of_direction,
                // One that leaves a part out may stand within it.
                is_inside: part > 0.0,
            });
        }
    }
    all
}

/// Places on the way from without to the middle of what is to be seen: in a niche, or within the walls around a court.
pub(super) fn nearer(points: &[Point]) -> Vec<Candidate> {
    let points: Vec<_> = points.iter().map(|point| (point.p, point.weight)).collect();
    let tangent = libm::tan(0.5 * f64::from(INSIDE_YFOV));
    let middle = [0, 1, 2].map(|axis| points.iter().map(|(p, weight)| p[axis] * weight).sum::<f64>());
    let mut all = Vec::new();
    for (towards, counts) in directions() {
        let forward = towards.map(|x| -x);
        let Some(eye) = fit::eye(&points, &axes(forward), tangent, PART.0) else {
            continue;
        };
        all.extend(WAY.iter().map(|&way| Candidate {
            view: looking(along(middle, way, sub(eye, middle)), forward, UP, INSIDE_YFOV),
            counts: INSIDE_COUNTS * counts,
            is_inside: true,
        }));
    }
    all
}

/// Places between surfaces, their backs to the wall.
pub(super) fn between(points: &[Point], room: &Room, size: f64) -> Vec<Candidate> {
    let mut all = Vec::new();
    let step = 1e-5 * size;
    for k in 0..INSIDE.min(points.len()) {
        let point = &points[k * points.len() / INSIDE.min(points.len())];
        let d = unit(along(anywhere(k), 1.2, point.n));
        let start = along(point.p, step, d);
        // Where nothing is on the other side one is not inside.
        let Some(met) = room.meet(start, d) else {
            continue;
        };
        let middle = along(start, 0.5 * met.t, d);
        let height = |y: f64| room.meet(middle, [0.0, y, 0.0]).map(|met| y * met.t);
        let up = match (height(-1.0), height(1.0)) {
            (Some(floor), Some(ceiling)) => floor + HEIGHT * (ceiling - floor),
            _ => 0.0,
        };
        let middle = along(middle, up, UP);
        for turn in 0..TURNS {
            let around = 360.0 * (turn as f64 + 0.5) / TURNS as f64;
            let back = direction(around, 0.0);
            let way = room.meet(middle, back).map_or(0.0, |met| BACK * met.t);
            let forward = direction(around + 180.0, DOWN);
            all.push(Candidate {
                view: looking(along(middle, way, back), forward, UP, INSIDE_YFOV),
                counts: INSIDE_COUNTS,
                is_inside: true,
            });
        }
    }
    all
}

/// The directions from without, towards the camera, and what each counts.
fn directions() -> impl Iterator<Item = ([f64; 3], f64)> {
    let all = ABOVE.iter().flat_map(|&(around, above, counts)| {
        around
            .iter()
            .map(move |&around| (direction(around, above), counts))
    });
    all.map(|(towards, counts)| {
        let behind = if towards[2] < -0.1 { BEHIND } else { 1.0 };
        let left = if towards[0] < -0.1 { LEFT } else { 1.0 };
        (towards, counts * behind * left)
    })
}

/// The unit vector at so many degrees around the upward axis, from +Z towards +X, and above the horizon.
fn direction(around: f64, above: f64) -> [f64; 3] {
    let [around, above] = [around, above].map(f64::to_radians);
    let flat = libm::cos(above);
    [
        libm::sin(around) * flat,
        libm::sin(above),
        libm::cos(around) * flat,
    ]
}

/// Those of a camera that looks along `forward`, which is not upright.
fn axes(forward: [f64; 3]) -> Axes {
    let view = looking([0.0; 3], forward, UP, DEFAULT_YFOV);
    [view.right, view.up, view.forward].map(|axis| axis.map(f64::from))
}
