//! Entry points.
#![cfg_attr(target_arch = "spirv", no_std)]

pub mod render;
pub mod shading;
