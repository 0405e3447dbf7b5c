//! The command line. Tables go to standard output, or one JSON object with `--json`; progress and notes go to standard
//! error. Exit status: 0 done, 1 results differ or an invariant is violated, 2 the input or the machine is at fault,
//! 130 after an interrupt.

mod bench;
mod compare;
mod demo;
mod devices;
mod export;
mod info;
mod inspect;
mod measure;
mod reading;
mod render;
mod stability;
mod table;
mod target;
mod trade;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::cli::table::news;
use crate::error::HostError;
use crate::render::uninterrupted;

/// A two-level light BVH on the CPU and on Vulkan devices, compared bit for bit.
#[derive(Debug, Parser)]
#[command(name = "lightbvh", version)]
struct Args {
    #[command(flatten)]
    context: Context,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Build, animate, refit and render a street on the CPU and every device
    Demo(demo::Args),
    /// Render a frame of a scene
    Render(render::Args),
    /// Write a scene as a .glb file
    Export(export::Args),
    /// Compare every device with the CPU, bit for bit, and check every invariant of the trees
    ///
    /// Without a device only invariants are checked: a note says so, or with LIGHTBVH_REQUIRE_VULKAN=1 an error.
    Verify(verify::Args),
    /// Check every extreme that the light BVH must survive against stated bounds
    Stability(stability::Args),
    /// Report what a scene requires and the smallest model that is sufficient, and check it
    Inspect(inspect::Args),
    /// List the Vulkan devices and whether their arithmetic is exact
    Info,
    /// Compare all methods over an animation as the paper does: errors and times
    Compare(compare::Args),
    /// Measure speed against accuracy for importances, builders, levels and candidates
    Trade(trade::Args),
    /// Time build, refit, sample and pmf, or frames of moving lights, or the worst scenes
    Bench(bench::Args),
}

/// Options that commands share.
#[derive(Debug, Default, clap::Args)]
struct Context {
    /// Print one JSON object instead of tables.
    #[arg(long, global = true)]
    json: bool,
    /// Use only the Vulkan device of this index or name (a part of it is enough).
    #[arg(long, global = true, value_name = "INDEX|NAME")]
    device: Option<String>,
}

/// How a command that ran to its end went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// As it should.
    Good,
    /// Results differ, or an invariant is violated.
    Bad,
}

impl Outcome {
    fn good_if(good: bool) -> Self {
        if good { Self::Good } else { Self::Bad }
    }
}

impl Command {
    fn run(self, context: &Context) -> Result<Outcome, HostError> {
        let usage = |option, needs| Err(HostError::Usage { option, needs });
        match self {
            Self::Export(_) if context.json => usage("--json", "a command that reports something"),
            Self::Export(_) | Self::Inspect(_) | Self::Trade(_) if context.device.is_some() => {
                usage("--device", "a command that runs devices")
            }
            Self::Demo(args) => demo::run(context, &args),
            Self::Render(args) => render::run(context, &args),
            Self::Export(args) => export::run(&args),
            Self::Verify(args) => verify::run(context, &args),
            Self::Stability(args) => stability::run(context, &args),
            Self::Inspect(args) => inspect::run(context, &args),
            Self::Info => info::run(context),
            Self::Compare(args) => compare::run(context, &args),
            Self::Trade(args) => trade::run(context, &args),
            Self::Bench(args) => bench::run(context, &args),
        }
    }
}

/// Runs the program.
pub fn main() -> ExitCode {
    // 128 and the number of the signal, as shells have it. Without the handler, a signal may leave a temporary file.
    let _ = ctrlc::set_handler(|| uninterrupted(|| std::process::exit(130)));
    // clap's own exit code for wrong usage is 2, as ours.
    let args = Args::parse();
    match args.command.run(&args.context) {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Bad) => ExitCode::from(1),
        Err(error) => {
            news!("lightbvh: {error}");
            ExitCode::from(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn commands_and_options_have_a_line_of_100_characters() {
        Args::command().debug_assert();
        for command in Args::command().get_subcommands() {
            let start = command.get_name();
            let about = command.get_about().map(ToString::to_string).unwrap_or_default();
            assert!((1..=90).contains(&about.chars().count()), "{start}: {about}");
            for option in command.get_arguments() {
                let text = option.get_long_help().or(option.get_help());
                let length = text.map_or(0, |text| text.to_string().chars().count());
                assert!((1..=100).contains(&length), "{start} {option}: {length}");
            }
        }
    }
}
