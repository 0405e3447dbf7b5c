//! All kernels. Written by `build-kernels` from the modules in `spirv`; edits are lost.

use crate::kernel::Access::{Read, ReadWrite, Write};
use crate::kernel::{Binding, Kernel};

/// Kernel `light_points`.
pub static LIGHT_POINTS: Kernel = Kernel {
    name: "light_points",
    bytes: include_bytes!("../spirv/light_points.spv"),
    bindings: &[
        Binding { binding: 0, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "samples", access: Read, stride: 12 },
        Binding { binding: 3, name: "numbers", access: Read, stride: 8 },
        Binding { binding: 4, name: "results", access: Write, stride: 44 },
    ],
    push_constants: 4,
    workgroup: [64, 1, 1],
};

/// Kernel `light_points_any`.
pub static LIGHT_POINTS_ANY: Kernel = Kernel {
    name: "light_points_any",
    bytes: include_bytes!("../spirv/light_points_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "queries", access: Read, stride: 32 },
        Binding { binding: 3, name: "samples", access: Read, stride: 12 },
        Binding { binding: 4, name: "numbers", access: Read, stride: 8 },
        Binding { binding: 5, name: "results", access: Write, stride: 44 },
    ],
    push_constants: 4,
    workgroup: [64, 1, 1],
};

/// Kernel `light_points_linked`.
pub static LIGHT_POINTS_LINKED: Kernel = Kernel {
    name: "light_points_linked",
    bytes: include_bytes!("../spirv/light_points_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "triangles", access: Read, stride: 60 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "samples", access: Read, stride: 12 },
        Binding { binding: 3, name: "numbers", access: Read, stride: 8 },
        Binding { binding: 4, name: "results", access: Write, stride: 44 },
    ],
    push_constants: 4,
    workgroup: [64, 1, 1],
};

