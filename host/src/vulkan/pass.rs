//! A pass: what the host writes, then dispatches in order, each one seeing all that was before it.

use super::buffer::{Binding, Buffer};
use super::error::VulkanError;
use super::kernel::Kernel;
use super::shared::Shared;
use bytemuck::Pod;
use lightbvh_gpu::groups;
use std::ops::Range;
use std::sync::Arc;

/// What one submission does: buffers filled and copied, then bytes of the host's written, then dispatches. It keeps what it
/// uses alive.
#[derive(Clone, Default)]
pub struct Pass<'a> {
    pub(crate) fills: Vec<Binding>,
    pub(super) carries: Vec<(Binding, Binding, u64)>,
    pub(crate) writes: Vec<Write<'a>>,
    pub(crate) dispatches: Vec<Dispatch>,
}

/// Bytes of the host's, and where they go.
#[derive(Clone)]
pub(crate) struct Write<'a> {
    pub(crate) target: Binding,
    /// First byte of the target.
    pub(crate) at: u64,
    data: Data<'a>,
}

#[derive(Clone)]
enum Data<'a> {
    Borrowed(&'a [u8]),
    Shared(Arc<[u8]>, Range<usize>),
}

impl Write<'_> {
    pub(crate) fn data(&self) -> &[u8] {
        match &self.data {
            Data::Borrowed(data) => data,
            Data::Shared(all, range) => &all[range.clone()],
        }
    }
}

/// One kernel over a number of items.
#[derive(Clone)]
pub(crate) struct Dispatch {
    pub(crate) kernel: Arc<Kernel>,
    pub(crate) buffers: Vec<Binding>,
    pub(crate) push: Vec<u8>,
    pub(crate) invocations: u32,
}

impl<'a> Pass<'a> {
    /// An empty pass.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets every word of a buffer, its room too, to [`UNWRITTEN`](super::UNWRITTEN), before anything else.
    pub fn clear<T: Pod>(&mut self, buffer: &Buffer<T>) -> &mut Self {
        self.fills.push(buffer.bind());
        self
    }

    /// Copies what `from` holds to the start of `to`, as far as both reach; before anything is written.
    pub fn carry<T: Pod>(&mut self, from: &Buffer<T>, to: &Buffer<T>) -> &mut Self {
        let bytes = from.byte_len().min(to.byte_len()) as u64;
        if bytes > 0 {
            self.carries.push((from.bind(), to.bind(), bytes));
        }
        self
    }

    /// Replaces elements of `buffer` from `first` on, before any dispatch. Parts that are written in one pass do not overlap.
    /// All that is written goes through the staging ring, the regions of a buffer by one copy and many short ones by one
    /// dispatch, on every device.
    ///
    /// # Errors
    /// [`VulkanError::WrongLength`] when they do not fit.
    pub fn write<T: Pod>(
        &mut self,
        buffer: &Buffer<T>,
        first: usize,
        data: &'a [T],
    ) -> Result<&mut Self, VulkanError> {
        if first > buffer.len() || data.len() > buffer.len() - first {
            return Err(VulkanError::WrongLength {
                given: first.saturating_add(data.len()),
                held: buffer.len(),
            });
        }
        if !data.is_empty() {
            self.writes.push(Write {
                target: buffer.bind(),
                at: (first * size_of::<T>()) as u64,
                data: Data::Borrowed(bytemuck::cast_slice(data)),
            });
        }
        Ok(self)
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

    /// The same, with copies of the bytes that it writes.
    pub(crate) fn into_owned(self) -> Pass<'static> {
        // Run by run, not byte by byte.
        let mut all = Vec::with_capacity(self.bytes());
        self.writes
            .iter()
            .for_each(|write| all.extend_from_slice(write.data()));
        let all: Arc<[u8]> = all.into();
        let mut end = 0;
        let own = |write: Write<'_>| {
            let range = end..end + write.data().len();
            end = range.end;
            Write {
                target: write.target,
                at: write.at,
                data: Data::Shared(Arc::clone(&all), range),
            }
        };
        Pass {
            writes: self.writes.into_iter().map(own).collect(),
            fills: self.fills,
            carries: self.carries,
            dispatches: self.dispatches,
        }
    }

    /// Bytes that it writes.
    pub(crate) fn bytes(&self) -> usize {
        self.writes.iter().map(|write| write.data().len()).sum()
    }

    /// Number of dispatches.
    pub fn len(&self) -> usize {
        self.dispatches.len()
    }

    /// Whether nothing is to be done.
    pub fn is_empty(&self) -> bool {
        self.dispatches.is_empty()
            && self.writes.is_empty()
            && self.fills.is_empty()
            && self.carries.is_empty()
    }

    /// Whether everything fits together, before anything is recorded. Returns the writes, sorted by buffer and place.
    pub(super) fn check(&self, shared: &Shared) -> Result<Vec<&Write<'a>>, VulkanError> {
        for dispatch in &self.dispatches {
            dispatch.check(shared)?;
        }
        let targets = self.writes.iter().map(|write| &write.target);
        let carried = self.carries.iter().flat_map(|(from, to, _)| [from, to]);
        for binding in targets.chain(&self.fills).chain(carried) {
            if binding.memory.shared.id != shared.id {
                return Err(VulkanError::ForeignObject {
                    what: "a buffer that a pass writes".into(),
                    device: shared.probe.name.clone(),
                });
            }
        }
        let mut sorted: Vec<&Write<'a>> = self.writes.iter().collect();
        sorted.sort_by_key(|write| (Arc::as_ptr(&write.target.memory), write.at));
        for pair in sorted.windows(2) {
            let (one, other) = (pair[0], pair[1]);
            if Arc::ptr_eq(&one.target.memory, &other.target.memory)
                && one.at + one.data().len() as u64 > other.at
            {
                return Err(VulkanError::OverlappingWrites {
                    device: shared.probe.name.clone(),
                    first: other.at,
                    end: one.at + one.data().len() as u64,
                });
            }
        }
        Ok(sorted)
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
            let given = buffer.element_bytes;
            let stride = declared.map(|declared| declared.stride);
            if let Some(expected) = stride.filter(|stride| *stride as usize != given) {
                return Err(bad(format!(
                    "buffer {binding} has elements of {given} bytes, not {expected}"
                )));
            }
        }
        Ok(())
    }
}
