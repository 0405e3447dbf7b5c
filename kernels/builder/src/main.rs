//! `build-kernels`: compiles every entry point of `kernels` to `kernels/gpu/spirv` and `host/spirv`, writes the manifest and the tables; or
//! those of another crate, to modules under the same rules.

use lightbvh_kernels_builder::Error;
use lightbvh_kernels_builder::compile::{Built, compile, compile_crate};
use lightbvh_kernels_builder::files;
use lightbvh_kernels_builder::manifest::{self, DIRECTORY, ModuleRecord, place};
use lightbvh_kernels_builder::model::write_crate;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "\
Compiles the kernels, decorates and verifies them: those of the tree to kernels/gpu/spirv, those of the
renderer to host/spirv. Writes the manifest and the tables of kernels.

Usage: build-kernels [--check]
       build-kernels --crate PATH --out DIR
       build-kernels --model MODEL --width WIDTH --receiver RECEIVER --out DIR

  --check       write nothing; fail when the committed modules are not what the sources give
  --crate PATH  compile the entry points of the crate in the folder PATH instead, under the same rules
  --model MODEL --width WIDTH --receiver RECEIVER
                compile sample, pmf and the refits of that model instead, and for receivers of that type:
                types as in Rust, `Triangles` or `(MomentNode<8>, Glossy<DefaultImportance>)`, `GlossyPoint`
  --out DIR     where its modules go, one file ENTRY_POINT.spv for each

Without --crate the current directory must be inside the repository. See kernels/README.md for the compiler it needs.";

/// Bytes of stack that the compiler's threads have: it follows on it how deep selections and loops lie in each other, and
/// overflowed the 8 MiB that it has otherwise.
const STACK: (&str, &str) = ("RUST_MIN_STACK", "536870912");

fn main() -> ExitCode {
    if std::env::var_os(STACK.0).is_none() {
        return with_stack();
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        [] => kernels(false),
        ["--check"] => kernels(true),
        ["--crate", path, "--out", out] | ["--out", out, "--crate", path] => {
            another(Path::new(path), Path::new(out))
        }
        [
            "--model",
            model,
            "--width",
            width,
            "--receiver",
            receiver,
            "--out",
            out,
        ] => another_model([model, width, receiver], Path::new(out)),
        ["--help" | "-h"] => {
            println!("{USAGE}");
            Ok(())
        }
        _ => {
            eprintln!("build-kernels: unknown arguments {arguments:?}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("build-kernels: {message}");
            ExitCode::FAILURE
        }
    }
}

/// This program again, in an environment that gives the compiler its stack.
fn with_stack() -> ExitCode {
    let again = std::env::current_exe().and_then(|own| {
        Command::new(own)
            .args(std::env::args_os().skip(1))
            .env(STACK.0, STACK.1)
            .status()
    });
    match again {
        Ok(status) => ExitCode::from(
            status
                .code()
                .and_then(|code| u8::try_from(code).ok())
                .unwrap_or(1),
        ),
        Err(error) => {
            eprintln!("build-kernels: cannot start itself again: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Builds lightbvh's own kernels.
fn kernels(check: bool) -> Result<(), Error> {
    let root = repository()?;
    let built = compile(&root)?;
    if check {
        compare(&root, &built)
    } else {
        write(&root, &built)
    }
}

/// Builds another crate's kernels, and says what they take.
fn another(path: &Path, out: &Path) -> Result<(), Error> {
    let modules = compile_crate(path, out)?;
    for (record, words) in &modules {
        println!("{}", describe(record, words)?);
        let interface = record.interface(words)?;
        for (binding, (name, buffer)) in record.buffers.iter().zip(&interface.buffers).enumerate() {
            println!(
                "  binding {binding}: {name}, {:?}, {} bytes an element",
                buffer.access, buffer.stride
            );
        }
        validate(&out.join(&record.file))?;
    }
    Ok(())
}

/// Builds the kernels of another model.
fn another_model(types: [&str; 3], out: &Path) -> Result<(), Error> {
    another(&write_crate(types, &repository()?, out)?, out)
}

/// The directory above the current one that holds the kernels.
fn repository() -> Result<PathBuf, Error> {
    let here = std::env::current_dir().map_err(|error| Error(format!("no current directory: {error}")))?;
    manifest::root_above(&here)
}

fn write(root: &Path, built: &Built) -> Result<(), Error> {
    manifest::write(root, &built.manifest, &built.modules)?;
    for (record, (_, words)) in built.manifest.modules.iter().zip(&built.modules) {
        println!("{}", describe(record, words)?);
        validate(&root.join(place(&record.file)))?;
    }
    println!(
        "{} modules, {}",
        built.manifest.modules.len(),
        built.manifest.compiler
    );
    Ok(())
}

/// Fails unless the committed modules have the bytes just built, and the manifest lists them. That it agrees with the sources is a test.
fn compare(root: &Path, built: &Built) -> Result<(), Error> {
    let committed = manifest::read(root)?;
    for (file, words) in &built.modules {
        let path = root.join(place(file));
        if files::read(&path)? != files::bytes(words) {
            return Err(Error(format!(
                "{} differs from what the sources give; rebuild and commit it\n  \
                 committed: {} with {}\n  now:       {} with {}",
                place(file),
                committed.backend,
                committed.compiler,
                built.manifest.backend,
                built.manifest.compiler
            )));
        }
    }
    if committed.modules != built.manifest.modules || committed.source_files != built.manifest.source_files {
        return Err(Error(format!(
            "{DIRECTORY}/{} lists other modules or sources; rebuild it",
            manifest::FILE
        )));
    }
    println!(
        "{} modules are what the sources give, byte for byte",
        built.modules.len()
    );
    Ok(())
}

fn describe(record: &ModuleRecord, words: &[u32]) -> Result<String, Error> {
    let interface = record.interface(words)?;
    let [x, y, z] = interface.workgroup;
    Ok(format!(
        "{}: {} words, workgroup {x}x{y}x{z}, {} buffers, {} bytes of push constants",
        record.file,
        words.len(),
        interface.buffers.len(),
        interface.push_constants
    ))
}

/// Lets `spirv-val` look at the finished module where it is installed; the backend has validated it before decoration.
fn validate(path: &Path) -> Result<(), Error> {
    match Command::new("spirv-val")
        .args(["--target-env", "vulkan1.2"])
        .arg(path)
        .output()
    {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(Error(format!(
            "spirv-val refuses {}: {}",
            path.display(),
            String::from_utf8_lossy(&output.stderr)
        ))),
        Err(_) => {
            println!("  spirv-val is not installed: not validated after decoration");
            Ok(())
        }
    }
}
