//! Carts and bicycles that carry their lamps along the street and back.

use super::super::builder::SceneBuilder;
use super::super::random::Random;
use super::super::shapes::Shape;
use super::super::track::Track;
use super::Palette;

/// How many go round.
const CARTS: u32 = 14;
const BICYCLES: u32 = 22;

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    carts(b, random, palette);
    bicycles(b, random, palette);
}

/// Street vendors' carts at 6 m/s: two lanterns that swing and a row of bulbs under the roof.
fn carts(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let cloths = [[0.60, 0.10, 0.08], [0.12, 0.22, 0.50], [0.65, 0.55, 0.20]]
        .map(|color| b.matte("cloth", color, 0.9));
    let mut wood = Shape::new();
    wood.block([0.0, 0.75, 0.0], [1.0, 0.6, 1.7]);
    for x in [-0.5, 0.5] {
        for z in [-0.8, 0.8] {
            wood.beam([x, 1.0, z], [x, 2.1, z], 0.06);
            // A wheel is a cylinder on its side.
            let wheel = Shape::of(|s| s.cylinder([0.0; 3], [0.35, 0.35], 0.08, 12));
            let half = std::f64::consts::FRAC_1_SQRT_2;
            wood.append(&wheel, [x * 1.1 + 0.04, 0.35, z * 0.7], [0.0, 0.0, half, half]);
        }
    }
    let roof = Shape::of(|s| {
        s.block([0.0, 2.15, 0.0], [1.3, 0.08, 2.0])
            .block([0.0, 2.25, 0.0], [0.9, 0.12, 1.6])
    });
    let carts = cloths.map(|cloth| b.mesh("cart", &[(&wood, palette.wood), (&roof, cloth)]));

    let bulbs = {
        let glow = b.glow("cart bulb", [40.0, 24.0, 10.0]);
        let mut row = Shape::new();
        for i in 0..6 {
            let z = -0.85 + 0.34 * f64::from(i);
            row.octahedron([-0.62, 2.02, z], 0.06)
                .octahedron([0.62, 2.02, z], 0.06);
        }
        b.mesh("cart bulbs", &[(&row, glow)])
    };
    let lantern = {
        let glow = b.glow("cart lantern", [48.0, 22.0, 7.0]);
        let lamp = Shape::of(|s| s.icosphere([0.0, -0.35, 0.0], [0.12, 0.15, 0.12], 0));
        let cord = Shape::of(|s| s.beam([0.0, -0.22, 0.0], [0.0, 0.0, 0.0], 0.02));
        b.mesh("cart lantern", &[(&lamp, glow), (&cord, palette.iron)])
    };
    let track = Track {
        half: [2.0, 74.0],
        radius: 2.0,
    };
    for i in 0..CARTS {
        let start = (f64::from(i) + random.between(-0.3, 0.3)) / f64::from(CARTS);
        let cart = b.put("cart", None, [0.0; 3], carts[random.pick(carts.len())]);
        // Carts share one lane, so they share one speed: 295 m in 49 s.
        b.drive(cart, &track, 0.0, 1225, start);
        b.put("cart bulbs", Some(cart), [0.0; 3], bulbs);
        for z in [-1.1, 1.1] {
            let lantern = b.put("cart lantern", Some(cart), [0.0, 2.1, z], lantern);
            b.swing(lantern, [1.0, 0.0, 0.0], 0.4, 35, random.unit());
        }
    }
}

/// Bicycles at 9 m/s with a lamp to the front and one to the back.
fn bicycles(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let mut frame = Shape::new();
    let (rear, front, crank, seat, bar) = (
        [0.0, 0.34, -0.5],
        [0.0, 0.34, 0.55],
        [0.0, 0.32, 0.0],
        [0.0, 0.9, -0.2],
        [0.0, 0.95, 0.4],
    );
    for (from, to) in [
        (rear, crank),
        (crank, seat),
        (crank, bar),
        (seat, bar),
        (bar, front),
        (rear, seat),
    ] {
        frame.beam(from, to, 0.04);
    }
    frame
        .beam([-0.28, 1.0, 0.38], [0.28, 1.0, 0.38], 0.03)
        .block([0.0, 0.95, -0.22], [0.14, 0.05, 0.25]);
    for [_, y, z] in [rear, front] {
        let wheel = Shape::of(|s| s.torus([0.0; 3], 0.32, 0.025, 16, 4));
        let half = std::f64::consts::FRAC_1_SQRT_2;
        frame.append(&wheel, [0.0, y, z], [0.0, half, 0.0, half]);
    }
    let rider = Shape::of(|s| {
        s.icosphere([0.0, 1.25, 0.0], [0.2, 0.38, 0.18], 1)
            .icosphere([0.0, 1.72, 0.1], [0.12, 0.14, 0.12], 1)
    });
    let cloth = b.matte("coat", [0.16, 0.20, 0.30], 0.9);
    let bicycle = b.mesh("bicycle", &[(&frame, palette.iron), (&rider, cloth)]);

    // One-sided discs, facing ahead and back.
    let disc = |z: f64, radius: f64, y: f64| {
        let mut disc = Shape::new();
        let lamp = Shape::of(|s| s.cylinder([0.0; 3], [radius, radius], 0.04, 8));
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let turn = if z > 0.0 {
            [half, 0.0, 0.0, half]
        } else {
            [-half, 0.0, 0.0, half]
        };
        disc.append(&lamp, [0.0, y, z], turn);
        disc
    };
    let head_glow = b.glow("headlamp", [260.0, 250.0, 220.0]);
    let tail_glow = b.glow("tail lamp", [45.0, 2.0, 1.0]);
    let head = b.mesh("headlamp", &[(&disc(0.55, 0.06, 0.85), head_glow)]);
    let tail = b.mesh("tail lamp", &[(&disc(-0.55, 0.05, 0.7), tail_glow)]);
    let track = Track {
        half: [3.3, 76.0],
        radius: 3.3,
    };
    for i in 0..BICYCLES {
        let start = (f64::from(i) + random.between(-0.3, 0.3)) / f64::from(BICYCLES);
        let node = b.put("bicycle", None, [0.0; 3], bicycle);
        // 311 m in 35 s.
        b.drive(node, &track, 0.0, 875, start);
        b.put("headlamp", Some(node), [0.0; 3], head);
        b.put("tail lamp", Some(node), [0.0; 3], tail);
    }
}
