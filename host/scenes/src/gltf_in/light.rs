//! Lights without area: `KHR_lights_punctual`, and photometric ones (`EXT_lights_ies`), read and checked.

use std::collections::HashMap;

use gltf::json;
use lightbvh::light::MAX_COORDINATE;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::SceneError;
use super::super::model::SceneData;
use super::super::profile::Profile;
use super::{Document, container};

const PUNCTUAL: &str = "KHR_lights_punctual";
pub(in super::super) const IES: &str = "EXT_lights_ies";

/// What a node names of `KHR_lights_punctual`.
#[derive(Deserialize)]
struct Named {
    light: usize,
}

/// What a node names of `EXT_lights_ies`.
#[derive(Deserialize)]
struct Measured {
    light: usize,
    #[serde(default = "one")]
    multiplier: f32,
    #[serde(default = "white")]
    color: [f32; 3],
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

/// A photometric file.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct File {
    #[serde(default)]
    name: String,
    uri: Option<String>,
    buffer_view: Option<u32>,
}

fn white() -> [f32; 3] {
    [1.0; 3]
}

fn one() -> f32 {
    1.0
}

/// What the nodes in the scene name of an extension, each with its name in the file and its place in the scene; `place` is
/// where each of the file's nodes went.
fn named<T: DeserializeOwned>(
    document: &Document<'_>,
    place: &[Option<u32>],
    extension: &str,
) -> Result<Vec<(String, u32, T)>, SceneError> {
    let mut all = Vec::new();
    for (index, node) in document.root.nodes.iter().enumerate() {
        let Some(extensions) = &node.extensions else {
            continue;
        };
        let element = format!("nodes[{index}]");
        let found = document.extension(&extensions.others, extension, &element)?;
        all.extend(found.and_then(|found| Some((element, place[index]?, found))));
    }
    Ok(all)
}

/// The light of that number in the list of an extension.
fn listed<T: DeserializeOwned>(document: &Document<'_>, extension: &str, number: usize) -> Result<T, String> {
    let root = document.root.extensions.as_ref();
    let lights = root.and_then(|root| root.others.get(extension)?.get("lights"));
    let light = lights
        .and_then(Value::as_array)
        .and_then(|lights| lights.get(number));
    let light = light.ok_or_else(|| String::from("it is not there"))?;
    T::deserialize(light).map_err(|error| error.to_string())
}

fn is_light(color: [f32; 3], factor: f32) -> bool {
    let mut numbers = color.into_iter().chain([factor]);
    numbers.all(|x| x >= 0.0 && x.is_finite())
}

/// The lights of `KHR_lights_punctual`.
pub(super) fn punctual(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    for (element, node, Named { light: number }) in named(document, place, PUNCTUAL)? {
        match listed(document, PUNCTUAL, number).and_then(|own| light(own, node)) {
            Ok((light, note)) => {
                data.analytic.push(light);
                if let Some(note) = note {
                    document.note(&element, format!("light {number}: {note}"));
                }
            }
            Err(problem) => document.note(&element, format!("light {number} is left out: {problem}")),
        }
    }
    Ok(())
}

/// The photometric lights of `EXT_lights_ies`.
pub(super) fn measured(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    // By number in the file: each is read once, and noted once where it cannot be.
    let mut read: HashMap<usize, Option<u32>> = HashMap::new();
    for (element, node, own) in named::<Measured>(document, place, IES)? {
        if !is_light(own.color, own.multiplier) {
            let what =
                "its photometric light is left out: its colour or multiplier is negative or not finite";
            document.note(&element, what);
            continue;
        }
        let profile = *read.entry(own.light).or_insert_with(|| {
            let number = own.light;
            match profile(document, number) {
                Ok(profile) => data.profiles.push(profile),
                Err(problem) => {
                    let what = format!(
                        "photometric profile {number} ({IES}) is left out with its lights: {problem}"
                    );
                    document.note("", what);
                    return None;
                }
            }
            Some(data.profiles.len() as u32 - 1)
        });
        let Some(index) = profile else { continue };
        let profile = &data.profiles[index as usize];
        data.analytic.push(AnalyticLight {
            name: profile.name.clone(),
            node,
            kind: AnalyticKind::profile(index, profile),
            color: own.color.map(|channel| channel.min(1.0)),
            intensity: own.multiplier,
            range: None,
        });
    }
    Ok(())
}

fn profile(document: &Document<'_>, number: usize) -> Result<Profile, String> {
    let file: File = listed(document, IES, number)?;
    let element = format!("extensions.{IES}.lights[{number}]");
    let view = file.buffer_view.map(json::Index::new);
    let bytes = container::uri_or_view(document, file.uri.as_deref(), view, &element);
    Profile::read(file.name, bytes.map_err(|error| error.to_string())?)
}

/// Radians by which cones may be wider than they can be, as rounding has them.
const ROUNDED: f32 = 1e-3;

/// One light, with a note where it is taken as another; or what is wrong with it.
fn light(light: Light, node: u32) -> Result<(AnalyticLight, Option<String>), String> {
    if !is_light(light.color, light.intensity) {
        return Err(String::from("its colour or intensity is negative or not finite"));
    }
    if light.range.is_some_and(|range| range.is_nan() || range <= 0.0) {
        return Err(String::from("its range is not above 0 metres"));
    }
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
            let cut = (inner.min(outer).min(most), outer.min(most));
            if outer > most + ROUNDED || inner > outer + ROUNDED {
                note = Some(format!(
                    "its cones, from {inner} to {outer} radians, are cut to {} and {}: the outer one to a right angle, the inner one to the outer",
                    cut.0, cut.1
                ));
            }
            AnalyticKind::Spot {
                inner: cut.0,
                outer: cut.1,
            }
        }
    };
    // The domain of lights, which begins below any room and ends beyond any scene.
    let range = light.range.filter(|range| *range <= MAX_COORDINATE);
    let light = AnalyticLight {
        name: light.name,
        node,
        kind,
        color: light.color,
        intensity: light.intensity,
        range: range.map(|range| range.max(2.0_f32.powi(-20))),
    };
    Ok((light, note))
}
