//! Vulkan compute without a window: devices, buffers, kernels, passes, and the question whether a device is exact.
//!
//! The files follow a device's life: instance, probe, device, buffers, kernels, passes, submission. All of the
//! host's `unsafe` code is in this module; what it needs to be sound is checked here and not left to callers, with one
//! exception that Vulkan itself makes: the instructions of a SPIR-V module are trusted like any program's.
//!
//! ```no_run
//! use lightbvh_host::vulkan::{Device, Options, Pass};
//! # fn main() -> Result<(), lightbvh_host::vulkan::VulkanError> {
//! let list = Device::list()?;
//! let device = Device::open(list.select("llvmpipe")?, Options::default())?;
//! let kernel = device.kernel("self_test")?;
//! let input = device.upload(&[[1u32, 2, 3]])?;
//! let output = device.output::<u32>(38)?;
//! let mut pass = Pass::new();
//! pass.dispatch(&kernel, &[input.bind(), output.bind()], &1u32.to_ne_bytes(), 1);
//! let timings = device.run(&pass)?;
//! println!("{:?}: {:x?}", timings.wall, output.read()?);
//! # Ok(())
//! # }
//! ```
#![allow(unsafe_code)]
#![warn(clippy::undocumented_unsafe_blocks)]

mod buffer;
mod device;
mod error;
mod fault;
mod instance;
mod kernel;
mod memory;
mod pass;
mod pipeline;
mod probe;
mod queue;
mod run;
mod self_test;
mod shared;
mod submit;
mod validation;

pub use buffer::{Binding, Buffer, UNWRITTEN};
pub use device::{Device, DeviceInfo, DeviceList, Options};
pub use error::VulkanError;
pub use kernel::Kernel;
pub use pass::Pass;
pub use probe::{Driver, Probe};
pub use run::Timings;
pub use self_test::{Exactness, Finding};
