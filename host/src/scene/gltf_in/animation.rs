//! Animations of nodes.

use gltf::json;
use gltf::json::validation::Checked;

use super::super::error::SceneError;
use super::super::model::{Animation, Channel, Interpolation, Property};
use super::Document;

/// All animations; `place` is where each of the file's nodes went.
pub(super) fn read(document: &Document<'_>, place: &[Option<u32>]) -> Result<Vec<Animation>, SceneError> {
    let mut animations = Vec::new();
    for (a, animation) in document.root.animations.iter().enumerate() {
        let mut channels = Vec::new();
        for (c, channel) in animation.channels.iter().enumerate() {
            let element = format!("animations[{a}].channels[{c}]");
            channels.extend(one(document, animation, channel, place, &element)?);
        }
        if !channels.is_empty() {
            let name = animation.name.clone().unwrap_or_else(|| format!("animation {a}"));
            animations.push(Animation { name, channels });
        }
    }
    Ok(animations)
}

/// One channel, or `None` where it moves nothing that is used.
fn one(
    document: &Document<'_>,
    animation: &json::Animation,
    channel: &json::animation::Channel,
    place: &[Option<u32>],
    element: &str,
) -> Result<Option<Channel>, SceneError> {
    document.get(&document.root.nodes, channel.target.node, "node", element)?;
    let Some(node) = place[channel.target.node.value()] else {
        return Ok(None);
    };
    let property = match channel.target.path {
        Checked::Valid(json::animation::Property::Translation) => Property::Translation,
        Checked::Valid(json::animation::Property::Rotation) => Property::Rotation,
        Checked::Valid(json::animation::Property::Scale) => Property::Scale,
        Checked::Valid(json::animation::Property::MorphTargetWeights) | Checked::Invalid => {
            document.warn(format!(
                "{element}: skipped, as only translation, rotation and scale are animated"
            ));
            return Ok(None);
        }
    };
    let sampler = document.get(&animation.samplers, channel.sampler, "sampler", element)?;
    let interpolation = match sampler.interpolation {
        Checked::Valid(json::animation::Interpolation::Linear) => Interpolation::Linear,
        Checked::Valid(json::animation::Interpolation::Step) => Interpolation::Step,
        Checked::Valid(json::animation::Interpolation::CubicSpline) => Interpolation::CubicSpline,
        Checked::Invalid => {
            let advice = "use LINEAR, STEP or CUBICSPLINE";
            return Err(document.malformed(element, "has an unknown interpolation", advice));
        }
    };
    let times = document
        .floats::<1>(sampler.input, element)?
        .into_iter()
        .map(|[time]| time)
        .collect();
    let values = match property {
        Property::Rotation => document.floats::<4>(sampler.output, element)?,
        Property::Translation | Property::Scale => {
            let values = document.floats::<3>(sampler.output, element)?;
            values.into_iter().map(|[x, y, z]| [x, y, z, 0.0]).collect()
        }
    };
    Ok(Some(Channel {
        node,
        property,
        interpolation,
        times,
        values,
    }))
}
