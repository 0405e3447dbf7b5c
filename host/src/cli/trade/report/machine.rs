//! Where, when and by what a report was made.

use std::env::consts::{ARCH, OS};
use std::path::Path;
use std::time::SystemTime;

use serde::Serialize;

/// The head of a report.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli) struct Made {
    /// The processor's name where the system tells it, its family and the system elsewhere.
    pub machine: String,
    /// Threads that images and trees have.
    pub threads: usize,
    /// The command line.
    pub command: String,
    /// Of this program.
    pub version: &'static str,
    /// Whether the compiler optimised it: times of one that is not say nothing.
    pub optimised: bool,
    /// Universal time, to the second.
    pub date: String,
}

impl Made {
    pub fn now() -> Self {
        let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
            let line = text.lines().find(|line| line.starts_with("model name"))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        });
        Self {
            machine: format!("{}, {OS}", processor.unwrap_or_else(|| ARCH.to_owned())),
            threads: rayon::current_num_threads(),
            command: command(std::env::args()),
            version: env!("CARGO_PKG_VERSION"),
            optimised: !cfg!(debug_assertions),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        }
    }
}

/// The command line, by the program's name alone: where it lies is nobody's business.
pub(in crate::cli) fn command(mut args: impl Iterator<Item = String>) -> String {
    let program = args.next().unwrap_or_default();
    let program = Path::new(&program).file_stem().unwrap_or_default();
    let plain = |c: char| c.is_alphanumeric() || "-_./:=,+@%".contains(c);
    let quoted = |arg: String| match !arg.is_empty() && arg.chars().all(plain) {
        true => arg,
        false => format!("'{}'", arg.replace('\'', "'\\''")),
    };
    let mut line = program.to_string_lossy().into_owned();
    for arg in args {
        line = format!("{line} {}", quoted(arg));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_can_be_given_to_a_shell_again() {
        let args = ["/some/where/lightbvh", "trade", "--scene", "my scene's.glb"];
        let line = command(args.into_iter().map(String::from));
        assert_eq!(line, r"lightbvh trade --scene 'my scene'\''s.glb'");
        let args = ["lightbvh", "a&b.gltf", "a$b", "a\nb", "", "C:/x=1,2"];
        let line = command(args.into_iter().map(String::from));
        assert_eq!(line, "lightbvh 'a&b.gltf' 'a$b' 'a\nb' '' C:/x=1,2");
    }
}
