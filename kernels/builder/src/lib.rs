//! From rust-gpu's output to the modules that lightbvh ships.
//!
//! The program `build-kernels` compiles every entry point of `lightbvh-kernels`, then for each module
//! 1. [`decorate`] forbids contraction and re-association of every float operation, strips what is not needed, takes
//!    empty arms out of branches,
//! 2. [`verify`] refuses whatever Vulkan does not define to the bit on every device,
//! 3. [`manifest`] records sources, compiler, hashes and the parameters' [`names`] next to the committed modules,
//! 4. [`table`] writes them all down as constants of the package `lightbvh-gpu`.
//!
//! This library is everything but the compiler, so the tests hold the committed modules to the same rules without
//! it. The compiler itself is behind the features `prebuilt-backend` and `upstream` (`kernels/README.md`).
#![forbid(unsafe_code)]

mod branches;
pub mod decorate;
pub mod files;
pub mod manifest;
pub mod model;
pub mod names;
pub mod shader;
pub mod sources;
pub mod table;
pub mod verify;

#[cfg(feature = "compile")]
pub mod compile;

/// Why modules cannot be built or do not belong together: a sentence that says what, where and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Error(pub String);

/// Reads SPIR-V words into a module.
fn load(words: &[u32]) -> Result<rspirv::dr::Module, Error> {
    rspirv::dr::load_words(words).map_err(|state| {
        Error(format!(
            "not a readable SPIR-V module: {state}; rebuild it with build-kernels"
        ))
    })
}
