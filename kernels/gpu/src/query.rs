//! What the kernels `sample` and `pmf` are asked, for each kind of receiver.

use bytemuck::{Pod, Zeroable};
use lightbvh::importance::LinkedPoint;
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

    /// Asks `pmf` what `LightTree::pmf(point, light, instance)` gives.
    #[must_use]
    pub fn pmf(point: ShadingPoint, light: u32, instance: u32) -> Self {
        Self {
            point,
            words: [light, instance],
        }
    }
}

/// What `sample_linked` and `pmf_linked` are asked ([`KernelSet::LINKED`](crate::KernelSet::LINKED)), as [`Query`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LinkedQuery {
    /// The point to be lit, of the domain of [`ShadingPoint::checked`].
    pub point: ShadingPoint,
    /// Its bits: [`LinkedPoint::mask`].
    pub mask: u32,
    /// As of [`Query`].
    pub words: [u32; 2],
}

impl LinkedQuery {
    /// Asks for what `LightTree::sample(receiver, random)` gives.
    #[must_use]
    pub fn sample(receiver: LinkedPoint<ShadingPoint>, random: impl Into<Random64>) -> Self {
        let LinkedPoint { point, mask } = receiver;
        let words = Query::sample(point, random).words;
        Self { point, mask, words }
    }

    /// Asks for what `LightTree::pmf(receiver, light, instance)` gives.
    #[must_use]
    pub fn pmf(receiver: LinkedPoint<ShadingPoint>, light: u32, instance: u32) -> Self {
        let LinkedPoint { point, mask } = receiver;
        let words = [light, instance];
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

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use super::*;
    use crate::{EQ4, KernelSet, MOMENTS};
    use lightbvh::SampledLight;

    const POINT: ShadingPoint = ShadingPoint {
        p: [1.0, 2.0, 3.0],
        n: [0.0, 1.0, 0.0],
    };

    #[test]
    fn queries_and_answers_fit_the_kernels() {
        for (set, query) in [
            (&MOMENTS, size_of::<Query>()),
            (&EQ4, size_of::<Query>()),
            (&KernelSet::ANY, size_of::<Query>()),
            (&KernelSet::LINKED, size_of::<LinkedQuery>()),
        ] {
            for (kernel, answer) in [
                (set.sample, size_of::<SampledLight>()),
                (set.pmf, size_of::<f32>()),
            ] {
                let stride = |name| kernel.binding(name).unwrap().stride as usize;
                assert_eq!(stride("queries"), query, "{}", kernel.name);
                assert_eq!(stride("results"), answer, "{}", kernel.name);
            }
        }
        let push = query_push(7, TreeWords::default());
        assert_eq!(size_of_val(&push), MOMENTS.sample.push_constants as usize);
    }

    #[test]
    fn words_stand_where_the_kernels_read_them() {
        let query = Query::sample(POINT, 0x0123_4567_89ab_cdef_u64);
        assert_eq!(query.words, [0x0123_4567, 0x89ab_cdef]);
        assert_eq!(Query::pmf(POINT, 8, 9).words, [8, 9]);
        let tree: TreeWords = bytemuck::cast([1_u32, 2, 3, 4, 5, 6, 7, 8, 9]);
        assert_eq!(query_push(7, tree), [7, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    }
}
