//! A two-level light BVH for sampling one of many moving lights in real-time ray tracing — one source for CPU and GPU.
//!
//! A **light BVH** is a tree over lights whose nodes say where the lights below are, which way they face and how much
//! they emit (Conty Estevez & Kulla 2018). To light a point, a walk from the root chooses at each node among the
//! children by their *importance*, an estimate of what they contribute there, and ends at one light with a known
//! probability: a low-variance estimate of the light of all, for the price of a walk. The estimate is positive wherever
//! there is flux, so no light is lost (`docs/walk.md`).
//!
//! **Two levels** make it fit for moving lights (Moreau, Pharr & Clarberg 2019; Freire & Pereira 2023): each emissive
//! mesh has a bottom-level tree over its triangles that is refitted, and edits change a top-level tree over the instances leaf by
//! leaf, while a thread builds whole trees in the background (`docs/dynamics.md`).
//!
//! **The bits agree.** Nodes, refit and traversal are written with operations that Vulkan defines exactly ([`exact`]), in
//! a fixed order, so the same source compiled by rust-gpu gives the same words on a device as natively.
//!
//! | | |
//! |---|---|
//! | [`LightBvh`], [`AnyLights`], [`MaskedLights`] | light BVHs over triangles, over lights of every kind, and with masks: each a [`Bvh`], which owns its arrays: edits, refit of what changed, samples and their probabilities |
//! | [`EmissiveTriangle`], [`Lights`], [`Transform`] | lights, and where their meshes stand |
//! | [`ShadingPoint`], [`Random64`], [`SampledLight`], [`LightPoint`] | what is lit, the number that chooses, the light chosen, a point on it |
//! | [`Rebuilder`] | builds whole trees on a thread in the background, or within the frame if there are no threads |
//! | [`bvh`], [`build`] | edits, ids, views, plans and files; builders |
//! | [`light`] | lights of other kinds: points, spots, spheres, rectangles, discs; points on them |
//! | [`importance`], [`node`] | what children are chosen by, and what nodes store of them |
//! | [`requirements`] | what a scene requires, and the smallest model that is sufficient |
//! | [`tree`] | the models that light BVHs are made of; a light BVH as borrowed arrays, the same on devices |
//! | [`refit`], [`exact`] | passes and arithmetic, the same on devices |
//! | [`reservoir`] | one of several light samples by what they would contribute (resampled importance sampling) |
//! | [`error`] | why input is refused |
//! | [`device`] | unstable: what the kernels, the host and the tests of this workspace share with the tree |
//!
//! `core/examples` has programs, the first page of the repository a frame with its edits.
//!
//! # Papers
//! - A. Conty Estevez, C. Kulla. Importance sampling of many lights with adaptive tree splitting. HPG 2018.
//! - P. Moreau, M. Pharr, P. Clarberg. Dynamic many-light sampling for real-time ray tracing. HPG 2019.
//! - P. Freire, J. M. Pereira. Dynamic many-light importance sampling for real-time ray tracing. 2023 ("the paper").
//! - B. Bitterli, C. Wyman, M. Pharr, P. Shirley, A. Lefohn, W. Jarosz. Spatiotemporal reservoir resampling for real-time
//!   ray tracing with dynamic direct lighting. 2020 ("ReSTIR").
//! - M. Pharr, W. Jakob, G. Humphreys. Physically based rendering, 4th edition, section 12.6. 2023.
#![no_std]
#![forbid(unsafe_code)]
// Device code indexes: iterators over arrays do not survive rust-gpu's pointer rules (no array-to-slice unsizing).
// `clamp` panics where the bounds cross, and a panic path in a kernel costs registers and inlining.
#![allow(clippy::needless_range_loop, clippy::manual_clamp)]
#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod device;
pub mod error;
pub mod exact;
pub mod importance;
pub mod light;
pub mod node;
pub mod refit;
pub mod reservoir;
pub mod tree;

#[cfg(feature = "alloc")]
pub mod build;
#[cfg(feature = "alloc")]
pub mod bvh;
#[cfg(feature = "alloc")]
pub mod requirements;

mod beam;
mod bounds;
mod choose;
mod cone;
mod domain;
mod emission;
mod halves;
mod instance;
#[cfg(test)]
mod kit;
mod model;
mod moments;
mod point;
#[cfg(not(target_arch = "spirv"))]
mod prefetch;
mod random;
mod summary;
mod trail;
mod traverse;
mod unroll;
mod vector;
mod weight;
mod widest;

#[cfg(feature = "alloc")]
mod levels;
#[cfg(feature = "alloc")]
mod lights;
#[cfg(feature = "alloc")]
mod sweep;
#[cfg(feature = "alloc")]
mod transform;

#[cfg(feature = "std")]
pub use bvh::Rebuilder;
#[cfg(feature = "alloc")]
#[doc(inline)]
pub use bvh::{AnyLights, Bvh, LightBvh, MaskedLights};
#[cfg(feature = "alloc")]
pub use lights::Lights;

pub use point::ShadingPoint;
pub use random::Random64;
pub use traverse::SampledLight;

// Short paths to what is documented in a module.
#[cfg(feature = "alloc")]
#[doc(hidden)]
pub use build::{BuildParams, Heuristic};
#[cfg(feature = "std")]
#[doc(hidden)]
pub use bvh::RebuilderParams;
#[cfg(feature = "alloc")]
#[doc(hidden)]
pub use bvh::{Edit, InstanceId, MeshId};
#[doc(hidden)]
pub use error::*;
#[doc(hidden)]
pub use importance::{Defensive, Eq4, Flux, FluxOverDistance, Glossy, ImportanceModel, Moments};
#[doc(hidden)]
pub use light::{EmissiveTriangle, LightPoint};
#[doc(hidden)]
pub use node::{
    BoundsNode, CompactNode, LightBounds, LightMoments, LightNode, MomentLayout, MomentNode, Node, Summary,
    TwoSidedMomentNode,
};
#[doc(hidden)]
pub use point::{GlossyPoint, Receiver};
#[doc(hidden)]
pub use refit::Instance;
#[cfg(feature = "alloc")]
#[doc(hidden)]
pub use transform::Transform;
#[doc(hidden)]
pub use tree::{DefaultTree, INVALID, LightTree, TreeWords};

/// The snippets of documents, compiled and run.
#[cfg(all(doctest, feature = "std"))]
mod documents {
    #[doc = include_str!("../../README.md")]
    struct FirstPage;
    #[doc = include_str!("../../docs/lights.md")]
    struct Lights;
}
