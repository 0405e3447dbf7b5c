//! Photometric lights (`EXT_lights_ies`): read and checked.

use std::collections::HashMap;

use serde::Deserialize;
use serde_json::{Map, Value};

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::SceneError;
use super::super::model::SceneData;
use super::super::profile::Profile;
use super::punctual::{one, white};
use super::{Document, container};

pub(in super::super) const NAME: &str = "EXT_lights_ies";

/// What a node's extension names.
#[derive(Deserialize)]
struct Named {
    light: usize,
    #[serde(default = "one")]
    multiplier: f32,
    #[serde(default = "white")]
    color: [f32; 3],
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct File {
    #[serde(default)]
    name: String,
    uri: Option<String>,
    buffer_view: Option<usize>,
}

/// The photometric lights of the nodes in the scene; `place` is where each of the file's nodes went.
pub(super) fn read(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    let none = Map::new();
    let root = document.root.extensions.as_ref();
    let files = root.and_then(|root| root.others.get(NAME)?.get("lights"));
    let files = files.and_then(Value::as_array);
    // By number in the file: each is read once, and noted once where it cannot be.
    let mut read: HashMap<usize, Option<u32>> = HashMap::new();
    for (index, node) in document.root.nodes.iter().enumerate() {
        let extensions = node.extensions.as_ref().map(|extensions| &extensions.others);
        let element = format!("nodes[{index}]");
        let named: Option<Named> = document.extension(extensions.unwrap_or(&none), NAME, &element)?;
        let (Some(named), Some(node)) = (named, place[index]) else {
            continue;
        };
        let Named {
            light,
            multiplier,
            color,
        } = named;
        if !color
            .iter()
            .chain([&multiplier])
            .all(|x| *x >= 0.0 && x.is_finite())
        {
            document.warn(format!(
                "the photometric light of {element} is left out: its colour or multiplier is negative or not finite"
            ));
            continue;
        }
        let profile = *read.entry(light).or_insert_with(|| {
            let file = files.and_then(|files| files.get(light));
            let found = match file {
                Some(file) => profile(document, file, light),
                None => Err(String::from("it is not there")),
            };
            match found {
                Ok(profile) => {
                    data.profiles.push(profile);
                    Some(data.profiles.len() as u32 - 1)
                }
                Err(problem) => {
                    document.warn(format!(
                        "photometric profile {light} ({NAME}) is left out with its lights: {problem}"
                    ));
                    None
                }
            }
        });
        if let Some(profile) = profile {
            let own = &data.profiles[profile as usize];
            data.analytic.push(AnalyticLight {
                name: own.name.clone(),
                node,
                kind: AnalyticKind::profile(profile, own),
                color: color.map(|channel| channel.min(1.0)),
                intensity: multiplier,
                range: None,
            });
        }
    }
    Ok(())
}

fn profile(document: &Document<'_>, value: &Value, index: usize) -> Result<Profile, String> {
    let file = File::deserialize(value).map_err(|error| error.to_string())?;
    let element = format!("extensions.{NAME}.lights[{index}]");
    let bytes = match (&file.uri, file.buffer_view) {
        (Some(uri), _) => container::fetch(document, uri, &element),
        (None, Some(view)) => document
            .view(gltf::json::Index::new(view as u32), &element)
            .map(|(bytes, _)| bytes.to_vec()),
        (None, None) => return Err(String::from("it has neither a uri nor a bufferView")),
    };
    let bytes = bytes.map_err(|error| error.to_string())?;
    Profile::read(file.name, bytes)
}
