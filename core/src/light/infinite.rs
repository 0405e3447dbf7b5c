//! Lights without end, which no tree holds: an environment map all around, and suns.
//!
//! They stand beside the light BVH. An [`Environment`] chooses a texel of its map, and a direction within it, by the light that comes from
//! there; a [`DistantLight`] has one direction. A [`Split`] says with which probability a sample goes to the tree, to the environment
//! or to a sun, and the product of its share and what the chosen one says is the probability of the sample, exactly:
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use lightbvh::light::infinite::{DistantLight, Environment, Split};
//!
//! // A sky that is brighter above, 64 texels wide.
//! let sky = Environment::from_fn(64, |direction| [0.2 + 0.8 * direction[1].max(0.0); 3]).unwrap();
//! let sun = DistantLight { direction: [0.6, 0.8, 0.0], irradiance: [500.0; 3] };
//! // What a point receives from each on average: the tree's, the sky's, the sun's. Estimates of the engine's own; positive where there is light.
//! let split = Split::new([100.0, 2.0, 400.0]);
//! let share = split.choose(0x9000_0000_u32);
//! let pmf = match share.index {
//!     0 => 0.0, // bvh.sample(&point, share.rest)
//!     1 => sky.map().sample(share.rest, [0.3, 0.7]).density,
//!     _ => 1.0,
//! };
//! assert!(share.pmf * pmf > 0.0);
//! # }
//! ```
//!
//! All of it is shared code: the same bits on every processor.

#[cfg(feature = "alloc")]
mod counts;
mod distant;
mod environment;
mod octahedron;
#[cfg(feature = "alloc")]
mod owned;
mod split;
#[cfg(all(test, feature = "std"))]
mod tests;

pub use distant::DistantLight;
pub use environment::{EnvironmentMap, EnvironmentSample, MAX_LEVELS};
pub use octahedron::{direction_at, place_of};
#[cfg(feature = "alloc")]
pub use owned::Environment;
pub use split::{Share, Split};
