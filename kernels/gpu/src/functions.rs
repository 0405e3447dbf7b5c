//! Functions for shaders in other languages (`docs/shaders.md`): `lightbvh_sample` and `lightbvh_pmf`, for points and for cells, and `lightbvh_light_point`, over the
//! buffers of a [`Mirror`](crate::Mirror) of a `LightBvh`, and its [words](lightbvh::TreeWords).

/// In WGSL: text to put before a shader of one's own.
pub const WGSL: &str = include_str!("../shaders/lightbvh.wgsl");
/// In GLSL 4.50 for Vulkan: text to put after `#version`.
pub const GLSL: &str = include_str!("../shaders/lightbvh.glsl");
/// In HLSL, shader model 6.0, and Slang.
pub const HLSL: &str = include_str!("../shaders/lightbvh.hlsl");
/// In the Metal shading language, 2.4.
pub const METAL: &str = include_str!("../shaders/lightbvh.metal");
