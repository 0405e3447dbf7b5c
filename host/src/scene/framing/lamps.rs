//! The lamps of a frame, as what there is to see and as what it is seen by.
//!
//! A point within a small closed mesh lights the inside of that mesh alone: programs place lamps so that let them shine through
//! their own bulbs. Such ones are shut in, and count where there is no other light; so do those that have nothing in their
//! range, and triangles all of whose light lands on what shines: the inner walls of glowing bulbs.

use glam::Vec3;
use lightbvh::light::{AnyLight, Light, PointLight, ProfileLight, SpotLight};
use lightbvh_kernels::shading::trace::NONE;

use super::super::frame::Frame;
use super::super::scene_light::SceneLight;
use super::points::{Point, luminance};
use super::room::Room;
use super::spread::{along, anywhere, area, cosine, inside, sequence, spread, unit, within};
use crate::vector::{dot, normal, sub};

/// Points on lamps, at most.
const LIGHTS: usize = 64;

/// What the back of a two-sided lamp counts against its front.
const BACK_COUNTS: f64 = 0.2;

/// Lamps that may be found to be shut in, at most: those with the brightest share.
const ASKED: usize = 1024;

/// Lamps that stand off, at most: those with the brightest share.
const FAR: usize = 16;

/// Rays that tell so of each.
const RAYS: usize = 8;

/// And rays towards surfaces, where those miss.
const AIMED: usize = 32;

/// What lies farther away than this part of the scene's size is no bulb: of the backs of surfaces, and of fronts, which are
/// also the walls of a small room.
const BULB: f64 = 0.05;
const THICK_BULB: f64 = 0.01;

/// A front whose back lies within this part of the way to it is that of a wall of two sides, and no room's.
const WALL: f64 = 0.5;

/// What each lamp sends out, W but for a factor of π; zero where it is shut in and there is other light.
pub(super) fn fluxes(frame: &Frame, room: &Room, size: f64, is_under_sky: bool) -> Vec<f64> {
    let all = all_fluxes(frame);
    let mut asked: Vec<usize> = spread(&all, ASKED).map(|(index, _)| index).collect();
    asked.dedup();
    let mut open = all.clone();
    for index in asked {
        if is_shut_in(frame, room, size, index) || is_out_of_range(frame, room, size, index) {
            open[index] = 0.0;
        }
    }
    // However faint: nobody means an image from within a bulb.
    if is_under_sky || open.iter().any(|&flux| flux > 0.0) {
        open
    } else {
        all
    }
}

/// Lamps without size that stand beyond all that there is to see, which light it as suns do: those with the brightest share.
/// The flux of those that shine all around is taken out of `fluxes`; rays in the cone of a spot find where on a large floor its
/// light lands, and miss what is small in it. That of all of them is taken out of what is returned beside: they need not be in
/// the image.
pub(super) fn take_far(frame: &Frame, fluxes: &mut [f64]) -> (Vec<AnyLight>, Vec<f64>) {
    let triangles = frame.triangles.iter().chain(&frame.clear);
    let Some((low, high)) = super::bounds(triangles.flat_map(|triangle| triangle.p)) else {
        return (Vec::new(), fluxes.to_vec());
    };
    let middle = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
    let reach = squared(sub(high, middle));
    let first = frame.emissive.len();
    let is_far = |light: &AnyLight| {
        let bounds = light.bounds();
        bounds.min == bounds.max && squared(sub(light.centroid().map(f64::from), middle)) > reach
    };
    let mut seen = fluxes.to_vec();
    let mut others = vec![0.0; frame.others.len()];
    for (own, _) in frame.others.iter().enumerate().filter(|(_, light)| is_far(light)) {
        seen[first + own] = 0.0;
        others[own] = fluxes[first + own];
        if cone(frame, first + own).is_none() {
            fluxes[first + own] = 0.0;
        }
    }
    let mut chosen: Vec<usize> = spread(&others, FAR).map(|(own, _)| own).collect();
    chosen.dedup();
    (chosen.into_iter().map(|own| frame.others[own]).collect(), seen)
}

fn squared(v: [f64; 3]) -> f64 {
    dot(v, v)
}

/// The part of a lamp's light that is left so many metres from it, where it has a range: the window of glTF's
/// `KHR_lights_punctual`.
pub(super) fn left_at(frame: &Frame, index: usize, distance: f64) -> f64 {
    let own = index.checked_sub(frame.emissive.len());
    let Some(light) = own.and_then(|own| frame.others.get(own)) else {
        return 1.0;
    };
    let point = PointLight::try_from(*light).map(|point| point.range);
    let range = point.or_else(|_| SpotLight::try_from(*light).map(|spot| spot.range));
    match range {
        Ok(range) if range > 0.0 => (1.0 - (distance / f64::from(range)).powi(4)).max(0.0),
        _ => 1.0,
    }
}

/// The cosine of the cone about its axis that a lamp shines in, where it does.
pub(super) fn cone(frame: &Frame, index: usize) -> Option<f64> {
    let light = frame.others.get(index.checked_sub(frame.emissive.len())?)?;
    let spot = SpotLight::try_from(*light).map(|spot| spot.cos_outer);
    let cosine = spot.or_else(|_| ProfileLight::try_from(*light).map(|profile| profile.cos_outer));
    cosine.ok().map(f64::from)
}

