//! The kernels of one choice of node layout and importance.

use crate::kernel::Kernel;
use crate::refit::Pass;
use crate::table;

/// The kernels over nodes of one layout. Every kernel that takes nodes exists once for each choice; the others in
/// [`KERNELS`](crate::KERNELS) serve all.
#[derive(Clone, Copy, Debug)]
pub struct KernelSet {
    /// Recomputes children of nodes of bottom levels.
    pub refit_bottom: &'static Kernel,
    /// Recomputes children of nodes of the top level.
    pub refit_top: &'static Kernel,
    /// Recomputes nodes from their children.
    pub refit_nodes: &'static Kernel,
    /// A light for each query's point.
    pub sample: &'static Kernel,
    /// The probability of each query's light.
    pub pmf: &'static Kernel,
    /// A point on each query's sampled light.
    pub light_points: &'static Kernel,
}

/// The kernels of `LightBvh`: `Bvh<(MomentNode<8>, Defensive<Moments, 6>)>`.
pub static MOMENTS: KernelSet = KernelSet {
    refit_bottom: &table::REFIT_BOTTOM,
    refit_top: &table::REFIT_TOP,
    refit_nodes: &table::REFIT_NODES,
    sample: &table::SAMPLE,
    pmf: &table::PMF,
    light_points: &table::LIGHT_POINTS,
};

/// The kernels of `Bvh<(CompactNode<4>, Eq4), 4>`, the paper's.
pub static EQ4: KernelSet = KernelSet {
    refit_bottom: &table::REFIT_BOTTOM_EQ4,
    refit_top: &table::REFIT_TOP_EQ4,
    refit_nodes: &table::REFIT_NODES_EQ4,
    sample: &table::SAMPLE_EQ4,
    pmf: &table::PMF_EQ4,
    light_points: &table::LIGHT_POINTS,
};

impl KernelSet {
    /// Those of [`MOMENTS`] for cells, over the same nodes. They are asked [`CellQuery`](crate::CellQuery)s.
    pub const CELLS: Self = Self {
        refit_bottom: &table::REFIT_BOTTOM,
        refit_top: &table::REFIT_TOP,
        refit_nodes: &table::REFIT_NODES,
        sample: &table::SAMPLE_CELL,
        pmf: &table::PMF_CELL,
        light_points: &table::LIGHT_POINTS,
    };

    /// The kernels of `Bvh<(SpotMomentNode<8, AnyLight>, Defensive<Moments, 6>)>`, over lights of any kind. A node is 256
    /// bytes where one of [`MOMENTS`] is 192; a scene of triangles alone takes that.
    ///
    /// Its [`light_points`](Self::light_points) reads `queries` besides, for a point on a light of some kinds depends on the
    /// receiver.
    pub const ANY: Self = Self {
        refit_bottom: &table::REFIT_BOTTOM_ANY,
        refit_top: &table::REFIT_TOP_ANY,
        refit_nodes: &table::REFIT_NODES_ANY,
        sample: &table::SAMPLE_ANY,
        pmf: &table::PMF_ANY,
        light_points: &table::LIGHT_POINTS_ANY,
    };

    /// The kernels of [`MaskedLights`](lightbvh::MaskedLights). They are asked [`LinkedQuery`](crate::LinkedQuery)s, also by
    /// [`light_points`](Self::light_points).
    pub const LINKED: Self = Self {
        refit_bottom: &table::REFIT_BOTTOM_LINKED,
        refit_top: &table::REFIT_TOP_LINKED,
        refit_nodes: &table::REFIT_NODES_LINKED,
        sample: &table::SAMPLE_LINKED,
        pmf: &table::PMF_LINKED,
        light_points: &table::LIGHT_POINTS_LINKED,
    };
}

impl KernelSet {
    /// The kernel of a pass of a refit.
    #[must_use]
    pub fn refit(&self, pass: Pass) -> &'static Kernel {
        match pass {
            Pass::Bottom => self.refit_bottom,
            Pass::Top => self.refit_top,
            Pass::Nodes => self.refit_nodes,
        }
    }
}
