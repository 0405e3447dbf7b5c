//! Passes `sample` and `pmf` for receivers that say more than a [`ShadingPoint`] does: one with a mask of lights, one that light reaches from
//! both sides, a piece of a ray through a volume. Masks have nodes, and so refits, of their own; the other two walk the default's trees.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::importance::{
    Leveled, Linked, LinkedPoint, RaySegment, SegmentSample, Subtended, Transmissive, TransmissivePoint,
};
use lightbvh::instance::world_light;
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit};
use lightbvh::refit::{self, BlasRoot, Children, LIMITED_ROWS};
use lightbvh::{Defensive, Instance, LightPoint, LightTree, Moments, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::{Node, WIDTH};
use crate::invocation;
use crate::query::{PointsPush, QueryPush};
use crate::refit::{RefitPush, bottom_pass, nodes_pass, roots_pass, top_pass};

/// Node over triangles with masks.
pub type LinkedNode = Lit<LinkedMomentNode<8>, LinkedTriangle>;
/// What lights with masks are chosen by.
pub type LinkedImportance = Linked<Leveled<Moments, 9>>;
/// What a point with two sides chooses by.
pub type TransmissiveImportance = Defensive<Transmissive<Moments>, 6>;
/// What a piece of a ray chooses by.
pub type SegmentImportance = Defensive<Subtended<Moments>, 6>;

/// A point with a mask, and what is asked: 36 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LinkedQuery {
    /// The point to be lit.
    pub point: ShadingPoint,
    /// Its bits, of [`LinkedPoint`].
    pub mask: u32,
    /// As of [`Query`](crate::query::Query).
    pub words: [u32; 2],
}

/// A point with two sides, and what is asked: 40 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TransmissiveQuery {
    /// The point to be lit.
    pub receiver: TransmissivePoint,
    /// As of [`Query`](crate::query::Query).
    pub words: [u32; 2],
}

/// A piece of a ray, and what is asked: 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SegmentQuery {
    /// The piece to be lit.
    pub segment: RaySegment,
    /// As of [`Query`](crate::query::Query).
    pub words: [u32; 2],
}

impl LinkedQuery {
    /// Who asks.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> LinkedPoint<ShadingPoint> {
        LinkedPoint {
            point: self.point,
            mask: self.mask,
        }
    }
}

impl TransmissiveQuery {
    /// Who asks.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> TransmissivePoint {
        self.receiver
    }
}

impl SegmentQuery {
    /// Who asks.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> RaySegment {
        self.segment
    }
}

/// The passes for one kind of receiver.
macro_rules! receiver_passes {
    ($query:ty, $node:ty, $importance:ty, $sample:ident, $sample_name:tt, $pmf:ident, $pmf_name:tt) => {
        /// Chooses a light for each query's receiver.
        #[spirv(compute(threads(64), entry_point_name = $sample_name))]
        pub fn $sample(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[$query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [SampledLight],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree: LightTree<'_, $node, $importance, 8> = push.tree.tree(nodes, instances, trails);
                let query = queries[i as usize];
                let number = Random64 {
                    high: query.words[0],
                    low: query.words[1],
                };
                results[i as usize] = tree.sample_for(&query.receiver(), number);
            }
        }

        /// Evaluates the probability of each query's light for its receiver.
        #[spirv(compute(threads(64), entry_point_name = $pmf_name))]
        pub fn $pmf(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[$query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [f32],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree: LightTree<'_, $node, $importance, 8> = push.tree.tree(nodes, instances, trails);
                let query = queries[i as usize];
                results[i as usize] = tree.pmf_for(&query.receiver(), query.words[0], query.words[1]);
            }
        }
    };
}

receiver_passes!(
    LinkedQuery,
    LinkedNode,
    LinkedImportance,
    sample_linked,
    "sample_linked",
    pmf_linked,
    "pmf_linked"
);
receiver_passes!(
    TransmissiveQuery,
    Node,
    TransmissiveImportance,
    sample_transmissive,
    "sample_transmissive",
    pmf_transmissive,
    "pmf_transmissive"
);
receiver_passes!(
    SegmentQuery,
    Node,
    SegmentImportance,
    sample_segment,
    "sample_segment",
    pmf_segment,
    "pmf_segment"
);

bottom_pass!(
    LinkedNode,
    WIDTH,
    LIMITED_ROWS,
    LinkedTriangle,
    refit_bottom_linked,
    "refit_bottom_linked"
);
roots_pass!(LinkedNode, refit_roots_linked, "refit_roots_linked");
top_pass!(
    LinkedNode,
    WIDTH,
    LIMITED_ROWS,
    refit_top_linked,
    "refit_top_linked"
);
nodes_pass!(
    LinkedNode,
    WIDTH,
    LIMITED_ROWS,
    refit_nodes_linked,
    "refit_nodes_linked"
);

/// As [`light_points`](crate::query::light_points), of triangles with masks.
#[spirv(compute(threads(64), entry_point_name = "light_points_linked"))]
pub fn light_points_linked(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &PointsPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] triangles: &[LinkedTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] samples: &[SampledLight],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] numbers: &[[f32; 2]],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [LightPoint],
) {
    let i = invocation(id);
    if i < push.count && i < samples.len() as u32 && i < numbers.len() as u32 {
        let sample = samples[i as usize];
        let light = world_light(triangles, instances, sample.light, sample.instance);
        results[i as usize] = light.light.point(numbers[i as usize]);
    }
}

/// The place on each query's segment for light from each of `points`, which the number of `parts` chooses in [0, 1), and its density over length.
#[spirv(compute(threads(64), entry_point_name = "segment_places"))]
pub fn segment_places(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &PointsPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] queries: &[SegmentQuery],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] points: &[LightPoint],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] parts: &[f32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] results: &mut [SegmentSample],
) {
    let i = invocation(id);
    let known = i < queries.len() as u32 && i < points.len() as u32 && i < parts.len() as u32;
    if i < push.count && known {
        let center = glam::Vec3::from_array(points[i as usize].p);
        results[i as usize] = queries[i as usize].segment.sample(center, parts[i as usize]);
    }
}
