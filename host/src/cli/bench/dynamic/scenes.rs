//! The scenes, each made by seeded numbers: lamps, and the edits of each frame.

use std::f32::consts::TAU;

use super::world::{Point, World};
use crate::stability::random::Random;

/// Lamps, and how their variance is measured.
pub(super) struct Scene {
    pub name: &'static str,
    pub lamps: Vec<Lamp>,
    /// Number of frames, of first frames that do not count, and of frames from one measurement of variance to the next.
    pub frames: usize,
    pub warm: usize,
    pub look: usize,
    /// Number of points at which variance is measured.
    pub points: u32,
    /// Side of the square that they lie in; none for points near lamps.
    pub side: Option<f32>,
    /// Edits a frame.
    pub step: Step,
}

/// Initial position and radiance.
type Lamp = (Point, f32);
type Step = Box<dyn FnMut(usize, &mut World)>;

impl Scene {
    fn new(name: &'static str, lamps: Vec<Lamp>, step: impl FnMut(usize, &mut World) + 'static) -> Self {
        Self {
            name,
            side: Some(side(lamps.len())),
            points: match lamps.len() {
                0..50_000 => 20,
                50_000..500_000 => 8,
                _ => 4,
            },
            lamps,
            frames: 140,
            warm: 20,
            look: 30,
            step: Box::new(step),
        }
    }

    fn near(self) -> Self {
        Self { side: None, ..self }
    }
}

/// All scenes.
pub(super) fn scenes() -> Vec<Scene> {
    vec![
        mix("20 random edits", 1_000, 20),
        mix("50 random edits", 10_000, 50),
        mix("50 random edits", 1_000_000, 50),
        convoy(),
        walk(10_000, 0.42),
        rings(100_000),
        scatter(10_000),
        clusters(16),
        clusters(64),
    ]
}

/// Side of the square that holds `count` lamps, metres: 4 m² for each.
fn side(count: usize) -> f32 {
    2.0 * (count as f32).sqrt()
}

fn anywhere(random: &mut Random, side: f32) -> Point {
    [
        random.between(0.0, side),
        random.between(3.0, 6.0),
        random.between(0.0, side),
    ]
}

fn bright(random: &mut Random) -> f32 {
    random.between(0.2, 1.2)
}

fn scattered(count: usize) -> Vec<Lamp> {
    let random = &mut Random::new(1);
    let side = side(count);
    (0..count)
        .map(|_| (anywhere(random, side), bright(random)))
        .collect()
}

/// A quarter of the edits adds, a quarter removes, half move anywhere.
fn mix(name: &'static str, count: usize, edits: usize) -> Scene {
    let (mut random, side) = (Random::new(2), side(count));
    let step = move |_, world: &mut World| {
        for _ in 0..edits {
            match random.below(4) {
                0 => world.add(anywhere(&mut random, side), bright(&mut random)),
                1 => world.remove(world.some(&mut random)),
                _ => world.place(world.some(&mut random), anywhere(&mut random, side)),
            }
        }
    };
    Scene::new(name, scattered(count), step)
}

/// 500 drive through 20,000.
fn convoy() -> Scene {
    let (mut lamps, mut random) = (scattered(20_000), Random::new(4));
    let still = lamps.len();
    let side = side(still);
    let within: Vec<[f32; 2]> = (0..500)
        .map(|_| [random.between(0.0, 60.0), random.between(0.0, 10.0)])
        .collect();
    let at = move |[x, z]: [f32; 2], frame: usize| [x + 0.4 * frame as f32, 1.0, side / 2.0 + z];
    lamps.extend(within.iter().map(|&own| (at(own, 0), 2.0)));
    let step = move |frame, world: &mut World| {
        for (lamp, &own) in (still..).zip(&within) {
            world.place(lamp, at(own, frame + 1));
        }
    };
    Scene::new("convoy of 500 in 20,000", lamps, step).near()
}

/// All walk, each its own way.
fn walk(count: usize, step: f32) -> Scene {
    let (mut random, side) = (Random::new(6), side(count));
    let lamps = scattered(count);
    let ways: Vec<(Point, f32)> = lamps
        .iter()
        .map(|&(at, _)| (at, random.between(0.0, TAU)))
        .collect();
    Scene::new("all walk", lamps, move |frame, world| {
        let far = step * (frame + 1) as f32;
        for (lamp, &([x, y, z], angle)) in ways.iter().enumerate() {
            let by = |x: f32, way: f32| (x + far * way).rem_euclid(side);
            world.place(lamp, [by(x, angle.cos()), y, by(z, angle.sin())]);
        }
    })
}

/// All turn about the middle at one of ten speeds.
fn rings(count: usize) -> Scene {
    let (mut random, side) = (Random::new(7), side(count));
    let rings: Vec<[f32; 4]> = (0..count)
        .map(|_| {
            let speed = 0.05 * (0.3 + 0.2 * random.below(5) as f32) / 60.0;
            let way = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let radius = random.unit().sqrt() * side / 2.0;
            [
                radius,
                random.between(0.0, TAU),
                random.between(3.0, 6.0),
                way * speed,
            ]
        })
        .collect();
    let at = move |[radius, angle, y, speed]: [f32; 4], frame: usize| {
        let (s, c) = (angle + speed * frame as f32).sin_cos();
        [side / 2.0 + radius * c, y, side / 2.0 + radius * s]
    };
    let lamps = rings.iter().map(|&own| (at(own, 0), 1.0)).collect();
    Scene {
        frames: 60,
        look: 20,
        ..Scene::new("all on rings", lamps, move |frame, world| {
            for (lamp, &own) in rings.iter().enumerate() {
                world.place(lamp, at(own, frame + 1));
            }
        })
    }
}

/// Half of all jump in each frame.
fn scatter(count: usize) -> Scene {
    let (mut random, side) = (Random::new(9), side(count));
    Scene {
        frames: 60,
        warm: 0,
        look: 10,
        ..Scene::new("half jump in each frame", scattered(count), move |_, world| {
            for lamp in (0..count).step_by(2) {
                world.place(lamp, anywhere(&mut random, side));
            }
        })
    }
}

/// Clusters of 1000 change places in 100 frames.
fn clusters(count: usize) -> Scene {
    const OWN: usize = 1000;
    let mut random = Random::new(10);
    let within: Vec<Point> = (0..count * OWN).map(|_| anywhere(&mut random, 10.0)).collect();
    let mut targets: Vec<usize> = (0..count).collect();
    for k in (1..count).rev() {
        targets.swap(k, random.below(k as u32 + 1) as usize);
    }
    let across = (count as f32).sqrt() as usize;
    let corner = move |cluster: usize| [cluster % across, cluster / across].map(|x| 40.0 * x as f32);
    let at = move |lamp: usize, [x, y, z]: Point, share: f32| {
        let (from, to) = (corner(lamp / OWN), corner(targets[lamp / OWN]));
        let by = |axis: usize| from[axis] + (to[axis] - from[axis]) * share;
        [x + by(0), y, z + by(1)]
    };
    let lamps = within
        .iter()
        .enumerate()
        .map(|(lamp, &own)| (at(lamp, own, 0.0), 1.0))
        .collect();
    let step = move |frame: usize, world: &mut World| {
        for (lamp, &own) in within.iter().enumerate() {
            world.place(lamp, at(lamp, own, (frame + 1) as f32 / 100.0));
        }
    };
    Scene {
        frames: 100,
        warm: 0,
        look: 20,
        points: 20,
        ..Scene::new("clusters of 1000 change places", lamps, step)
    }
    .near()
}
