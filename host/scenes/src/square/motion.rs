//! What moves: cars round the park, drones above it, fireflies in it.

use super::super::builder::{STILL, SceneBuilder};
use super::super::random::Random;
use super::super::shapes::{Shape, on_circle};
use super::super::track::Track;
use super::PARK;

const CARS: u32 = 84;
const FIREFLIES: usize = 1300;

/// Rings of drones: radius and height in metres, drones, whole turns per period.
const DRONE_RINGS: [(f64, f64, u32, i32); 4] = [
    (10.0, 9.0, 24, 2),
    (22.0, 13.0, 40, -1),
    (36.0, 10.0, 56, 1),
    (52.0, 16.0, 64, -1),
];

const UP: [f64; 3] = [0.0, 1.0, 0.0];

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, iron: u32) {
    cars(b, random, iron);
    drones(b, random, iron);
    fireflies(b, random);
}

/// Two lanes, at 12 m/s, with two lamps ahead and two behind.
fn cars(b: &mut SceneBuilder, random: &mut Random, iron: u32) {
    let paints = [
        [0.5, 0.05, 0.05],
        [0.08, 0.10, 0.30],
        [0.4, 0.4, 0.42],
        [0.05, 0.05, 0.05],
    ];
    let body = Shape::of(|s| {
        s.block([0.0, 0.62, 0.0], [1.8, 0.6, 4.2])
            .block([0.0, 1.2, -0.3], [1.6, 0.6, 2.2])
    });
    let mut wheels = Shape::new();
    for x in [-0.85, 0.85] {
        for z in [-1.3, 1.3] {
            wheels.block([x, 0.32, z], [0.25, 0.64, 0.64]);
        }
    }
    let cars = paints.map(|color| {
        let paint = b.matte("paint", color, 0.3);
        b.mesh("car", &[(&body, paint), (&wheels, iron)])
    });
    // One-sided panes: the light goes ahead, or behind.
    let ahead = Shape::of(|s| s.pane([0.14, 0.09]));
    let behind = Shape::of(|s| s.pane([-0.14, 0.07]));
    let head_glow = b.glow("headlamp", [300.0, 290.0, 260.0]);
    let tail_glow = b.glow("tail lamp", [60.0, 3.0, 2.0]);
    let head = b.mesh("headlamp", &[(&ahead, head_glow)]);
    let tail = b.mesh("tail lamp", &[(&behind, tail_glow)]);

    for lane in 0..2 {
        let half = PARK + 6.0 + 5.0 * f64::from(lane);
        let track = Track {
            half: [half, half],
            radius: 10.0,
        };
        // 12 m/s at 25 frames per second.
        let period = (track.length() / 12.0 * 25.0) as u32;
        for i in 0..CARS / 2 {
            let start = (f64::from(i) + random.between(-0.3, 0.3)) / f64::from(CARS / 2);
            let car = b.put("car", None, [0.0; 3], cars[random.pick(cars.len())]);
            b.drive(car, &track, -0.05, period, start);
            for x in [-0.6, 0.6] {
                b.put("headlamp", Some(car), [x, 0.65, 2.12], head);
                b.put("tail lamp", Some(car), [x, 0.75, -2.12], tail);
            }
        }
    }
}

/// Rings that turn about the middle; each drone bobs and carries a lamp below it.
fn drones(b: &mut SceneBuilder, random: &mut Random, iron: u32) {
    let glows = [
        [500.0, 60.0, 280.0],
        [60.0, 380.0, 560.0],
        [180.0, 520.0, 110.0],
        [560.0, 340.0, 60.0],
    ];
    let body = Shape::of(|s| {
        s.block([0.0; 3], [0.5, 0.08, 0.08])
            .block([0.0; 3], [0.08, 0.08, 0.5])
    });
    let lamp = Shape::of(|s| s.octahedron([0.0, -0.16, 0.0], 0.10));
    for ((radius, height, count, turns), radiance) in DRONE_RINGS.into_iter().zip(glows) {
        let glow = b.glow("drone", radiance);
        let drone = b.mesh("drone", &[(&lamp, glow), (&body, iron)]);
        let hub = b.node("drone ring", None, [0.0, height, 0.0], STILL, None);
        b.spin(hub, UP, turns, 900, 0.0);
        for i in 0..count {
            let turn = f64::from(i) / f64::from(count);
            let [c, s] = on_circle(turn);
            let at = [radius * c, 0.0, radius * s];
            let node = b.put("drone", Some(hub), at, drone);
            b.bob(node, at, 1.2, 150, 3.0 * turn + 0.1 * random.unit());
        }
    }
}

/// Each on a smooth closed path of its own around a home between the trees.
fn fireflies(b: &mut SceneBuilder, random: &mut Random) {
    let glows = [[170.0, 260.0, 30.0], [250.0, 220.0, 40.0]].map(|radiance| b.glow("firefly", radiance));
    let meshes = glows.map(|glow| {
        let body = Shape::of(|s| s.octahedron([0.0; 3], 0.035));
        b.mesh("firefly", &[(&body, glow)])
    });
    for _ in 0..FIREFLIES {
        let home = [
            random.between(-PARK, PARK),
            random.between(0.5, 1.8),
            random.between(-PARK, PARK),
        ];
        let points: [[f64; 3]; 6] = std::array::from_fn(|_| {
            let reach = [3.0, 0.4, 3.0];
            [0, 1, 2].map(|axis| home[axis] + random.between(-reach[axis], reach[axis]))
        });
        let node = b.put("firefly", None, home, meshes[random.pick(2)]);
        b.fly(node, &points, 200 + 50 * random.pick(4) as u32);
    }
}
