//! A small engine that knows nothing of lights: an instance, a device, buffers, pipelines and commands, all made here with `ash`. The
//! examples drive lightbvh with it; yours takes its place.

pub mod buffer;
pub mod commands;
pub mod gpu;
pub mod pipeline;
pub mod words;
pub mod world;

/// What the examples fail with: a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;
