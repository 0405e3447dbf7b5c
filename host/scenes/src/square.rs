//! `square`: a park between houses in the manner of Emerald Square, wide and with thousands of small lights.
//!
//! 200 m by 200 m. Path lamps, fairy lights in the trees and lit windows stand still; cars drive round the park, four
//! rings of drones turn above it, and fireflies wander between the trees. Nearly every light is a mesh light of its
//! own, so that the top level has the work: the paper reports its longest rebuilds for Emerald Square (Table 2).
//!
//! The ground is y = 0, the park's middle the origin.

mod buildings;
mod motion;
mod park;

use super::builder::SceneBuilder;
use super::error::SceneError;
use super::random::Random;
use super::scene::Scene;
use super::shapes::Shape;

/// Half the width of the park inside the road, metres.
const PARK: f64 = 72.0;

/// Distance of the houses' fronts from the middle, metres.
const FRONTS: f64 = 92.0;

/// Builds the scene, which passes the same checks as one from a file.
pub(super) fn square() -> Result<Scene, SceneError> {
    let mut b = SceneBuilder::new("square", [0.008, 0.012, 0.028]);
    let mut random = Random::new(2);
    let iron = b.metal("iron", [0.12, 0.13, 0.14], 0.5, 0.4);
    ground(&mut b);
    buildings::add(&mut b, &mut random);
    park::add(&mut b, &mut random, iron);
    motion::add(&mut b, &mut random, iron);
    b.camera([-0.5, 2.6, 46.0], [0.4, 4.6, 0.0], 55.0);
    b.finish()
}

/// Lawn, road, pavement, two crossing paths and a round one.
fn ground(b: &mut SceneBuilder) {
    let grass = b.matte("grass", [0.10, 0.22, 0.07], 1.0);
    let asphalt = b.matte("asphalt", [0.10, 0.10, 0.11], 0.4);
    let gravel = b.matte("gravel", [0.45, 0.40, 0.32], 0.9);
    let slabs = b.matte("slabs", [0.35, 0.34, 0.33], 0.7);
    let flat = |shape: &mut Shape, [x0, x1]: [f64; 2], [z0, z1]: [f64; 2], y: f64| {
        shape.quad([[x0, y, z1], [x1, y, z1], [x1, y, z0], [x0, y, z0]]);
    };
    let (mut lawn, mut road, mut path, mut pavement) =
        (Shape::new(), Shape::new(), Shape::new(), Shape::new());
    flat(&mut lawn, [-PARK, PARK], [-PARK, PARK], 0.0);
    flat(&mut road, [-140.0, 140.0], [-140.0, 140.0], -0.05);
    for side in [-1.0, 1.0] {
        let (a, c) = (side * FRONTS, side * (FRONTS - 4.0));
        let strip = [f64::min(a, c), f64::max(a, c)];
        pavement.cuboid([strip[0], -0.05, -FRONTS], [strip[1], 0.1, FRONTS]);
        pavement.cuboid([-FRONTS, -0.05, strip[0]], [FRONTS, 0.1, strip[1]]);
    }
    flat(&mut path, [-PARK, PARK], [-2.0, 2.0], 0.01);
    flat(&mut path, [-2.0, 2.0], [-PARK, PARK], 0.011);
    path.cylinder([0.0, 0.0, 0.0], [14.0, 14.0], 0.012, 48);
    let mesh = b.mesh(
        "ground",
        &[
            (&lawn, grass),
            (&road, asphalt),
            (&path, gravel),
            (&pavement, slabs),
        ],
    );
    b.put("ground", None, [0.0; 3], mesh);
}
