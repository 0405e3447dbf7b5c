//! The camera of a scene that brings none: it shows what is lit, from its front.
//!
//! ```text
//! points.rs   what there is to see: where light lands, lamps, a little of all surfaces
//! places.rs   where a camera may stand: around it, as near as fit.rs says, and between surfaces
//! judge.rs    how much is seen from there, and whether the image shows backs or what stands in the way
//! lamps.rs    the lamps: points on them, and those whose light does not leave their bulbs
//! room.rs     the frame's triangles under rays; spread.rs: directions and places, the same in every run
//! ```
//!
//! The place from which most is seen is taken. The work is bounded: at most 1024 points and 356 places, so 365,000 rays between
//! them, 14,000 of small images, and 35,000 that find points and places; of small scenes less.

mod fit;
mod judge;
mod lamps;
mod places;
mod points;
mod room;
mod spread;

use super::camera::view_of_box;
use super::frame::Frame;
use super::model::Material;
use crate::render::View;
use crate::vector::{dot, sub};
use room::Room;

/// How far away the camera stands of a box that nothing is known of, in half diagonals: its sphere fills the image.
const DISTANCE: f64 = 2.37;

/// Of so many places of each sort, those from which most is seen, images are made.
const IMAGES: usize = 16;

/// The view of a frame by its triangles, lights and materials, those of the scene.
pub(super) fn view(frame: &Frame, materials: &[Material]) -> View {
    let triangles = || frame.triangles.iter().chain(&frame.clear);
    let (low, high) = bounds(triangles().flat_map(|triangle| triangle.p)).unwrap_or_default();
    let fallback = view_of_box(low, high, [0.35, 0.3, 1.0], DISTANCE);
    let Some(room) = Room::new(&frame.triangles, materials) else {
        return fallback;
    };
    let size = dot(sub(high, low), sub(high, low)).sqrt();
    let points = points::points(frame, &room, size);
    let corners = points::corners(frame);
    let mut best = (0.0, fallback);
    for places in [
        places::around(&points, &corners, size),
        places::nearer(&points),
        places::between(&points, &room, size),
    ] {
        let seen = places
            .into_iter()
            .map(|place| (place.counts * judge::seen(&points, &room, &place.view), place));
        let mut seen: Vec<_> = seen.collect();
        // Stable: of equal ones the first.
        seen.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (score, place) in seen.iter().take(IMAGES) {
            let score = score * judge::clean(&points, &room, place);
            if score > best.0 {
                best = (score, place.view);
            }
        }
    }
    best.1
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

#[cfg(test)]
mod tests;
