//! A pass: dispatches in order, each one seeing what those before it wrote.

use super::buffer::Binding;
use super::error::VulkanError;
use super::kernel::Kernel;
use super::shared::Shared;
use lightbvh_gpu::groups;
use std::sync::Arc;

/// What one submission does. It keeps what it uses alive.
#[derive(Default)]
pub struct Pass {
    pub(crate) dispatches: Vec<Dispatch>,
}

/// One kernel over a number of items.
pub(crate) struct Dispatch {
    pub(crate) kernel: Arc<Kernel>,
    pub(crate) buffers: Vec<Binding>,
    pub(crate) push: Vec<u8>,
    pub(crate) invocations: u32,
}

impl Pass {
    /// An empty pass.
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends a dispatch: `buffers` in the order of the kernel's bindings, `push` the bytes of its push constants,
    /// `invocations` at least one for each item (0 does nothing).
    pub fn dispatch(
        &mut self,
        kernel: &Arc<Kernel>,
        buffers: &[Binding],
        push: &[u8],
        invocations: u32,
    ) -> &mut Self {
        self.dispatches.push(Dispatch {
            kernel: Arc::clone(kernel),
            buffers: buffers.to_vec(),
            push: push.to_vec(),
            invocations,
        });
        self
    }
}

impl Dispatch {
    /// Whether everything fits together, before anything is recorded.
    pub(crate) fn check(&self, shared: &Shared) -> Result<(), VulkanError> {
        let kernel = &self.kernel;
        let foreign = |what: String| VulkanError::ForeignObject {
            what,
            device: shared.probe.name.clone(),
        };
        let bad = |what: String| VulkanError::BadDispatch {
            kernel: kernel.name.clone(),
            what,
        };
        if kernel.device != shared.id {
            return Err(foreign(format!("kernel `{}`", kernel.name)));
        }
        let Some(_) = groups(self.invocations, kernel.interface.workgroup[0]) else {
            return Err(bad(format!(
                "{} invocations are more than 32 bits can number",
                self.invocations
            )));
        };
        let (given, expected) = (self.push.len(), kernel.interface.push_constants as usize);
        if given != expected {
            return Err(bad(format!(
                "it takes {expected} bytes of push constants, {given} were given"
            )));
        }
        let (given, expected) = (self.buffers.len(), kernel.interface.buffers.len());
        if given != expected {
            return Err(bad(format!("it takes {expected} buffers, {given} were given")));
        }
        for (binding, (buffer, declared)) in self.buffers.iter().zip(&kernel.interface.buffers).enumerate() {
            if buffer.memory.shared.id != shared.id {
                return Err(foreign(format!("buffer {binding} of kernel `{}`", kernel.name)));
            }
            let (given, expected) = (buffer.element_bytes, declared.stride);
            if expected as usize != given {
                return Err(bad(format!(
                    "buffer {binding} has elements of {given} bytes, not {expected}"
                )));
            }
        }
        Ok(())
    }
}
