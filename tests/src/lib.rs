//! Tests.

pub mod devices;
