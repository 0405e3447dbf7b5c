//! Helpers of the built-in scenes: names, materials, nodes and looping motions.

use std::collections::BTreeMap;

use super::error::SceneError;
use super::model::{
    Animation, Camera, Channel, Interpolation, Material, Mesh, Node, Primitive, Property, Scene, SceneData,
};
use super::shapes::{Shape, on_circle, rotation};
use super::transform::{Transform, cross, sub, unit_or};

/// Deterministic numbers for placement.
pub(super) struct Dice(u32);

impl Dice {
    pub fn new(seed: u32) -> Self {
        Self(seed)
    }

    /// PCG-RXS-M-XS on 32 bits (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient ... Generators").
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        f64::from(self.next()) / 4_294_967_296.0
    }

    /// In [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// In 0..count.
    pub fn pick(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }
}

/// A scene under construction. Channels are collected into one animation per period.
pub(super) struct SceneBuilder {
    data: SceneData,
    channels: BTreeMap<u32, Vec<Channel>>,
}

impl SceneBuilder {
    pub fn new(name: &str, background: [f32; 3]) -> Self {
        let data = SceneData {
            name: name.to_owned(),
            background,
            ..SceneData::default()
        };
        Self {
            data,
            channels: BTreeMap::new(),
        }
    }

    /// A surface that reflects.
    pub fn matte(&mut self, name: &str, base_color: [f32; 3], roughness: f32) -> u32 {
        self.material(Material {
            name: name.to_owned(),
            base_color,
            roughness,
            ..Material::default()
        })
    }

    /// A surface that shines, W/(m² sr).
    pub fn glow(&mut self, name: &str, radiance: [f32; 3]) -> u32 {
        let base_color = [0.5; 3];
        self.material(Material {
            name: name.to_owned(),
            base_color,
            radiance,
            ..Material::default()
        })
    }

    pub fn material(&mut self, material: Material) -> u32 {
        self.data.materials.push(material);
        self.data.materials.len() as u32 - 1
    }

    /// A mesh of one primitive per shape; empty shapes are left out.
    pub fn mesh(&mut self, name: &str, shapes: &[(&Shape, u32)]) -> u32 {
        let filled = shapes.iter().filter(|(shape, _)| !shape.triangles.is_empty());
        let primitives = filled
            .map(|&(shape, material)| Primitive {
                positions: shape.positions.clone(),
                triangles: shape.triangles.clone(),
                material,
                radiance: None,
            })
            .collect();
        self.data.meshes.push(Mesh {
            name: name.to_owned(),
            primitives,
        });
        self.data.meshes.len() as u32 - 1
    }

    /// A node with a mesh, moved and turned.
    pub fn node(
        &mut self,
        name: &str,
        parent: Option<u32>,
        at: [f64; 3],
        turn: [f32; 4],
        mesh: Option<u32>,
    ) -> u32 {
        let translation = at.map(|x| x as f32);
        let transform = Transform::Trs {
            translation,
            rotation: turn,
            scale: [1.0; 3],
        };
        self.data.nodes.push(Node {
            name: name.to_owned(),
            parent,
            transform,
            mesh,
        });
        self.data.nodes.len() as u32 - 1
    }

    /// A node that is only moved.
    pub fn put(&mut self, name: &str, parent: Option<u32>, at: [f64; 3], mesh: u32) -> u32 {
        self.node(name, parent, at, STILL, Some(mesh))
    }

    /// Swings about `axis` like a pendulum, `amplitude` in radians, `phase` in turns.
    pub fn swing(&mut self, node: u32, axis: [f64; 3], amplitude: f64, period: u32, phase: f64) {
        let value = |t: f64| rotation(axis, amplitude * on_circle(t + phase)[1]);
        self.keys(node, Property::Rotation, Interpolation::Linear, period, 16, value);
    }

