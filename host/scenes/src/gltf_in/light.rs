//! Lights without area: `KHR_lights_punctual`, and photometric ones (`EXT_lights_ies`), read and checked.

use std::collections::HashMap;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use gltf::json;
use gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf::json::validation::Checked::{Invalid, Valid};
use lightbvh::light::MAX_COORDINATE;
use serde::Deserialize;

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::SceneError;
use super::super::model::SceneData;
use super::super::profile::Profile;
use super::{Document, container};

pub(in super::super) const IES: &str = "EXT_lights_ies";

/// What a node names of `EXT_lights_ies`.
#[derive(Deserialize)]
struct Measured {
    light: usize,
    #[serde(default = "one")]
    multiplier: f32,
    #[serde(default = "white")]
    color: [f32; 3],
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

/// The photometric lights of `EXT_lights_ies`.
pub(super) fn measured(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    // By number in the file: each is read once, and noted once where it cannot be.
    let mut read: HashMap<usize, Option<u32>> = HashMap::new();
    for (index, node) in document.root.nodes.iter().enumerate() {
        let (Some(extensions), Some(node_in_scene)) = (&node.extensions, place[index]) else {
            continue;
        };
        let element = format!("nodes[{index}]");
        let own: Option<Measured> = document.extension(&extensions.others, IES, &element)?;
        let Some(own) = own else { continue };
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
            node: node_in_scene,
            kind: AnalyticKind::Profile {
                profile: index,
                sent: profile.sent,
            },
            color: own.color.map(|channel| channel.min(1.0)),
            intensity: own.multiplier,
            range: None,
        });
    }
    Ok(())
}

fn profile(document: &Document<'_>, number: usize) -> Result<Profile, String> {
    let root = document.root.extensions.as_ref();
    let file = root.and_then(|root| root.others.get(IES)?.get("lights")?.get(number));
    let file = file.ok_or_else(|| String::from("it is not there"))?;
    let file = File::deserialize(file).map_err(|error| error.to_string())?;
    let element = format!("extensions.{IES}.lights[{number}]");
    let view = file.buffer_view.map(json::Index::new);
    let bytes = container::uri_or_view(document, file.uri.as_deref(), view, &element);
    Profile::read(file.name, bytes.map_err(|error| error.to_string())?)
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
        name: light.name.clone().unwrap_or_default(),
        node,
        kind,
        color: light.color,
        intensity: light.intensity,
        range: range.map(|range| range.max(2.0_f32.powi(-20))),
    })
}
