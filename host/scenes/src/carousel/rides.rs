//! The carousel itself, the swing ride, the cups and the gyroscope.

use super::super::builder::{STILL, SceneBuilder};
use super::super::random::Random;
use super::super::shapes::{Shape, on_circle, rotation};
use super::{Palette, UP, bulb_circle, bulb_line};

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    merry_go_round(b, random, palette);
    swing_ride(b, random, palette);
    cups(b, random, palette);
    gyroscope(b, palette);
}

/// A turning platform with a lit canopy; horses rise and fall on poles of bulbs.
fn merry_go_round(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let platform = Shape::of(|s| {
        s.cylinder([0.0, 0.2, 0.0], [6.6, 6.6], 0.25, 48)
            .cylinder([0.0, 0.45, 0.0], [1.3, 1.3], 4.6, 24)
    });
    let canopy = Shape::of(|s| {
        s.cylinder([0.0, 5.0, 0.0], [6.8, 6.8], 0.5, 48)
            .cylinder([0.0, 5.5, 0.0], [6.8, 0.4], 1.9, 24)
    });
    let body = b.mesh("carousel", &[(&platform, palette.cream), (&canopy, palette.red)]);
    let hub = b.put("carousel", None, [0.0; 3], body);
    b.spin(hub, UP, 1, 300, 0.0);

    for (tier, (radius, y, count)) in [
        (6.85, 5.05, 128),
        (6.85, 5.45, 128),
        (1.4, 4.4, 40),
        (1.4, 3.0, 40),
        (6.65, 0.3, 120),
    ]
    .into_iter()
    .enumerate()
    {
        let mesh = b.mesh(
            "ring of bulbs",
            &[(&bulb_circle(radius, count, 0.06), palette.bulbs[tier % 3])],
        );
        b.put("ring of bulbs", Some(hub), [0.0, y, 0.0], mesh);
    }
    let rib = bulb_line([6.7, 5.6, 0.0], [0.5, 7.42, 0.0], 28, 0.055);
    let ribs = palette.bulbs.map(|glow| b.mesh("rib of bulbs", &[(&rib, glow)]));
    for i in 0..24 {
        let turn = rotation(UP, std::f64::consts::TAU * f64::from(i) / 24.0);
        b.node(
            "rib of bulbs",
            Some(hub),
            [0.0; 3],
            turn,
            Some(ribs[if i % 2 == 0 { 0 } else { 1 }]),
        );
    }

    let mut horse = Shape::new();
    horse
        .icosphere([0.0, 1.5, 0.0], [0.28, 0.32, 0.65], 1)
        .icosphere([0.0, 2.1, 0.75], [0.14, 0.2, 0.3], 1);
    horse.beam([0.0, 1.6, 0.45], [0.0, 2.15, 0.65], 0.22);
    for (x, z) in [(-0.15, -0.4), (0.15, -0.4), (-0.15, 0.4), (0.15, 0.4)] {
        horse.beam([x, 1.4, z], [x, 0.75, z + 0.2], 0.1);
    }
    let pole = bulb_line([0.0, 2.0, 0.0], [0.0, 3.9, 0.0], 14, 0.045);
    let meshes = palette
        .bulbs
        .map(|glow| b.mesh("horse", &[(&pole, glow), (&horse, palette.cream)]));
    for (radius, count) in [(5.6, 20), (3.6, 12)] {
        for i in 0..count {
            let turn = f64::from(i) / f64::from(count);
            let [c, s] = on_circle(turn);
            let at = [radius * c, 0.3, radius * s];
            let facing = rotation(UP, std::f64::consts::TAU * -turn);
            let seat = b.node("horse", Some(hub), at, facing, Some(meshes[random.pick(5)]));
            b.bob(seat, at, 0.35, 75, f64::from(i % 4) / 4.0);
        }
    }
}

