//! Street lamps, strings of bulbs, paper lanterns and neon signs.

use super::super::builder::{STILL, SceneBuilder};
use super::super::random::Random;
use super::super::shapes::Shape;
use super::{FACADE, HALF_LENGTH, Palette};

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    street_lamps(b, palette);
    strings(b, random, palette);
    lanterns(b, random, palette);
    signs(b, random, palette);
}

/// Swings between these amplitudes in radians, in a period of the first number of frames and up to so many steps more.
fn swing(b: &mut SceneBuilder, random: &mut Random, node: u32, [low, high]: [f64; 2], period: [u32; 3]) {
    let amplitude = random.between(low, high);
    let [first, step, count] = period;
    let period = first + step * random.pick(count as usize) as u32;
    b.swing(node, [1.0, 0.0, 0.0], amplitude, period, random.unit());
}

/// A post every 8 m on either side, with two lamps each.
fn street_lamps(b: &mut SceneBuilder, palette: &Palette) {
    let mut iron = Shape::new();
    iron.cylinder([0.0; 3], [0.14, 0.12], 0.5, 8)
        .cylinder([0.0, 0.5, 0.0], [0.06, 0.05], 3.7, 8);
    iron.beam([0.0, 4.0, -0.6], [0.0, 4.0, 0.6], 0.05);
    for z in [-0.6, 0.6] {
        iron.cylinder([0.0, 4.02, z], [0.2, 0.03], 0.22, 8);
    }
    let post = b.mesh("lamp post", &[(&iron, palette.iron)]);
    let glow = b.glow("lamp", [95.0, 62.0, 30.0]);
    let bulb = b.solid("lamp", glow, |s| s.icosphere([0.0; 3], [0.13, 0.15, 0.13], 0));
    let count = (2.0 * HALF_LENGTH / 8.0) as i32;
    for i in 0..count {
        for side in [-1.0, 1.0] {
            // The two sides alternate.
            let z = -HALF_LENGTH + 8.0 * f64::from(i) + if side > 0.0 { 2.0 } else { 6.0 };
            let post = b.put("lamp post", None, [side * 4.5, 0.12, z], post);
            for end in [-0.6, 0.6] {
                b.put("lamp", Some(post), [0.0, 3.85, end], bulb);
            }
        }
    }
}

/// Strings of bulbs across the street, each one mesh light, swinging about the line between its ends.
fn strings(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let colors = [
        [26.0, 15.0, 6.0],
        [30.0, 8.0, 4.0],
        [6.0, 18.0, 8.0],
        [7.0, 10.0, 26.0],
        [26.0, 20.0, 12.0],
    ];
    let glows = colors.map(|radiance| b.glow("bulb", radiance));
    let bulbs = 14;
    let mut cable = Shape::new();
    let mut beads = Shape::new();
    let point = |i: i32| {
        let t = f64::from(i) / f64::from(bulbs + 1);
        // A parabola is close to a catenary that sags this little.
        [FACADE * (2.0 * t - 1.0), -4.0 * t * (1.0 - t), 0.0]
    };
    for i in 0..=bulbs {
        cable.beam(point(i), point(i + 1), 0.02);
        if i > 0 {
            let [x, y, z] = point(i);
            beads.octahedron([x, y - 0.09, z], 0.075);
        }
    }
    let meshes = glows.map(|glow| b.mesh("string of bulbs", &[(&beads, glow), (&cable, palette.iron)]));
    let mut z = -HALF_LENGTH + 3.0;
    while z < HALF_LENGTH {
        let mesh = meshes[random.pick(meshes.len())];
        let node = b.put("string of bulbs", None, [0.0, random.between(5.6, 6.6), z], mesh);
        swing(b, random, node, [0.15, 0.5], [60, 15, 4]);
        z += 6.0;
    }
}

