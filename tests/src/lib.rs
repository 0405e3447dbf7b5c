//! Generators, oracles and statistics shared by the tests.

pub mod generate;
pub mod gltf_files;
pub mod statistics;
