//! The tables of kernels as Rust source: of the tree's passes in the package `lightbvh-gpu`, of the renderer's in the host.

use std::fmt::Write;

use lightbvh_gpu::spirv::Interface;

const HEAD: &str = "\
//! Compiled kernels. Written by `build-kernels` from the modules in `spirv`; edits are lost.

// Constant, name, bytes of push constants, workgroup: for each binding its name, access and stride.
CRATE::kernels! {
";

/// The table of `kernels`, each with the names of its buffers, in their order, for a crate that knows `lightbvh-gpu` as `gpu`.
#[must_use]
pub fn render<'a>(gpu: &str, kernels: impl IntoIterator<Item = (&'a [String], &'a Interface)>) -> String {
    let mut text = HEAD.replace("CRATE", gpu);
    for (names, kernel) in kernels {
        let name = &kernel.entry_point;
        let buffers: Vec<String> = (names.iter().zip(&kernel.buffers).enumerate())
            .map(|(binding, (name, buffer))| {
                format!("{binding} {name} {:?} {}", buffer.access, buffer.stride)
            })
            .collect();
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "    {} \"{name}\" {} {:?}: {};",
            name.to_uppercase(),
            kernel.push_constants,
            kernel.workgroup,
            buffers.join(", ")
        );
    }
    text.push_str("}\n");
    text
}
