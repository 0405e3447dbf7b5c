//! Runs rust-gpu on the kernels, or on any crate of kernels. Only with the features `prebuilt-backend` or `upstream`.

use crate::Error;
use crate::decorate::decorate;
use crate::files::{self, cannot};
use crate::manifest::{Manifest, ModuleRecord};
use crate::names::buffer_names;
use crate::sources::{self, ALWAYS};
use crate::verify::verify;
use lightbvh_gpu::spirv::words;
use spirv_builder::{Capability, CompileResult, ModuleResult, SpirvBuilder};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Vulkan 1.2 with SPIR-V 1.5: the widest that has the Vulkan memory model in its core.
const TARGET: &str = "spirv-unknown-vulkan1.2";

/// What the compiler makes, below the root of the repository or of another crate.
const TARGET_DIR: &str = "target/kernels";

/// In there: all kernels as one module that has its names still. For lightbvh relative to the repository's root, where Cargo runs the
/// compiler, so that the compiler's options and with them its cache do not depend on where the checkout is.
const NAMED: &str = "target/kernels/named";

/// The version of spirv-builder, which `Cargo.toml` pins, and with it of the backend.
const BACKEND: &str = "rustc_codegen_spirv 0.11.0";

/// Finished modules and their manifest.
pub struct Built {
    /// Origin and interfaces.
    pub manifest: Manifest,
    /// File names and words, sorted by name.
    pub modules: Vec<(String, Vec<u32>)>,
}

/// A backend that is already built, and the rustup toolchain that loads it.
struct Prebuilt {
    library: OsString,
    toolchain: String,
}

/// Modules by the names of their files, and where the compiler left what they were made of.
struct Compiled {
    modules: Vec<(ModuleRecord, Vec<u32>)>,
    raw: PathBuf,
}

/// Compiles, decorates and verifies every entry point of the repository at `root`.
///
/// # Errors
/// What the compiler, the verifier or the file system said.
pub fn compile(root: &Path) -> Result<Built, Error> {
    let root = &resolved(root)?;
    let prebuilt = prebuilt()?;
    let compiler = compiler(prebuilt.as_ref())?;
    let compiled = modules(
        prebuilt,
        &root.join("kernels"),
        &root.join(TARGET_DIR),
        root,
        NAMED,
    )?;
    let source_files = source_files(root, &compiled.raw)?;
    let (records, modules) = (compiled.modules.into_iter())
        .map(|(record, words)| (record.clone(), (record.file, words)))
        .unzip();
    let manifest = Manifest {
        source_sha256: sources::hash(root, &source_files)?,
        source_files,
        compiler,
        backend: BACKEND.to_owned(),
        target: TARGET.to_owned(),
        modules: records,
    };
    Ok(Built { manifest, modules })
}

/// Compiles, decorates and verifies every entry point of the crate in the folder `path`, as those of lightbvh are, and writes
/// the modules into the folder `out`. What the compiler makes stays in `target/kernels` of the crate.
///
/// # Errors
/// As [`compile`]; nothing is written then.
pub fn compile_crate(path: &Path, out: &Path) -> Result<Vec<(ModuleRecord, Vec<u32>)>, Error> {
    let path = resolved(path)?;
    let target = path.join(TARGET_DIR);
    let named = path.join(NAMED);
    let compiled = modules(prebuilt()?, &path, &target, &path, &named.to_string_lossy())?;
    std::fs::create_dir_all(out).map_err(cannot("create", out))?;
    for (record, words) in &compiled.modules {
        files::write(&out.join(&record.file), &files::bytes(words))?;
    }
    Ok(compiled.modules)
}

/// Cargo names files by their resolved paths, and they are compared with this one.
fn resolved(path: &Path) -> Result<PathBuf, Error> {
    path.canonicalize().map_err(cannot("resolve", path))
}

/// The finished modules of the crate in the folder `kernels`, sorted by name. `named` is where the compiler leaves its names,
/// which is below `root`.
fn modules(
    prebuilt: Option<Prebuilt>,
    kernels: &Path,
    target: &Path,
    root: &Path,
    named: &str,
) -> Result<Compiled, Error> {
    let directory = root.join(named);
    std::fs::create_dir_all(&directory).map_err(cannot("create", &directory))?;
    let result = run(kernels, target, named, prebuilt)?;
    let ModuleResult::MultiModule(raw) = result.module else {
        return Err(Error(
            "rust-gpu gave one module where one per entry point was asked for".to_owned(),
        ));
    };
    let any = raw.values().next().ok_or_else(|| {
        Error("the crate has no entry point: no function with #[spirv(compute(..))]".to_owned())
    })?;
    // .../NAME.spvs/ENTRY.spv
    let crate_name = any.parent().and_then(Path::file_stem).unwrap_or_default();
    let mut names = names(&directory.join(crate_name).with_extension("spv"))?;
    let mut modules = Vec::new();
    for (entry_point, path) in &raw {
        let file = format!("{entry_point}.spv");
        let words = words(&files::read(path)?);
        let words = decorate(&words).map_err(|error| Error(format!("{file}: {error}")))?;
        verify(&file, &words)?;
        let buffers = names.remove(entry_point).unwrap_or_default();
        modules.push((ModuleRecord::new(file, &words, buffers), words));
    }
    let raw = any.clone();
    Ok(Compiled { modules, raw })
}

