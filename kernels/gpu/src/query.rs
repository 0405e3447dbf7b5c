//! What the kernels `sample` and `pmf` are asked, for each kind of receiver.

use bytemuck::{Pod, Zeroable};
use lightbvh::importance::{Cell, LinkedPoint};
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
        let Random64 { high, low } = random.into();
        Self {
            point,
            words: [high, low],
        }
    }

    /// Asks `pmf` what `LightTree::pmf(point, light, instance)` gives: as in a `SampledLight`, or the number
    /// `lights_of(id).start + part` and `id.index()`.
    #[must_use]
    pub fn pmf(point: ShadingPoint, light: u32, instance: u32) -> Self {
        Self {
            point,
            words: [light, instance],
        }
    }
}

/// What `sample_cell` and `pmf_cell` are asked ([`KernelSet::CELLS`](crate::KernelSet::CELLS)).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct CellQuery {
    /// The cell to be lit, of the domain of [`Cell::checked`].
    pub cell: Cell,
    /// As of [`Query`].
    pub words: [u32; 2],
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

impl LinkedQuery {
    /// As [`Query::sample`].
    #[must_use]
    pub fn sample(receiver: LinkedPoint<ShadingPoint>, random: impl Into<Random64>) -> Self {
        Self::of(receiver, Query::sample(receiver.point, random))
    }

    /// As [`Query::pmf`].
    #[must_use]
    pub fn pmf(receiver: LinkedPoint<ShadingPoint>, light: u32, instance: u32) -> Self {
        Self::of(receiver, Query::pmf(receiver.point, light, instance))
    }

    fn of(receiver: LinkedPoint<ShadingPoint>, Query { point, words }: Query) -> Self {
        let mask = receiver.mask;
        Self { point, mask, words }
    }
}

/// The push constants of `sample` and `pmf` for `count` queries of the tree of [`Frame::words`](crate::Frame::words).
#[must_use]
pub fn query_push(count: u32, tree: TreeWords) -> [u32; 10] {
    let mut push = [count; 10];
    push[1..].copy_from_slice(&bytemuck::cast::<_, [u32; 9]>(tree));
    push
}
