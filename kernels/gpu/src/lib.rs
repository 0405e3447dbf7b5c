#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

extern crate alloc;

mod buffer;
mod device;
mod dispatch;
mod float_environment;
mod float_modes;
mod frame;
mod kernel;
mod memory_model;
mod query;
mod refit;
#[cfg(feature = "kernels")]
mod set;
pub mod spirv;
#[cfg(feature = "kernels")]
#[rustfmt::skip]
pub mod table;

pub use buffer::{Buffer, TREE_WORDS, tree_words};
pub use device::{PUSH_CONSTANTS, REQUIRED_FEATURES, STORAGE_BUFFERS, VULKAN};
pub use dispatch::{ROW_GROUPS, groups};
pub use float_environment::FloatEnvironment;
pub use float_modes::{FloatControls, with_float_modes};
pub use frame::{Copy, Frame, Mirror};
pub use kernel::{Access, Binding, Kernel};
pub use memory_model::without_vulkan_memory_model;
pub use query::{Query, query_push};
pub use refit::{Dispatch, Pass, Refit};
#[cfg(feature = "kernels")]
pub use set::{EQ4, KernelSet, MOMENTS};
#[cfg(feature = "kernels")]
pub use table::KERNELS;