/// Paper lanterns on cords between the strings.
fn lanterns(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let glows = [[5.0, 0.8, 0.4], [4.5, 2.4, 0.7], [5.0, 1.7, 0.35]]
        .map(|radiance| b.glow("paper lantern", radiance));
    let mut cord = Shape::new();
    cord.beam([0.0, -0.7, 0.0], [0.0, 0.0, 0.0], 0.02);
    cord.cylinder([0.0, -0.76, 0.0], [0.12, 0.10], 0.08, 8);
    let paper = Shape::of(|s| s.icosphere([0.0, -1.0, 0.0], [0.26, 0.24, 0.26], 1));
    let meshes = glows.map(|glow| b.mesh("paper lantern", &[(&paper, glow), (&cord, palette.iron)]));
    let span = b.solid("cord", palette.iron, |s| {
        s.beam([-FACADE, 0.0, 0.0], [FACADE, 0.0, 0.0], 0.015)
    });
    let mut z = -HALF_LENGTH + 6.0;
    while z < HALF_LENGTH {
        let span = b.put("cord", None, [0.0, 5.9, z], span);
        for x in [-3.2, 0.0, 3.2] {
            let mesh = meshes[random.pick(meshes.len())];
            let node = b.put("paper lantern", Some(span), [x, 0.0, 0.0], mesh);
            swing(b, random, node, [0.2, 0.6], [45, 10, 4]);
        }
        z += 12.0;
    }
}

/// Neon signs on brackets; every second one swings.
fn signs(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let colors = [
        [9.0, 0.2, 0.7],
        [0.2, 4.0, 7.0],
        [0.4, 7.0, 0.6],
        [8.0, 2.4, 0.1],
        [4.0, 0.3, 7.0],
    ];
    let glows = colors.map(|radiance| b.glow("neon", radiance));
    let tubes = [sign_frame(), sign_ring(), sign_arrow()];
    let board = Shape::of(|s| s.block([0.0, -0.85, 0.0], [1.0, 1.5, 0.06]));
    let bracket = Shape::of(|s| s.beam([-0.7, 0.0, 0.0], [0.9, 0.0, 0.0], 0.05));
    let bracket = b.mesh("bracket", &[(&bracket, palette.iron)]);
    let meshes: Vec<[u32; 5]> = tubes
        .iter()
        .map(|tube| glows.map(|glow| b.mesh("neon sign", &[(tube, glow), (&board, palette.wood)])))
        .collect();
    let mut z = -HALF_LENGTH + 4.0;
    let mut count = 0;
    while z < HALF_LENGTH - 2.0 {
        let side = if count % 2 == 0 { -1.0 } else { 1.0 };
        let at = [side * (FACADE - 0.9), random.between(4.4, 5.4), z];
        let bracket = b.put("bracket", None, at, bracket);
        let mesh = meshes[random.pick(tubes.len())][random.pick(colors.len())];
        let sign = b.node("neon sign", Some(bracket), [0.0, -0.05, 0.0], STILL, Some(mesh));
        if count % 4 < 2 {
            swing(b, random, sign, [0.1, 0.35], [50, 10, 3]);
        }
        z += 4.0;
        count += 1;
    }
}

/// Both faces of a board carry the same tubes.
fn on_both_faces(draw: impl Fn(&mut Shape, f64)) -> Shape {
    let mut tubes = Shape::new();
    for z in [-0.07, 0.07] {
        draw(&mut tubes, z);
    }
    tubes
}

fn sign_frame() -> Shape {
    on_both_faces(|tubes, z| {
        let corners = [[-0.4, -1.5, z], [0.4, -1.5, z], [0.4, -0.2, z], [-0.4, -0.2, z]];
        for i in 0..4 {
            tubes.beam(corners[i], corners[(i + 1) % 4], 0.05);
        }
        tubes
            .beam([-0.25, -0.7, z], [0.25, -0.7, z], 0.05)
            .beam([-0.25, -1.0, z], [0.25, -1.0, z], 0.05);
    })
}

fn sign_ring() -> Shape {
    on_both_faces(|tubes, z| {
        tubes
            .torus([0.0, -0.85, z], 0.36, 0.03, 12, 3)
            .torus([0.0, -0.85, z], 0.2, 0.03, 8, 3);
    })
}

fn sign_arrow() -> Shape {
    on_both_faces(|tubes, z| {
        tubes.beam([0.0, -0.3, z], [0.0, -1.4, z], 0.05);
        for x in [-0.3, 0.3] {
            tubes
                .beam([0.0, -1.4, z], [x, -1.0, z], 0.05)
                .beam([x, -0.3, z], [x, -0.7, z], 0.05);
        }
    })
}
