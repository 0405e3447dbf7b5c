//! Helpers of the built-in scenes: names, materials, nodes and looping motions.

use std::collections::BTreeMap;

use super::analytic::AnalyticLight;
use super::camera::towards;
use super::error::SceneError;
use super::model::{Animation, Channel, Interpolation, Material, Mesh, Node, Primitive, Property, SceneData};
use super::scene::Scene;
use super::shapes::{Shape, on_circle, rotation};
use super::track::Track;
use super::transform::Transform;

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

    /// A surface that is metal in part.
    pub fn metal(&mut self, name: &str, base_color: [f32; 3], metallic: f32, roughness: f32) -> u32 {
        let index = self.matte(name, base_color, roughness);
        self.data.materials[index as usize].metallic = metallic;
        index
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

    fn material(&mut self, material: Material) -> u32 {
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
                ..Primitive::default()
            })
            .collect();
        self.data.meshes.push(Mesh {
            name: name.to_owned(),
            primitives,
        });
        self.data.meshes.len() as u32 - 1
    }

    /// A mesh of one shape.
    pub fn solid(&mut self, name: &str, material: u32, draw: impl FnOnce(&mut Shape) -> &mut Shape) -> u32 {
        self.mesh(name, &[(&Shape::of(draw), material)])
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

    /// A light by formula.
    pub fn analytic(&mut self, light: AnalyticLight) {
        self.data.analytic.push(light);
    }

    /// Swings about `axis` like a pendulum, `amplitude` in radians, `phase` in turns.
    pub fn swing(&mut self, node: u32, axis: [f64; 3], amplitude: f64, period: u32, phase: f64) {
        let value = |t: f64| rotation(axis, amplitude * on_circle(t + phase)[1]).to_vec();
        self.keys(node, Property::Rotation, period, 16, value);
    }

    /// Turns about `axis` by whole `turns` in a period, starting at `phase` turns.
    pub fn spin(&mut self, node: u32, axis: [f64; 3], turns: i32, period: u32, phase: f64) {
        let value = |t: f64| rotation(axis, std::f64::consts::TAU * (f64::from(turns) * t + phase)).to_vec();
        self.keys(node, Property::Rotation, period, 6 * turns.unsigned_abs(), value);
    }

    /// Moves up and down around `at`, `height` in metres, `phase` in turns.
    pub fn bob(&mut self, node: u32, at: [f64; 3], height: f64, period: u32, phase: f64) {
        let value = |t: f64| {
            let y = at[1] + height * on_circle(t + phase)[1];
            vec![at[0] as f32, y as f32, at[2] as f32]
        };
        self.keys(node, Property::Translation, period, 12, value);
    }

    /// Evenly spaced keys over a period of `period` frames; the last one closes the loop.
    fn keys(
        &mut self,
        node: u32,
        property: Property,
        period: u32,
        steps: u32,
        value: impl Fn(f64) -> Vec<f32>,
    ) {
        let at = |i: u32| f64::from(i) / f64::from(steps);
        let times = (0..=steps)
            .map(|i| (at(i) * f64::from(period) / 25.0) as f32)
            .collect();
        let values = (0..=steps).flat_map(|i| value(at(i % steps))).collect();
        self.channels.entry(period).or_default().push(Channel {
            node,
            property,
            interpolation: Interpolation::Linear,
            times,
            values,
        });
    }

    /// Flies through `points` and back to the first on a smooth closed curve (Catmull-Rom tangents).
    pub fn fly(&mut self, node: u32, points: &[[f64; 3]], period: u32) {
        let count = points.len();
        let step = f64::from(period) / 25.0 / count as f64;
        let mut values = Vec::new();
        for i in 0..=count {
            let [before, here, after] = [i + count - 1, i, i + 1].map(|i| points[i % count]);
            let tangent = [0, 1, 2].map(|axis| ((after[axis] - before[axis]) / (2.0 * step)) as f32);
            values.extend([tangent, here.map(|x| x as f32), tangent].as_flattened());
        }
        let times = (0..=count).map(|i| (i as f64 * step) as f32).collect();
        self.channels.entry(period).or_default().push(Channel {
            node,
            property: Property::Translation,
            interpolation: Interpolation::CubicSpline,
            times,
            values,
        });
    }

    /// Drives along a closed track, facing ahead with +Z, from `start` turns of the track on.
    pub fn drive(&mut self, node: u32, track: &Track, height: f64, period: u32, start: f64) {
        let (mut times, mut places, mut turns) = (Vec::new(), Vec::new(), Vec::new());
        for turn in track.stops(start) {
            let ([x, z], heading) = track.at(turn);
            times.push(((turn - start) * f64::from(period) / 25.0) as f32);
            places.extend([x, height, z].map(|x| x as f32));
            turns.extend(rotation([0.0, 1.0, 0.0], heading));
        }
        for (property, values) in [(Property::Translation, places), (Property::Rotation, turns)] {
            self.channels.entry(period).or_default().push(Channel {
                node,
                property,
                interpolation: Interpolation::Linear,
                times: times.clone(),
                values,
            });
        }
    }

    /// A camera at `eye` that looks at `target`.
    pub fn camera(&mut self, eye: [f64; 3], target: [f64; 3], yfov_degrees: f64) {
        self.data
            .look(&towards(eye, target, yfov_degrees.to_radians() as f32));
    }

    pub fn finish(mut self) -> Result<Scene, SceneError> {
        for (place, (period, channels)) in (0..).zip(self.channels) {
            self.data.animations.push(Animation {
                name: format!("{period} frames"),
                place,
                channels,
            });
        }
        Scene::new(self.data)
    }
}

/// No rotation.
pub(super) const STILL: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
