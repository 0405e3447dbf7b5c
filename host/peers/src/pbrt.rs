//! pbrt-v4's importance.

use core::array;

use lightbvh::ShadingPoint;
use lightbvh::device::sight::{over_distance, root};
use lightbvh::device::vector::{dot, is_zero};
use lightbvh::exact;
use lightbvh::importance::{ImportanceModel, Space, on_one_scale};
use lightbvh::node::BoundsNode;

use crate::sight::{FLOOR, Sight};

/// The importance of pbrt-v4's `BVHLightSampler`: `LightBounds::Importance` (`src/pbrt/lights.cpp`; Pharr, Jakob & Humphreys,
/// Physically Based Rendering, 4th edition, section 12.6.3). On the layouts that hold bounds.
///
/// Φ · cos θ' · cos θ'_i / max(d², r), where
/// - d is the distance of the box's centre and r half the box's diagonal: a length, which pbrt compares with a square. So the metre
///   matters, and a scene scaled by a power of two has other probabilities;
/// - θ' = max(0, max(0, θ_w − θ_o) − θ_b), θ_w from the axis of the normals to the point, θ_b of the sphere around the box; all is
///   zero where cos θ' ≤ 0;
/// - θ'_i = max(0, θ_i − θ_b), with |cos θ_i|: lights behind an opaque surface count as those before it. In a volume there is no
///   such factor.
///
/// Departures: a two-sided emitter is a cone of every direction in [`LightBounds`](lightbvh::node::LightBounds), which has no flag for it, so
/// that cos θ' is 1 where pbrt takes |cos θ_w|; and the product of the cosines is at least 2^-10, where pbrt gives zero, or, at the very
/// centre of a box, NaN.
#[derive(Clone, Copy, Debug)]
pub struct Pbrt;

impl<N: BoundsNode<W>, const W: usize> ImportanceModel<N, W> for Pbrt {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        let n = point.normal();
        on_one_scale(&array::from_fn(|slot| {
            let cluster = node.cluster(slot);
            let sight = Sight::of_sphere(&cluster, point);
            let emitted = sight.emitted(&cluster);
            let reaches = emitted > 0.0;
            let bounded = sight.nearest(exact::abs(dot(n, sight.v)));
            let incident = if is_zero(n) { 1.0 } else { bounded };
            let cosines = if reaches { emitted * incident } else { 0.0 };
            let squared = exact::max(sight.d_squared, root(cluster.radius_squared));
            over_distance(cluster.phi, squared, exact::max(cosines, FLOOR))
        }))
    }
}