/// Kernel `path_bvh`.
pub static PATH_BVH: Kernel = Kernel {
    name: "path_bvh",
    bytes: include_bytes!("../spirv/path_bvh.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_bvh_any`.
pub static PATH_BVH_ANY: Kernel = Kernel {
    name: "path_bvh_any",
    bytes: include_bytes!("../spirv/path_bvh_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
        Binding { binding: 9, name: "suns", access: Read, stride: 24 },
        Binding { binding: 10, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 11, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 12, name: "corners", access: Read, stride: 28 },
        Binding { binding: 13, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_bvh_eq4`.
pub static PATH_BVH_EQ4: Kernel = Kernel {
    name: "path_bvh_eq4",
    bytes: include_bytes!("../spirv/path_bvh_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_power`.
pub static PATH_POWER: Kernel = Kernel {
    name: "path_power",
    bytes: include_bytes!("../spirv/path_power.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_power_any`.
pub static PATH_POWER_ANY: Kernel = Kernel {
    name: "path_power_any",
    bytes: include_bytes!("../spirv/path_power_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "results", access: Write, stride: 12 },
        Binding { binding: 8, name: "suns", access: Read, stride: 24 },
        Binding { binding: 9, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 10, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 11, name: "corners", access: Read, stride: 28 },
        Binding { binding: 12, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_uniform`.
pub static PATH_UNIFORM: Kernel = Kernel {
    name: "path_uniform",
    bytes: include_bytes!("../spirv/path_uniform.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `path_uniform_any`.
pub static PATH_UNIFORM_ANY: Kernel = Kernel {
    name: "path_uniform_any",
    bytes: include_bytes!("../spirv/path_uniform_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "results", access: Write, stride: 12 },
        Binding { binding: 7, name: "suns", access: Read, stride: 24 },
        Binding { binding: 8, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 9, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 10, name: "corners", access: Read, stride: 28 },
        Binding { binding: 11, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 88,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf`.
pub static PMF: Kernel = Kernel {
    name: "pmf",
    bytes: include_bytes!("../spirv/pmf.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_any`.
pub static PMF_ANY: Kernel = Kernel {
    name: "pmf_any",
    bytes: include_bytes!("../spirv/pmf_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_eq4`.
pub static PMF_EQ4: Kernel = Kernel {
    name: "pmf_eq4",
    bytes: include_bytes!("../spirv/pmf_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_linked`.
pub static PMF_LINKED: Kernel = Kernel {
    name: "pmf_linked",
    bytes: include_bytes!("../spirv/pmf_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 36 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_narrow`.
pub static PMF_NARROW: Kernel = Kernel {
    name: "pmf_narrow",
    bytes: include_bytes!("../spirv/pmf_narrow.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 96 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_native`.
pub static PMF_NATIVE: Kernel = Kernel {
    name: "pmf_native",
    bytes: include_bytes!("../spirv/pmf_native.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_segment`.
pub static PMF_SEGMENT: Kernel = Kernel {
    name: "pmf_segment",
    bytes: include_bytes!("../spirv/pmf_segment.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_transmissive`.
pub static PMF_TRANSMISSIVE: Kernel = Kernel {
    name: "pmf_transmissive",
    bytes: include_bytes!("../spirv/pmf_transmissive.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 40 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `pmf_wide`.
pub static PMF_WIDE: Kernel = Kernel {
    name: "pmf_wide",
    bytes: include_bytes!("../spirv/pmf_wide.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 384 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 4 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_bottom`.
pub static REFIT_BOTTOM: Kernel = Kernel {
    name: "refit_bottom",
    bytes: include_bytes!("../spirv/refit_bottom.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 2, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 3, name: "children", access: Write, stride: 384 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_bottom_any`.
pub static REFIT_BOTTOM_ANY: Kernel = Kernel {
    name: "refit_bottom_any",
    bytes: include_bytes!("../spirv/refit_bottom_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 2, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 3, name: "children", access: Write, stride: 672 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_bottom_eq4`.
pub static REFIT_BOTTOM_EQ4: Kernel = Kernel {
    name: "refit_bottom_eq4",
    bytes: include_bytes!("../spirv/refit_bottom_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 2, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 3, name: "children", access: Write, stride: 192 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_bottom_linked`.
pub static REFIT_BOTTOM_LINKED: Kernel = Kernel {
    name: "refit_bottom_linked",
    bytes: include_bytes!("../spirv/refit_bottom_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 60 },
        Binding { binding: 2, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 3, name: "children", access: Write, stride: 672 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_nodes`.
pub static REFIT_NODES: Kernel = Kernel {
    name: "refit_nodes",
    bytes: include_bytes!("../spirv/refit_nodes.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "children", access: Read, stride: 384 },
        Binding { binding: 2, name: "nodes", access: ReadWrite, stride: 192 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_nodes_any`.
pub static REFIT_NODES_ANY: Kernel = Kernel {
    name: "refit_nodes_any",
    bytes: include_bytes!("../spirv/refit_nodes_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "children", access: Read, stride: 672 },
        Binding { binding: 2, name: "nodes", access: ReadWrite, stride: 224 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_nodes_eq4`.
pub static REFIT_NODES_EQ4: Kernel = Kernel {
    name: "refit_nodes_eq4",
    bytes: include_bytes!("../spirv/refit_nodes_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "children", access: Read, stride: 192 },
        Binding { binding: 2, name: "nodes", access: ReadWrite, stride: 112 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_nodes_linked`.
pub static REFIT_NODES_LINKED: Kernel = Kernel {
    name: "refit_nodes_linked",
    bytes: include_bytes!("../spirv/refit_nodes_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "children", access: Read, stride: 672 },
        Binding { binding: 2, name: "nodes", access: ReadWrite, stride: 224 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_roots`.
pub static REFIT_ROOTS: Kernel = Kernel {
    name: "refit_roots",
    bytes: include_bytes!("../spirv/refit_roots.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 2, name: "roots", access: ReadWrite, stride: 52 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_roots_any`.
pub static REFIT_ROOTS_ANY: Kernel = Kernel {
    name: "refit_roots_any",
    bytes: include_bytes!("../spirv/refit_roots_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 2, name: "roots", access: ReadWrite, stride: 52 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_roots_eq4`.
pub static REFIT_ROOTS_EQ4: Kernel = Kernel {
    name: "refit_roots_eq4",
    bytes: include_bytes!("../spirv/refit_roots_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 2, name: "roots", access: ReadWrite, stride: 52 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_roots_linked`.
pub static REFIT_ROOTS_LINKED: Kernel = Kernel {
    name: "refit_roots_linked",
    bytes: include_bytes!("../spirv/refit_roots_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 2, name: "roots", access: ReadWrite, stride: 52 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_top`.
pub static REFIT_TOP: Kernel = Kernel {
    name: "refit_top",
    bytes: include_bytes!("../spirv/refit_top.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "roots", access: Read, stride: 52 },
        Binding { binding: 3, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 4, name: "children", access: Write, stride: 384 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_top_any`.
pub static REFIT_TOP_ANY: Kernel = Kernel {
    name: "refit_top_any",
    bytes: include_bytes!("../spirv/refit_top_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "roots", access: Read, stride: 52 },
        Binding { binding: 3, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 4, name: "children", access: Write, stride: 672 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_top_eq4`.
pub static REFIT_TOP_EQ4: Kernel = Kernel {
    name: "refit_top_eq4",
    bytes: include_bytes!("../spirv/refit_top_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "roots", access: Read, stride: 52 },
        Binding { binding: 3, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 4, name: "children", access: Write, stride: 192 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `refit_top_linked`.
pub static REFIT_TOP_LINKED: Kernel = Kernel {
    name: "refit_top_linked",
    bytes: include_bytes!("../spirv/refit_top_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "list", access: Read, stride: 4 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "roots", access: Read, stride: 52 },
        Binding { binding: 3, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 4, name: "children", access: Write, stride: 672 },
    ],
    push_constants: 8,
    workgroup: [64, 1, 1],
};

/// Kernel `render_bvh`.
pub static RENDER_BVH: Kernel = Kernel {
    name: "render_bvh",
    bytes: include_bytes!("../spirv/render_bvh.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_bvh_any`.
pub static RENDER_BVH_ANY: Kernel = Kernel {
    name: "render_bvh_any",
    bytes: include_bytes!("../spirv/render_bvh_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
        Binding { binding: 9, name: "suns", access: Read, stride: 24 },
        Binding { binding: 10, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 11, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 12, name: "corners", access: Read, stride: 28 },
        Binding { binding: 13, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_bvh_eq4`.
pub static RENDER_BVH_EQ4: Kernel = Kernel {
    name: "render_bvh_eq4",
    bytes: include_bytes!("../spirv/render_bvh_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_power`.
pub static RENDER_POWER: Kernel = Kernel {
    name: "render_power",
    bytes: include_bytes!("../spirv/render_power.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_power_any`.
pub static RENDER_POWER_ANY: Kernel = Kernel {
    name: "render_power_any",
    bytes: include_bytes!("../spirv/render_power_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "results", access: Write, stride: 12 },
        Binding { binding: 8, name: "suns", access: Read, stride: 24 },
        Binding { binding: 9, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 10, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 11, name: "corners", access: Read, stride: 28 },
        Binding { binding: 12, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_uniform`.
pub static RENDER_UNIFORM: Kernel = Kernel {
    name: "render_uniform",
    bytes: include_bytes!("../spirv/render_uniform.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `render_uniform_any`.
pub static RENDER_UNIFORM_ANY: Kernel = Kernel {
    name: "render_uniform_any",
    bytes: include_bytes!("../spirv/render_uniform_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "results", access: Write, stride: 12 },
        Binding { binding: 7, name: "suns", access: Read, stride: 24 },
        Binding { binding: 8, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 9, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 10, name: "corners", access: Read, stride: 28 },
        Binding { binding: 11, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_initial_bvh`.
pub static RESTIR_INITIAL_BVH: Kernel = Kernel {
    name: "restir_initial_bvh",
    bytes: include_bytes!("../spirv/restir_initial_bvh.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "gbuffer", access: Write, stride: 56 },
        Binding { binding: 9, name: "reservoirs", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_initial_bvh_any`.
pub static RESTIR_INITIAL_BVH_ANY: Kernel = Kernel {
    name: "restir_initial_bvh_any",
    bytes: include_bytes!("../spirv/restir_initial_bvh_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "gbuffer", access: Write, stride: 56 },
        Binding { binding: 9, name: "reservoirs", access: Write, stride: 28 },
        Binding { binding: 10, name: "suns", access: Read, stride: 24 },
        Binding { binding: 11, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 12, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 13, name: "corners", access: Read, stride: 28 },
        Binding { binding: 14, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_initial_bvh_eq4`.
pub static RESTIR_INITIAL_BVH_EQ4: Kernel = Kernel {
    name: "restir_initial_bvh_eq4",
    bytes: include_bytes!("../spirv/restir_initial_bvh_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 7, name: "trails", access: Read, stride: 4 },
        Binding { binding: 8, name: "gbuffer", access: Write, stride: 56 },
        Binding { binding: 9, name: "reservoirs", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_initial_power`.
pub static RESTIR_INITIAL_POWER: Kernel = Kernel {
    name: "restir_initial_power",
    bytes: include_bytes!("../spirv/restir_initial_power.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "gbuffer", access: Write, stride: 56 },
        Binding { binding: 8, name: "reservoirs", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_initial_power_any`.
pub static RESTIR_INITIAL_POWER_ANY: Kernel = Kernel {
    name: "restir_initial_power_any",
    bytes: include_bytes!("../spirv/restir_initial_power_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "camera", access: Read, stride: 48 },
        Binding { binding: 6, name: "thresholds", access: Read, stride: 4 },
        Binding { binding: 7, name: "gbuffer", access: Write, stride: 56 },
        Binding { binding: 8, name: "reservoirs", access: Write, stride: 28 },
        Binding { binding: 9, name: "suns", access: Read, stride: 24 },
        Binding { binding: 10, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 11, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 12, name: "corners", access: Read, stride: 28 },
        Binding { binding: 13, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_shade`.
pub static RESTIR_SHADE: Kernel = Kernel {
    name: "restir_shade",
    bytes: include_bytes!("../spirv/restir_shade.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 6, name: "reservoirs", access: ReadWrite, stride: 28 },
        Binding { binding: 7, name: "results", access: Write, stride: 16 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_shade_any`.
pub static RESTIR_SHADE_ANY: Kernel = Kernel {
    name: "restir_shade_any",
    bytes: include_bytes!("../spirv/restir_shade_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 6, name: "reservoirs", access: ReadWrite, stride: 28 },
        Binding { binding: 7, name: "results", access: Write, stride: 16 },
        Binding { binding: 8, name: "suns", access: Read, stride: 24 },
        Binding { binding: 9, name: "sky_counts", access: Read, stride: 4 },
        Binding { binding: 10, name: "sky_radiance", access: Read, stride: 12 },
        Binding { binding: 11, name: "corners", access: Read, stride: 28 },
        Binding { binding: 12, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_spatial_biased`.
pub static RESTIR_SPATIAL_BIASED: Kernel = Kernel {
    name: "restir_spatial_biased",
    bytes: include_bytes!("../spirv/restir_spatial_biased.spv"),
    bindings: &[
        Binding { binding: 0, name: "materials", access: Read, stride: 20 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 2, name: "instances", access: Read, stride: 136 },
        Binding { binding: 3, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 4, name: "reservoirs", access: Read, stride: 28 },
        Binding { binding: 5, name: "results", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_spatial_biased_any`.
pub static RESTIR_SPATIAL_BIASED_ANY: Kernel = Kernel {
    name: "restir_spatial_biased_any",
    bytes: include_bytes!("../spirv/restir_spatial_biased_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "materials", access: Read, stride: 20 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 2, name: "instances", access: Read, stride: 136 },
        Binding { binding: 3, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 4, name: "reservoirs", access: Read, stride: 28 },
        Binding { binding: 5, name: "results", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_spatial_unbiased`.
pub static RESTIR_SPATIAL_UNBIASED: Kernel = Kernel {
    name: "restir_spatial_unbiased",
    bytes: include_bytes!("../spirv/restir_spatial_unbiased.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 6, name: "reservoirs", access: Read, stride: 28 },
        Binding { binding: 7, name: "results", access: Write, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_spatial_unbiased_any`.
pub static RESTIR_SPATIAL_UNBIASED_ANY: Kernel = Kernel {
    name: "restir_spatial_unbiased_any",
    bytes: include_bytes!("../spirv/restir_spatial_unbiased_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "materials", access: Read, stride: 20 },
        Binding { binding: 3, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 4, name: "instances", access: Read, stride: 136 },
        Binding { binding: 5, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 6, name: "reservoirs", access: Read, stride: 28 },
        Binding { binding: 7, name: "results", access: Write, stride: 28 },
        Binding { binding: 8, name: "corners", access: Read, stride: 28 },
        Binding { binding: 9, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_temporal_biased`.
pub static RESTIR_TEMPORAL_BIASED: Kernel = Kernel {
    name: "restir_temporal_biased",
    bytes: include_bytes!("../spirv/restir_temporal_biased.spv"),
    bindings: &[
        Binding { binding: 0, name: "materials", access: Read, stride: 20 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 2, name: "instances", access: Read, stride: 136 },
        Binding { binding: 3, name: "before_camera", access: Read, stride: 48 },
        Binding { binding: 4, name: "before_gbuffer", access: Read, stride: 56 },
        Binding { binding: 5, name: "before_reservoirs", access: Read, stride: 28 },
        Binding { binding: 6, name: "to_current", access: Read, stride: 8 },
        Binding { binding: 7, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 8, name: "reservoirs", access: ReadWrite, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_temporal_biased_any`.
pub static RESTIR_TEMPORAL_BIASED_ANY: Kernel = Kernel {
    name: "restir_temporal_biased_any",
    bytes: include_bytes!("../spirv/restir_temporal_biased_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "materials", access: Read, stride: 20 },
        Binding { binding: 1, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 2, name: "instances", access: Read, stride: 136 },
        Binding { binding: 3, name: "before_camera", access: Read, stride: 48 },
        Binding { binding: 4, name: "before_gbuffer", access: Read, stride: 56 },
        Binding { binding: 5, name: "before_reservoirs", access: Read, stride: 28 },
        Binding { binding: 6, name: "to_current", access: Read, stride: 8 },
        Binding { binding: 7, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 8, name: "reservoirs", access: ReadWrite, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_temporal_unbiased`.
pub static RESTIR_TEMPORAL_UNBIASED: Kernel = Kernel {
    name: "restir_temporal_unbiased",
    bytes: include_bytes!("../spirv/restir_temporal_unbiased.spv"),
    bindings: &[
        Binding { binding: 0, name: "before_ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "before_surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "before_triangles", access: Read, stride: 56 },
        Binding { binding: 3, name: "before_instances", access: Read, stride: 136 },
        Binding { binding: 4, name: "to_previous", access: Read, stride: 8 },
        Binding { binding: 5, name: "materials", access: Read, stride: 20 },
        Binding { binding: 6, name: "triangles", access: Read, stride: 56 },
        Binding { binding: 7, name: "instances", access: Read, stride: 136 },
        Binding { binding: 8, name: "before_camera", access: Read, stride: 48 },
        Binding { binding: 9, name: "before_gbuffer", access: Read, stride: 56 },
        Binding { binding: 10, name: "before_reservoirs", access: Read, stride: 28 },
        Binding { binding: 11, name: "to_current", access: Read, stride: 8 },
        Binding { binding: 12, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 13, name: "reservoirs", access: ReadWrite, stride: 28 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `restir_temporal_unbiased_any`.
pub static RESTIR_TEMPORAL_UNBIASED_ANY: Kernel = Kernel {
    name: "restir_temporal_unbiased_any",
    bytes: include_bytes!("../spirv/restir_temporal_unbiased_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "before_ray_nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "before_surfaces", access: Read, stride: 192 },
        Binding { binding: 2, name: "before_triangles", access: Read, stride: 68 },
        Binding { binding: 3, name: "before_instances", access: Read, stride: 136 },
        Binding { binding: 4, name: "to_previous", access: Read, stride: 8 },
        Binding { binding: 5, name: "materials", access: Read, stride: 20 },
        Binding { binding: 6, name: "triangles", access: Read, stride: 68 },
        Binding { binding: 7, name: "instances", access: Read, stride: 136 },
        Binding { binding: 8, name: "before_camera", access: Read, stride: 48 },
        Binding { binding: 9, name: "before_gbuffer", access: Read, stride: 56 },
        Binding { binding: 10, name: "before_reservoirs", access: Read, stride: 28 },
        Binding { binding: 11, name: "to_current", access: Read, stride: 8 },
        Binding { binding: 12, name: "gbuffer", access: Read, stride: 56 },
        Binding { binding: 13, name: "reservoirs", access: ReadWrite, stride: 28 },
        Binding { binding: 14, name: "before_corners", access: Read, stride: 28 },
        Binding { binding: 15, name: "paint", access: Read, stride: 4 },
    ],
    push_constants: 84,
    workgroup: [64, 1, 1],
};

/// Kernel `sample`.
pub static SAMPLE: Kernel = Kernel {
    name: "sample",
    bytes: include_bytes!("../spirv/sample.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_any`.
pub static SAMPLE_ANY: Kernel = Kernel {
    name: "sample_any",
    bytes: include_bytes!("../spirv/sample_any.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_eq4`.
pub static SAMPLE_EQ4: Kernel = Kernel {
    name: "sample_eq4",
    bytes: include_bytes!("../spirv/sample_eq4.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 112 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_linked`.
pub static SAMPLE_LINKED: Kernel = Kernel {
    name: "sample_linked",
    bytes: include_bytes!("../spirv/sample_linked.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 224 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 36 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_narrow`.
pub static SAMPLE_NARROW: Kernel = Kernel {
    name: "sample_narrow",
    bytes: include_bytes!("../spirv/sample_narrow.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 96 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_native`.
pub static SAMPLE_NATIVE: Kernel = Kernel {
    name: "sample_native",
    bytes: include_bytes!("../spirv/sample_native.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_segment`.
pub static SAMPLE_SEGMENT: Kernel = Kernel {
    name: "sample_segment",
    bytes: include_bytes!("../spirv/sample_segment.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_transmissive`.
pub static SAMPLE_TRANSMISSIVE: Kernel = Kernel {
    name: "sample_transmissive",
    bytes: include_bytes!("../spirv/sample_transmissive.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 192 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 40 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `sample_wide`.
pub static SAMPLE_WIDE: Kernel = Kernel {
    name: "sample_wide",
    bytes: include_bytes!("../spirv/sample_wide.spv"),
    bindings: &[
        Binding { binding: 0, name: "nodes", access: Read, stride: 384 },
        Binding { binding: 1, name: "instances", access: Read, stride: 136 },
        Binding { binding: 2, name: "trails", access: Read, stride: 4 },
        Binding { binding: 3, name: "queries", access: Read, stride: 32 },
        Binding { binding: 4, name: "results", access: Write, stride: 12 },
    ],
    push_constants: 24,
    workgroup: [64, 1, 1],
};

/// Kernel `scatter`.
pub static SCATTER: Kernel = Kernel {
    name: "scatter",
    bytes: include_bytes!("../spirv/scatter.spv"),
    bindings: &[
        Binding { binding: 0, name: "from", access: Read, stride: 4 },
        Binding { binding: 1, name: "to", access: Write, stride: 4 },
    ],
    push_constants: 12,
    workgroup: [64, 1, 1],
};

/// Kernel `segment_places`.
pub static SEGMENT_PLACES: Kernel = Kernel {
    name: "segment_places",
    bytes: include_bytes!("../spirv/segment_places.spv"),
    bindings: &[
        Binding { binding: 0, name: "queries", access: Read, stride: 32 },
        Binding { binding: 1, name: "points", access: Read, stride: 44 },
        Binding { binding: 2, name: "parts", access: Read, stride: 4 },
        Binding { binding: 3, name: "results", access: Write, stride: 8 },
    ],
    push_constants: 4,
    workgroup: [64, 1, 1],
};

/// Kernel `self_test`.
pub static SELF_TEST: Kernel = Kernel {
    name: "self_test",
    bytes: include_bytes!("../spirv/self_test.spv"),
    bindings: &[
        Binding { binding: 0, name: "operands", access: Read, stride: 12 },
        Binding { binding: 1, name: "answers", access: Write, stride: 4 },
    ],
    push_constants: 4,
    workgroup: [64, 1, 1],
};

/// All kernels, sorted by name.
pub static KERNELS: &[&Kernel] = &[
    &LIGHT_POINTS,
    &LIGHT_POINTS_ANY,
    &LIGHT_POINTS_LINKED,
    &PATH_BVH,
    &PATH_BVH_ANY,
    &PATH_BVH_EQ4,
    &PATH_POWER,
    &PATH_POWER_ANY,
    &PATH_UNIFORM,
    &PATH_UNIFORM_ANY,
    &PMF,
    &PMF_ANY,
    &PMF_EQ4,
    &PMF_LINKED,
    &PMF_NARROW,
    &PMF_NATIVE,
    &PMF_SEGMENT,
    &PMF_TRANSMISSIVE,
    &PMF_WIDE,
    &REFIT_BOTTOM,
    &REFIT_BOTTOM_ANY,
    &REFIT_BOTTOM_EQ4,
    &REFIT_BOTTOM_LINKED,
    &REFIT_NODES,
    &REFIT_NODES_ANY,
    &REFIT_NODES_EQ4,
    &REFIT_NODES_LINKED,
    &REFIT_ROOTS,
    &REFIT_ROOTS_ANY,
    &REFIT_ROOTS_EQ4,
    &REFIT_ROOTS_LINKED,
    &REFIT_TOP,
    &REFIT_TOP_ANY,
    &REFIT_TOP_EQ4,
    &REFIT_TOP_LINKED,
    &RENDER_BVH,
    &RENDER_BVH_ANY,
    &RENDER_BVH_EQ4,
    &RENDER_POWER,
    &RENDER_POWER_ANY,
    &RENDER_UNIFORM,
    &RENDER_UNIFORM_ANY,
    &RESTIR_INITIAL_BVH,
    &RESTIR_INITIAL_BVH_ANY,
    &RESTIR_INITIAL_BVH_EQ4,
    &RESTIR_INITIAL_POWER,
    &RESTIR_INITIAL_POWER_ANY,
    &RESTIR_SHADE,
    &RESTIR_SHADE_ANY,
    &RESTIR_SPATIAL_BIASED,
    &RESTIR_SPATIAL_BIASED_ANY,
    &RESTIR_SPATIAL_UNBIASED,
    &RESTIR_SPATIAL_UNBIASED_ANY,
    &RESTIR_TEMPORAL_BIASED,
    &RESTIR_TEMPORAL_BIASED_ANY,
    &RESTIR_TEMPORAL_UNBIASED,
    &RESTIR_TEMPORAL_UNBIASED_ANY,
    &SAMPLE,
    &SAMPLE_ANY,
    &SAMPLE_EQ4,
    &SAMPLE_LINKED,
    &SAMPLE_NARROW,
    &SAMPLE_NATIVE,
    &SAMPLE_SEGMENT,
    &SAMPLE_TRANSMISSIVE,
    &SAMPLE_WIDE,
    &SCATTER,
    &SEGMENT_PLACES,
    &SELF_TEST,
];
