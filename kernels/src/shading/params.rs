//! What the pixels of an image have in common.

use bytemuck::{Pod, Zeroable};

/// What all pixels of an image have in common besides the scene; push constants, 52 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RenderParams {
    /// Columns, 1 to 2^24.
    pub width: u32,
    /// Rows, 1 to 2^24.
    pub height: u32,
    /// Lights sampled for each pixel, at most 2^24.
    pub samples: u32,
    /// Number of the first of them among `all`: a pixel may have more samples than one image takes, which images then take one after the
    /// other. Paths have none.
    pub first: u32,
    /// Samples of a pixel that are spread evenly among each other; 0 counts as `samples`.
    pub all: u32,
    /// Candidates of each light sample, at most [`MAX_CANDIDATES`](super::direct::MAX_CANDIDATES); 0 counts as 1, which is a
    /// light as picked. Paths take no candidates.
    pub candidates: u32,
    /// Chooses the random numbers of the lights. Images that differ in nothing else show the same surfaces.
    pub seed: u32,
    /// Which of `parts` this image is, whose mean has the samples of all: their numbers lie between each other's. Paths have none.
    pub part: u32,
    /// How many such images there are; 0 counts as 1.
    pub parts: u32,
    /// Chooses the points within the pixels that camera rays go through, evenly spread for successive numbers: the mean over several is smooth at
    /// edges.
    pub jitter: u32,
    /// Radiance of what no surface covers, linear RGB, W/(m² sr).
    pub background: [f32; 3],
}

const _: () = assert!(size_of::<RenderParams>() == 52);
