#![doc = include_str!("../README.md")]
//!
//! `include/lightbvh.h` documents functions and structures.
#![warn(unsafe_op_in_unsafe_fn)]

mod edit;
mod error;
mod held;
mod ids;
mod kernel;
mod light;
mod mirror;
mod query;
mod raw;
mod rebuilder;
mod scene;

pub use edit::*;
pub use error::{Status, lightbvh_last_error};
pub use held::{Handle, Held};
pub use ids::CId;
pub use kernel::*;
pub use light::CLight;
pub use mirror::*;
pub use query::*;
pub use rebuilder::*;
pub use scene::{Scene, lightbvh_create, lightbvh_create_from_words, lightbvh_free};
