//! How much a camera sees of what there is to see.

use super::places::Candidate;
use super::points::Point;
use super::room::Room;
use super::spread::{along, unit};
use crate::render::View;
use crate::vector::{dot, sub};

/// Columns by rows of the images that places are judged by.
const ASPECT: f64 = 16.0 / 9.0;

/// Rays of an image: columns and rows.
const IMAGE: [usize; 2] = [16, 9];

/// A side that is seen at an angle whose sine is less than this takes few pixels, and counts less.
const STEEP: f64 = 0.4;

/// Of what fills the image, a point's size is about a tenth of the image's half height; what is so much smaller that this part
/// of it is not reached counts less.
const LARGE: f64 = 0.065;

/// What is nearer than this part of the distance of what is to be seen stands in the way.
const NEAR: f64 = 0.12;

/// How far above its surface a point is looked at, as a part of the distance.
const ABOVE: f64 = 1e-5;

/// A ray goes on behind a surface from so many times its distance.
const BEYOND: f64 = 1.0 + 1e-5;

/// What a place counts from which nothing but what stands in the way is seen.
const ALL_NEAR: f64 = 0.2;

/// Dark points count as such up to so many times what is seen of lit ones, and then next to nothing: an image of them alone is
/// black.
const BESIDE_LIGHT: f64 = 4.0;
const IN_THE_DARK: f64 = 1e-3;

/// How much of all points is seen, from 0 to 1: those within the image, on this side of their surface, nothing before them.
/// Dark ones count beside lit ones.
pub(super) fn seen(points: &[Point], room: &Room, view: &View) -> f64 {
    let [eye, right, up, forward] = [view.eye, view.right, view.up, view.forward].map(|v| v.map(f64::from));
    let tangent = libm::tan(0.5 * f64::from(view.yfov));
    let (mut lit, mut dark) = (0.0, 0.0);
    for Point {
        p,
        n,
        weight,
        size,
        is_lit,
    } in points
    {
        let d = sub(*p, eye);
        let depth = dot(d, forward);
        let half = depth * tangent;
        if depth <= 0.0 || dot(d, right).abs() > half * ASPECT || dot(d, up).abs() > half {
            continue;
        }
        let faces = if *n == [0.0; 3] { 1.0 } else { -dot(unit(d), *n) };
        // From above its surface: beside an edge the other side of it would not be told from its own.
        let above = along(*p, ABOVE * dot(d, d).sqrt(), *n);
        if faces > 0.0 && room.is_clear(eye, above) {
            let large = (size / (half * LARGE)).min(1.0);
            // What is one point has no size.
            let large = if *size > 0.0 { large } else { 1.0 };
            let counts = weight * large * (faces / STEEP).min(1.0);
            if *is_lit {
                lit += counts;
            } else {
                dark += counts;
            }
        }
    }
    let shown = dark.min(BESIDE_LIGHT * lit);
    lit + shown + IN_THE_DARK * (dark - shown)
}

/// What the image counts, from 0 to 1: less where it shows backs of surfaces, as within a crate or behind a wall, or something
/// close before the eye.
pub(super) fn clean(points: &[Point], room: &Room, candidate: &Candidate) -> f64 {
    let view = &candidate.view;
    let [eye, right, up, forward] = [view.eye, view.right, view.up, view.forward].map(|v| v.map(f64::from));
    let tangent = libm::tan(0.5 * f64::from(view.yfov));
    let depths = points
        .iter()
        .map(|point| (dot(sub(point.p, eye), forward).max(0.0), point.weight));
    let mean = depths.map(|(depth, weight)| depth * weight).sum::<f64>();
    let (mut met, mut back, mut near) = (0.0, 0.0, 0.0);
    for k in 0..IMAGE[0] * IMAGE[1] {
        let place = |i: usize, of: usize| (2.0 * (i as f64 + 0.5) / of as f64 - 1.0) * tangent;
        let (x, y) = (
            place(k % IMAGE[0], IMAGE[0]) * ASPECT,
            place(k / IMAGE[0], IMAGE[1]),
        );
        let d = along(along(forward, x, right), y, up);
        let Some(hit) = room.meet(eye, d) else {
            continue;
        };
        met += 1.0;
        // From without, the back of a sheet is as good as its front; that of a wall hides what is before its front.
        let hides = || room.meet(along(eye, hit.t * BEYOND, d), d).is_some();
        if hit.is_back(d) && (candidate.is_inside || hides()) {
            back += 1.0 - room.back(hit.material);
        }
        near += f64::from(u8::from(hit.t < NEAR * mean));
    }
    if met == 0.0 {
        return 1.0;
    }
    let all = (IMAGE[0] * IMAGE[1]) as f64;
    (1.0 - back / met) * (1.0 - (1.0 - ALL_NEAR) * near / all)
}
