//! Passes over trees of lights of any kind, [`AnyLight`]. Nodes are the default's with beams, since any kind may be a spot.

use glam::UVec3;
use lightbvh::light::{AnyLight, Light};
use lightbvh::refit::world_light;
use lightbvh::refit::{self, BlasRoot, Children, LIMITED_ROWS};
use lightbvh::{Instance, LightPoint, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::{AnyNode, AnyTree, WIDTH};
use crate::invocation;
use crate::query::{PointsPush, Query, QueryPush};
use crate::refit::RefitPush;

query_passes!(
    Query,
    AnyNode,
    AnyTree,
    sample_any = "sample_any",
    pmf_any = "pmf_any"
);
refit_passes!(
    AnyNode,
    WIDTH,
    LIMITED_ROWS,
    AnyLight,
    refit_bottom_any = "refit_bottom_any",
    refit_top_any = "refit_top_any",
    refit_nodes_any = "refit_nodes_any",
    refit_roots_any = "refit_roots_any"
);

/// The point on a sampled light that the two numbers of `uv` choose for a receiver.
#[inline]
#[must_use]
pub fn light_point_for<L: Light>(
    lights: &[L],
    instances: &[Instance],
    point: &ShadingPoint,
    sample: &SampledLight,
    uv: [f32; 2],
) -> LightPoint {
    world_light(lights, instances, sample.light, sample.instance).point_for(point.position(), uv)
}

/// A pass of points on lights that depend on the receiver, a field `point` of `$query`.
macro_rules! points_for_pass {
    ($query:ty, $pass:ident = $name:tt) => {
        /// Turns each of `samples`, as pass `sample` writes them for `queries`, into a point on its light in the world, by the two numbers of
        /// `numbers` in [0, 1): none that cannot send light to the query's point, as far as the kind knows.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &PointsPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] lights: &[AnyLight],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] queries: &[$query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] samples: &[SampledLight],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] numbers: &[[f32; 2]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] results: &mut [LightPoint],
        ) {
            let i = invocation(id);
            let known = i < samples.len() as u32 && i < queries.len() as u32 && i < numbers.len() as u32;
            if i < push.count && known {
                let (point, sample) = (queries[i as usize].point, samples[i as usize]);
                results[i as usize] =
                    light_point_for(lights, instances, &point, &sample, numbers[i as usize]);
            }
        }
    };
}

points_for_pass!(Query, light_points_any = "light_points_any");

pub(crate) use points_for_pass;
