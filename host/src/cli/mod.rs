//! The command line. Tables go to standard output, or one JSON object with `--json`; progress and notes go to standard
//! error. Exit status: 0 done, 1 results differ or an invariant is violated, 2 the input or the machine is at fault.

mod bench;
mod compare;
mod demo;
mod devices;
mod export;
mod frames;
mod gallery;
mod info;
mod inspect;
mod numbers;
mod progress;
mod range;
mod render;
mod soak;
mod stability;
mod table;
mod target;
mod times;
mod trade;
mod validate;
mod variance;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::cli::table::news;
use crate::error::HostError;

/// A two-level light BVH on the CPU and on Vulkan devices, compared bit for bit.
#[derive(Debug, Parser)]
#[command(name = "lightbvh", version)]
struct Args {
    #[command(subcommand)]
    command: Command,
    /// Print one JSON object instead of tables.
    #[arg(long, global = true)]
    json: bool,
    /// Use only the Vulkan device of this index or name (a part of it is enough).
    #[arg(long, global = true, value_name = "INDEX|NAME")]
    device: Option<String>,
    /// Run devices under the Khronos validation layer; any message of it is an error.
    #[arg(long, global = true)]
    validation: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Build, animate, refit, sample and render a street on the CPU and every device, and compare.
    Demo(demo::Args),
    /// Render a frame of a scene.
    Render(render::Args),
    /// Compare refit, sample, pmf, render and ReSTIR on every device with the CPU, word for word. Without a device there is
    /// nothing to compare: a note says so, or with LIGHTBVH_REQUIRE_VULKAN=1 an error.
    Verify(verify::Args),
    /// Time build, refit, sample and pmf, and measure what accuracy costs.
    Bench(bench::Args),
    /// Compute the variance of one light sample exactly, scene by scene. Columns `of 8` and `of 32` are the squared error of
    /// the mean of so many candidates by one number, `split 8` and `split 32` that of adaptive splitting, over the square of
    /// what there is; `nothing` is the share of samples that contribute nothing. Means are those of a few points where variance
    /// is great: compare them by thousands of points.
    Variance(variance::Args),
    /// Measure speed against accuracy for each choice: structure, importance, width, builder, candidates.
    Trade(trade::Args),
    /// Say what a scene requires and the smallest model that is sufficient, and check that it is.
    Inspect(inspect::Args),
    /// Compare stratified and low-discrepancy numbers with independent ones.
    Numbers(numbers::Args),
    /// Compare the methods over an animation as the paper does: errors, times, graphs and close-ups.
    Compare(compare::Args),
    /// Render scenes by every method in equal time, next to references: a page with a sheet of pictures for each scene. Exit
    /// status 1: a scene could not be rendered, and the page says which.
    Gallery(gallery::Args),
    /// Check every extreme that the light BVH must survive, on the CPU and every device, against stated bounds.
    Stability(stability::Args),
    /// Run many frames of random edits beside rebuilds, each held against its bound, and compare every device with the CPU.
    Soak(soak::Args),
    /// List the Vulkan devices and whether their arithmetic is exact.
    Info,
    /// Check every invariant of the light BVHs of a scene, over its lights as they stand in the world. No instances share a
    /// mesh there, so a light takes more bytes than in the tables of `inspect` and `trade`.
    Validate(validate::Args),
    /// Write a scene as a .glb file.
    Export(export::Args),
}

impl Command {
    /// Whether it ever runs a device.
    fn runs_devices(&self) -> bool {
        !matches!(
            self,
            Self::Variance(_) | Self::Inspect(_) | Self::Numbers(_) | Self::Validate(_) | Self::Export(_)
        )
    }
}

/// What all commands share.
struct Context {
    json: bool,
    device: Option<String>,
    validation: bool,
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

/// Runs the program.
pub fn main() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => {
            // clap's own exit code for wrong usage is 2, as ours.
            let code = error.exit_code();
            let _ = error.print();
            return ExitCode::from(u8::try_from(code).unwrap_or(2));
        }
    };
    let named = [
        ("--device", args.device.is_some()),
        ("--validation", args.validation),
    ];
    if let Some((option, _)) = named
        .iter()
        .find(|(_, is_given)| *is_given && !args.command.runs_devices())
    {
        news!(
            "lightbvh: {option} is for commands that run devices, and this one runs on the CPU alone; leave it out"
        );
        return ExitCode::from(2);
    }
    let context = Context {
        json: args.json,
        device: args.device,
        validation: args.validation,
    };
    let result = match &args.command {
        Command::Demo(args) => demo::run(&context, args),
        Command::Render(args) => render::run(&context, args),
        Command::Verify(args) => verify::run(&context, args),
        Command::Bench(args) => bench::run(&context, args),
        Command::Variance(args) => variance::run(&context, args),
        Command::Trade(args) => trade::run(&context, args),
        Command::Inspect(args) => inspect::run(&context, args),
        Command::Numbers(args) => numbers::run(&context, args),
        Command::Compare(args) => compare::run(&context, args),
        Command::Gallery(args) => gallery::run(&context, args),
        Command::Stability(args) => stability::run(&context, args),
        Command::Soak(args) => soak::run(&context, args),
        Command::Info => info::run(&context),
        Command::Validate(args) => validate::run(&context, args),
        Command::Export(args) => export::run(&context, args),
    };
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Bad) => ExitCode::from(1),
        // The reader of our output has closed it, as `head` does.
        Err(HostError::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            news!("lightbvh: {error}");
            ExitCode::from(2)
        }
    }
}
