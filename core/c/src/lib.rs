#![doc = include_str!("../README.md")]
#![warn(unsafe_op_in_unsafe_fn)]

mod edit;
mod error;
mod held;
mod ids;
mod query;
mod raw;
mod rebuilder;

pub use edit::*;
pub use error::{Status, lightbvh_last_error};
pub use held::{Handle, Held, lightbvh_create, lightbvh_free};
pub use ids::{CInstance, CMesh};
pub use query::*;
pub use rebuilder::*;
