//! Lights without area: `KHR_lights_punctual`, read and checked.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf::json::validation::Checked::{Invalid, Valid};
use lightbvh::light::MAX_COORDINATE;

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::short;
use super::super::model::SceneData;
use super::Document;

fn is_light(color: [f32; 3], factor: f32) -> bool {
    let mut numbers = color.into_iter().chain([factor]);
    numbers.all(|x| x >= 0.0 && x.is_finite())
}

/// The lights of `KHR_lights_punctual`; `place` is where each of the file's nodes went.
pub(super) fn punctual(document: &Document<'_>, place: &[Option<u32>], data: &mut SceneData) {
    let root = document.root.extensions.as_ref();
    let lights = root.and_then(|root| root.khr_lights_punctual.as_ref());
    for (index, (own, place)) in document.root.nodes.iter().zip(place).enumerate() {
        let extensions = own.extensions.as_ref();
        let named = extensions.and_then(|own| own.khr_lights_punctual.as_ref());
        let (Some(named), Some(node)) = (named, place) else {
            continue;
        };
        let number = named.light.value();
        let own = lights.and_then(|list| list.lights.get(number));
        match own
            .ok_or_else(|| String::from("it is not there"))
            .and_then(|own| light(own, *node))
        {
            Ok(light) => data.analytic.push(light),
            Err(problem) => {
                document.note(
                    &format!("nodes[{index}]"),
                    format!("light {number} is left out: {problem}"),
                );
            }
        }
    }
}

/// One light, or what is wrong with it.
fn light(light: &Light, node: u32) -> Result<AnalyticLight, String> {
    if !is_light(light.color, light.intensity) {
        return Err(String::from("its colour or intensity is negative or not finite"));
    }
    if light.range.is_some_and(|range| range.is_nan() || range <= 0.0) {
        return Err(String::from("its range is not above 0 metres"));
    }
    let kind = match light.type_ {
        Valid(Type::Directional) => {
            return Err(String::from("it is directional, and no light BVH holds such"));
        }
        Valid(Type::Point) => AnalyticKind::Point,
        Valid(Type::Spot) => {
            let cone = light.spot.as_ref();
            let inner = cone.map_or(0.0, |cone| cone.inner_cone_angle);
            let outer = cone.map_or(FRAC_PI_4, |cone| cone.outer_cone_angle);
            // NaN is in no range.
            if !(inner >= 0.0 && outer > 0.0 && outer.is_finite()) {
                return Err(format!("its cone, from {inner} to {outer} radians, is none"));
            }
            // Exporters write inner cones as wide as outer ones, and cones beyond a right angle.
            let outer = outer.min(FRAC_PI_2);
            AnalyticKind::Spot {
                inner: inner.min(outer),
                outer,
            }
        }
        Invalid => return Err(String::from("its type is none of directional, point and spot")),
    };
    // The domain of lights, which begins below any room and ends beyond any scene.
    let range = light.range.filter(|range| *range <= MAX_COORDINATE);
    Ok(AnalyticLight {
        name: short(light.name.as_deref().unwrap_or_default()),
        node,
        kind,
        color: light.color,
        intensity: light.intensity,
        range: range.map(|range| range.max(2.0_f32.powi(-20))),
    })
}
