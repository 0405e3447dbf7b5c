//! What the kernels `sample` and `pmf` are asked, for each kind of receiver.

use bytemuck::{Pod, Zeroable};
use lightbvh::{Random64, ShadingPoint, TreeWords};

/// An element of the buffer `queries`. `sample` answers with a [`SampledLight`](lightbvh::SampledLight), `pmf` with an `f32`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Query {
    /// The point to be lit, of the domain of [`ShadingPoint::checked`].
    pub point: ShadingPoint,
    /// For `sample` the random number, its high word first; for `pmf` the light and its instance.
    pub words: [u32; 2],
}

impl Query {
    /// Asks `sample` what `LightTree::sample(point, random)` gives.
    #[must_use]
    pub fn sample(point: ShadingPoint, random: impl Into<Random64>) -> Self {
        let random = random.into();
        Self {
            point,
            words: [random.high, random.low],
        }
    }
}

/// What `sample_linked` and `pmf_linked` are asked ([`KernelSet::LINKED`](crate::KernelSet::LINKED)), as [`Query`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LinkedQuery {
    /// The point to be lit, of the domain of [`ShadingPoint::checked`].
    pub point: ShadingPoint,
    /// Its bits: [`LinkedPoint::mask`](lightbvh::importance::LinkedPoint::mask).
    pub mask: u32,
    /// As of [`Query`].
    pub words: [u32; 2],
}

/// The push constants of `sample` and `pmf` for `count` queries of the tree of [`Frame::words`](crate::Frame::words).
#[must_use]
pub fn query_push(count: u32, tree: TreeWords) -> [u32; 10] {
    let mut push = [count; 10];
    push[1..].copy_from_slice(&bytemuck::cast::<_, [u32; 9]>(tree));
    push
}
