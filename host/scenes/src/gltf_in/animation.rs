//! Animations of nodes.

use gltf::json;
use gltf::json::validation::Checked::{Invalid, Valid};

use super::super::error::SceneError;
use super::super::model::{Animation, Channel, Interpolation, Property};
use super::{DAMAGED, Document};

/// Animations, and the places and names of those that move nothing of the scene.
type All = (Vec<Animation>, Vec<(u32, String)>);

/// All animations; `place` is where each of the file's nodes went.
pub(super) fn read(document: &Document<'_>, place: &[Option<u32>]) -> Result<All, SceneError> {
    let (mut animations, mut idle) = (Vec::new(), Vec::new());
    for (a, animation) in document.root.animations.iter().enumerate() {
        let mut channels = Vec::new();
        for (c, channel) in animation.channels.iter().enumerate() {
            let element = format!("animations[{a}].channels[{c}]");
            channels.extend(one(document, animation, channel, place, &element)?);
        }
        let name = animation.name.clone().unwrap_or_else(|| format!("animation {a}"));
        let place = a as u32;
        match channels.is_empty() {
            true => idle.push((place, name)),
            false => animations.push(Animation {
                name,
                place,
                channels,
            }),
        }
    }
    Ok((animations, idle))
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
    let sampler = document.get(&animation.samplers, channel.sampler, "sampler", element)?;
    let interpolation = match sampler.interpolation {
        Valid(json::animation::Interpolation::Linear) => Interpolation::Linear,
        Valid(json::animation::Interpolation::Step) => Interpolation::Step,
        Valid(json::animation::Interpolation::CubicSpline) => Interpolation::CubicSpline,
        Invalid => {
            let advice = "use LINEAR, STEP or CUBICSPLINE";
            return Err(document.malformed(element, "has an unknown interpolation", advice));
        }
    };
    let times = document
        .floats::<1>(sampler.input, element, None)?
        .into_flattened();
    let three = || {
        document
            .floats::<3>(sampler.output, element, None)
            .map(Vec::into_flattened)
    };
    let (property, values) = match channel.target.path {
        Valid(json::animation::Property::Translation) => (Property::Translation, three()?),
        Valid(json::animation::Property::Scale) => (Property::Scale, three()?),
        Valid(json::animation::Property::Rotation) => {
            let values = document.floats::<4>(sampler.output, element, None)?;
            (Property::Rotation, values.into_flattened())
        }
        Valid(json::animation::Property::MorphTargetWeights) => {
            let values = document
                .floats::<1>(sampler.output, element, None)?
                .into_flattened();
            let rows = match interpolation {
                Interpolation::CubicSpline => 3 * times.len(),
                _ => times.len(),
            };
            let targets = values.len().checked_div(rows).unwrap_or(0);
            if targets == 0 || targets * rows != values.len() {
                let problem = format!("has {} weights for {rows} rows of them", values.len());
                return Err(document.malformed(element, problem, DAMAGED));
            }
            (Property::Weights(targets as u32), values)
        }
        Invalid => {
            let what = "skipped, as only translation, rotation, scale and weights are animated";
            document.note(element, what);
            return Ok(None);
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
