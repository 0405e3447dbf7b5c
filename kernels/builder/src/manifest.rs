//! `kernels/gpu/spirv/manifest.json`: where the committed modules come from, and what they are.

use crate::files::{self, cannot};
use crate::shader::{Language, Library, Naming, SETS};
use crate::{Error, sources, table};
use lightbvh_gpu::spirv::{Interface, words};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Directory of the manifest and of the tree's modules, below the repository's root.
pub const DIRECTORY: &str = "kernels/gpu/spirv";

/// Directory of the functions for shaders, below the root.
const SHADERS: &str = "kernels/gpu/shaders";

/// A folder of modules, the table of them, both below the root, and how the table's crate knows `lightbvh-gpu`.
const FOLDERS: [(&str, &str, &str); 2] = [
    (DIRECTORY, "kernels/gpu/src/table.rs", "crate"),
    ("host/spirv", "host/src/renderer.rs", "lightbvh_gpu"),
];

/// The folder of a module: those of the reference renderer are the host's.
#[must_use]
pub fn folder(file: &str) -> &'static str {
    FOLDERS[usize::from(file.starts_with("render"))].0
}

/// Name of the manifest in [`DIRECTORY`].
pub const FILE: &str = "manifest.json";

const REBUILD: &str = "run build-kernels (kernels/README.md) and commit what it writes";

/// The committed modules and their origin.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// SHA-256 over the sources and the dependencies of the kernels ([`sources::hash`]).
    pub source_sha256: String,
    /// The files that the hash covers, relative to the root, sorted.
    pub source_files: Vec<String>,
    /// The compiler, as `rustc --version` names it.
    pub compiler: String,
    /// The SPIR-V backend and its version.
    pub backend: String,
    /// The target: Vulkan version and with it the SPIR-V version.
    pub target: String,
    /// The modules, sorted by name.
    pub modules: Vec<ModuleRecord>,
}

/// One module.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModuleRecord {
    /// File in its [`folder`]: the entry point's name with `.spv`.
    pub file: String,
    /// Names of the buffers, by binding.
    pub buffers: Vec<String>,
    /// SHA-256 of the file.
    pub sha256: String,
}

impl ModuleRecord {
    /// Describes a finished module whose buffers have these names.
    #[must_use]
    pub fn new(file: String, words: &[u32], buffers: Vec<String>) -> Self {
        Self {
            file,
            buffers,
            sha256: sources::hash_bytes(&files::bytes(words)),
        }
    }

    /// What the module takes; `words` are its own.
    ///
    /// # Errors
    /// When its interface is not one that the host offers, or the names are not those of its buffers.
    pub fn interface(&self, words: &[u32]) -> Result<Interface, Error> {
        let interface = Interface::read(words);
        let interface = interface.map_err(|error| Error(format!("{}: {error}", self.file)))?;
        if self.file.strip_suffix(".spv") != Some(&*interface.entry_point) {
            return Err(self.wrong("entry point"));
        }
        if self.buffers.len() != interface.buffers.len() {
            return Err(self.wrong("names of buffers"));
        }
        Ok(interface)
    }

    fn wrong(&self, what: &str) -> Error {
        Error(format!(
            "{} is not the module that the manifest records ({what}); {REBUILD}",
            place(&self.file)
        ))
    }
}

/// The repository that a directory is in.
///
/// # Errors
/// When it is in none.
pub fn root_above(directory: &Path) -> Result<PathBuf, Error> {
    let mut above = directory.ancestors();
    let root = above.find(|own| own.join("kernels/builder/Cargo.toml").is_file());
    root.map(Path::to_owned)
        .ok_or_else(|| Error(format!("{} is not inside the repository", directory.display())))
}

/// Reads the manifest of the repository at `root`.
///
/// # Errors
/// When there is none, or none that this program understands.
pub fn read(root: &Path) -> Result<Manifest, Error> {
    let path = root.join(DIRECTORY).join(FILE);
    serde_json::from_slice(&files::read(&path)?)
        .map_err(|error| Error(format!("{}: not a manifest: {error}; {REBUILD}", path.display())))
}

/// Reads the words of a recorded module.
///
/// # Errors
/// When the file cannot be read or is not the recorded one.
pub fn read_module(root: &Path, record: &ModuleRecord) -> Result<Vec<u32>, Error> {
    let bytes = files::read(&root.join(place(&record.file)))?;
    match sources::hash_bytes(&bytes) == record.sha256 {
        true => Ok(words(&bytes)),
        false => Err(record.wrong("hash")),
    }
}

/// The words of a committed module, and the names of its buffers by binding.
///
/// # Errors
/// When the manifest has no such file, or it cannot be read.
pub fn module(root: &Path, committed: &Manifest, file: &str) -> Result<(Vec<u32>, Vec<String>), Error> {
    let record = committed.modules.iter().find(|own| own.file == file);
    let record = record.ok_or_else(|| Error(format!("{file} is not in {DIRECTORY}/{FILE}")))?;
    Ok((read_module(root, record)?, record.buffers.clone()))
}

