//! Functions of lightbvh for shaders (`docs/shaders.md`), as a package for WESL.
//!
//! ```wgsl
//! import lightbvh::lightbvh_sample;
//! ```
//!
//! [`lightbvh::PACKAGE`] goes to `Wesl::add_package`.

wesl::wesl_pkg!(pub lightbvh);