    /// Turns about `axis` by whole `turns` in a period, starting at `phase` turns.
    pub fn spin(&mut self, node: u32, axis: [f64; 3], turns: i32, period: u32, phase: f64) {
        let value = |t: f64| rotation(axis, std::f64::consts::TAU * (f64::from(turns) * t + phase));
        self.keys(
            node,
            Property::Rotation,
            Interpolation::Linear,
            period,
            6 * turns.unsigned_abs(),
            value,
        );
    }

    /// Moves up and down around `at`, `height` in metres, `phase` in turns.
    pub fn bob(&mut self, node: u32, at: [f64; 3], height: f64, period: u32, phase: f64) {
        let value = |t: f64| {
            let y = at[1] + height * on_circle(t + phase)[1];
            [at[0] as f32, y as f32, at[2] as f32, 0.0]
        };
        self.keys(
            node,
            Property::Translation,
            Interpolation::Linear,
            period,
            12,
            value,
        );
    }

    /// Evenly spaced keys over a period of `period` frames; the last one closes the loop.
    fn keys(
        &mut self,
        node: u32,
        property: Property,
        interpolation: Interpolation,
        period: u32,
        steps: u32,
        value: impl Fn(f64) -> [f32; 4],
    ) {
        let at = |i: u32| f64::from(i) / f64::from(steps);
        let times = (0..=steps)
            .map(|i| (at(i) * f64::from(period) / 25.0) as f32)
            .collect();
        let values = (0..=steps).map(|i| value(at(i % steps))).collect();
        self.channel(
            period,
            Channel {
                node,
                property,
                interpolation,
                times,
                values,
            },
        );
    }

    /// Flies through `points` and back to the first on a smooth closed curve (Catmull-Rom tangents).
    pub fn fly(&mut self, node: u32, points: &[[f64; 3]], period: u32) {
        let count = points.len();
        let step = f64::from(period) / 25.0 / count as f64;
        let mut values = Vec::new();
        for i in 0..=count {
            let [before, here, after] = [i + count - 1, i, i + 1].map(|i| points[i % count]);
            let tangent = [0, 1, 2].map(|axis| ((after[axis] - before[axis]) / (2.0 * step)) as f32);
            let tangent = [tangent[0], tangent[1], tangent[2], 0.0];
            values.extend([
                tangent,
                [here[0] as f32, here[1] as f32, here[2] as f32, 0.0],
                tangent,
            ]);
        }
        let times = (0..=count).map(|i| (i as f64 * step) as f32).collect();
        let (property, interpolation) = (Property::Translation, Interpolation::CubicSpline);
        self.channel(
            period,
            Channel {
                node,
                property,
                interpolation,
                times,
                values,
            },
        );
    }

    /// Drives along a closed track, facing ahead with +Z, from `start` turns of the track on.
    pub fn drive(&mut self, node: u32, track: &Track, height: f64, period: u32, start: f64) {
        let (mut times, mut places, mut turns) = (Vec::new(), Vec::new(), Vec::new());
        for turn in track.stops(start) {
            let ([x, z], heading) = track.at(turn);
            times.push(((turn - start) * f64::from(period) / 25.0) as f32);
            places.push([x as f32, height as f32, z as f32, 0.0]);
            turns.push(rotation([0.0, 1.0, 0.0], heading));
        }
        for (property, values) in [(Property::Translation, places), (Property::Rotation, turns)] {
            let (times, interpolation) = (times.clone(), Interpolation::Linear);
            self.channel(
                period,
                Channel {
                    node,
                    property,
                    interpolation,
                    times,
                    values,
                },
            );
        }
    }

    fn channel(&mut self, period: u32, channel: Channel) {
        self.channels.entry(period).or_default().push(channel);
    }

