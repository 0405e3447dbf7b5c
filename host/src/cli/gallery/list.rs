//! Lists of scenes: a JSON file with what is to be rendered, who made it, and whether it may be shown.
//!
//! ```json
//! { "scenes": [ {
//!     "scene": "lamps/lamp.glb", "title": "Lamp", "author": "A. Name", "licence": "CC0-1.0",
//!     "source": "https://example.org/lamp", "may_be_shown": true,
//!     "camera": 0, "frame": 8, "environment": "sky.hdr", "environment_scale": 1.0
//! } ] }
//! ```
//!
//! `scene` and `may_be_shown` are required. Paths are relative to the list.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::{Deserializer, Error as _};

use super::plan::MAX_FRAME;
use crate::error::HostError;
use crate::scene::{BUILT_IN, STAGE};

/// Most letters of a title, a name or an address.
const MOST_LETTERS: usize = 300;

/// A scene of a list.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    /// A built-in name, or a path from the list's folder.
    pub scene: String,
    pub title: Option<String>,
    pub author: Option<String>,
    /// Its short name, such as `CC-BY-4.0`.
    pub licence: Option<String>,
    /// Where it is from, `https://` or `http://`.
    pub source: Option<String>,
    /// Whether pictures of it may be published.
    pub may_be_shown: bool,
    /// Which of the scene's cameras looks, from 0.
    pub camera: u32,
    /// Frame of the animation, 25 per second; that of the command line where there is none.
    pub frame: Option<u32>,
    /// An environment map, a path from the list's folder.
    pub environment: Option<String>,
    /// Factor on its radiance, above 0.
    pub environment_scale: f32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Whole {
    scenes: Vec<Raw>,
}

/// An entry as it stands in the file, each value checked by itself.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    #[serde(deserialize_with = "words")]
    scene: String,
    #[serde(default, deserialize_with = "some_words")]
    title: Option<String>,
    #[serde(default, deserialize_with = "some_words")]
    author: Option<String>,
    #[serde(default, deserialize_with = "some_words")]
    licence: Option<String>,
    #[serde(default, deserialize_with = "address")]
    source: Option<String>,
    may_be_shown: bool,
    #[serde(default)]
    camera: u32,
    #[serde(default, deserialize_with = "frame")]
    frame: Option<u32>,
    #[serde(default, deserialize_with = "some_words")]
    environment: Option<String>,
    #[serde(default, deserialize_with = "factor")]
    environment_scale: Option<f32>,
}

impl TryFrom<Raw> for Entry {
    type Error = String;

    fn try_from(raw: Raw) -> Result<Self, String> {
        let scene = raw.scene;
        let problem = |words: &str| Err(format!("the entry of `{scene}` that begins here {words}"));
        if raw.may_be_shown && !is_built_in(&scene) && (raw.author.is_none() || raw.licence.is_none()) {
            return problem(
                "may be shown, but has no `author` or no `licence`; add both, or set `may_be_shown` to false",
            );
        }
        if raw.environment_scale.is_some() && raw.environment.is_none() {
            return problem(
                "has an `environment_scale` without an `environment`; name a .hdr or .exr picture, or remove it",
            );
        }
        Ok(Self {
            scene,
            title: raw.title,
            author: raw.author,
            licence: raw.licence,
            source: raw.source,
            may_be_shown: raw.may_be_shown,
            camera: raw.camera,
            frame: raw.frame,
            environment: raw.environment,
            environment_scale: raw.environment_scale.unwrap_or(1.0),
        })
    }
}

impl Entry {
    /// An entry for what the command line names alone.
    pub fn named(scene: &str) -> Self {
        Self {
            scene: scene.to_owned(),
            title: None,
            author: None,
            licence: None,
            source: None,
            may_be_shown: true,
            camera: 0,
            frame: None,
            environment: None,
            environment_scale: 1.0,
        }
    }
}

/// Whether it is the name of a scene that the program makes.
pub(super) fn is_built_in(scene: &str) -> bool {
    scene == STAGE || BUILT_IN.contains(&scene)
}

