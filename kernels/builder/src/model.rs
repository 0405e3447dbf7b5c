//! Kernels of a model and receiver of one's own: a crate of their entry points that is written, then built like any other crate's.

use std::path::{Path, PathBuf};

use crate::Error;
use crate::files::{self, cannot};

/// The entry points; `PASSES`, `MODEL`, `WIDTH` and `RECEIVER` stand for what the crate is written for.
const ENTRY_POINTS: &str = r#"//! The passes of a model. Written by `build-kernels --model`.
#![cfg_attr(target_arch = "spirv", no_std)]
#![allow(clippy::too_many_arguments, unexpected_cfgs, unused_imports)]

#[macro_use]
#[path = "PASSES"]
mod passes;

use glam::UVec3;
use lightbvh::importance::*;
use lightbvh::light::*;
use lightbvh::node::*;
use lightbvh::refit::{self, Children, child_rows};
use lightbvh::tree::{AnyKind, Masked, Model, Paper, Triangles};
use lightbvh::*;
use passes::{QueryPush, RefitPush, invocation};
use spirv_std::spirv;

type Own = MODEL;
type OwnNode = <Own as Model<WIDTH>>::Node;
type OwnTree<'a> = LightTree<'a, OwnNode, <Own as Model<WIDTH>>::Importance, WIDTH>;

/// A receiver; for `sample` the number of the walk, its high word first, for `pmf` a light and its instance.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Query {
    pub receiver: RECEIVER,
    pub words: [u32; 2],
}

impl Query {
    fn receiver(&self) -> RECEIVER {
        self.receiver
    }
}

query_passes!(Query, OwnNode, OwnTree, sample = "sample", pmf = "pmf");
refit_passes!(
    OwnNode,
    WIDTH,
    child_rows::<OwnNode, WIDTH>(),
    <Own as Model<WIDTH>>::Light,
    refit_bottom = "refit_bottom",
    refit_top = "refit_top",
    refit_nodes = "refit_nodes"
);
"#;

const MANIFEST: &str = r#"[package]
name = "lightbvh-model"
version = "0.1.0"
edition = "2024"
publish = false

[workspace]

[lib]
crate-type = ["dylib", "lib"]

[dependencies]
lightbvh = { path = CORE, default-features = false }
bytemuck = { version = "1.25", default-features = false, features = ["derive"] }
glam = { version = "0.34", default-features = false, features = ["u32", "nostd-libm"] }
spirv-std = "=0.11.0"
"#;

/// Writes the crate of a model of `width` and of a receiver, types as Rust has them, into the folder `out`, for the repository at `root`, and
/// returns its folder. A wrong type is an error of the compiler.
///
/// # Errors
/// Names the file that cannot be written.
pub fn write_crate([model, width, receiver]: [&str; 3], root: &Path, out: &Path) -> Result<PathBuf, Error> {
    let folder = out.join("crate");
    let sources = folder.join("src");
    std::fs::create_dir_all(&sources).map_err(cannot("create", &sources))?;
    let root = root.canonicalize().map_err(cannot("resolve", root))?;
    let quoted = |path: &str| format!("{:?}", root.join(path).display().to_string());
    let entry_points = ENTRY_POINTS
        .replace("RECEIVER", receiver)
        .replace("WIDTH", width)
        .replace("MODEL", model)
        .replace("\"PASSES\"", &quoted("kernels/src/passes.rs"));
    let manifest = MANIFEST.replace("CORE", &quoted("core"));
    files::write(&folder.join("Cargo.toml"), manifest.as_bytes())?;
    files::write(&sources.join("lib.rs"), entry_points.as_bytes())?;
    Ok(folder)
}
