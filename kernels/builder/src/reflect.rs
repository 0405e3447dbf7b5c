//! The interface of a shipped module: one that keeps the conventions of all kernels.

use lightbvh_gpu::spirv::{BufferUse, Interface};

use crate::Error;

/// What a kernel takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelInterface {
    /// Name of the entry point.
    pub entry_point: String,
    /// Invocations of a workgroup in x, y and z.
    pub workgroup: [u32; 3],
    /// Name and use of the storage buffers, by binding.
    pub buffers: Vec<(String, BufferUse)>,
    /// Size of the push constants in bytes; 0 when there are none.
    pub push_constants: u32,
}

/// Reads the interface of a module with one entry point; `names` are those of its buffers.
///
/// # Errors
/// When the words are no module, or its interface is not one of the kind that all kernels share.
pub fn reflect(words: &[u32], names: &[String]) -> Result<KernelInterface, Error> {
    let interface = Interface::read(words).map_err(|error| Error(error.to_string()))?;
    let entry_point = interface.entry_point;
    if names.len() != interface.buffers.len() {
        return Err(Error(format!(
            "entry point `{entry_point}` has {} buffers and {} names of them",
            interface.buffers.len(),
            names.len()
        )));
    }
    let mut buffers = Vec::new();
    for (binding, (name, buffer)) in names.iter().zip(interface.buffers).enumerate() {
        let Some(buffer) = buffer else {
            return Err(Error(format!(
                "entry point `{entry_point}`: binding {binding} is no array; kernels use bindings 0, 1, .. of set 0 in parameter order"
            )));
        };
        buffers.push((name.clone(), buffer));
    }
    Ok(KernelInterface {
        entry_point,
        workgroup: interface.workgroup,
        buffers,
        push_constants: interface.push_constants,
    })
}
