//! `carousel`: a fairground in the manner of Measure One, tens of thousands of emissive triangles, most of them moving.
//!
//! A carousel with three tiers of bulbs and rising horses, a Ferris wheel, a swing ride, spinning cups and a gyroscope of
//! nested rings. Each ring, rib or string of bulbs is one mesh light, so that here the bottom levels have the work.
//!
//! The ground is y = 0; the carousel stands at the origin.

mod ground;
mod rides;
mod wheel;

use super::builder::SceneBuilder;
use super::error::SceneError;
use super::random::Random;
use super::scene::Scene;
use super::shapes::{Shape, on_circle};

const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// Materials that several rides share.
struct Palette {
    steel: u32,
    red: u32,
    cream: u32,
    wood: u32,
    bulbs: [u32; 5],
}

/// Builds the scene, which passes the same checks as one from a file.
pub(super) fn carousel() -> Result<Scene, SceneError> {
    let mut b = SceneBuilder::new("carousel", [0.010, 0.010, 0.026]);
    let mut random = Random::new(3);
    let colors = [
        [34.0, 21.0, 9.0],
        [40.0, 4.0, 2.5],
        [3.5, 16.0, 40.0],
        [6.0, 34.0, 5.0],
        [30.0, 3.5, 34.0],
    ];
    let palette = Palette {
        steel: b.metal("steel", [0.35, 0.36, 0.38], 0.6, 0.35),
        red: b.matte("red paint", [0.55, 0.07, 0.06], 0.5),
        cream: b.matte("cream paint", [0.65, 0.58, 0.42], 0.6),
        wood: b.matte("wood", [0.30, 0.19, 0.11], 0.8),
        bulbs: colors.map(|radiance| b.glow("bulbs", radiance)),
    };
    ground::add(&mut b, &mut random, &palette);
    rides::add(&mut b, &mut random, &palette);
    wheel::add(&mut b, &palette);
    b.camera([4.0, 3.2, 23.0], [-1.0, 5.6, 0.0], 60.0);
    b.finish()
}

/// `count` octahedral bulbs on a horizontal circle.
fn bulb_circle(radius: f64, count: u32, size: f64) -> Shape {
    let mut bulbs = Shape::new();
    for i in 0..count {
        let [c, s] = on_circle(f64::from(i) / f64::from(count));
        bulbs.octahedron([radius * c, 0.0, radius * s], size);
    }
    bulbs
}

/// `count` octahedral bulbs on a line, both ends included.
fn bulb_line(from: [f64; 3], to: [f64; 3], count: u32, size: f64) -> Shape {
    let mut bulbs = Shape::new();
    for i in 0..count {
        let t = f64::from(i) / f64::from(count - 1);
        bulbs.octahedron(
            [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * t),
            size,
        );
    }
    bulbs
}
