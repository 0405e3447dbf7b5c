//! ReSTIR's steps for one pixel, plain functions that the kernels and the CPU share (B. Bitterli et al., "Spatiotemporal
//! reservoir resampling for real-time ray tracing with dynamic direct lighting", 2020; below: ReSTIR).
//!
//! | module | step |
//! |---|---|
//! | [`surface`] | what the later steps need of the surface that a pixel sees |
//! | [`target`] | p̂: the luminance that one light sample reflects to the viewer, shadows left out |
//! | [`initial`] | candidates from any [`PickLight`](super::pick::PickLight), one chosen, its visibility |
//! | [`temporal`] | the reservoir of the frame before |
//! | [`spatial`] | the reservoirs of neighbours |
//! | [`combine`] | how reservoirs are counted: [`combine::Combine`] |
//! | [`shade`] | the last shadow ray and the colour |
//!
//! # What is unbiased, and when
//!
//! A reservoir's weight W is one over a density, in expectation, for every sample that is lit *and visible* from its pixel's
//! surface (in its frame): that is the invariant. Each step keeps it under [`combine::Combine::is_unbiased`]:
//! - *initial*: by resampled importance sampling (ReSTIR section 3); the shadow ray then removes samples outside of the
//!   invariant only.
//! - *temporal*: Algorithm 6 over two reservoirs. Whether the earlier one could have produced a sample is asked of the frame
//!   it comes from: with that frame's lights, surface, and a shadow ray through that frame's geometry. So lights, geometry
//!   and camera may move; lights may come and go as far as the remap tells. Reflectances must not change.
//! - *spatial*: Algorithm 6 over the pixel and its neighbours, a shadow ray from each neighbour. The own shadow ray is left
//!   to *shade*: where it is blocked, the weight is wrong, and *shade* makes it zero, for the picture and for the next frame.
//!
//! The weights are those of ReSTIR section 4.3, the balance heuristic with targets for densities, instead of 1 / Z: they
//! have less variance at the same rays. The sums of counts and the limit of the history change no expectation, because
//! counts do not depend on which samples were drawn.
//!
//! Without it a reservoir is counted whether it could have produced the sample or not: darker where pixels do
//! not see the same lights (ReSTIR section 4.2), and without a ray.

pub mod combine;
pub mod initial;
pub mod painted;
pub mod shade;
pub mod spatial;
pub mod surface;
pub mod target;
pub mod temporal;

use bytemuck::{Pod, Zeroable};
use lightbvh::exact::hash;
use lightbvh::reservoir::Reservoir;

/// What all pixels of a frame have in common besides the scene; 56 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RestirParams {
    /// Columns, 1 to 2^24.
    pub width: u32,
    /// Rows, 1 to 2^24.
    pub height: u32,
    /// Chooses all random numbers but those of [`jitter`](Self::jitter); another one for each frame.
    pub seed: u32,
    /// Chooses the points within the pixels that camera rays go through.
    pub jitter: u32,
    /// Radiance of what no surface covers, linear RGB, W/(m² sr).
    pub background: [f32; 3],
    /// Candidates per pixel, at most 2^16 (ReSTIR: 32).
    pub candidates: u32,
    /// Most samples that the history counts for (ReSTIR: 20 times the candidates); 0 leaves it out.
    pub history: u32,
    /// Neighbours that a spatial pass looks at, at most 2^16 (ReSTIR: 5 when biased, 3 when unbiased).
    pub neighbors: u32,
    /// How far away they may be, pixels (ReSTIR: 30); at most 2^20.
    pub radius: u32,
    /// Number of the spatial pass, from 0.
    pub spatial_pass: u32,
    /// 1 where the remaps of lights hold entries, 0 where every light kept its index.
    pub remapped: u32,
    /// 1 where the next frame is to know that the last shadow ray was blocked, as unbiased reuse needs; 0 leaves the
    /// sample in the history (ReSTIR Algorithm 5), where neighbours may see it: less dark under biased reuse.
    pub drops_occluded: u32,
}

const _: () = assert!(size_of::<RestirParams>() == 56);

/// The reservoir of a pixel, and what it cost; 28 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PixelReservoir {
    /// The reservoir.
    pub reservoir: Reservoir,
    /// Shadow rays traced for this pixel in this frame so far.
    pub shadow_rays: u32,
}

const _: () = assert!(size_of::<PixelReservoir>() == 28);

/// The steps' random numbers are apart by these.
const INITIAL: u32 = 0x1b56_c4e9;
const TEMPORAL: u32 = 0x7d2d_59f3;
const SPATIAL: u32 = 0x3c6e_f372;
const SHADE: u32 = 0x2545_f491;

/// Where the random numbers of a step begin for pixel `index`.
#[inline]
fn step_seed(params: &RestirParams, index: u32, step: u32) -> u32 {
    hash(hash(index).wrapping_add(hash(params.seed ^ step)))
}
