//! Lights without area (`KHR_lights_punctual`): read and checked.

use lightbvh::light::MAX_COORDINATE;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::SceneError;
use super::super::model::SceneData;
use super::Document;

const NAME: &str = "KHR_lights_punctual";

/// What a node's extension names.
#[derive(Deserialize)]
struct Named {
    light: usize,
}

#[derive(Deserialize)]
struct Light {
    #[serde(default)]
    name: String,
    #[serde(default = "white")]
    color: [f32; 3],
    #[serde(default = "one")]
    intensity: f32,
    range: Option<f32>,
    #[serde(rename = "type")]
    kind: Kind,
    #[serde(default)]
    spot: Cone,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Directional,
    Point,
    Spot,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Cone {
    inner_cone_angle: f32,
    outer_cone_angle: f32,
}

impl Default for Cone {
    fn default() -> Self {
        Self {
            inner_cone_angle: 0.0,
            outer_cone_angle: std::f32::consts::FRAC_PI_4,
        }
    }
}

pub(super) fn white() -> [f32; 3] {
    [1.0; 3]
}

pub(super) fn one() -> f32 {
    1.0
}

/// The lights of the nodes in the scene; `place` is where each of the file's nodes went.
pub(super) fn read(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    let none = Map::new();
    let others = |extensions: Option<&_>| -> Option<Value> {
        let extensions: &gltf::json::extensions::root::Root = extensions?;
        extensions.others.get(NAME)?.get("lights").cloned()
    };
    let lights = others(document.root.extensions.as_ref());
    let lights = lights.as_ref().and_then(Value::as_array);
    for (index, node) in document.root.nodes.iter().enumerate() {
        let extensions = node.extensions.as_ref().map(|extensions| &extensions.others);
        let element = format!("nodes[{index}]");
        let named: Option<Named> = document.extension(extensions.unwrap_or(&none), NAME, &element)?;
        let (Some(named), Some(node)) = (named, place[index]) else {
            continue;
        };
        let found = lights.and_then(|lights| lights.get(named.light));
        match found.map_or(Err(String::from("it is not there")), |value| light(value, node)) {
            Ok((light, note)) => {
                data.analytic.push(light);
                // The element comes first, so that what several nodes say is said once.
                if let Some(note) = note {
                    document.warn(format!("{element}: light {}: {note}", named.light));
                }
            }
            Err(problem) => {
                document.warn(format!("{element}: light {} is left out: {problem}", named.light));
            }
        }
    }
    Ok(())
}

/// Radians by which cones may be wider than they can be, as rounding has them.
const ROUNDED: f32 = 1e-3;

/// One light, with a note where it is taken as another; or what is wrong with it.
fn light(value: &Value, node: u32) -> Result<(AnalyticLight, Option<String>), String> {
    let light = Light::deserialize(value).map_err(|error| error.to_string())?;
    let Light {
        name,
        color,
        intensity,
        range,
        ..
    } = light;
    if !color
        .iter()
        .chain([&intensity])
        .all(|x| *x >= 0.0 && x.is_finite())
    {
        return Err(String::from("its colour or intensity is negative or not finite"));
    }
    if range.is_some_and(|range| range.is_nan() || range <= 0.0) {
        return Err(String::from("its range is not above 0 metres"));
    }
    // The domain of lights, which begins below any room and ends beyond any scene.
    let range = range
        .filter(|range| *range <= MAX_COORDINATE)
        .map(|range| range.max(2.0_f32.powi(-20)));
    let mut note = None;
    let kind = match light.kind {
        Kind::Directional => AnalyticKind::Directional,
        Kind::Point => AnalyticKind::Point,
        Kind::Spot => {
            let Cone {
                inner_cone_angle: inner,
                outer_cone_angle: outer,
            } = light.spot;
            // NaN is in no range.
            if !(inner >= 0.0 && outer > 0.0 && outer.is_finite()) {
                return Err(format!("its cone, from {inner} to {outer} radians, is none"));
            }
            // Exporters write inner cones as wide as outer ones, and cones beyond what is allowed.
            let most = std::f32::consts::FRAC_PI_2;
            if outer > most + ROUNDED || inner > outer + ROUNDED {
                note = Some(format!(
                    "its cones, from {inner} to {outer} radians, are cut to {} and {}: the outer one to a right angle, the inner one to the outer",
                    inner.min(outer).min(most),
                    outer.min(most)
                ));
            }
            let outer = outer.min(most);
            AnalyticKind::Spot {
                inner: inner.min(outer),
                outer,
            }
        }
    };
    let light = AnalyticLight {
        name,
        node,
        kind,
        color,
        intensity,
        range,
    };
    Ok((light, note))
}
