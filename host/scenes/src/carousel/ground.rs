//! The fairground: paving, booths with lit fronts, masts with strings of bulbs.

use super::super::builder::SceneBuilder;
use super::super::random::Random;
use super::super::shapes::{Shape, on_circle};
use super::{Palette, bulb_line};

/// Distance of the booths from the middle, metres.
const BOOTHS: f64 = 30.0;

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let colors = [[0.22, 0.20, 0.19], [0.26, 0.24, 0.22], [0.18, 0.17, 0.17]];
    let slabs = colors.map(|color| b.matte("paving", color, 0.5));
    let mut paving: [Shape; 3] = std::array::from_fn(|_| Shape::new());
    let half = 24;
    for x in -half..half {
        for z in -half..half {
            let (x, z) = (2.0 * f64::from(x), 2.0 * f64::from(z));
            let low = -0.02 * random.unit();
            let corners = [
                [x, low, z + 2.0],
                [x + 2.0, low, z + 2.0],
                [x + 2.0, low, z],
                [x, low, z],
            ];
            paving[random.pick(3)].quad(corners);
        }
    }
    let shapes: Vec<(&Shape, u32)> = paving.iter().zip(slabs).collect();
    let mesh = b.mesh("paving", &shapes);
    b.put("paving", None, [0.0; 3], mesh);
    booths(b, random, palette);
    masts(b, palette);
}

/// Striped booths in a half circle, open to the middle.
fn booths(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let mut walls = Shape::new();
    walls
        .block([0.0, 1.5, -1.5], [4.0, 3.0, 0.1])
        .block([0.0, 0.5, 1.0], [4.0, 1.0, 0.5]);
    let mut stripes = Shape::new();
    for side in [-2.0, 2.0] {
        walls.block([side, 1.5, 0.0], [0.1, 3.0, 3.0]);
    }
    for i in 0..8 {
        let x = -1.75 + 0.5 * f64::from(i);
        let roof = if i % 2 == 0 { &mut stripes } else { &mut walls };
        roof.beam([x, 3.0, 1.9], [x, 3.7, -1.6], 0.25).beam(
            [x + 0.25, 3.0, 1.9],
            [x + 0.25, 3.7, -1.6],
            0.25,
        );
    }
    let mut prizes = Shape::new();
    for i in 0..14 {
        let at = [
            -1.7 + 0.26 * f64::from(i),
            1.25 + 0.35 * f64::from(i % 3),
            -1.0 + 0.2 * f64::from(i % 2),
        ];
        prizes.icosphere(at, [0.14, 0.17, 0.14], 1);
    }
    let booth = b.mesh(
        "booth",
        &[
            (&walls, palette.cream),
            (&stripes, palette.red),
            (&prizes, palette.wood),
        ],
    );
    let front = bulb_line([-1.9, 2.9, 2.0], [1.9, 2.9, 2.0], 16, 0.06);
    let fronts = palette.bulbs.map(|glow| b.mesh("booth bulbs", &[(&front, glow)]));
    for i in 0..16 {
        let turn = 0.5 + (f64::from(i) + 0.5) / 32.0;
        let [c, s] = on_circle(turn);
        let heading = (0.25 - turn) * std::f64::consts::TAU + std::f64::consts::PI;
        let turned = super::super::shapes::rotation(super::UP, heading);
        let booth = b.node("booth", None, [BOOTHS * c, 0.0, BOOTHS * s], turned, Some(booth));
        b.put(
            "booth bulbs",
            Some(booth),
            [0.0; 3],
            fronts[random.pick(fronts.len())],
        );
    }
}

/// Masts around the ground, joined by strings of bulbs.
fn masts(b: &mut SceneBuilder, palette: &Palette) {
    let mast = Shape::of(|s| s.cylinder([0.0; 3], [0.12, 0.08], 7.0, 8));
    let mast = b.mesh("mast", &[(&mast, palette.steel)]);
    let place = |i: u32| {
        let [c, s] = on_circle(f64::from(i) / 18.0);
        [25.0 * c, 7.0, 25.0 * s]
    };
    for i in 0..18 {
        let [from, to] = [place(i), place(i + 1)];
        b.put("mast", None, [from[0], 0.0, from[2]], mast);
        let line = bulb_line(from, to, 24, 0.06);
        let mesh = b.mesh("mast bulbs", &[(&line, palette.bulbs[i as usize % 5])]);
        b.put("mast bulbs", None, [0.0; 3], mesh);
    }
}
