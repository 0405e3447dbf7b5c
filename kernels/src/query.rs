//! Passes `sample` and `pmf`: one invocation answers one query. Pass `light_points`: one invocation turns one sample into a point
//! on its light.

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use lightbvh::light::Light;
use lightbvh::refit::world_light;
use lightbvh::{EmissiveTriangle, Instance, LightPoint, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::{Compiled, Node, PaperNode, PaperTree, StandardTree, TreeOf};
use crate::invocation;
pub use crate::passes::QueryPush;

/// A point, and what is asked: 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Query {
    /// The point to be lit.
    pub point: ShadingPoint,
    /// For `sample` the number of the walk, its high word first; for `pmf` the light and its instance (`u32::MAX` in a
    /// single-level tree).
    pub words: [u32; 2],
}

impl Query {
    /// The receiver.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> ShadingPoint {
        self.point
    }
}

/// The answer to a query of pass `sample`.
#[inline]
#[must_use]
pub fn sample_query<C: Compiled<W>, const W: usize>(tree: &TreeOf<'_, C, W>, query: &Query) -> SampledLight {
    let number = Random64 {
        high: query.words[0],
        low: query.words[1],
    };
    tree.sample(&query.point, number)
}

/// The answer to a query of pass `pmf`.
#[inline]
#[must_use]
pub fn pmf_query<C: Compiled<W>, const W: usize>(tree: &TreeOf<'_, C, W>, query: &Query) -> f32 {
    tree.pmf(&query.point, query.words[0], query.words[1])
}

query_passes!(Query, Node, StandardTree, sample = "sample", pmf = "pmf");
query_passes!(
    Query,
    PaperNode,
    PaperTree,
    sample_eq4 = "sample_eq4",
    pmf_eq4 = "pmf_eq4"
);

/// Push constants of pass `light_points`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PointsPush {
    /// Number of samples.
    pub count: u32,
}

/// Turns each of `samples`, as pass `sample` writes them, into a point on its light in the world, by the two numbers of `numbers`
/// in [0, 1). It reads the lights through their instances: when an instance moves, its record is all that changes.
#[spirv(compute(threads(64), entry_point_name = "light_points"))]
pub fn light_points(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &PointsPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] lights: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] samples: &[SampledLight],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] numbers: &[[f32; 2]],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [LightPoint],
) {
    let i = invocation(id);
    if i < push.count && i < samples.len() as u32 && i < numbers.len() as u32 {
        let SampledLight { light, instance, .. } = samples[i as usize];
        let own = world_light(lights, instances, light, instance);
        // Where the receiver is does not matter.
        results[i as usize] = own.point_for(Vec3::ZERO, numbers[i as usize]);
    }
}
