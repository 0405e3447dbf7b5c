//! A two-level light BVH for sampling one of many moving lights in real-time ray tracing — one source for CPU and GPU.
//!
//! A **light BVH** is a tree over lights whose nodes say where the lights below are, which way they face and how much
//! they emit (Conty Estevez & Kulla 2018). To light a point, a walk from the root chooses at each node among the
//! children by their *importance*, an estimate of what they contribute there, and ends at one light with a known
//! probability: a low-variance estimate of the light of all, for the price of a walk. The estimate is positive wherever
//! there is flux, so no light is lost (`docs/walk.md`).
//!
//! **Two levels** make it fit for moving lights (Moreau, Pharr & Clarberg 2019; Freire & Pereira 2023): each emissive
//! mesh has a bottom-level tree over its triangles that is only refitted, and a small top-level tree over the meshes is
//! refitted or rebuilt every frame.
//!
//! **The bits agree.** Nodes, refit and traversal are written with operations that Vulkan defines exactly ([`exact`]), in
//! a fixed order, so the same source compiled by rust-gpu gives the same words on a device as natively.
//!
//! | module | what |
//! |---|---|
//! | [`exact`], [`vector`] | the arithmetic |
//! | [`light`], [`bounds`], [`cone`], [`point`] | lights and what is known of sets of them; the receiver |
//! | [`summary`], [`importance`] | what nodes store of their children, and what these are chosen by |
//! | [`node`], [`tree`], [`trail`] | layout of nodes, links, bit trails |
//! | [`refit`] | new summaries on an unchanged topology |
//! | [`traverse`] | sampling, and the probability of any light |
//! | [`instance`] | leaves of the top level with a space of their own |
//! | [`reservoir`] | resampling of light samples, over candidates and over other reservoirs (ReSTIR) |
//! | `bvh`, `transform` (feature `alloc`) | the light BVH that owns its arrays: edits, instances, refit of what changed, rebuilds |
//! | `lights`, `build`, `validate` (feature `alloc`) | lights that stand in the world, builders, invariants |
//! | `rebuilder` (feature `std`) | rebuilds on a thread beside the frame, or within it where there are no threads |
//!
#![cfg_attr(
    feature = "std",
    doc = r#"
```
use lightbvh::{EmissiveTriangle, LightBvh, Rebuilder, ShadingPoint, Transform};

// A lamp of one triangle that shines down: vertices in metres, radiance in W/(m² sr).
let lamp = EmissiveTriangle {
    p: [[0.0, 3.0, 0.0], [0.1, 3.0, 0.0], [0.0, 3.0, 0.1]],
    radiance: [9.0; 3],
    mesh: 0,
    flags: 0,
};
let mut bvh = LightBvh::default();
let mesh = bvh.add_mesh(vec![lamp])?;                                    // validated once
let lamps = (0..100)
    .map(|i| bvh.add_instance(mesh, Transform::at([i as f32, 0.0, 0.0])))
    .collect::<Result<Vec<_>, _>>()?;
let mut rebuilder = Rebuilder::default();
for frame in 0..3 {
    rebuilder.begin_frame(&mut bvh)?;                                    // swaps in what was built beside the last frame
    bvh.set_transform(lamps[7], Transform::at([7.0, frame as f32, 0.0]))?; // or many edits at once: bvh.apply(edits)
    bvh.refit();                                                         // what the edits touch; or on a device, by bvh.plan()
    rebuilder.end_frame(&bvh);

    let point = ShadingPoint { p: [5.0, 0.0, 0.0], n: [0.0, 1.0, 0.0] };
    let sampled = bvh.sample(&point, 0x1234_5678_u32);                   // a light, its instance, its exact probability
    let pmf = bvh.pmf(&point, sampled.light, sampled.instance);
    assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
    let triangle = bvh.triangle(sampled.light, sampled.instance);        // in the world
    assert!(triangle.is_some());
}
# Ok::<(), Box<dyn std::error::Error>>(())
```
"#
)]
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

pub mod bounds;
pub mod cone;
pub mod exact;
mod halves;
pub mod importance;
pub mod instance;
pub mod light;
pub mod moments;
pub mod node;
pub mod point;
mod prefetch;
pub mod refit;
pub mod reservoir;
pub mod summary;
pub mod trail;
pub mod traverse;
pub mod tree;
pub mod vector;

#[cfg(feature = "alloc")]
pub mod build;
#[cfg(feature = "alloc")]
pub mod bvh;
#[cfg(feature = "alloc")]
pub mod levels;
#[cfg(feature = "alloc")]
pub mod lights;
#[cfg(feature = "alloc")]
pub mod sweep;
#[cfg(feature = "alloc")]
pub mod transform;
#[cfg(feature = "alloc")]
pub mod validate;
#[cfg(feature = "alloc")]
mod widest;

#[cfg(feature = "std")]
pub mod rebuilder;

#[cfg(feature = "alloc")]
pub use build::{BuildParams, Effort, Heuristic};
#[cfg(feature = "alloc")]
pub use bvh::{Bvh, Edit, EditError, InstanceId, LightBvh, MeshId, ReadError};
#[cfg(feature = "alloc")]
pub use lights::{Lights, LightsError};
#[cfg(feature = "std")]
pub use rebuilder::{RebuildError, Rebuilder, RebuilderParams};
#[cfg(feature = "alloc")]
pub use transform::Transform;
#[cfg(feature = "alloc")]
pub use validate::Violation;

pub use bounds::LightBounds;
pub use importance::{Defensive, Eq4, FluxOverDistance, ImportanceModel, Moments};
pub use instance::Instance;
pub use light::{EmissiveTriangle, LightError};
pub use moments::LightMoments;
pub use node::{
    BoundsNode, CompactNode, FullMomentNode, FullNode, LeanMomentNode, LightNode, MomentLayout, MomentNode,
};
pub use point::{PointError, ShadingPoint};
pub use summary::Summary;
pub use traverse::{Random64, SampledLight};
pub use tree::{INVALID, LightTree};

/// The snippets of the first page, compiled and run.
#[cfg(all(doctest, feature = "std"))]
#[doc = include_str!("../../README.md")]
struct FirstPage;