/// The files of functions for shaders, below the root, and their texts.
fn functions(
    read: impl FnMut(&str) -> Result<(Vec<u32>, Vec<String>), Error>,
) -> Result<Vec<(String, String)>, Error> {
    let library = Library::new(Naming::default(), &SETS[0], read)?;
    let file = |own: Language| format!("{SHADERS}/lightbvh.{}", own.extension());
    let texts = Language::ALL
        .into_iter()
        .map(|own| Ok((file(own), library.print(own)?)));
    texts.collect()
}

/// Checks, without a compiler, that the committed modules are those of the sources beside them, and tables and functions those of the modules.
///
/// # Errors
/// The first disagreement between sources, manifest, modules and table.
pub fn check(root: &Path) -> Result<Manifest, Error> {
    let manifest = read(root)?;
    let found = sources::hash(root, &manifest.source_files)?;
    if found != manifest.source_sha256 {
        return Err(Error(format!(
            "the kernels' sources changed since {DIRECTORY} was built: hash {found}, recorded {}; {REBUILD}",
            manifest.source_sha256
        )));
    }
    let mut interfaces = Vec::new();
    for record in &manifest.modules {
        let words = read_module(root, record)?;
        interfaces.push((record, record.interface(&words)?));
    }
    for (file, text) in tables(&interfaces) {
        if files::read(&root.join(file))? != text.as_bytes() {
            return Err(Error(format!(
                "{file} is not the table of its modules; {REBUILD}"
            )));
        }
    }
    for (file, text) in functions(|kernel| module(root, &manifest, &format!("{kernel}.spv")))? {
        if files::read(&root.join(&file))? != text.as_bytes() {
            return Err(Error(format!("{file} is not what its modules give; {REBUILD}")));
        }
    }
    let listed: Vec<String> = manifest
        .modules
        .iter()
        .map(|module| place(&module.file))
        .collect();
    match module_files(root)?
        .into_iter()
        .find(|file| !listed.contains(file))
    {
        Some(file) => Err(Error(format!(
            "{file} is not in the manifest; remove it, or {REBUILD}"
        ))),
        None => Ok(manifest),
    }
}

/// The file of a module, below the root.
#[must_use]
pub fn place(file: &str) -> String {
    format!("{}/{file}", folder(file))
}

/// The files of the tables, below the root, and their texts.
fn tables(kernels: &[(&ModuleRecord, Interface)]) -> [(&'static str, String); 2] {
    FOLDERS.map(|(directory, file, gpu)| {
        let own = kernels
            .iter()
            .filter(|(record, _)| folder(&record.file) == directory);
        (
            file,
            table::render(gpu, own.map(|(record, own)| (&*record.buffers, own))),
        )
    })
}

/// Replaces the committed modules, the manifest and the table of kernels; modules of entry points that are gone are removed.
///
/// # Errors
/// Names the file that could not be written, or the module whose interface is not one that the host offers.
pub fn write(root: &Path, manifest: &Manifest, modules: &[(String, Vec<u32>)]) -> Result<(), Error> {
    let interfaces = manifest.modules.iter().zip(modules);
    let interfaces: Result<Vec<_>, Error> = interfaces
        .map(|(record, (_, words))| Ok((record, record.interface(words)?)))
        .collect();
    let tables = tables(&interfaces?);
    let built = manifest.modules.iter().zip(modules);
    let find = |kernel: &str| {
        let mut built = built.clone();
        let own = built.find(|(record, _)| record.file.strip_suffix(".spv") == Some(kernel));
        let own = own.map(|(record, (_, words))| (words.clone(), record.buffers.clone()));
        own.ok_or_else(|| Error(format!("no kernel is named {kernel}")))
    };
    let functions = functions(find)?;
    for (directory, ..) in FOLDERS {
        let directory = root.join(directory);
        std::fs::create_dir_all(&directory).map_err(cannot("create", &directory))?;
    }
    for (file, words) in modules {
        files::write(&root.join(place(file)), &files::bytes(words))?;
    }
    for file in module_files(root)? {
        if modules.iter().all(|(kept, _)| place(kept) != file) {
            let path = root.join(&file);
            std::fs::remove_file(&path).map_err(cannot("remove", &path))?;
        }
    }
    for (file, text) in tables {
        files::write(&root.join(file), text.as_bytes())?;
    }
    for (file, text) in functions {
        files::write(&root.join(file), text.as_bytes())?;
    }
    let path = root.join(DIRECTORY).join(FILE);
    let mut json = serde_json::to_string_pretty(manifest)
        .map_err(|error| Error(format!("{}: {error}", path.display())))?;
    json.push('\n');
    files::write(&path, json.as_bytes())
}

/// The `.spv` files that are there, below the root, sorted.
fn module_files(root: &Path) -> Result<Vec<String>, Error> {
    let mut found = Vec::new();
    for (directory, ..) in FOLDERS {
        let path = root.join(directory);
        let entries = std::fs::read_dir(&path).map_err(cannot("list", &path))?;
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let modules = names.filter(|name| name.ends_with(".spv"));
        found.extend(modules.map(|name| format!("{directory}/{name}")));
    }
    found.sort_unstable();
    Ok(found)
}
