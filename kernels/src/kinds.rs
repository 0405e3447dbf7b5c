//! Passes over trees of lights of any kind, [`AnyLight`]. Nodes are the default's with beams, since any kind may be a spot.

use glam::UVec3;
use lightbvh::light::{AnyLight, Light};
use lightbvh::refit::world_light;
use lightbvh::refit::{self, Children, LIMITED_ROWS};
use lightbvh::{Instance, LightPoint, Random64, SampledLight};
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
    refit_nodes_any = "refit_nodes_any"
);

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
                let SampledLight {
                    light, instance, ..
                } = samples[i as usize];
                let own = world_light(lights, instances, light, instance);
                results[i as usize] =
                    own.point_for(queries[i as usize].point.position(), numbers[i as usize]);
            }
        }
    };
}

points_for_pass!(Query, light_points_any = "light_points_any");

pub(crate) use points_for_pass;
