//! Host.
#![deny(unsafe_code)]

pub mod compare;
pub mod vulkan;
