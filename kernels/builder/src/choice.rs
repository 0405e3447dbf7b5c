//! Kernels of another choice of layout, width and share of uniform choice: a crate of entry points that is written, then built
//! like any other crate's.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use lightbvh::requirements::{Choice, Layout};

use crate::Error;
use crate::files::{self, cannot};

/// The entry points; `NODE` and `IMPORTANCE` stand for the choice's types.
const ENTRY_POINTS: &str = include_str!("choice/entry_points.txt");

/// The choice that the values of `--layout`, `--width` and `--share` name.
///
/// # Errors
/// Names the first that means nothing.
pub fn parse(layout: &str, width: &str, share: &str) -> Result<Choice, Error> {
    let named = Layout::ALL.into_iter().find(|own| own.name() == layout);
    let number = |option: &str, text: &str, range: RangeInclusive<u32>, expected: &str| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let refused = || format!("--{option} {text} is out of range, expected {expected}");
        number.ok_or_else(|| Error(refused()))
    };
    Ok(Choice {
        layout: named.ok_or_else(|| {
            Error(format!(
                "--layout {layout} is not known, expected moments or two-sided"
            ))
        })?,
        width: number("width", width, 4..=16, "4 to 16")? as usize,
        uniform_halvings: number("share", share, 0..=20, "0 for none or up to 20 halvings of 1")?,
        ..Choice::DEFAULT
    })
}

/// Writes the crate of `choice` into the folder `out`, for the repository at `root`, and returns its folder.
///
/// # Errors
/// Names the file that cannot be written.
pub fn write_crate(choice: &Choice, root: &Path, out: &Path) -> Result<PathBuf, Error> {
    let folder = out.join("crate");
    let sources = folder.join("src");
    std::fs::create_dir_all(&sources).map_err(cannot("create", &sources))?;
    let core = root.join("core");
    let core = core.canonicalize().map_err(cannot("resolve", &core))?;
    files::write(&folder.join("Cargo.toml"), manifest(&core).as_bytes())?;
    files::write(&sources.join("lib.rs"), entry_points(choice).as_bytes())?;
    Ok(folder)
}

fn entry_points(choice: &Choice) -> String {
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
        assert_eq!((choice.width, choice.uniform_halvings), (16, 0));
        assert_eq!(parse("moments", "8", "6"), Ok(Choice::DEFAULT));
        for (layout, width, share, said) in [
            ("eq4", "8", "6", "--layout eq4"),
            ("two-sided", "17", "6", "--width 17"),
            ("two-sided", "eight", "6", "--width eight"),
            ("moments", "8", "21", "--share 21"),
        ] {
            let error = parse(layout, width, share).expect_err(said).to_string();
            assert!(error.starts_with(said) && error.contains("expected"), "{error}");
        }
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
