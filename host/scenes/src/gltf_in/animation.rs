//! Animations of nodes.

use std::collections::HashSet;
use std::mem::discriminant;

use gltf::json;
use gltf::json::validation::Checked::{Invalid, Valid};

use super::super::error::{SceneError, short};
use super::super::model::{Animation, Channel, Interpolation, Property};
use super::Document;

/// The animations that move something of the scene; `place` is where each of the file's nodes went. One that moves what one before
/// it does is left out with a note: the format does not say which is meant.
pub(super) fn read(document: &Document<'_>, place: &[Option<u32>]) -> Result<Vec<Animation>, SceneError> {
    let (mut animations, mut moved) = (Vec::new(), HashSet::new());
    for (a, animation) in document.root.animations.iter().enumerate() {
        let mut channels = Vec::new();
        for (c, channel) in animation.channels.iter().enumerate() {
            let element = format!("animations[{a}].channels[{c}]");
            channels.extend(one(document, animation, channel, place, &element)?);
        }
        let name = animation
            .name
            .as_deref()
            .map_or_else(|| format!("animation {a}"), short);
        let own = Animation {
            name,
            place: a as u32,
            channels,
        };
        let what = |own: &Channel| (own.node, discriminant(&own.property));
        if own.channels.iter().any(|own| moved.contains(&what(own))) {
            document.note(&own.shown(), "it moves what one before it does, and is left out");
        } else if !own.channels.is_empty() {
            moved.extend(own.channels.iter().map(what));
            animations.push(own);
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
        Valid(json::animation::Property::MorphTargetWeights) | Invalid => {
            let what = "skipped, as only translation, rotation and scale are animated";
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
