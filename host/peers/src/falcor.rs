//! Falcor's importance.

use core::array;

use lightbvh::ShadingPoint;
use lightbvh::device::sight::over_distance;
use lightbvh::device::vector::{dot, is_zero};
use lightbvh::exact;
use lightbvh::importance::{ImportanceModel, Space, on_one_scale};
use lightbvh::node::BoundsNode;

use crate::sight::{FLOOR, Sight};

/// The importance of Falcor's `LightBVHSampler` with its default options: `computeImportance` and `boundCosineTerm`
/// (`Source/Falcor/Rendering/Lights/LightBVHSampler.slang`; Moreau & Clarberg, Ray Tracing Gems, chapter 18, Eq. 17), cones
/// around spheres (`SolidAngleBoundMethod::Sphere`). On the layouts that hold bounds.
///
/// Φ · N·L · cos θ' / max(d, h)², where
/// - d is the distance of the box's centre and h the greatest half extent of the box;
/// - N·L = cos max(0, θ_i − θ_u), at least 0, θ_u of the sphere around the box; 1 in a volume;
/// - θ' = max(0, max(0, θ − θ_o) − θ_u), its cosine at least 0, and 1 where cos θ_o ≤ 0. Emitters are taken as diffuse: θ_e is 90°.
///
/// Departures: the product of the cosines is at least 2^-10, where Falcor gives zero, or, at the very centre of a box, NaN. Of the
/// lights of a leaf, among which Falcor chooses alike, each has its own bounds here.
#[derive(Clone, Copy, Debug)]
pub struct Falcor;

impl<N: BoundsNode<W>, const W: usize> ImportanceModel<N, W> for Falcor {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        let n = point.normal();
        on_one_scale(&array::from_fn(|slot| {
            let cluster = node.cluster(slot);
            let sight = Sight::of_sphere(&cluster, point);
            let facing = exact::max(sight.emitted(&cluster), 0.0);
            let orientation = if cluster.cos_theta_o > 0.0 { facing } else { 1.0 };
            let bounded = exact::max(sight.nearest(dot(n, sight.v)), 0.0);
            let incident = if is_zero(n) { 1.0 } else { bounded };
            let half = exact::max(exact::max(cluster.extent.x, cluster.extent.y), cluster.extent.z);
            let squared = exact::max(sight.d_squared, half * half);
            let factor = exact::max(incident * orientation, FLOOR);
            over_distance(cluster.phi, squared, factor)
        }))
    }
}
