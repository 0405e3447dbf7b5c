//! Host.

pub mod render;
