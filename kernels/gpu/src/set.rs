//! The kernels of one choice of node layout and importance.

use crate::kernel::Kernel;
use crate::refit::Pass;
use crate::table;

/// The kernels over nodes of one layout. Every kernel that takes nodes exists once for each choice; the others in
/// [`KERNELS`](crate::KERNELS) serve all.
#[derive(Clone, Copy, Debug)]
pub struct KernelSet {
    /// Nodes of bottom levels anew.
    pub refit_bottom: &'static Kernel,
    /// Roots of bottom levels anew.
    pub refit_roots: &'static Kernel,
    /// Nodes of the top level anew.
    pub refit_top: &'static Kernel,
    /// A light for each query's point.
    pub sample: &'static Kernel,
    /// The probability of each query's light.
    pub pmf: &'static Kernel,
}

/// The kernels of `LightBvh`: `Bvh<MomentNode<8>, Defensive<Moments, 6>, 8>`.
pub static MOMENTS: KernelSet = KernelSet {
    refit_bottom: &table::REFIT_BOTTOM,
    refit_roots: &table::REFIT_ROOTS,
    refit_top: &table::REFIT_TOP,
    sample: &table::SAMPLE,
    pmf: &table::PMF,
};

/// The kernels of `Bvh<CompactNode<4>, Eq4, 4>`, the paper's.
pub static EQ4: KernelSet = KernelSet {
    refit_bottom: &table::REFIT_BOTTOM_EQ4,
    refit_roots: &table::REFIT_ROOTS_EQ4,
    refit_top: &table::REFIT_TOP_EQ4,
    sample: &table::SAMPLE_EQ4,
    pmf: &table::PMF_EQ4,
};

impl KernelSet {
    /// The kernel of a pass of a refit.
    #[must_use]
    pub fn refit(&self, pass: Pass) -> &'static Kernel {
        match pass {
            Pass::Bottom => self.refit_bottom,
            Pass::Roots => self.refit_roots,
            Pass::Top => self.refit_top,
        }
    }
}

#[cfg(test)]
mod tests {
    use lightbvh::{CompactNode, MomentNode};

    use super::*;
    use crate::buffer::Buffer;

    fn fits<N>(set: &KernelSet, suffix: &str) {
        for pass in [Pass::Bottom, Pass::Roots, Pass::Top] {
            let kernel = set.refit(pass);
            assert_eq!(kernel.name.strip_suffix(suffix), Some(pass.name()));
            assert_eq!(kernel.push_constants, 8);
        }
        assert_eq!(
            set.sample.push_constants as usize,
            4 + size_of::<lightbvh::TreeWords>()
        );
        assert_eq!(
            set.pmf.push_constants as usize,
            4 + size_of::<lightbvh::TreeWords>()
        );
        for kernel in [
            set.refit_bottom,
            set.refit_roots,
            set.refit_top,
            set.sample,
            set.pmf,
        ] {
            for binding in kernel.bindings {
                match Buffer::named(binding.name) {
                    Some(buffer) => assert_eq!(binding.stride, buffer.stride::<N>(), "{binding:?}"),
                    None => assert!(
                        ["list", "queries", "results"].contains(&binding.name),
                        "{binding:?}"
                    ),
                }
            }
        }
    }

    #[test]
    fn the_buffers_of_core_fit_the_kernels() {
        fits::<MomentNode<8>>(&MOMENTS, "");
        fits::<CompactNode<4>>(&EQ4, "_eq4");
    }
}
