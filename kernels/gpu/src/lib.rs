#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

extern crate alloc;

mod buffer;
pub mod device;
mod dispatch;
mod float_environment;
pub mod float_modes;
mod frame;
#[cfg(feature = "kernels")]
pub mod functions;
pub mod kernel;
mod memory_model;
pub mod query;
mod refit;
#[cfg(feature = "kernels")]
pub mod self_test;
#[cfg(feature = "kernels")]
mod set;
// For the kernels' builder and the host.
#[doc(hidden)]
pub mod spirv;
#[cfg(feature = "kernels")]
#[doc(hidden)]
#[rustfmt::skip]
pub mod table;

pub use buffer::DeviceBuffer;
pub use frame::{Frame, Mirror, Step};
pub use refit::Pass;
#[cfg(feature = "kernels")]
pub use set::{EQ4, KernelSet, MOMENTS};
pub use spirv::ModuleError;
#[cfg(feature = "kernels")]
#[doc(inline)]
pub use table::{KERNELS, LIGHT_POINTS};

// Short paths to what is documented in a module.
#[doc(hidden)]
pub use device::{REQUIRED_FEATURES, STORAGE_BUFFERS, without_vulkan_memory_model};
#[doc(hidden)]
pub use float_modes::{FloatControls, FloatEnvironment, with_float_modes};
#[doc(hidden)]
pub use kernel::{Access, Binding, Kernel, ROW_GROUPS, groups};
#[doc(hidden)]
pub use query::{CellQuery, LinkedQuery, Query, query_push};
