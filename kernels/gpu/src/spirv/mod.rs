//! SPIR-V modules read word by word: what a kernel takes, and whether it can be read at all.

mod access;
mod interface;
pub(crate) mod words;

pub use interface::{BufferUse, Interface};
pub use words::{ModuleError, words};
