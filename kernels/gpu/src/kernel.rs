//! A compiled kernel and what it takes.

pub use crate::dispatch::{ROW_GROUPS, groups};

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

/// What a kernel does with the elements of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// It reads them, or none.
    Read,
    /// It writes them, and what they were does not matter.
    Write,
    /// It reads and writes them.
    ReadWrite,
}

impl Kernel {
    /// The kernel of that name.
    #[cfg(feature = "kernels")]
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        crate::KERNELS.iter().copied().find(|kernel| kernel.name == name)
    }

    /// The binding of that name.
    #[must_use]
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|binding| binding.name == name)
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

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::spirv::Interface;
    use crate::{KERNELS, Kernel};

    #[test]
    fn the_table_is_what_the_modules_declare() {
        for kernel in KERNELS {
            assert_eq!(kernel.bytes.len() % 4, 0, "{}", kernel.name);
            let read = Interface::read(&kernel.words()).expect(kernel.name);
            assert_eq!(read.entry_point, kernel.name);
            assert_eq!(read.workgroup, kernel.workgroup, "{}", kernel.name);
            assert_eq!(read.push_constants, kernel.push_constants, "{}", kernel.name);
            let declared: Vec<_> = read
                .buffers
                .iter()
                .map(|buffer| buffer.expect(kernel.name))
                .collect();
            let listed: Vec<_> = kernel
                .bindings
                .iter()
                .map(|binding| crate::spirv::BufferUse {
                    access: binding.access,
                    stride: binding.stride,
                })
                .collect();
            assert_eq!(declared, listed, "{}", kernel.name);
            assert!(
                (0..)
                    .zip(kernel.bindings)
                    .all(|(i, binding)| binding.binding == i)
            );
        }
    }

    #[test]
    fn kernels_are_found_by_name() {
        for &kernel in KERNELS {
            assert_eq!(Kernel::named(kernel.name), Some(kernel));
        }
        assert_eq!(Kernel::named("no_such_kernel"), None);
    }

    #[test]
    fn a_pass_writes_its_results_and_no_input() {
        let access = |kernel, name| Kernel::named(kernel).unwrap().binding(name).unwrap().access;
        for kernel in ["sample", "pmf", "sample_eq4", "pmf_eq4"] {
            assert_eq!(access(kernel, "results"), Access::Write, "{kernel}");
        }
        for kernel in ["refit_bottom", "refit_top", "refit_bottom_eq4", "refit_top_eq4"] {
            assert_eq!(access(kernel, "nodes"), Access::Read, "{kernel}");
            assert_eq!(access(kernel, "children"), Access::Write, "{kernel}");
            assert_eq!(access(kernel, "list"), Access::Read, "{kernel}");
        }
        for kernel in ["refit_nodes", "refit_nodes_eq4"] {
            assert_eq!(access(kernel, "nodes"), Access::ReadWrite, "{kernel}");
            assert_eq!(access(kernel, "children"), Access::Read, "{kernel}");
            assert_eq!(access(kernel, "list"), Access::Read, "{kernel}");
        }
        assert_eq!(access("refit_roots", "roots"), Access::ReadWrite);
    }

    /// An array has one stride, whichever kernel of a choice of layout takes it.
    #[test]
    fn equal_names_are_arrays_of_equal_strides() {
        let mut seen: Vec<(&str, &str, u32)> = Vec::new();
        for kernel in KERNELS {
            let suffix = ["_eq4", "_any", "_linked"]
                .into_iter()
                .find(|suffix| kernel.name.ends_with(suffix));
            for binding in kernel.bindings {
                // Each pass has results of its own; nodes and lights have the layout of the choice.
                if binding.name != "results" {
                    let is_own = match suffix {
                        Some("_any") => {
                            matches!(binding.name, "nodes" | "children" | "triangles")
                        }
                        Some("_linked") => {
                            matches!(binding.name, "nodes" | "children" | "triangles" | "queries")
                        }
                        _ => matches!(binding.name, "nodes" | "children"),
                    };
                    let layout = suffix.filter(|_| is_own).unwrap_or("");
                    seen.push((binding.name, layout, binding.stride));
                }
            }
        }
        seen.sort_unstable();
        seen.dedup();
        assert!(
            seen.windows(2)
                .all(|pair| (pair[0].0, pair[0].1) != (pair[1].0, pair[1].1)),
            "{seen:?}"
        );
    }
}
