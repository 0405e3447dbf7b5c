//! Kernels of another choice of layout, width and share of uniform choice: a crate of entry points that is written, then built
//! like any other crate's.

use std::path::{Path, PathBuf};

use lightbvh::requirements::{Layout, Model};

use crate::files::{self, FileError};

/// The entry points; `NODE` and `IMPORTANCE` stand for the choice's types.
const ENTRY_POINTS: &str = include_str!("choice/entry_points.txt");

/// Most halvings of a share of uniform choice, as `Defensive` has it.
const MOST_HALVINGS: u32 = 20;

/// Why options name no choice.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum ChoiceError {
    /// No such layout.
    #[error("--layout {0} is not known, expected moments or two-sided")]
    Layout(String),
    /// No such width.
    #[error("--width {0} is out of range, expected 4 to 16")]
    Width(String),
    /// No such share.
    #[error("--share {0} is out of range, expected 0 for none or up to 20 halvings of 1")]
    Share(String),
}

/// The choice that the values of `--layout`, `--width` and `--share` name.
///
/// # Errors
/// [`ChoiceError`] naming the first that means nothing.
pub fn parse(layout: &str, width: &str, share: &str) -> Result<Model, ChoiceError> {
    let named = Layout::ALL.into_iter().find(|own| own.name() == layout);
    let number = |text: &str| text.parse::<u32>().ok();
    Ok(Model {
        layout: named.ok_or_else(|| ChoiceError::Layout(layout.to_owned()))?,
        width: number(width)
            .filter(|width| (4..=16).contains(width))
            .ok_or_else(|| ChoiceError::Width(width.to_owned()))? as usize,
        uniform_halvings: number(share)
            .filter(|&share| share <= MOST_HALVINGS)
            .ok_or_else(|| ChoiceError::Share(share.to_owned()))?,
        ..Model::DEFAULT
    })
}

/// Writes the crate of `choice` into the folder `out`, for the repository at `root`, and returns its folder.
///
/// # Errors
/// Names the file that cannot be written.
pub fn write_crate(choice: &Model, root: &Path, out: &Path) -> Result<PathBuf, FileError> {
    let folder = out.join("crate");
    let sources = folder.join("src");
    std::fs::create_dir_all(&sources).map_err(|source| FileError::new("create", &sources, source))?;
    let core = root.join("core");
    let core = core
        .canonicalize()
        .map_err(|source| FileError::new("resolve", &core, source))?;
    files::replace(&folder.join("Cargo.toml"), manifest(&core).as_bytes())?;
    files::replace(&sources.join("lib.rs"), entry_points(choice).as_bytes())?;
    Ok(folder)
}

fn entry_points(choice: &Model) -> String {
    ENTRY_POINTS
        .replace("NODE", &choice.node_type())
        .replace("IMPORTANCE", &choice.importance_type())
        .replace("WIDTH", &choice.width.to_string())
}

fn manifest(core: &Path) -> String {
    format!(
        r#"[package]
name = "lightbvh-choice"
version = "0.1.0"
edition = "2024"
publish = false

[workspace]

[lib]
crate-type = ["dylib", "lib"]

[dependencies]
lightbvh = {{ path = {:?}, default-features = false }}
bytemuck = {{ version = "1.25", default-features = false, features = ["derive"] }}
spirv-std = "=0.11.0"
"#,
        core.display().to_string()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_name_a_choice_or_say_what_would() {
        let choice = parse("two-sided", "16", "0").expect("a choice");
        assert_eq!(
            (choice.node_type(), choice.importance_type()),
            ("TwoSidedMomentNode<16>".into(), "Moments".into())
        );
        let choice = parse("moments", "8", "6").expect("a choice");
        assert_eq!(choice, Model::DEFAULT);
        for layout in ["Moments", "eq4", "", "two-sided-moments"] {
            assert_eq!(
                parse(layout, "8", "6"),
                Err(ChoiceError::Layout(layout.to_owned()))
            );
        }
        for width in ["3", "17", "-8", "eight"] {
            assert_eq!(
                parse("two-sided", width, "6"),
                Err(ChoiceError::Width(width.to_owned()))
            );
        }
        assert_eq!(
            parse("moments", "8", "21"),
            Err(ChoiceError::Share("21".to_owned()))
        );
    }

    /// Every pass of a set of kernels is there, over the nodes of the choice.
    #[test]
    fn the_crate_has_the_passes_of_the_choice() {
        let choice = parse("two-sided", "8", "6").expect("a choice");
        let source = entry_points(&choice);
        for pass in [
            "sample",
            "pmf",
            "refit_bottom",
            "refit_roots",
            "refit_top",
            "refit_nodes",
        ] {
            assert!(source.contains(&format!("pub fn {pass}(")), "{pass}");
        }
        assert!(source.contains("type Node = TwoSidedMomentNode<8>;"), "{source}");
        assert!(
            source.contains("type Importance = Defensive<Moments, 6>;"),
            "{source}"
        );
        assert!(
            ["NODE", "IMPORTANCE", "WIDTH"]
                .iter()
                .all(|name| !source.contains(name))
        );
    }
}
