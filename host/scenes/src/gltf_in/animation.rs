//! Animations of nodes.

use gltf::json;
use gltf::json::validation::Checked;

use super::super::deform::MorphChannel;
use super::super::error::SceneError;
use super::super::model::{Animation, Channel, Interpolation, Property};
use super::Document;

/// Animations, and the places and names of those that move nothing of the scene.
type All = (Vec<Animation>, Vec<(u32, String)>);

/// All animations; `place` is where each of the file's nodes went.
pub(super) fn read(document: &Document<'_>, place: &[Option<u32>]) -> Result<All, SceneError> {
    let (mut animations, mut idle) = (Vec::new(), Vec::new());
    for (a, animation) in document.root.animations.iter().enumerate() {
        let (mut channels, mut morphs) = (Vec::new(), Vec::new());
        for (c, channel) in animation.channels.iter().enumerate() {
            let element = format!("animations[{a}].channels[{c}]");
            match one(document, animation, channel, place, &element)? {
                Some(One::Moving(channel)) => channels.push(channel),
                Some(One::Bending(channel)) => morphs.push(channel),
                None => {}
            }
        }
        let name = animation.name.clone().unwrap_or_else(|| format!("animation {a}"));
        if channels.is_empty() && morphs.is_empty() {
            idle.push((a as u32, name));
        } else {
            animations.push(Animation {
                name,
                place: a as u32,
                channels,
                morphs,
            });
        }
    }
    Ok((animations, idle))
}

/// What a channel changes.
enum One {
    Moving(Channel),
    Bending(MorphChannel),
}

/// One channel, or `None` where it moves nothing that is used.
fn one(
    document: &Document<'_>,
    animation: &json::Animation,
    channel: &json::animation::Channel,
    place: &[Option<u32>],
    element: &str,
) -> Result<Option<One>, SceneError> {
    document.get(&document.root.nodes, channel.target.node, "node", element)?;
    let Some(node) = place[channel.target.node.value()] else {
        return Ok(None);
    };
    let property = match channel.target.path {
        Checked::Valid(json::animation::Property::Translation) => Some(Property::Translation),
        Checked::Valid(json::animation::Property::Rotation) => Some(Property::Rotation),
        Checked::Valid(json::animation::Property::Scale) => Some(Property::Scale),
        Checked::Valid(json::animation::Property::MorphTargetWeights) => None,
        Checked::Invalid => {
            document.warn(format!(
                "{element}: skipped, as only translation, rotation, scale and weights are animated"
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
    let times: Vec<f32> = document
        .floats::<1>(sampler.input, element)?
        .into_iter()
        .map(|[time]| time)
        .collect();
    let Some(property) = property else {
        let values = document.floats::<1>(sampler.output, element)?;
        return morph(document, node, (interpolation, times, values), element);
    };
    let values = match property {
        Property::Rotation => document.floats::<4>(sampler.output, element)?,
        Property::Translation | Property::Scale => {
            let values = document.floats::<3>(sampler.output, element)?;
            values.into_iter().map(|[x, y, z]| [x, y, z, 0.0]).collect()
        }
    };
    Ok(Some(One::Moving(Channel {
        node,
        property,
        interpolation,
        times,
        values,
    })))
}

/// Keys of weights: as many for each key as the mesh has targets.
fn morph(
    document: &Document<'_>,
    node: u32,
    (interpolation, times, values): (Interpolation, Vec<f32>, Vec<[f32; 1]>),
    element: &str,
) -> Result<Option<One>, SceneError> {
    let rows = times.len()
        * if interpolation == Interpolation::CubicSpline {
            3
        } else {
            1
        };
    let targets = values.len().checked_div(rows).unwrap_or(0);
    if targets == 0 || targets * rows != values.len() {
        let problem = format!("has {} weights for {rows} rows of them", values.len());
        return Err(document.malformed(element, problem, "the file is damaged; export it again"));
    }
    Ok(Some(One::Bending(MorphChannel {
        node,
        targets: targets as u32,
        interpolation,
        times,
        values: values.into_flattened(),
    })))
}
