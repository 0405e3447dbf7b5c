//! Overwrites the known answers of `tests/data/known`, which is a change of results: first describe it in the changelog under
//! "Changes to bits".
//!
//! - `cargo run -p lightbvh-tests --example known_answers -- overwrite-answers`: new answers to the inputs that are there.
//! - `cargo run -p lightbvh-tests --example known_answers -- overwrite-inputs FILE...`: new inputs too, of the files named
//!   (without folder and ending), or of `all`.
//! - `cargo run -p lightbvh-tests --example known_answers -- overwrite-self-test`: the answers that `lightbvh-gpu` carries.

use std::path::Path;
use std::process::ExitCode;

use lightbvh::node::NODE_FORMAT;
use lightbvh_tests::known::{FILES, File, Subject, answer, changes_to_bits, fresh};
use lightbvh_tests::self_test;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments
        .iter()
        .map(String::as_str)
        .collect::<Vec<_>>()
        .as_slice()
    {
        ["overwrite-answers"] => overwrite_answers(),
        ["overwrite-inputs", names @ ..] if !names.is_empty() => overwrite_inputs(names),
        ["overwrite-self-test"] => overwrite_self_test(),
        _ => {
            eprintln!(
                "say `overwrite-self-test`, `overwrite-answers`, or `overwrite-inputs` and names of files or `all`"
            );
            ExitCode::FAILURE
        }
    }
}

fn overwrite_answers() -> ExitCode {
    for (name, subject) in FILES {
        let old = File::read(name);
        let answers = answer(&old, subject);
        let (compared, differences) = old.differences("this build", &answers);
        println!(
            "{name}: {compared} words, differences shown: {}",
            differences.len()
        );
        if differences.is_empty() && old.node_format == NODE_FORMAT {
            continue;
        }
        if changes_to_bits() <= old.changes_to_bits {
            eprintln!("{name}: the changelog says nothing new under \"Changes to bits\"; nothing is written");
            return ExitCode::FAILURE;
        }
        write(&old.answered(&answers), subject);
    }
    ExitCode::SUCCESS
}

fn overwrite_inputs(names: &[&str]) -> ExitCode {
    for (name, subject) in FILES {
        if names.contains(&name) || names == ["all"] {
            let file = fresh::inputs(name);
            let answers = answer(&file, subject);
            write(&file.answered(&answers), subject);
        }
    }
    ExitCode::SUCCESS
}

fn overwrite_self_test() -> ExitCode {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .join(self_test::FILE);
    match std::fs::write(&path, self_test::words()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

fn write(file: &File, subject: Subject) {
    let file = File {
        node_format: NODE_FORMAT,
        changes_to_bits: changes_to_bits(),
        ..file.clone()
    };
    let path = File::path(&file.name);
    match std::fs::write(&path, file.text()) {
        Ok(()) => println!("{}: written ({subject:?})", path.display()),
        Err(error) => eprintln!("{}: {error}", path.display()),
    }
}
