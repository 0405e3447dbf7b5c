//! The reference renderer's parts, plain functions that the render kernel and the CPU share. No light BVH here: how a
//! light is chosen comes in through [`pick::PickLight`].
//!
//! | module | what |
//! |---|---|
//! | [`grid`] | the grid that coordinates lie on, so that no product of lengths is subnormal |
//! | [`ray`], [`block`], [`trace`] | a ray against a box and a triangle; triangles of the ray BVH; the walk through it |
//! | [`camera`], [`material`] | where rays start; how surfaces reflect |
//! | [`emitters`] | the lights, read through their instances |
//! | [`emitter`] | a light as the renderer shows it, of triangles alone or of any kind |
//! | [`area`] | a point on the chosen light, and what it contributes |
//! | [`textures`], [`picture`] | textures: colours, glow, what is cut out |
//! | [`pick`] | the choice of a light: the trait, uniform and by power |
//! | [`picks`] | the lights of a pixel's samples |
//! | [`numbers`] | the numbers that lights and points on them are drawn by |
//! | [`params`], [`pixel`] | what pixels have in common; what a ray sees |
//! | [`direct`] | the light that a surface reflects once |
//! | [`lobe`] | directions with a known density |
//! | [`path`] | light along whole paths |
//!
//! Results agree to the bit between processors in this domain: coordinates at most [`grid::MAX_COORDINATE`] in magnitude
//! and on the grid (the host's ray-BVH builder sees to both), radiances as in [`lightbvh::light`], albedo and specular
//! weight in [0, 1]. Outside of it nothing panics, and every loop still ends.

pub mod area;
pub mod block;
pub mod camera;
pub mod direct;
pub mod emitter;
pub mod emitters;
pub mod grid;
pub mod lobe;
pub mod material;
pub mod numbers;
pub mod params;
pub mod path;
pub mod pick;
pub mod picks;
pub mod picture;
pub mod pixel;
pub mod ray;
pub mod textures;
pub mod trace;