/// Whether a lamp has a range within which its rays meet nothing, those towards some of the surfaces neither.
fn is_out_of_range(frame: &Frame, room: &Room, size: f64, index: usize) -> bool {
    if left_at(frame, index, f64::INFINITY) > 0.0 {
        return false;
    }
    let cosine = cone(frame, index);
    let lights = |p, d| {
        let met = room.meet(along(p, 1e-9 * size, d), d);
        met.is_some_and(|met| left_at(frame, index, met.t) > 0.0)
    };
    let anywhere = (0..RAYS).any(|i| {
        let (p, axis) = point_on(frame, index, i);
        lights(p, cosine.map_or(anywhere(i), |cosine| within(axis, cosine, i)))
    });
    let count = frame.triangles.len();
    !anywhere
        && !(0..AIMED.min(count)).any(|k| {
            let (p, axis) = point_on(frame, index, k);
            let d = sub(inside(&frame.triangles[k * count / AIMED.min(count)].p, k), p);
            let away = squared(d).sqrt();
            away > 0.0
                && left_at(frame, index, away) > 0.0
                && cosine.is_none_or(|cosine| dot(d, axis) >= cosine * away)
                && lights(p, unit(d))
        })
}

/// Whether a lamp is a point that sends every ray to the back of something close by, to a wall of two sides there, or to
/// something very close; or a triangle that sends every ray to what shines.
fn is_shut_in(frame: &Frame, room: &Room, size: f64, index: usize) -> bool {
    let step = 1e-9 * size;
    let Some(own) = index.checked_sub(frame.emissive.len()) else {
        return lights_itself(frame, room, 1e-6 * size, index);
    };
    let Some(light) = frame.others.get(own) else {
        return false;
    };
    let bounds = light.bounds();
    bounds.min == bounds.max
        && (0..RAYS).all(|i| {
            let (p, d) = (light.centroid().map(f64::from), anywhere(i));
            let Some(met) = room.meet(along(p, step, d), d) else {
                return false;
            };
            let is_wall = || {
                let behind = room.meet(along(p, met.t * (1.0 + 1e-5) + step, d), d);
                behind.is_some_and(|behind| behind.is_back(d) && behind.t < WALL * met.t)
            };
            met.t < THICK_BULB * size || met.t < BULB * size && (met.is_back(d) || is_wall())
        })
}

/// Whether all light of a triangle, from both of its sides where it has two, lands on what shines.
fn lights_itself(frame: &Frame, room: &Room, step: f64, index: usize) -> bool {
    let sides: &[f64] = if is_two_sided(frame, index) {
        &[1.0, -1.0]
    } else {
        &[1.0]
    };
    sides.iter().all(|side| {
        (0..RAYS).all(|i| {
            let (p, n) = point_on(frame, index, i);
            let d = cosine(n.map(|x| side * x), i);
            let met = room.meet(along(p, step, d), d);
            met.is_some_and(|met| frame.triangles[met.triangle].light != NONE)
        })
    })
}

/// What each lamp sends out, W but for a factor of π.
fn all_fluxes(frame: &Frame) -> Vec<f64> {
    let triangles = frame
        .emissive
        .iter()
        .map(|light| area(&light.p) * luminance(light.radiance));
    let others = frame
        .others
        .iter()
        .map(|light| light.flux() / std::f64::consts::PI);
    triangles.chain(others).collect()
}

/// Points on the lamps themselves.
pub(super) fn points(frame: &Frame, fluxes: &[f64]) -> Vec<Point> {
    let roots: Vec<f64> = fluxes.iter().copied().map(libm::cbrt).collect();
    let count = LIGHTS.min(4 * roots.len());
    let points = spread(&roots, count).map(|(index, i)| {
        let (p, n) = point_on(frame, index, i);
        let (n, weight) = side(frame, index, i, n);
        Point {
            p,
            n,
            weight,
            size: 0.0,
            is_lit: true,
        }
    });
    points.collect()
}

/// The `i`-th of points of a lamp, and its normal there: none of what has no surface, but the axis of a spot.
pub(super) fn point_on(frame: &Frame, index: usize, i: usize) -> ([f64; 3], [f64; 3]) {
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
            let axis = SpotLight::try_from(*light).map(|spot| spot.axis);
            let axis = axis.or_else(|_| ProfileLight::try_from(*light).map(|profile| profile.axis));
            let n = axis.unwrap_or(at.normal);
            (at.p.map(f64::from), n.map(f64::from))
        }
    }
}

/// The side of a lamp that its `i`-th point lies on, and what that counts: of two sides every other one is the back.
pub(super) fn side(frame: &Frame, index: usize, i: usize, n: [f64; 3]) -> ([f64; 3], f64) {
    if is_two_sided(frame, index) && i % 2 == 1 {
        (n.map(|x| -x), BACK_COUNTS)
    } else {
        (n, 1.0)
    }
}

fn is_two_sided(frame: &Frame, index: usize) -> bool {
    match frame.emissive.get(index) {
        Some(light) => light.is_two_sided(),
        None => frame.others[index - frame.emissive.len()].is_two_sided(),
    }
}
