//! The Ferris wheel: rims and spokes of bulbs turn together, gondolas turn back and stay upright.

use super::super::builder::{STILL, SceneBuilder};
use super::super::shapes::{Shape, on_circle, rotation};
use super::{Palette, bulb_line};

const RADIUS: f64 = 10.0;
const AXLE: f64 = 12.0;
const GONDOLAS: u32 = 20;

/// Frames for one turn.
const PERIOD: u32 = 500;

const AXIS: [f64; 3] = [0.0, 0.0, 1.0];

pub(super) fn add(b: &mut SceneBuilder, palette: &Palette) {
    let mut legs = Shape::new();
    for z in [-1.4, 1.4] {
        for x in [-4.5, 4.5] {
            legs.beam([x, 0.0, z * 1.6], [0.0, AXLE, z], 0.35);
        }
    }
    let legs = b.mesh("wheel legs", &[(&legs, palette.steel)]);
    let stand = b.put("wheel legs", None, [-3.0, 0.0, -18.0], legs);

    let mut frame = Shape::new();
    frame
        .torus([0.0, 0.0, -1.0], RADIUS, 0.12, 72, 4)
        .torus([0.0, 0.0, 1.0], RADIUS, 0.12, 72, 4);
    frame.torus([0.0; 3], 1.0, 0.4, 24, 6);
    let frame = b.mesh("wheel", &[(&frame, palette.steel)]);
    let wheel = b.node("wheel", Some(stand), [0.0, AXLE, 0.0], STILL, Some(frame));
    b.spin(wheel, AXIS, 1, PERIOD, 0.0);

    // Rims: two circles of icosahedral bulbs on either face, cut into quarters so that each is one mesh light.
    for (color, radius, count) in [(0, RADIUS + 0.2, 25), (1, RADIUS - 0.5, 22)] {
        let mut quarter = Shape::new();
        for z in [-1.2, 1.2] {
            for i in 0..count {
                let [c, s] = on_circle(0.25 * f64::from(i) / f64::from(count));
                quarter.icosphere([radius * c, radius * s, z], [0.1; 3], 0);
            }
        }
        let mesh = b.mesh("rim bulbs", &[(&quarter, palette.bulbs[color])]);
        for i in 0..4 {
            let turn = rotation(AXIS, 0.25 * std::f64::consts::TAU * f64::from(i));
            b.node("rim bulbs", Some(wheel), [0.0; 3], turn, Some(mesh));
        }
    }
    spokes(b, palette, wheel);
    gondolas(b, palette, wheel);
}

fn spokes(b: &mut SceneBuilder, palette: &Palette, wheel: u32) {
    let meshes = [2, 4].map(|color: usize| {
        let mut bulbs = Shape::new();
        let mut bars = Shape::new();
        for z in [-1.1, 1.1] {
            let line = bulb_line([1.4, 0.0, z], [RADIUS - 0.8, 0.0, z], 26, 0.07);
            bulbs.append(&line, [0.0; 3], [0.0, 0.0, 0.0, 1.0]);
            bars.beam([1.2, 0.0, z * 0.9], [RADIUS, 0.0, z * 0.9], 0.1);
        }
        b.mesh("spoke", &[(&bulbs, palette.bulbs[color]), (&bars, palette.steel)])
    });
    for i in 0..GONDOLAS {
        let turn = rotation(
            AXIS,
            std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(GONDOLAS),
        );
        b.node("spoke", Some(wheel), [0.0; 3], turn, Some(meshes[i as usize % 2]));
    }
}

fn gondolas(b: &mut SceneBuilder, palette: &Palette, wheel: u32) {
    let mut cabin = Shape::new();
    cabin
        .block([0.0, -1.5, 0.0], [1.2, 0.7, 1.4])
        .block([0.0, -0.25, 0.0], [1.3, 0.12, 1.5]);
    for x in [-0.55, 0.55] {
        for z in [-0.65, 0.65] {
            cabin.beam([x, -1.3, z], [x, -0.25, z], 0.06);
        }
    }
    let mut lights = Shape::new();
    for (from, to) in [
        ([-0.65, -0.36, 0.76], [0.65, -0.36, 0.76]),
        ([-0.65, -0.36, -0.76], [0.65, -0.36, -0.76]),
    ] {
        lights.append(&bulb_line(from, to, 8, 0.05), [0.0; 3], [0.0, 0.0, 0.0, 1.0]);
    }
    lights.icosphere([0.0, -0.5, 0.0], [0.12; 3], 0);
    let paints = [palette.red, palette.cream];
    let meshes: Vec<u32> = (0..10)
        .map(|i| {
            b.mesh(
                "gondola",
                &[(&lights, palette.bulbs[i % 5]), (&cabin, paints[i % 2])],
            )
        })
        .collect();
    for i in 0..GONDOLAS {
        let [c, s] = on_circle(f64::from(i) / f64::from(GONDOLAS));
        let node = b.put(
            "gondola",
            Some(wheel),
            [RADIUS * c, RADIUS * s, 0.0],
            meshes[i as usize % 10],
        );
        b.spin(node, AXIS, -1, PERIOD, 0.0);
    }
}
