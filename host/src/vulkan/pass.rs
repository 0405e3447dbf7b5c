//! A pass: dispatches in order, each one seeing all that those before it wrote.

use super::buffer::Binding;
use super::error::VulkanError;
use super::kernel::Kernel;
use super::shared::Shared;
use lightbvh_kernels::ROW_GROUPS;

/// A list of dispatches.
#[derive(Default)]
pub struct Pass<'a> {
    pub(crate) dispatches: Vec<Dispatch<'a>>,
}

/// One kernel over a number of items.
pub(crate) struct Dispatch<'a> {
    pub(crate) kernel: &'a Kernel,
    pub(crate) buffers: Vec<Binding<'a>>,
    pub(crate) push: Vec<u8>,
    pub(crate) invocations: u32,
}

impl<'a> Pass<'a> {
    /// An empty pass.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends a dispatch: `buffers` in the order of the kernel's bindings, `push` the bytes of its push constants,
    /// `invocations` at least one for each item (0 does nothing).
    pub fn dispatch(
        &mut self,
        kernel: &'a Kernel,
        buffers: &[Binding<'a>],
        push: &[u8],
        invocations: u32,
    ) -> &mut Self {
        self.dispatches.push(Dispatch {
            kernel,
            buffers: buffers.to_vec(),
            push: push.to_vec(),
            invocations,
        });
        self
    }

    /// Number of dispatches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.dispatches.len()
    }

    /// Whether there are no dispatches.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dispatches.is_empty()
    }
}

impl Dispatch<'_> {
    /// Whether everything fits together, before anything is recorded.
    pub(crate) fn check(&self, shared: &Shared) -> Result<(), VulkanError> {
        let kernel = self.kernel;
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
        let (given, expected) = (self.push.len(), kernel.interface.push_bytes as usize);
        if given != expected {
            return Err(bad(format!(
                "it takes {expected} bytes of push constants, {given} were given"
            )));
        }
        let (given, expected) = (self.buffers.len(), kernel.interface.strides.len());
        if given != expected {
            return Err(bad(format!("it takes {expected} buffers, {given} were given")));
        }
        for (binding, (buffer, stride)) in self.buffers.iter().zip(&kernel.interface.strides).enumerate() {
            if buffer.memory.shared.id != shared.id {
                return Err(foreign(format!("buffer {binding} of kernel `{}`", kernel.name)));
            }
            let given = buffer.element_bytes;
            if let Some(expected) = stride.filter(|stride| *stride as usize != given) {
                return Err(bad(format!(
                    "buffer {binding} has elements of {given} bytes, not {expected}"
                )));
            }
        }
        Ok(())
    }
}

/// Workgroups in x and y for `invocations` of a kernel whose workgroups are `width` wide, or `None` if their numbers
/// would not fit 32 bits: invocation `(x, y)` is number `y * ROW_GROUPS * width + x`, and the last row is a whole one.
pub(crate) fn groups(invocations: u32, width: u32) -> Option<[u32; 2]> {
    let groups = invocations.div_ceil(width);
    if groups <= ROW_GROUPS {
        return Some([groups, 1]);
    }
    let rows = groups.div_ceil(ROW_GROUPS);
    let numbered = u64::from(rows) * u64::from(ROW_GROUPS) * u64::from(width);
    (numbered <= 1 << 32).then_some([ROW_GROUPS, rows])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_begin_where_one_is_full() {
        assert_eq!(groups(0, 64), Some([0, 1]));
        assert_eq!(groups(1, 64), Some([1, 1]));
        assert_eq!(groups(64, 64), Some([1, 1]));
        assert_eq!(groups(65, 64), Some([2, 1]));
        assert_eq!(groups(65_535 * 64, 64), Some([65_535, 1]));
        assert_eq!(groups(65_535 * 64 + 1, 64), Some([65_535, 2]));
        assert_eq!(groups(1024 * 65_535 * 64, 64), Some([65_535, 1024]));
    }

    #[test]
    fn numbers_that_would_wrap_are_refused() {
        assert_eq!(groups(1024 * 65_535 * 64 + 1, 64), None);
        assert_eq!(groups(u32::MAX, 64), None);
    }
}
