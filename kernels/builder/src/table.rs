//! The table of all kernels as Rust source, for the package `lightbvh-gpu`.

use std::fmt::Write;

use lightbvh_gpu::Access;

use crate::reflect::KernelInterface;

/// The table's file, below the repository's root.
pub const FILE: &str = "kernels/gpu/src/table.rs";

const HEAD: &str = "\
//! All kernels. Written by `build-kernels` from the modules in `spirv`; edits are lost.

use crate::kernel::Access::{Read, ReadWrite, Write};
use crate::kernel::{Binding, Kernel};
";

/// The table of `kernels`, each from the module of its name, in their order.
#[must_use]
pub fn render(kernels: &[KernelInterface]) -> String {
    let mut text = HEAD.to_owned();
    for kernel in kernels {
        // Writing to a string does not fail.
        let _ = one(&mut text, kernel);
    }
    text.push_str("\n/// All kernels, sorted by name.\npub static KERNELS: &[&Kernel] = &[\n");
    for kernel in kernels {
        let _ = writeln!(text, "    &{},", constant(kernel));
    }
    text.push_str("];\n");
    text
}

fn one(text: &mut String, kernel: &KernelInterface) -> std::fmt::Result {
    let name = &kernel.entry_point;
    let [x, y, z] = kernel.workgroup;
    writeln!(text, "\n/// Kernel `{name}`.")?;
    writeln!(text, "pub static {}: Kernel = Kernel {{", constant(kernel))?;
    writeln!(text, "    name: \"{name}\",")?;
    writeln!(text, "    bytes: include_bytes!(\"../spirv/{name}.spv\"),")?;
    writeln!(text, "    bindings: &[")?;
    for (binding, (name, buffer)) in kernel.buffers.iter().enumerate() {
        let access = match buffer.access {
            Access::Read => "Read",
            Access::Write => "Write",
            Access::ReadWrite => "ReadWrite",
        };
        let stride = buffer.stride;
        writeln!(
            text,
            "        Binding {{ binding: {binding}, name: \"{name}\", access: {access}, stride: {stride} }},"
        )?;
    }
    writeln!(text, "    ],")?;
    writeln!(text, "    push_constants: {},", kernel.push_constants)?;
    writeln!(text, "    workgroup: [{x}, {y}, {z}],")?;
    writeln!(text, "}};")
}

/// Name of the kernel's constant.
fn constant(kernel: &KernelInterface) -> String {
    kernel.entry_point.to_uppercase()
}
