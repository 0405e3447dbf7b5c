//! Where, when and by what a report was made.

use std::env::consts::{ARCH, OS};
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
        let args: Vec<String> = std::env::args().skip(1).collect();
        Self {
            machine: format!("{}, {OS}", processor.unwrap_or_else(|| ARCH.to_owned())),
            threads: rayon::current_num_threads(),
            // By the program's name alone, wherever it lies.
            command: format!("lightbvh {}", args.join(" ")),
            version: env!("CARGO_PKG_VERSION"),
            optimised: !cfg!(debug_assertions),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        }
    }
}
