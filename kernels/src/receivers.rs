//! Passes for receivers with a mask of lights, over lights with masks: nodes, and so refits, of their own.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit};
use lightbvh::refit::{self, BlasRoot, Children, LIMITED_ROWS};
use lightbvh::{Instance, LightPoint, LightTree, Moments, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::WIDTH;
use crate::invocation;
use crate::query::{PointsPush, QueryPush, light_point, points_pass, query_passes};
use crate::refit::{RefitPush, refit_passes};

/// Node over triangles with masks.
pub type LinkedNode = Lit<LinkedMomentNode<8>, LinkedTriangle>;
/// What lights with masks are chosen by.
pub type LinkedImportance = Linked<Leveled<Moments, 9>>;

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

impl LinkedQuery {
    /// The receiver.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> LinkedPoint<ShadingPoint> {
        LinkedPoint {
            point: self.point,
            mask: self.mask,
        }
    }
}

type LinkedTree<'a> = LightTree<'a, LinkedNode, LinkedImportance, WIDTH>;

query_passes!(
    LinkedQuery,
    LinkedNode,
    LinkedTree,
    sample_linked = "sample_linked",
    pmf_linked = "pmf_linked"
);
points_pass!(LinkedTriangle, light_points_linked = "light_points_linked");
refit_passes!(
    LinkedNode,
    WIDTH,
    LIMITED_ROWS,
    LinkedTriangle,
    refit_bottom_linked = "refit_bottom_linked",
    refit_top_linked = "refit_top_linked",
    refit_nodes_linked = "refit_nodes_linked"
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::AnyNode;

    /// Both layouts have the words that a root is made of in the same places, so `refit_roots_any` serves both.
    #[test]
    fn roots_of_linked_nodes_are_those_of_nodes_over_any_light() {
        let words: Vec<u32> = (0..64 * 56).map(lightbvh::exact::hash).collect();
        let linked: &[LinkedNode] = bytemuck::cast_slice(&words);
        let any: &[AnyNode] = bytemuck::cast_slice(&words);
        for node in 0..64 {
            let roots = [refit::root(linked, node), refit::root(any, node)];
            assert_eq!(bytemuck::bytes_of(&roots[0]), bytemuck::bytes_of(&roots[1]));
        }
    }
}
