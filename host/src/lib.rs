//! Host.

pub mod scene;
