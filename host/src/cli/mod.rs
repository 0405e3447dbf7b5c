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
mod variance;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::cli::table::news;
use crate::error::HostError;
use crate::render::uninterrupted;

/// Commands by purpose; clap groups options alone.
const GROUPS: &str = "\
Pictures and files:  demo, render, export
Checks:              verify, stability, inspect, info
Measurements:        compare, trade, variance, bench";

/// A two-level light BVH on the CPU and on Vulkan devices, compared bit for bit.
#[derive(Debug, Parser)]
#[command(name = "lightbvh", version, after_help = GROUPS)]
struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Build, animate, refit and render a street on the CPU and every device
    Demo(OnDevices<demo::Args>),
    /// Render a frame of a scene
    Render(OnDevices<render::Args>),
    /// Write a scene as a .glb file
    Export(export::Args),
    /// Compare every device with the CPU, bit for bit, and check every invariant of the trees
    ///
    /// Without a device only invariants are checked: a note says so, or with LIGHTBVH_REQUIRE_VULKAN=1 an error.
    Verify(OnDevices<verify::Args>),
    /// Check every extreme that the light BVH must survive against stated bounds
    Stability(OnDevices<stability::Args>),
    /// Report what a scene requires and the smallest model that is sufficient, and check it
    Inspect(Json<inspect::Args>),
    /// List the Vulkan devices and whether their arithmetic is exact
    Info(OnDevices<Nothing>),
    /// Compare all methods over an animation as the paper does: errors and times
    Compare(OnDevices<compare::Args>),
    /// Measure speed against accuracy for importances, builders, levels and candidates
    Trade(Json<trade::Args>),
    /// Measure the exact variance of one sample on families of scenes, by peers' importances too
    Variance(Json<variance::Args>),
    /// Time build, refit, sample and pmf, or frames of moving lights, or the worst scenes
    Bench(OnDevices<bench::Args>),
}

/// A command that prints a table or one JSON object.
#[derive(Debug, clap::Args)]
struct Json<A: clap::Args> {
    #[command(flatten)]
    own: A,
    /// Print one JSON object instead of tables.
    #[arg(long)]
    json: bool,
}

/// The same of a command that runs devices.
#[derive(Debug, clap::Args)]
struct OnDevices<A: clap::Args> {
    #[command(flatten)]
    own: Json<A>,
    /// Use only the Vulkan device of this index or name (a part of it is enough).
    #[arg(long, value_name = "INDEX|NAME")]
    device: Option<String>,
}

/// No options of its own.
#[derive(Debug, clap::Args)]
struct Nothing {}

/// Options that all commands share.
#[derive(Default)]
struct Context {
    json: bool,
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

/// A command by its options.
type Run<A> = fn(&Context, &A) -> Result<Outcome, HostError>;

impl<A: clap::Args> Json<A> {
    fn run(self, run: Run<A>) -> (bool, Result<Outcome, HostError>) {
        let context = Context {
            json: self.json,
            ..Context::default()
        };
        (self.json, run(&context, &self.own))
    }
}

impl<A: clap::Args> OnDevices<A> {
    fn run(self, run: Run<A>) -> (bool, Result<Outcome, HostError>) {
        let context = Context {
            json: self.own.json,
            device: self.device,
        };
        (context.json, run(&context, &self.own.own))
    }
}

impl Command {
    /// Runs the command. Returns whether its output is JSON, and its outcome.
    fn run(self) -> (bool, Result<Outcome, HostError>) {
        match self {
            Self::Demo(args) => args.run(demo::run),
            Self::Render(args) => args.run(render::run),
            Self::Export(args) => (false, export::run(&args)),
            Self::Verify(args) => args.run(verify::run),
            Self::Stability(args) => args.run(stability::run),
            Self::Inspect(args) => args.run(inspect::run),
            Self::Info(args) => args.run(|context, Nothing {}| info::run(context)),
            Self::Compare(args) => args.run(compare::run),
            Self::Trade(args) => args.run(trade::run),
            Self::Variance(args) => args.run(variance::run),
            Self::Bench(args) => args.run(bench::run),
        }
    }
}

/// Ends the process with 128 and the number of the signal, as shells have it.
#[allow(unsafe_code)]
fn leave() {
    // SAFETY: nothing is shared, and no code of this process runs after it; `exit` would run a driver's cleanup beside the threads that
    // use it.
    unsafe { libc::_exit(130) }
}

/// Runs the program.
pub fn main() -> ExitCode {
    // Without the handler, a signal may leave a temporary file.
    let _ = ctrlc::set_handler(|| uninterrupted(leave));
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => {
            // clap's own exit code for wrong usage is 2, as ours.
            let code = error.exit_code();
            let _ = error.print();
            return ExitCode::from(u8::try_from(code).unwrap_or(2));
        }
    };
    let (is_json, result) = args.command.run();
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Bad) => ExitCode::from(1),
        // The reader of a table has closed it, as `head` does; an object that is cut is none.
        Err(HostError::Output(error)) if !is_json && error.kind() == std::io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
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
            assert!(GROUPS.contains(start), "{start} is of no group");
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