fn run(
    kernels: &Path,
    target: &Path,
    named: &str,
    prebuilt: Option<Prebuilt>,
) -> Result<CompileResult, Error> {
    let mut builder = SpirvBuilder::new(kernels, TARGET);
    if let Some(Prebuilt { library, toolchain }) = prebuilt {
        builder.rustc_codegen_spirv_location = Some(library.into());
        builder.toolchain_overwrite = Some(toolchain);
    }
    builder.multimodule = true;
    // spirv-opt folds (a + b) - a, x * 0 and the like at build time, unless the module declares this capability
    // (SPIRV-Tools, Instruction::IsFloatingPointFoldingAllowed). `decorate` takes it out again.
    builder.capabilities.push(Capability::SignedZeroInfNanPreserve);
    // An unused parameter keeps its binding: bindings are numbered by parameter order.
    builder.optimizer.preserve_bindings = true;
    builder.target_dir_path = Some(target.to_owned());
    builder.extra_args.push(format!("--dump-pre-inline={named}"));
    builder
        .build()
        .map_err(|error| Error(format!("rust-gpu: {error}")))
}

/// The names of buffers by entry point, from what the compiler left in `file`.
fn names(file: &Path) -> Result<BTreeMap<String, Vec<String>>, Error> {
    let words = words(&files::read(file)?);
    buffer_names(&words).map_err(|error| Error(format!("{}: {error}", file.display())))
}

fn prebuilt() -> Result<Option<Prebuilt>, Error> {
    match (
        std::env::var_os("RUSTC_CODEGEN_SPIRV"),
        std::env::var("RUST_GPU_TOOLCHAIN"),
    ) {
        (Some(library), Ok(toolchain)) => Ok(Some(Prebuilt { library, toolchain })),
        (Some(_), Err(_)) => Err(Error(
            "RUSTC_CODEGEN_SPIRV is set but RUST_GPU_TOOLCHAIN is not; set it to the rustup toolchain of the backend"
                .to_owned(),
        )),
        (None, _) if cfg!(feature = "upstream") => Ok(None),
        (None, _) => Err(Error(
            "RUSTC_CODEGEN_SPIRV is not set; set it and RUST_GPU_TOOLCHAIN to a prebuilt backend and its toolchain, \
             or build with --features upstream on upstream's nightly (kernels/README.md)"
                .to_owned(),
        )),
    }
}

/// First line of `rustc --version` of the toolchain that compiles the kernels.
fn compiler(prebuilt: Option<&Prebuilt>) -> Result<String, Error> {
    let mut command = Command::new("rustc");
    if let Some(Prebuilt { toolchain, .. }) = prebuilt {
        command.arg(format!("+{toolchain}"));
    }
    command.arg("--version");
    let program = format!("{command:?}");
    let fail = |reason: String| Error(format!("cannot run {program}: {reason}"));
    let output = command.output().map_err(|error| fail(error.to_string()))?;
    if !output.status.success() {
        return Err(fail(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    Ok(String::from_utf8_lossy(&output.stdout)
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned())
}

/// The files of this repository that the compiler read: Cargo writes them beside its result, in Make's notation.
fn source_files(root: &Path, module: &Path) -> Result<Vec<String>, Error> {
    // .../release/deps/NAME.spvs/ENTRY.spv, and .../release/NAME.spv.d
    let spvs = module.parent().unwrap_or(module);
    let release = spvs.parent().and_then(Path::parent).unwrap_or(spvs);
    let list = release
        .join(spvs.file_stem().unwrap_or_default())
        .with_extension("spv.d");
    let text = String::from_utf8_lossy(&files::read(&list)?).replace("\\ ", "\0");
    let mut found: BTreeSet<String> = ALWAYS.iter().map(|&file| file.to_owned()).collect();
    for path in text
        .split_whitespace()
        .map(|path| PathBuf::from(path.replace('\0', " ")))
    {
        let inside = path.strip_prefix(root).ok().and_then(Path::to_str);
        if let Some(file) = inside.filter(|file| file.ends_with(".rs") && !file.starts_with("target/")) {
            found.insert(file.replace('\\', "/"));
        }
    }
    Ok(found.into_iter().collect())
}
