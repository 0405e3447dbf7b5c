//! A compiled kernel and what it takes.

pub use crate::dispatch::{ROW_GROUPS, groups};
pub use crate::spirv::Access;

use alloc::vec::Vec;

use crate::float_modes::{FloatControls, with_float_modes};
use crate::spirv::words;

/// A compiled kernel: a SPIR-V 1.5 module with one compute entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// Name of the kernel and of the module's entry point.
    pub name: &'static str,
    /// The module, little endian, a multiple of four bytes. [`words`](Self::words) are what a graphics API takes.
    pub bytes: &'static [u8],
    /// The storage buffers: bindings 0, 1, .. of descriptor set 0.
    pub bindings: &'static [Binding],
    /// Size of the push constants, bytes; 0 where there are none.
    pub push_constants: u32,
    /// Invocations in a workgroup: x, y and z.
    pub workgroup: [u32; 3],
}

/// A storage buffer that a kernel takes: an array without a length of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Its binding in descriptor set 0.
    pub binding: u32,
    /// Name of the kernel's parameter. Equal names in different kernels are the same array.
    pub name: &'static str,
    /// What the kernel does with it.
    pub access: Access,
    /// Bytes from one element to the next.
    pub stride: u32,
}

/// The kernels of a list, from the modules in `../spirv`: a constant each, and all as `KERNELS`.
#[doc(hidden)]
#[macro_export]
macro_rules! kernels {
    ($($constant:ident $name:literal $push:literal $workgroup:tt: $($binding:literal $buffer:ident $access:ident $stride:literal),*;)*) => {
        $(
            #[doc = concat!("Kernel `", $name, "`.")]
            pub static $constant: $crate::Kernel = $crate::Kernel {
                name: $name,
                bytes: include_bytes!(concat!("../spirv/", $name, ".spv")),
                bindings: &[$($crate::Binding {
                    binding: $binding,
                    name: stringify!($buffer),
                    access: $crate::Access::$access,
                    stride: $stride,
                }),*],
                push_constants: $push,
                workgroup: $workgroup,
            };
        )*

        /// All kernels, sorted by name.
        pub static KERNELS: &[&$crate::Kernel] = &[$(&$constant),*];
    };
}

impl Kernel {
    /// The kernel of that name.
    #[cfg(feature = "kernels")]
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        crate::KERNELS.iter().copied().find(|kernel| kernel.name == name)
    }

    /// The module's words, for any device.
    #[must_use]
    pub fn words(&self) -> Vec<u32> {
        words(self.bytes)
    }

    /// The module's words for a device of those float controls; see [`with_float_modes`].
    ///
    /// # Panics
    /// Where the bytes are no module; those of this crate are.
    #[must_use]
    pub fn words_for(&self, controls: FloatControls) -> Vec<u32> {
        with_float_modes(&self.words(), controls).expect("a kernel of this crate is a module")
    }

    /// Workgroups to dispatch in x, y and z for a number of invocations; see [`groups`].
    #[must_use]
    pub fn groups(&self, invocations: u32) -> Option<[u32; 3]> {
        groups(invocations, self.workgroup[0])
    }
}
