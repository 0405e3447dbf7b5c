//! Passes for cells, over the nodes of `LightBvh`. Passes for receivers with masks, over lights of any kind in instances with masks:
//! nodes, and so refits, of their own.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::importance::{Cell, LinkedPoint};
use lightbvh::light::{AnyLight, Light};
use lightbvh::refit::{self, Children, LIMITED_ROWS, world_light};
use lightbvh::tree::{Masked, Model};
use lightbvh::{Instance, LightPoint, LightTree, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::{Node, StandardTree, WIDTH};
use crate::invocation;
use crate::kinds::points_for_pass;
use crate::query::{PointsPush, QueryPush};
use crate::refit::RefitPush;

/// Node of `MaskedLights`.
pub type LinkedNode = <Masked as Model<WIDTH>>::Node;
/// What they are chosen by.
pub type LinkedImportance = <Masked as Model<WIDTH>>::Importance;

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

/// A query for a cell, 44 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct CellQuery {
    /// The cell to be lit.
    pub cell: Cell,
    /// As of [`Query`](crate::query::Query).
    pub words: [u32; 2],
}

impl CellQuery {
    /// The receiver.
    #[inline(always)]
    #[must_use]
    pub fn receiver(&self) -> Cell {
        self.cell
    }
}

query_passes!(
    CellQuery,
    Node,
    StandardTree,
    sample_cell = "sample_cell",
    pmf_cell = "pmf_cell"
);

type LinkedTree<'a> = LightTree<'a, LinkedNode, LinkedImportance, WIDTH>;

query_passes!(
    LinkedQuery,
    LinkedNode,
    LinkedTree,
    sample_linked = "sample_linked",
    pmf_linked = "pmf_linked"
);
points_for_pass!(LinkedQuery, light_points_linked = "light_points_linked");
refit_passes!(
    LinkedNode,
    WIDTH,
    LIMITED_ROWS,
    AnyLight,
    refit_bottom_linked = "refit_bottom_linked",
    refit_top_linked = "refit_top_linked",
    refit_nodes_linked = "refit_nodes_linked"
);
