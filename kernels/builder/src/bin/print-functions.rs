//! `print-functions`: the functions of a set of kernels for shaders in another language, with the names, the bind group and the bindings
//! that an engine wants. Needs no compiler of kernels.

use lightbvh_kernels_builder::shader::{Language, Library, Naming, SETS, kernel};
use lightbvh_kernels_builder::{Error, manifest};
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

const USAGE: &str = "\
Prints functions for shaders, from the committed kernels.

Usage: print-functions kernel NAME
       print-functions LANGUAGE [--set SET] [--prefix PREFIX] [--group GROUP] [--bindings N,I,T,L,W]

  kernel NAME         a whole kernel in WGSL, push constants as a read-only buffer behind its others
  LANGUAGE            wgsl, glsl, hlsl or metal
  --set SET           any (AnyLights) or linked (MaskedLights); LightBvh otherwise
  --prefix PREFIX     what each name begins with, lower-case words joined by _; lightbvh otherwise
  --group GROUP       bind group, descriptor set or register space of the buffers; 0 otherwise
  --bindings N,I,T,L,W
                      bindings of nodes, instances, trails, lights, and the tree's words; 0,1,2,3,4 otherwise

The current directory must be inside the repository.";

fn main() -> ExitCode {
    let arguments = std::env::args_os().skip(1);
    let arguments: Vec<String> = arguments.map(|own| own.to_string_lossy().into_owned()).collect();
    let is_help = |own: &String| own == "--help" || own == "-h";
    let text = match arguments.is_empty() || arguments.iter().any(is_help) {
        true => Ok(format!("{USAGE}\n")),
        false => print(&arguments),
    };
    match text {
        // A reader that has seen enough, `head`, is no error.
        Ok(text) => match std::io::stdout().write_all(text.as_bytes()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                eprintln!("print-functions: cannot write: {error}");
                ExitCode::FAILURE
            }
            _ => ExitCode::SUCCESS,
        },
        Err(message) => {
            eprintln!("print-functions: {message}");
            ExitCode::FAILURE
        }
    }
}

fn print(arguments: &[String]) -> Result<String, Error> {
    let unknown = |what: &str, value: &str| Error(format!("no {what} is {value:?}\n\n{USAGE}"));
    let here = std::env::current_dir().map_err(|error| Error(format!("no current directory: {error}")))?;
    let root = manifest::root_above(&here)?;
    let committed = manifest::read(&root)?;
    if arguments[0] == "kernel" {
        let [_, name] = arguments else {
            return Err(Error(format!("`kernel` wants one name\n\n{USAGE}")));
        };
        let (words, buffers) = manifest::module(&root, &committed, &format!("{name}.spv"))?;
        return kernel(&words, &buffers);
    }
    let mut naming = Naming::default();
    let mut set = "";
    let mut languages = Language::ALL.into_iter();
    let language = languages.find(|own| own.extension() == arguments[0]);
    let language = language.ok_or_else(|| unknown("language", &arguments[0]))?;
    for pair in arguments[1..].chunks(2) {
        let [option, value] = pair else {
            return Err(Error(format!("{} wants a value\n\n{USAGE}", pair[0])));
        };
        match &**option {
            "--set" => set = value,
            "--prefix" => naming.prefix.clone_from(value),
            "--group" => naming.group = value.parse().map_err(|_| unknown("group, 0 to 255,", value))?,
            "--bindings" => {
                let numbers: Result<Vec<u8>, _> = value.split(',').map(str::parse).collect();
                let numbers = numbers.ok().and_then(|own| <[u8; 5]>::try_from(own).ok());
                naming.bindings =
                    numbers.ok_or_else(|| unknown("list of five bindings, 0 to 255,", value))?;
            }
            _ => return Err(unknown("option", option)),
        }
    }
    let found = SETS.iter().find(|own| own.suffix.trim_start_matches('_') == set);
    let set = found.ok_or_else(|| unknown("set", set))?;
    let library = Library::new(naming, set, |kernel| {
        manifest::module(&root, &committed, &format!("{kernel}{}.spv", set.suffix))
    })?;
    library.print(language)
}
