//! Animation: channel values at a time, and the world transform of every node.

use super::model::{Channel, Interpolation, Property, SceneData};
use super::transform::{Affine, Transform, normalized, slerp};

/// World transforms of all nodes at `seconds`, each animation looping over its own duration.
pub(super) fn world_transforms(data: &SceneData, seconds: f64) -> Vec<Affine> {
    let mut locals: Vec<Transform> = data.nodes.iter().map(|node| node.transform).collect();
    for animation in &data.animations {
        let duration = f64::from(animation.duration());
        let time = if duration > 0.0 { seconds % duration } else { 0.0 };
        for channel in &animation.channels {
            apply(channel, time, &mut locals[channel.node as usize]);
        }
    }

    // Parents come before their children, so one pass composes the whole hierarchy.
    let mut world: Vec<Affine> = Vec::with_capacity(locals.len());
    for (node, local) in data.nodes.iter().zip(&locals) {
        let parent = node
            .parent
            .map_or(Affine::IDENTITY, |parent| world[parent as usize]);
        world.push(parent.then_after(&local.affine()));
    }
    world
}

/// Replaces the animated part of `local`.
fn apply(channel: &Channel, time: f64, local: &mut Transform) {
    let value = sample(channel, time).map(|x| x as f32);
    if let Transform::Trs {
        translation,
        rotation,
        scale,
    } = local
    {
        let [x, y, z, _] = value;
        match channel.property {
            Property::Translation => *translation = [x, y, z],
            Property::Rotation => *rotation = value,
            Property::Scale => *scale = [x, y, z],
        }
    }
}

/// The channel's value at `time`, held before the first key and after the last (glTF 2.0, appendix C).
fn sample(channel: &Channel, time: f64) -> [f64; 4] {
    let times = &channel.times;
    let next = times.partition_point(|&key| f64::from(key) <= time);
    if next == 0 {
        return key_value(channel, 0);
    }
    if next == times.len() {
        return key_value(channel, next - 1);
    }
    let (from, to) = (next - 1, next);
    // Keys at or before `time` and after it differ, so the span is above zero.
    let span = f64::from(times[to]) - f64::from(times[from]);
    let t = (time - f64::from(times[from])) / span;
    match channel.interpolation {
        Interpolation::Step => key_value(channel, from),
        Interpolation::Linear if channel.property == Property::Rotation => {
            slerp(key_value(channel, from), key_value(channel, to), t)
        }
        Interpolation::Linear => {
            let (a, b) = (key_value(channel, from), key_value(channel, to));
            [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * t)
        }
        Interpolation::CubicSpline => hermite(channel, from, span, t),
    }
}

/// The value of key `key`, without its tangents.
fn key_value(channel: &Channel, key: usize) -> [f64; 4] {
    let index = match channel.interpolation {
        Interpolation::CubicSpline => 3 * key + 1,
        Interpolation::Step | Interpolation::Linear => key,
    };
    let value = channel.values[index].map(f64::from);
    if channel.property == Property::Rotation {
        normalized(value)
    } else {
        value
    }
}

/// Cubic Hermite spline between the keys `from` and `from + 1` (glTF 2.0, appendix C.5).
fn hermite(channel: &Channel, from: usize, span: f64, t: f64) -> [f64; 4] {
    let raw = |index: usize| channel.values[index].map(f64::from);
    let (v0, out0) = (raw(3 * from + 1), raw(3 * from + 2));
    let (in1, v1) = (raw(3 * from + 3), raw(3 * from + 4));
    let (t2, t3) = (t * t, t * t * t);
    let weights = [
        2.0 * t3 - 3.0 * t2 + 1.0,
        span * (t3 - 2.0 * t2 + t),
        3.0 * t2 - 2.0 * t3,
        span * (t3 - t2),
    ];
    let value = [0, 1, 2, 3]
        .map(|i| (weights[0] * v0[i] + weights[1] * out0[i]) + (weights[2] * v1[i] + weights[3] * in1[i]));
    if channel.property == Property::Rotation {
        normalized(value)
    } else {
        value
    }
}
