//! The interface of a shipped module: one that keeps the conventions of all kernels.

use lightbvh_gpu::spirv::{BufferUse, Interface, ModuleError};

/// Why a module's interface is not one that the host offers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReflectError {
    /// The words are no module with one compute entry point and buffers in descriptor set 0.
    #[error(transparent)]
    Module(#[from] ModuleError),
    /// A binding without a buffer.
    #[error(
        "entry point `{entry_point}`: binding {binding} is no array; kernels use bindings 0, 1, .. of set 0 in parameter order"
    )]
    Binding {
        /// The entry point.
        entry_point: String,
        /// The binding.
        binding: usize,
    },
    /// Not a name for each buffer.
    #[error("entry point `{entry_point}` has {buffers} buffers and {names} names of them")]
    Names {
        /// The entry point.
        entry_point: String,
        /// Number of buffers.
        buffers: usize,
        /// Number of names.
        names: usize,
    },
}

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
pub fn reflect(words: &[u32], names: &[String]) -> Result<KernelInterface, ReflectError> {
    let interface = Interface::read(words)?;
    let entry_point = interface.entry_point;
    if names.len() != interface.buffers.len() {
        return Err(ReflectError::Names {
            entry_point,
            buffers: interface.buffers.len(),
            names: names.len(),
        });
    }
    let mut buffers = Vec::new();
    for (binding, (name, buffer)) in names.iter().zip(interface.buffers).enumerate() {
        match buffer {
            Some(buffer) => buffers.push((name.clone(), buffer)),
            None => {
                return Err(ReflectError::Binding { entry_point, binding });
            }
        }
    }
    Ok(KernelInterface {
        entry_point,
        workgroup: interface.workgroup,
        buffers,
        push_constants: interface.push_constants,
    })
}
