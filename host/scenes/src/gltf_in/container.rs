//! Files, the GLB container, and the bytes of buffers.

use std::borrow::Cow;
use std::fmt::Display;

use gltf::binary::Glb;
use gltf::json::{self, Index};
use percent_encoding::percent_decode_str;
use serde_json::Value;

use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::super::error::{SceneError, malformed};
use super::super::files::POINTER;
use super::Document;

/// Exporters disagree about padding, so both forms are read.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

fn broken(path: &str, problem: impl Display) -> SceneError {
    let problem = format!("is not a readable glTF 2.0 file: {problem}");
    malformed(path, problem, "export it again as .glb or .gltf")
}

/// The JSON part and the binary part of a file.
pub(super) type Parts<'a> = (Cow<'a, [u8]>, Option<Cow<'a, [u8]>>);

/// The parts of a `.gltf` or `.glb` file (glTF 2.0, section 4.4).
pub(super) fn split<'a>(path: &str, bytes: &'a [u8]) -> Result<Parts<'a>, SceneError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.into(), None));
    }
    // The crate's reader subtracts the header's length from the one that it claims.
    let claimed = bytes.get(8..).and_then(|rest| rest.first_chunk());
    if claimed.is_none_or(|claimed| u32::from_le_bytes(*claimed) < 12) {
        return Err(broken(path, "the GLB header is cut off"));
    }
    let parts = Glb::from_slice(bytes).map_err(|error| broken(path, error))?;
    Ok((parts.json, parts.bin))
}

/// The JSON part, and how many channels of animations are left out of it: those that name no node, as `KHR_animation_pointer` has
/// them, which the model does not know.
pub(super) fn parse(path: &str, text: &[u8]) -> Result<(json::Root, usize), SceneError> {
    if text.starts_with(POINTER) {
        return Err(broken(path, "it is a pointer of Git LFS; run `git lfs pull`"));
    }
    let problem = match json::deserialize::from_slice(text) {
        Ok(root) => return Ok((root, 0)),
        Err(error) => broken(path, format!("its JSON part: {error}")),
    };
    let Ok(mut value) = serde_json::from_slice::<Value>(text) else {
        return Err(problem);
    };
    if let Some("1.0" | "1") = value.pointer("/asset/version").and_then(Value::as_str) {
        return Err(broken(path, "it is glTF 1.0"));
    }
    let (mut left_out, mut mended) = (0, false);
    let scenes = value.get_mut("scenes").and_then(Value::as_array_mut);
    for scene in scenes.into_iter().flatten().filter_map(Value::as_object_mut) {
        // A scene may have none.
        mended |= !scene.contains_key("nodes");
        scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
    }
    let animations = value.get_mut("animations").and_then(Value::as_array_mut);
    for animation in animations.into_iter().flatten() {
        if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            let before = channels.len();
            channels.retain(|channel| channel.pointer("/target/node").is_some());
            left_out += before - channels.len();
        }
    }
    match json::deserialize::from_value(value) {
        Ok(root) if left_out > 0 || mended => Ok((root, left_out)),
        _ => Err(problem),
    }
}

/// Refuses a file of another version than 2, and one that needs a later one than 2.0 (glTF 2.0, section 3.2).
pub(super) fn check_version(path: &str, asset: &json::Asset) -> Result<(), SceneError> {
    let (needed, is_read) = match &asset.min_version {
        Some(needed) => (needed, needed == "2.0"),
        None => (&asset.version, asset.version.split('.').next() == Some("2")),
    };
    match is_read {
        true => Ok(()),
        false => Err(broken(path, format!("it needs glTF {needed}"))),
    }
}

/// All buffers, each cut to the length that the JSON claims.
pub(super) fn buffers<'a>(
    document: &Document<'a>,
    binary: Option<Cow<'a, [u8]>>,
) -> Result<Vec<Cow<'a, [u8]>>, SceneError> {
    let mut buffers = Vec::new();
    for (index, buffer) in document.root.buffers.iter().enumerate() {
        let element = format!("buffers[{index}]");
        let bytes = match (&buffer.uri, &binary) {
            (Some(uri), _) => {
                let bytes = fetch(document, uri, &element)?;
                document.load.take(&element, "the buffer", bytes.len() as u64)?;
                Cow::Owned(bytes)
            }
            (None, Some(binary)) if index == 0 => binary.clone(),
            // Nothing is there: all its views are compressed.
            (None, _) if document.is_fallback(buffer) => {
                buffers.push(Cow::Borrowed(&[][..]));
                continue;
            }
            (None, _) => {
                let advice = "export as .glb, or keep the .bin file beside the .gltf";
                return Err(document.malformed(element, "has neither a uri nor a binary chunk", advice));
            }
        };
        let claimed = buffer.byte_length.0;
        let found = bytes.len() as u64;
        if claimed > found {
            let problem = format!("claims {claimed} bytes, but only {found} are there");
            let advice = "the file or its .bin is truncated; copy it again";
            return Err(document.malformed(element, problem, advice));
        }
        let claimed = claimed as usize;
        buffers.push(match bytes {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..claimed]),
            Cow::Owned(mut bytes) => {
                bytes.truncate(claimed);
                Cow::Owned(bytes)
            }
        });
    }
    Ok(buffers)
}

/// The bytes behind a `data:` URI or a path relative to the file.
pub(super) fn fetch(document: &Document<'_>, uri: &str, element: &str) -> Result<Vec<u8>, SceneError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, encoded)) = data.split_once(";base64,") else {
            let problem = "a data URI that is not base64 is not supported";
            return Err(document.malformed(element, problem, "embed it as base64"));
        };
        return BASE64.decode(encoded).map_err(|error| {
            document.malformed(element, format!("bad base64: {error}"), "export the file again")
        });
    }
    let decoded = percent_decode_str(uri).decode_utf8().ok();
    let relative = decoded.filter(|path| !path.is_empty() && !uri.contains("://"));
    let (Some(relative), Some(folder)) = (relative, document.load.folder()) else {
        let shown: String = uri.chars().take(80).collect();
        let advice = "use a path relative to the file, or embed the data";
        return Err(document.malformed(element, format!("the URI `{shown}` is not supported"), advice));
    };
    let bytes = document.load.read(&folder.join(&*relative))?;
    if bytes.starts_with(POINTER) {
        let problem = format!("`{uri}` is a pointer of Git LFS");
        return Err(document.malformed(element, problem, "run `git lfs pull`"));
    }
    Ok(bytes)
}

/// What a `uri`, or else a view holds.
pub(super) fn uri_or_view<'d>(
    document: &'d Document<'_>,
    uri: Option<&str>,
    view: Option<Index<json::buffer::View>>,
    element: &str,
) -> Result<Cow<'d, [u8]>, SceneError> {
    match (uri, view) {
        (Some(uri), _) => fetch(document, uri, element).map(Cow::Owned),
        (None, Some(view)) => document
            .view(view, element)
            .map(|(bytes, _)| Cow::Borrowed(bytes)),
        (None, None) => {
            let problem = "it has neither a uri nor a bufferView";
            Err(document.malformed(element, problem, "export the file again"))
        }
    }
}