/// Chairs on chains that fly outward around a tilted, lit crown.
fn swing_ride(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let tower = Shape::of(|s| s.cylinder([0.0; 3], [1.6, 0.7], 9.0, 16));
    let tower = b.mesh("swing tower", &[(&tower, palette.red)]);
    let tower = b.put("swing tower", None, [-15.0, 0.0, -6.0], tower);
    let crown = Shape::of(|s| s.cylinder([0.0; 3], [0.8, 5.0], 0.9, 32));
    let crown = b.mesh("swing crown", &[(&crown, palette.cream)]);
    let hub = b.put("swing crown", Some(tower), [0.0, 9.0, 0.0], crown);
    b.spin(hub, UP, -1, 150, 0.0);
    for (ring, (radius, y)) in [(5.05, 0.9), (4.2, 0.75), (3.2, 0.5), (2.2, 0.3)]
        .into_iter()
        .enumerate()
    {
        let mesh = b.mesh(
            "crown bulbs",
            &[(
                &bulb_circle(radius, 24 * (5 - ring as u32), 0.06),
                palette.bulbs[ring],
            )],
        );
        b.put("crown bulbs", Some(hub), [0.0, y, 0.0], mesh);
    }
    let mut chair = Shape::new();
    chair
        .block([0.0, -4.6, 0.0], [0.5, 0.08, 0.5])
        .block([0.25, -4.3, 0.0], [0.06, 0.6, 0.5]);
    for z in [-0.22, 0.22] {
        chair.beam([0.0, 0.0, z], [0.0, -4.6, z], 0.025);
    }
    let lights = bulb_line([0.0, -0.6, 0.0], [0.0, -4.4, 0.0], 16, 0.05);
    let meshes = palette
        .bulbs
        .map(|glow| b.mesh("chair", &[(&lights, glow), (&chair, palette.steel)]));
    for i in 0..28_u32 {
        let turn = f64::from(i) / 28.0;
        let [c, s] = on_circle(turn);
        let arm = b.node(
            "chair arm",
            Some(hub),
            [4.8 * c, 0.5, 4.8 * s],
            rotation(UP, -turn * std::f64::consts::TAU),
            None,
        );
        // Chains hang 35 degrees outward and swing a little.
        let hang = b.node(
            "chair hang",
            Some(arm),
            [0.0; 3],
            rotation([0.0, 0.0, 1.0], 0.6),
            None,
        );
        let chair = b.put("chair", Some(hang), [0.0; 3], meshes[i as usize % 5]);
        b.swing(chair, [0.0, 0.0, 1.0], 0.1, 60, random.unit());
    }
}

/// Three tables of six cups: cups turn on tables that turn on the floor.
fn cups(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let floor = b.solid("cup table", palette.wood, |s| {
        s.cylinder([0.0; 3], [2.6, 2.6], 0.2, 32)
    });
    let cup = Shape::of(|s| s.cylinder([0.0, 0.2, 0.0], [0.45, 0.75], 0.8, 16));
    let rim = bulb_circle(0.8, 26, 0.045);
    let meshes = palette.bulbs.map(|glow| b.mesh("cup bulbs", &[(&rim, glow)]));
    let cup = b.mesh("cup body", &[(&cup, palette.cream)]);
    let edge = b.mesh("table bulbs", &[(&bulb_circle(2.65, 64, 0.05), palette.bulbs[0])]);
    for (t, at) in [[11.0, 0.0, 12.0], [16.5, 0.0, 9.0], [15.0, 0.0, 15.0]]
        .into_iter()
        .enumerate()
    {
        let table = b.put("cup table", None, at, floor);
        b.spin(table, UP, if t == 1 { -1 } else { 1 }, 200, 0.1 * t as f64);
        b.put("table bulbs", Some(table), [0.0, 0.1, 0.0], edge);
        for i in 0..6 {
            let [c, s] = on_circle(f64::from(i) / 6.0);
            let node = b.put("cup", Some(table), [1.75 * c, 0.0, 1.75 * s], cup);
            b.spin(node, UP, -2, 100, random.unit());
            b.put("cup bulbs", Some(node), [0.0, 1.05, 0.0], meshes[random.pick(5)]);
        }
    }
}

/// Rings of bulbs, each hung in the next larger one and turning about another axis.
fn gyroscope(b: &mut SceneBuilder, palette: &Palette) {
    let mut stand = Shape::new();
    stand.cylinder([0.0; 3], [1.5, 0.8], 0.8, 16);
    for side in [-1.0, 1.0] {
        stand.beam([side * 0.6, 0.8, 0.0], [side * 3.7, 4.4, 0.0], 0.2);
    }
    let stand = b.mesh("gyroscope stand", &[(&stand, palette.steel)]);
    let mut parent = b.put("gyroscope stand", None, [12.5, 0.0, -2.0], stand);
    let axes = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    for ring in 0..7_u32 {
        let radius = 3.4 - 0.42 * f64::from(ring);
        let count = (radius * 32.0) as u32;
        let tube = Shape::of(|s| s.torus([0.0; 3], radius - 0.09, 0.05, 40, 4));
        // The torus lies around z; the bulbs lie around y.
        let mut flat = Shape::new();
        let half = std::f64::consts::FRAC_1_SQRT_2;
        flat.append(&tube, [0.0; 3], [half, 0.0, 0.0, half]);
        let bulbs = bulb_circle(radius, count, 0.055);
        let glow = palette.bulbs[ring as usize % 5];
        let mesh = b.mesh("gyroscope ring", &[(&bulbs, glow), (&flat, palette.steel)]);
        let at = if ring == 0 { [0.0, 4.4, 0.0] } else { [0.0; 3] };
        parent = b.node("gyroscope ring", Some(parent), at, STILL, Some(mesh));
        b.spin(
            parent,
            axes[ring as usize % 2],
            if ring % 3 == 0 { -1 } else { 1 },
            125 + 25 * ring,
            0.08,
        );
    }
}
