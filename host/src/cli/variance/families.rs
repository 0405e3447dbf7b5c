//! Families of scenes: where importances differ most, each by a seed.

use std::f32::consts::TAU;

use glam::Vec3;
use lightbvh::{EmissiveTriangle, Lights, ShadingPoint};

use crate::stability::random::Random;

/// A family: its name, and what adds its lights and returns a point of it.
pub(super) type Family = (&'static str, fn(&mut Stage) -> Place);

/// Draws a point.
type Place = Box<dyn Fn(&mut Random) -> (Vec3, Vec3)>;

/// All families.
pub(super) const FAMILIES: [Family; 12] = [
    ("grid", grid),
    ("road", road),
    ("tower", tower),
    ("ceiling", ceiling),
    ("hall", hall),
    ("tubes", tubes),
    ("town", town),
    ("cars", cars),
    ("spheres", spheres),
    ("fireflies", fireflies),
    ("clusters", clusters),
    ("scattered", scattered),
];

/// Lights and points of a scene, y upward, metres.
pub(super) struct Scene {
    pub lights: Lights,
    pub points: Vec<ShadingPoint>,
}

impl Scene {
    /// The scene of a family, with this many points.
    pub fn new((name, add): Family, seed: u32, points: u32) -> Self {
        let of_name = name.bytes().fold(seed, |sum, byte| {
            sum.wrapping_mul(31).wrapping_add(u32::from(byte))
        });
        let mut stage = Stage {
            random: Random::new(of_name),
            lights: Vec::new(),
            mesh: 0,
        };
        let place = add(&mut stage);
        let points = (0..points).map(|_| place(&mut stage.random));
        let point = |(p, n): (Vec3, Vec3)| ShadingPoint {
            p: p.into(),
            n: n.into(),
        };
        Self {
            points: points.map(point).collect(),
            lights: Lights::new(stage.lights).expect("the lights are made within the domain"),
        }
    }
}

/// What a family adds lights to.
pub(super) struct Stage {
    random: Random,
    lights: Vec<EmissiveTriangle>,
    /// The mesh that lights are added to.
    mesh: u32,
}

impl Stage {
    fn between(&mut self, low: f32, high: f32) -> f32 {
        self.random.between(low, high)
    }

    fn within(&mut self, low: Vec3, high: Vec3) -> Vec3 {
        within(&mut self.random, low, high)
    }

    fn direction(&mut self) -> Vec3 {
        self.random.direction().into()
    }

    /// A rectangle with two sides from its middle on.
    fn quad(&mut self, middle: Vec3, a: Vec3, b: Vec3, radiance: f32) {
        let corners = [-a - b, a - b, a + b, b - a].map(|corner| middle + 0.5 * corner);
        for [i, j, k] in [[0, 1, 2], [0, 2, 3]] {
            self.triangle([corners[i], corners[j], corners[k]], radiance);
        }
    }

    fn triangle(&mut self, corners: [Vec3; 3], radiance: f32) {
        self.lights.push(EmissiveTriangle {
            p: corners.map(Vec3::into),
            radiance: [radiance; 3],
            mesh: self.mesh,
            flags: 0,
        });
    }

    /// A rectangle of `width` by `height` with a normal, turned about it at random.
    fn facing(&mut self, middle: Vec3, normal: Vec3, [width, height]: [f32; 2], radiance: f32) {
        let turn = Vec3::from(self.random.direction());
        let a = normal.cross(turn).normalize();
        self.quad(middle, a * width, normal.cross(a) * height, radiance);
    }

    /// A rectangle that faces down, its sides along x and z.
    fn lamp(&mut self, middle: Vec3, width: f32, depth: f32, radiance: f32) {
        self.quad(middle, Vec3::X * width, Vec3::Z * depth, radiance);
    }

    fn octahedron(&mut self, middle: Vec3, radius: f32, radiance: f32) {
        for side in 0..8 {
            let sign = |bit: u32| if side >> bit & 1 == 0 { radius } else { -radius };
            let [x, y, z] = [Vec3::X * sign(0), Vec3::Y * sign(1), Vec3::Z * sign(2)];
            let corners = if (side as u32).count_ones().is_multiple_of(2) {
                [x, y, z]
            } else {
                [x, z, y]
            };
            self.triangle(corners.map(|corner| middle + corner), radiance);
        }
    }
}

fn within(random: &mut Random, low: Vec3, high: Vec3) -> Vec3 {
    let at = Vec3::from_array([0; 3].map(|_| random.unit()));
    low + (high - low) * at
}

/// A horizontal direction.
fn level(random: &mut Random) -> Vec3 {
    let angle = random.between(0.0, TAU);
    Vec3::new(angle.cos(), 0.0, angle.sin())
}

/// Upward on two of three points, else the normal of a wall.
fn floor_or_wall(random: &mut Random) -> Vec3 {
    match random.below(3) {
        0 => level(random),
        _ => Vec3::Y,
    }
}

/// Points in a box with normals of a kind.
fn points_in(low: Vec3, high: Vec3, normal: fn(&mut Random) -> Vec3) -> Place {
    Box::new(move |random| (within(random, low, high), normal(random)))
}

fn any_direction(random: &mut Random) -> Vec3 {
    random.direction().into()
}

/// Street lamps on a grid.
fn grid(stage: &mut Stage) -> Place {
    let apart = stage.between(15.0, 25.0);
    for k in 0..4900 {
        stage.mesh = k;
        let at = Vec3::new((k / 70) as f32 * apart, 8.0, (k % 70) as f32 * apart);
        stage.lamp(at, 0.4, 0.4, 100.0);
    }
    let high = Vec3::new(69.0 * apart, 1.0, 69.0 * apart);
    points_in(Vec3::ZERO, high, floor_or_wall)
}

/// Street lamps along roads that cross.
fn road(stage: &mut Stage) -> Place {
    let apart = stage.between(12.0, 18.0);
    for k in 0..2500u32 {
        let (across, along) = ((k / 100) as f32 * 60.0, (k % 100) as f32 * apart);
        stage.mesh = 2 * k;
        stage.lamp(Vec3::new(along, 8.0, across), 0.6, 0.25, 100.0);
        stage.mesh = 2 * k + 1;
        stage.lamp(Vec3::new(across, 8.0, along), 0.25, 0.6, 100.0);
    }
    Box::new(move |random| {
        let across = random.below(25) as f32 * 60.0 + random.between(-6.0, 6.0);
        let at = Vec3::new(random.between(0.0, 99.0 * apart), 0.0, across);
        let normal = floor_or_wall(random);
        (
            if random.below(2) == 0 {
                at
            } else {
                Vec3::new(at.z, at.y, at.x)
            },
            normal,
        )
    })
}

/// A tower of 40 floors with panels in their ceilings.
fn tower(stage: &mut Stage) -> Place {
    let apart = stage.between(2.5, 3.5);
    for k in 0..2560 {
        stage.mesh = k;
        let (x, y, z) = (k / 8 % 8, k / 64, k % 8);
        let at = Vec3::new(x as f32 * apart, y as f32 * 3.5 + 3.2, z as f32 * apart);
        stage.lamp(at, 1.2, 0.6, 20.0);
    }
    Box::new(move |random| {
        let floor = random.below(40) as f32 * 3.5;
        let high = Vec3::new(7.0 * apart, 2.0, 7.0 * apart);
        let at = within(random, Vec3::ZERO, high) + Vec3::Y * floor;
        (at, floor_or_wall(random))
    })
}

/// One low and wide room.
fn ceiling(stage: &mut Stage) -> Place {
    let height = stage.between(2.8, 3.5);
    for k in 0..1600 {
        stage.mesh = k;
        let at = Vec3::new((k / 40) as f32 * 2.4, height, (k % 40) as f32 * 2.4);
        stage.lamp(at, 1.2, 0.3, 20.0);
    }
    points_in(Vec3::ZERO, Vec3::new(94.0, 2.0, 94.0), floor_or_wall)
}

/// Two rows of lamps under the roof of a hall, tilted inward.
fn hall(stage: &mut Stage) -> Place {
    let tilt = stage.between(0.1, 0.4);
    for k in 0..120 {
        stage.mesh = k;
        let (x, side) = if k % 2 == 0 { (0.5, tilt) } else { (19.5, -tilt) };
        let normal = Vec3::new(side, -1.0, 0.0).normalize();
        let at = Vec3::new(x, 9.0, (k / 2) as f32);
        stage.quad(at, normal.cross(Vec3::Z) * -0.3, Vec3::Z * 0.8, 60.0);
    }
    Box::new(|random| {
        let at = within(random, Vec3::ZERO, Vec3::new(20.0, 9.0, 60.0));
        match random.below(3) {
            0 => (at.with_y(0.0), Vec3::Y),
            1 => (at.with_x(0.0), Vec3::X),
            _ => (at.with_x(20.0), -Vec3::X),
        }
    })
}

/// Neon tubes of six sides.
fn tubes(stage: &mut Stage) -> Place {
    for k in 0..300 {
        stage.mesh = k;
        let middle = stage.within(Vec3::new(0.0, 2.0, 0.0), Vec3::new(60.0, 6.0, 60.0));
        let (along, length) = (level(&mut stage.random), stage.between(0.6, 3.0));
        let across = along.cross(Vec3::Y);
        for side in 0..6 {
            let angle = TAU / 6.0 * side as f32;
            let out = across * angle.cos() + Vec3::Y * angle.sin();
            stage.quad(
                middle + out * 0.04,
                along * length,
                out.cross(along) * 0.045,
                30.0,
            );
        }
    }
    points_in(Vec3::ZERO, Vec3::new(60.0, 3.0, 60.0), floor_or_wall)
}

/// Shop signs in rows of one to six.
fn town(stage: &mut Stage) -> Place {
    for k in 0..250 {
        stage.mesh = k;
        let first = stage.within(Vec3::new(0.0, 2.0, 0.0), Vec3::new(200.0, 12.0, 200.0));
        let wall = level(&mut stage.random);
        let normal = (wall + Vec3::Y * stage.between(-0.6, 0.1)).normalize();
        let along = Vec3::new(wall.z, 0.0, -wall.x);
        for sign in 0..stage.random.below(6) + 1 {
            let radiance = stage.between(2.0, 60.0);
            let middle = first + along * (1.1 * sign as f32);
            stage.quad(middle, along, along.cross(normal) * -0.5, radiance);
        }
    }
    points_in(Vec3::ZERO, Vec3::new(200.0, 8.0, 200.0), floor_or_wall)
}

/// Parked cars: bright headlights in front, faint tail lights behind.
fn cars(stage: &mut Stage) -> Place {
    for k in 0..600 {
        stage.mesh = k;
        let at = Vec3::new((k / 20) as f32 * 6.0, 0.7, (k % 20) as f32 * 3.0);
        for side in [-0.7, 0.7] {
            let lamp = at + Vec3::Z * side;
            stage.quad(lamp, Vec3::Y * 0.15, Vec3::Z * 0.2, 300.0);
            stage.quad(lamp - Vec3::X * 4.2, Vec3::Z * 0.25, Vec3::Y * 0.1, 8.0);
        }
    }
    points_in(
        Vec3::new(-10.0, 0.0, -5.0),
        Vec3::new(190.0, 2.0, 65.0),
        floor_or_wall,
    )
}

/// Bright bodies that send light to all sides.
fn spheres(stage: &mut Stage) -> Place {
    for k in 0..190 {
        stage.mesh = k;
        let middle = stage.within(Vec3::ZERO, Vec3::new(50.0, 20.0, 50.0));
        let (radius, radiance) = (stage.between(0.1, 0.6), stage.between(1.0, 40.0));
        stage.octahedron(middle, radius, radiance);
    }
    points_in(Vec3::ZERO, Vec3::new(50.0, 20.0, 50.0), any_direction)
}

/// Fireflies in swarms, and three bonfires a thousand times as bright as a swarm.
fn fireflies(stage: &mut Stage) -> Place {
    for k in 0..500 {
        stage.mesh = k;
        let swarm = stage.within(Vec3::new(0.0, 1.0, 0.0), Vec3::new(100.0, 8.0, 100.0));
        for _ in 0..20 {
            let (away, normal) = (stage.direction(), stage.direction());
            let reach = stage.between(0.0, 6.0);
            stage.facing(swarm + away * reach, normal, [0.02; 2], 5.0);
        }
    }
    for k in 0..3 {
        stage.mesh = 500 + k;
        stage.octahedron(Vec3::new(30.0 + 20.0 * k as f32, 1.0, 50.0), 0.5, 200.0);
    }
    points_in(Vec3::ZERO, Vec3::new(100.0, 2.0, 100.0), floor_or_wall)
}

/// Clusters whose brightness is any of four powers of ten.
fn clusters(stage: &mut Stage) -> Place {
    for k in 0..30 {
        stage.mesh = k;
        let middle = stage.within(Vec3::ZERO, Vec3::new(100.0, 30.0, 100.0));
        let (size, radiance) = (stage.between(0.5, 4.0), 10.0f32.powf(stage.between(-2.0, 2.0)));
        for _ in 0..300 {
            let at = stage.within(middle - size, middle + size);
            let (normal, part) = (stage.direction(), stage.between(0.1, 1.0));
            stage.facing(at, normal, [0.1; 2], radiance * part);
        }
    }
    let low = Vec3::new(-10.0, -5.0, -10.0);
    points_in(low, Vec3::new(110.0, 35.0, 110.0), any_direction)
}

/// Meshes whose lights lie anywhere.
fn scattered(stage: &mut Stage) -> Place {
    for k in 0..10_000 {
        stage.mesh = k / 50;
        let (at, normal) = (stage.within(Vec3::ZERO, Vec3::splat(100.0)), stage.direction());
        let radiance = stage.between(0.1, 1.1);
        stage.facing(at, normal, [0.1; 2], radiance);
    }
    points_in(Vec3::ZERO, Vec3::splat(100.0), any_direction)
}