/// Reads a list; paths in it become those from the working folder.
///
/// # Errors
/// [`HostError::List`] with the line, for a file that is unreadable, no JSON, or has a value that means nothing.
pub(super) fn read(path: &Path) -> Result<Vec<Entry>, HostError> {
    let refused = |problem| HostError::List {
        path: path.to_owned(),
        problem,
    };
    let text = fs::read_to_string(path).map_err(|error| {
        refused(format!(
            "{error}; check that the file is there, is text, and that you may read it"
        ))
    })?;
    let mut entries = parse(&text).map_err(refused)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let from_here = |named: &mut String| *named = folder.join(&*named).to_string_lossy().into_owned();
    for entry in &mut entries {
        if !is_built_in(&entry.scene) {
            from_here(&mut entry.scene);
        }
        if let Some(environment) = &mut entry.environment {
            from_here(environment);
        }
    }
    Ok(entries)
}

/// The entries of a list, or where and why there are none.
fn parse(text: &str) -> Result<Vec<Entry>, String> {
    let whole: Whole = serde_json::from_str(text).map_err(|error| {
        let said = error.to_string();
        let at = format!(" at line {} column {}", error.line(), error.column());
        let what = said.strip_suffix(&at).unwrap_or(&said);
        let advice = match error.classify() {
            serde_json::error::Category::Data if what.contains("; ") => "",
            serde_json::error::Category::Data => "; `lightbvh gallery --help` has an example",
            _ => "; the list is JSON: check brackets, quotes and commas up to here",
        };
        format!("line {}: {what}{advice}", error.line())
    })?;
    if whole.scenes.is_empty() {
        return Err(String::from(
            "line 1: `scenes` is empty; add an entry, or leave --list out for the built-in scenes",
        ));
    }
    let entries = whole.scenes.into_iter().zip(entry_lines(text));
    entries
        .map(|(raw, line)| Entry::try_from(raw).map_err(|problem| format!("line {line}: {problem}")))
        .collect()
}

/// The lines in which the entries of a sound list begin: the third level of brackets.
fn entry_lines(text: &str) -> Vec<usize> {
    let (mut lines, mut line, mut depth) = (Vec::new(), 1, 0);
    let (mut in_text, mut escaped) = (false, false);
    for c in text.chars() {
        match c {
            '\n' => line += 1,
            _ if escaped => escaped = false,
            '\\' if in_text => escaped = true,
            '"' => in_text = !in_text,
            '{' | '[' if !in_text => {
                if depth == 2 {
                    lines.push(line);
                }
                depth += 1;
            }
            '}' | ']' if !in_text => depth -= 1,
            _ => {}
        }
    }
    lines
}

/// Text of one line.
fn checked(text: String) -> Result<String, &'static str> {
    if text.trim().is_empty() {
        return Err("a text is empty; fill it in, or remove its key");
    }
    if text.chars().any(char::is_control) {
        return Err("a text has a line break or another control character; write it in one line");
    }
    if text.chars().count() > MOST_LETTERS {
        return Err("a text has more than 300 letters; shorten it");
    }
    Ok(text)
}

fn words<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    checked(String::deserialize(from)?).map_err(D::Error::custom)
}

fn some_words<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    words(from).map(Some)
}

fn address<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    let text = words(from)?;
    let is_one = ["https://", "http://"]
        .iter()
        .any(|begin| text.starts_with(begin))
        && text
            .chars()
            .all(|c| c.is_ascii_graphic() && !"<>()\"`".contains(c));
    if !is_one {
        return Err(D::Error::custom(
            "`source` is no address; begin with https://, and write spaces and brackets as %20, %28 and %29",
        ));
    }
    Ok(Some(text))
}

fn frame<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
    let number = u32::deserialize(from)?;
    if u64::from(number) > MAX_FRAME {
        return Err(D::Error::custom("`frame` is too large; give 0 to 10000"));
    }
    Ok(Some(number))
}

fn factor<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f32>, D::Error> {
    let number = f32::deserialize(from)?;
    if !(number.is_finite() && number > 0.0) {
        return Err(D::Error::custom(
            "`environment_scale` is no factor; give a finite number above 0",
        ));
    }
    Ok(Some(number))
}

#[cfg(test)]
mod tests;
