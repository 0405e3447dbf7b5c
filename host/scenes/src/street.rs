//! `street`: a night street in the manner of Bistro Exterior, the scene of the paper's Figures 4 and 6.
//!
//! 160 m of facades, 14 m apart, with street lamps, strings of bulbs, paper lanterns, neon signs, lit windows and café
//! candles. Strings, lanterns and half of the signs swing; carts and bicycles carry their lamps round the street, so that
//! lights travel far from where a light BVH was built, as in the paper's moving Bistro.
//!
//! The street runs along z; x = 0 is its middle, y = 0 the road.

mod facades;
mod lamps;
mod traffic;

use super::builder::SceneBuilder;
use super::error::SceneError;
use super::random::Random;
use super::scene::Scene;
use super::shapes::Shape;

/// Half the length of the street, metres.
const HALF_LENGTH: f64 = 80.0;

/// Distance of the facades from the middle, metres.
const FACADE: f64 = 7.0;

/// Materials that several parts share.
struct Palette {
    iron: u32,
    wood: u32,
    stone: u32,
}

/// Builds the scene, which passes the same checks as one from a file.
pub(super) fn street() -> Result<Scene, SceneError> {
    let mut b = SceneBuilder::new("street", [0.010, 0.014, 0.030]);
    let mut random = Random::new(1);
    let palette = Palette {
        iron: b.metal("iron", [0.10, 0.11, 0.12], 0.6, 0.4),
        wood: b.matte("wood", [0.30, 0.18, 0.10], 0.7),
        stone: b.matte("stone", [0.45, 0.43, 0.40], 0.8),
    };
    ground(&mut b, &palette);
    facades::add(&mut b, &mut random, &palette);
    lamps::add(&mut b, &mut random, &palette);
    traffic::add(&mut b, &mut random, &palette);
    b.camera([2.2, 2.6, 58.0], [-0.8, 3.0, 0.0], 50.0);
    b.finish()
}

/// Wet asphalt, kerbs, and paving slabs whose colours vary.
fn ground(b: &mut SceneBuilder, palette: &Palette) {
    let asphalt = b.matte("asphalt", [0.10, 0.10, 0.11], 0.25);
    let slabs = b.matte("slabs", [0.28, 0.27, 0.26], 0.6);
    let mut road = Shape::new();
    let mut pavement = Shape::new();
    let mut kerb = Shape::new();
    let step = 4.0;
    let mut z = -HALF_LENGTH;
    while z < HALF_LENGTH {
        road.quad([
            [-4.0, 0.0, z + step],
            [4.0, 0.0, z + step],
            [4.0, 0.0, z],
            [-4.0, 0.0, z],
        ]);
        for side in [-1.0, 1.0] {
            let centre = side * 5.6;
            for row in [-0.9, 0.05, 1.0] {
                pavement.block([centre + row, 0.06, z + 0.25 * step], [0.9, 0.12, 0.48 * step]);
                pavement.block([centre + row, 0.06, z + 0.75 * step], [0.9, 0.12, 0.48 * step]);
            }
            kerb.block([side * 4.1, 0.07, z + 0.5 * step], [0.2, 0.14, step]);
            kerb.block([centre, 0.05, z + 0.5 * step], [2.8, 0.1, step]);
        }
        z += step;
    }
    let mesh = b.mesh(
        "ground",
        &[(&road, asphalt), (&pavement, slabs), (&kerb, palette.stone)],
    );
    b.put("ground", None, [0.0; 3], mesh);
}
