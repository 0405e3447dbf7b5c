//! Compiled kernels. Written by `build-kernels` from the modules in `spirv`; edits are lost.

// Constant, name, bytes of push constants, workgroup: for each binding its name, access and stride.
lightbvh_gpu::kernels! {
    RENDER "render" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 192, 7 trails Read 4, 8 thresholds Read 4, 9 results Write 12;
    RENDER_ANY "render_any" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 256, 7 trails Read 4, 8 thresholds Read 4, 9 corners Read 28, 10 textures Read 4, 11 results Write 12;
    RENDER_EQ4 "render_eq4" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 112, 7 trails Read 4, 8 thresholds Read 4, 9 results Write 12;
    RENDER_PATHS "render_paths" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 192, 7 trails Read 4, 8 thresholds Read 4, 9 results Write 12;
    RENDER_PATHS_ANY "render_paths_any" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 256, 7 trails Read 4, 8 thresholds Read 4, 9 corners Read 28, 10 textures Read 4, 11 results Write 12;
    RENDER_PATHS_EQ4 "render_paths_eq4" 104 [64, 1, 1]: 0 ray_nodes Read 224, 1 surfaces Read 192, 2 materials Read 20, 3 lights Read 56, 4 instances Read 136, 5 camera Read 48, 6 nodes Read 112, 7 trails Read 4, 8 thresholds Read 4, 9 results Write 12;
}
