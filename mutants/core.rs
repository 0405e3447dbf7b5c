//! Every test of core that needs neither the kernels nor the host, as one program: a mutant then costs one compilation and
//! one link (`docs/mutation.md`). The files are those of `tests/tests`; this one stands in for the crates around them.

// What these files name `lightbvh_tests` and `lightbvh_host` are the modules below.
extern crate self as lightbvh_host;
extern crate self as lightbvh_tests;

#[path = "../tests/src/edits.rs"]
pub mod edits;
#[path = "../tests/src/generate.rs"]
pub mod generate;
#[path = "../tests/src/layouts.rs"]
pub mod layouts;
#[path = "../tests/src/oracle.rs"]
pub mod oracle;
#[path = "../tests/src/placing.rs"]
pub mod placing;
#[path = "../tests/src/slowed.rs"]
pub mod slowed;

#[path = "../host/src/stability/geometry.rs"]
pub mod geometry;
#[path = "../host/src/stability/random.rs"]
pub mod random;
#[path = "../host/src/stability/statistics.rs"]
pub mod statistics;

/// Where the host has them.
pub mod stability {
    pub use crate::{geometry, random, statistics};
}

#[path = "../tests/tests/bounds.rs"]
mod bounds;
#[path = "../tests/tests/encoding.rs"]
mod encoding;
#[path = "../tests/tests/instance.rs"]
mod instance;
#[path = "../tests/tests/deep_scene.rs"]
mod later_deep_scene;
#[path = "../tests/tests/refit.rs"]
mod refit;
#[path = "../tests/tests/regressions.rs"]
mod regressions;

// Tests run in the order of their names and stop at the first failure, so those that see most come early.
#[path = "../tests/tests/known_words/mod.rs"]
mod first_known_words;
#[path = "../tests/tests/messages.rs"]
mod first_messages;

// Those that take seconds: for the mutants that the others let pass.
#[path = "../tests/tests/deep.rs"]
mod slow_deep;
#[path = "../tests/tests/exact_exhaustive.rs"]
mod slow_exact_exhaustive;
#[path = "../tests/tests/hostile.rs"]
mod slow_hostile;
#[path = "../tests/tests/importance.rs"]
mod slow_importance;
#[path = "../tests/tests/rebuilder.rs"]
mod slow_rebuilder;
#[path = "../tests/tests/sampling.rs"]
mod slow_sampling;
#[path = "../tests/tests/scene.rs"]
mod slow_scene;
#[path = "../tests/tests/scene_edits.rs"]
mod slow_scene_edits;
#[path = "../tests/tests/sweep.rs"]
mod slow_sweep;
