//! Runs rust-gpu on the kernels, or on any crate of kernels. Only with the features `prebuilt-backend` or `upstream`.

use crate::decorate::decorate;
use crate::files::{self, FileError};
use crate::manifest::{FORMAT, Manifest, ManifestError, ModuleRecord};
use crate::names::buffer_names;
use crate::sources::{self, ALWAYS};
use crate::verify::{VerifyError, verify};
use crate::{Unreadable, manifest};
use spirv_builder::{Capability, CompileResult, ModuleResult, SpirvBuilder, SpirvBuilderError};
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

/// Why the kernels could not be built.
#[derive(Debug, thiserror::Error)]
pub enum CompileError {
    /// A backend was named, but not the toolchain that loads it.
    #[error(
        "RUSTC_CODEGEN_SPIRV is set but RUST_GPU_TOOLCHAIN is not; set it to the rustup toolchain of the backend"
    )]
    NoToolchain,
    /// Built for a prebuilt backend, but none was named.
    #[error(
        "RUSTC_CODEGEN_SPIRV is not set; set it and RUST_GPU_TOOLCHAIN to a prebuilt backend and its toolchain, \
         or build with --features upstream on upstream's nightly (kernels/README.md)"
    )]
    NoBackend,
    /// The compiler refused.
    #[error("rust-gpu: {0}")]
    Builder(#[from] SpirvBuilderError),
    /// The compiler gave one module for all entry points.
    #[error("rust-gpu gave one module where one per entry point was asked for")]
    SingleModule,
    /// The crate has nothing to compile.
    #[error("the crate has no entry point: no function with #[spirv(compute(..))]")]
    NoEntryPoint,
    /// A module that cannot be parsed.
    #[error("{file}: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the parser said.
        source: Unreadable,
    },
    /// A module that breaks the rules.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// A module or file that does not fit.
    #[error(transparent)]
    Manifest(#[from] ManifestError),
    /// A file that cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// `rustc --version` failed.
    #[error("cannot run {program}: {reason}")]
    Compiler {
        /// The command.
        program: String,
        /// What went wrong.
        reason: String,
    },
}

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
pub fn compile(root: &Path) -> Result<Built, CompileError> {
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
        format: FORMAT,
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
pub fn compile_crate(path: &Path, out: &Path) -> Result<Vec<(ModuleRecord, Vec<u32>)>, CompileError> {
    let path = resolved(path)?;
    let target = path.join(TARGET_DIR);
    let named = path.join(NAMED);
    let compiled = modules(prebuilt()?, &path, &target, &path, &named.to_string_lossy())?;
    std::fs::create_dir_all(out).map_err(|source| FileError::new("create", out, source))?;
    for (record, words) in &compiled.modules {
        files::replace(&out.join(&record.file), &files::bytes(words))?;
    }
    Ok(compiled.modules)
}

/// Cargo names files by their resolved paths, and they are compared with this one.
fn resolved(path: &Path) -> Result<PathBuf, FileError> {
    path.canonicalize()
        .map_err(|source| FileError::new("resolve", path, source))
}

/// The finished modules of the crate in the folder `kernels`, sorted by name. `named` is where the compiler leaves its names,
/// which is below `root`.
fn modules(
    prebuilt: Option<Prebuilt>,
    kernels: &Path,
    target: &Path,
    root: &Path,
    named: &str,
) -> Result<Compiled, CompileError> {
    let directory = root.join(named);
    std::fs::create_dir_all(&directory).map_err(|source| FileError::new("create", &directory, source))?;
    let result = run(kernels, target, named, prebuilt)?;
    let ModuleResult::MultiModule(raw) = result.module else {
        return Err(CompileError::SingleModule);
    };
    let any = raw.values().next().ok_or(CompileError::NoEntryPoint)?;
    // .../NAME.spvs/ENTRY.spv
    let crate_name = any.parent().and_then(Path::file_stem).unwrap_or_default();
    let mut names = names(&directory.join(crate_name).with_extension("spv"))?;
    let mut modules = Vec::new();
    for (entry_point, path) in &raw {
        let file = format!("{entry_point}.spv");
        let words = files::words(&files::read(path)?).ok_or_else(|| ManifestError::Module {
            file: file.clone(),
            what: "not whole words",
        })?;
        let words = decorate(&words).map_err(|source| CompileError::Unreadable {
            file: file.clone(),
            source,
        })?;
        verify(&file, &words)?;
        let buffers = names.remove(entry_point).unwrap_or_default();
        modules.push((ModuleRecord::new(file, &words, buffers), words));
    }
    let raw = any.clone();
    Ok(Compiled { modules, raw })
}

/// Writes what [`compile`] made.
///
/// # Errors
/// Names the file that could not be written.
pub fn install(root: &Path, built: &Built) -> Result<(), CompileError> {
    Ok(manifest::write(root, &built.manifest, &built.modules)?)
}

fn run(
    kernels: &Path,
    target: &Path,
    named: &str,
    prebuilt: Option<Prebuilt>,
) -> Result<CompileResult, CompileError> {
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
    Ok(builder.build()?)
}

/// The names of buffers by entry point, from what the compiler left in `file`.
fn names(file: &Path) -> Result<BTreeMap<String, Vec<String>>, CompileError> {
    let words = files::words(&files::read(file)?).unwrap_or_default();
    buffer_names(&words).map_err(|source| CompileError::Unreadable {
        file: file.display().to_string(),
        source,
    })
}

fn prebuilt() -> Result<Option<Prebuilt>, CompileError> {
    match (
        std::env::var_os("RUSTC_CODEGEN_SPIRV"),
        std::env::var("RUST_GPU_TOOLCHAIN"),
    ) {
        (Some(library), Ok(toolchain)) => Ok(Some(Prebuilt { library, toolchain })),
        (Some(_), Err(_)) => Err(CompileError::NoToolchain),
        (None, _) if cfg!(feature = "upstream") => Ok(None),
        (None, _) => Err(CompileError::NoBackend),
    }
}

/// First line of `rustc --version` of the toolchain that compiles the kernels.
fn compiler(prebuilt: Option<&Prebuilt>) -> Result<String, CompileError> {
    let mut command = Command::new("rustc");
    if let Some(Prebuilt { toolchain, .. }) = prebuilt {
        command.arg(format!("+{toolchain}"));
    }
    command.arg("--version");
    let fail = |reason: String| CompileError::Compiler {
        program: format!("{command:?}"),
        reason,
    };
    let mut again = Command::new(command.get_program());
    let output = again
        .args(command.get_args())
        .output()
        .map_err(|error| fail(error.to_string()))?;
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
fn source_files(root: &Path, module: &Path) -> Result<Vec<String>, CompileError> {
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
