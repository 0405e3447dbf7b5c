//! Animation: channel values at a time, and the world transform of every node.

use glam::{DAffine3, DVec3, Vec3};

use super::analytic::AnalyticLight;
use super::model::{Channel, Interpolation, Primitive, Property, SceneData};
use super::transform::{Transform, normalized, slerp};

/// Where everything is at a time.
pub(super) struct Pose {
    /// From each node's space to the world.
    pub world: Vec<DAffine3>,
}

impl Pose {
    /// At `seconds`, each animation looping over its own duration.
    pub fn at(data: &SceneData, seconds: f64) -> Self {
        let mut locals: Vec<Transform> = data.nodes.iter().map(|node| node.transform).collect();
        for animation in &data.animations {
            let duration = f64::from(animation.duration());
            let time = if duration > 0.0 { seconds % duration } else { 0.0 };
            for channel in &animation.channels {
                apply(channel, time, &mut locals[channel.node as usize]);
            }
        }

        // Parents come before their children, so one pass composes the whole hierarchy.
        let mut world: Vec<DAffine3> = Vec::with_capacity(locals.len());
        for (node, local) in data.nodes.iter().zip(&locals) {
            let parent = node
                .parent
                .map_or(DAffine3::IDENTITY, |parent| world[parent as usize]);
            world.push(parent * local.affine());
        }
        Self { world }
    }

    /// The place of a node with a camera, a point light or a spot. Scales do not change
    /// such things (glTF 2.0, section 3.10; `KHR_lights_punctual`), but where they are so small or so large that directions are
    /// lost, these are the world's.
    pub fn unscaled(&self, node: u32) -> DAffine3 {
        let world = self.world[node as usize];
        // Their directions are exact in `f32`, and within the domain of a light BVH's transforms.
        let largest = (1_u64 << 40) as f64;
        let m = &world.matrix3;
        let mut lengths = [m.x_axis, m.y_axis, m.z_axis].into_iter().map(DVec3::length);
        match lengths.all(|length| (1.0 / largest..=largest).contains(&length)) {
            true => world,
            false => DAffine3::from_translation(world.translation),
        }
    }

    /// Where the vertices of a primitive on a node are.
    pub fn points(&self, node: usize, primitive: &Primitive) -> impl Iterator<Item = DVec3> {
        let world = self.world[node];
        let points = primitive.positions.iter();
        points.map(move |&p| world.transform_point3(Vec3::from(p).as_dvec3()))
    }

    /// The place of a light by formula.
    pub fn place_of(&self, light: &AnalyticLight) -> DAffine3 {
        if !light.kind.half().is_empty() {
            self.world[light.node as usize]
        } else {
            self.unscaled(light.node)
        }
    }
}

/// Replaces the animated part of `local`.
fn apply(channel: &Channel, time: f64, local: &mut Transform) {
    let three = || {
        let value = sample(channel, time);
        [0, 1, 2].map(|k| value[k] as f32)
    };
    if let Transform::Trs {
        translation,
        rotation,
        scale,
    } = local
    {
        match channel.property {
            Property::Translation => *translation = three(),
            Property::Scale => *scale = three(),
            Property::Rotation => *rotation = turn(channel, time).map(|x| x as f32),
        }
    }
}

/// The unit quaternion of a channel of rotations at `time`.
fn turn(channel: &Channel, time: f64) -> [f64; 4] {
    let key = |row: usize| normalized([0, 1, 2, 3].map(|k| f64::from(channel.values[4 * row + k])));
    match (step(&channel.times, time), channel.interpolation) {
        (Step::Between { from, t, .. }, Interpolation::Linear) => slerp(key(from), key(from + 1), t),
        _ => {
            let value = sample(channel, time);
            normalized([0, 1, 2, 3].map(|k| value[k]))
        }
    }
}

/// The channel's numbers at `time`, each interpolated by itself.
fn sample(channel: &Channel, time: f64) -> Vec<f64> {
    let count = channel.property.numbers();
    let place = step(&channel.times, time);
    let one = |k: usize| {
        let raw = |row: usize| f64::from(channel.values[row * count + k]);
        match (&place, channel.interpolation) {
            (Step::At(key), Interpolation::CubicSpline) => raw(3 * key + 1),
            (Step::At(key), _) | (Step::Between { from: key, .. }, Interpolation::Step) => raw(*key),
            (Step::Between { from, t, .. }, Interpolation::Linear) => {
                raw(*from) + (raw(from + 1) - raw(*from)) * t
            }
            (Step::Between { from, span, t }, Interpolation::CubicSpline) => {
                hermite([1, 2, 3, 4].map(|i| raw(3 * from + i)), *span, *t)
            }
        }
    };
    (0..count).map(one).collect()
}

/// Where a time lies among keys.
enum Step {
    /// At this key: before the first, after the last (glTF 2.0, appendix C).
    At(usize),
    /// Between `from` and the next, `t` of the `span` seconds on.
    Between { from: usize, span: f64, t: f64 },
}

fn step(times: &[f32], time: f64) -> Step {
    let next = times.partition_point(|&key| f64::from(key) <= time);
    if next == 0 {
        return Step::At(0);
    }
    if next == times.len() {
        return Step::At(next - 1);
    }
    let from = next - 1;
    // Keys at or before `time` and after it differ, so the span is above zero.
    let span = f64::from(times[next]) - f64::from(times[from]);
    let t = (time - f64::from(times[from])) / span;
    Step::Between { from, span, t }
}

/// Cubic Hermite spline from a value with its out-tangent to a value, whose in-tangent comes before it (glTF 2.0, appendix C.5).
fn hermite([v0, out0, in1, v1]: [f64; 4], span: f64, t: f64) -> f64 {
    let (t2, t3) = (t * t, t * t * t);
    let weights = [
        2.0 * t3 - 3.0 * t2 + 1.0,
        span * (t3 - 2.0 * t2 + t),
        3.0 * t2 - 2.0 * t3,
        span * (t3 - t2),
    ];
    (weights[0] * v0 + weights[1] * out0) + (weights[2] * v1 + weights[3] * in1)
}
