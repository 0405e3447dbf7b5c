//! SPIR-V modules read word by word: what a kernel takes, and whether it can be read at all.

mod interface;
pub(crate) mod words;

pub use interface::{BufferUse, Interface};
pub use words::{ModuleError, words};

/// What a kernel does with the elements of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// It reads them, or none.
    Read,
    /// It writes them, and may read them.
    Write,
}