    /// A camera at `eye` that looks at `target`.
    pub fn camera(&mut self, eye: [f64; 3], target: [f64; 3], yfov_degrees: f64) {
        let forward = unit_or(sub(target, eye), [0.0, 0.0, -1.0]);
        let right = unit_or(cross(forward, [0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]);
        let up = cross(right, forward);
        let columns = [right, up, forward.map(|x| -x), eye];
        let transform = Transform::Matrix(columns.map(|column| column.map(|x| x as f32)));
        self.data.nodes.push(Node {
            name: String::from("camera"),
            parent: None,
            transform,
            mesh: None,
        });
        let node = self.data.nodes.len() as u32 - 1;
        self.data.cameras.push(Camera {
            node,
            yfov: yfov_degrees.to_radians() as f32,
        });
    }

    pub fn finish(mut self) -> Result<Scene, SceneError> {
        for (period, channels) in self.channels {
            self.data.animations.push(Animation {
                name: format!("{period} frames"),
                channels,
            });
        }
        Scene::new(self.data)
    }
}

/// No rotation.
pub(super) const STILL: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// A closed track around the origin: a rectangle with rounded corners, driven counter-clockwise seen from above.
pub(super) struct Track {
    /// Half extents along x and z, metres.
    pub half: [f64; 2],
    /// Of the corners, at most the smaller half extent.
    pub radius: f64,
}

impl Track {
    /// Straight along x, quarter arc, straight along z, quarter arc: half of the track.
    fn parts(&self) -> [f64; 4] {
        let arc = 0.25 * std::f64::consts::TAU * self.radius;
        [
            2.0 * (self.half[0] - self.radius),
            arc,
            2.0 * (self.half[1] - self.radius),
            arc,
        ]
    }

    /// Length of the track, metres.
    pub fn length(&self) -> f64 {
        2.0 * self.parts().iter().sum::<f64>()
    }

    /// Place (x, z) and heading (radians about +Y, from +Z) at `turn` turns.
    pub fn at(&self, turn: f64) -> ([f64; 2], f64) {
        let turn = turn - libm::floor(turn);
        let half_turn = 2.0 * turn;
        // The second half is the first, seen from the other side.
        let (side, along) = if half_turn < 1.0 {
            (1.0, half_turn)
        } else {
            (-1.0, half_turn - 1.0)
        };
        let mut s = along * 0.5 * self.length();
        let [straight, arc, other, _] = self.parts();
        let inner = [self.half[0] - self.radius, self.half[1] - self.radius];
        let quarter = 0.25 * std::f64::consts::TAU;
        let corner = |cx: f64, cz: f64, angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            (
                [cx + self.radius * sine, cz + self.radius * cosine],
                quarter + angle,
            )
        };
        let (place, heading) = if s < straight {
            ([s - inner[0], self.half[1]], quarter)
        } else if {
            s -= straight;
            s < arc
        } {
            corner(inner[0], inner[1], s / self.radius)
        } else if {
            s -= arc;
            s < other
        } {
            ([self.half[0], inner[1] - s], 2.0 * quarter)
        } else {
            s -= other;
            corner(inner[0], -inner[1], quarter + s / self.radius)
        };
        let turned = if side > 0.0 {
            heading
        } else {
            heading + 2.0 * quarter
        };
        (place.map(|x| x * side), turned)
    }

    /// Turns at which keys are needed, from `start` to `start + 1`, both included.
    fn stops(&self, start: f64) -> Vec<f64> {
        let mut marks = Vec::new();
        let mut s = 0.0;
        for (index, part) in self.parts().iter().cycle().take(8).enumerate() {
            let steps = if index % 2 == 0 { 1 } else { 8 };
            marks.extend((0..steps).map(|i| (s + part * f64::from(i) / f64::from(steps)) / self.length()));
            s += part;
        }
        let start_turn = start - libm::floor(start);
        let mut stops = vec![start];
        let mut between: Vec<f64> = marks
            .iter()
            .map(|mark| {
                let ahead = mark - start_turn;
                ahead - libm::floor(ahead)
            })
            .filter(|ahead| *ahead > 1e-6 && *ahead < 1.0 - 1e-6)
            .collect();
        between.sort_by(f64::total_cmp);
        between.dedup();
        stops.extend(between.iter().map(|ahead| start + ahead));
        stops.push(start + 1.0);
        stops
    }
}
