//! Compiled kernels. Written by `build-kernels` from the modules in `spirv`; edits are lost.

// Constant, name, bytes of push constants, workgroup: for each binding its name, access and stride.
crate::kernels! {
    LIGHT_POINTS "light_points" 4 [64, 1, 1]: 0 lights Read 56, 1 instances Read 136, 2 samples Read 12, 3 numbers Read 8, 4 results Write 44;
    LIGHT_POINTS_ANY "light_points_any" 4 [64, 1, 1]: 0 lights Read 56, 1 instances Read 136, 2 queries Read 32, 3 samples Read 12, 4 numbers Read 8, 5 results Write 44;
    LIGHT_POINTS_LINKED "light_points_linked" 4 [64, 1, 1]: 0 lights Read 56, 1 instances Read 136, 2 queries Read 36, 3 samples Read 12, 4 numbers Read 8, 5 results Write 44;
    PMF "pmf" 40 [64, 1, 1]: 0 nodes Read 192, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 4;
    PMF_ANY "pmf_any" 40 [64, 1, 1]: 0 nodes Read 256, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 4;
    PMF_CELL "pmf_cell" 40 [64, 1, 1]: 0 nodes Read 192, 1 instances Read 136, 2 trails Read 4, 3 queries Read 44, 4 results Write 4;
    PMF_EQ4 "pmf_eq4" 40 [64, 1, 1]: 0 nodes Read 112, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 4;
    PMF_LINKED "pmf_linked" 40 [64, 1, 1]: 0 nodes Read 288, 1 instances Read 136, 2 trails Read 4, 3 queries Read 36, 4 results Write 4;
    REFIT_BOTTOM "refit_bottom" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 nodes Read 192, 3 children Write 384;
    REFIT_BOTTOM_ANY "refit_bottom_any" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 nodes Read 256, 3 children Write 704;
    REFIT_BOTTOM_EQ4 "refit_bottom_eq4" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 nodes Read 112, 3 children Write 192;
    REFIT_BOTTOM_LINKED "refit_bottom_linked" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 nodes Read 288, 3 children Write 704;
    REFIT_NODES "refit_nodes" 12 [64, 1, 1]: 0 list Read 4, 1 children Read 384, 2 nodes Write 192;
    REFIT_NODES_ANY "refit_nodes_any" 12 [64, 1, 1]: 0 list Read 4, 1 children Read 704, 2 nodes Write 256;
    REFIT_NODES_EQ4 "refit_nodes_eq4" 12 [64, 1, 1]: 0 list Read 4, 1 children Read 192, 2 nodes Write 112;
    REFIT_NODES_LINKED "refit_nodes_linked" 12 [64, 1, 1]: 0 list Read 4, 1 children Read 704, 2 nodes Write 288;
    REFIT_TOP "refit_top" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 instances Read 136, 3 nodes Read 192, 4 children Write 384;
    REFIT_TOP_ANY "refit_top_any" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 instances Read 136, 3 nodes Read 256, 4 children Write 704;
    REFIT_TOP_EQ4 "refit_top_eq4" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 instances Read 136, 3 nodes Read 112, 4 children Write 192;
    REFIT_TOP_LINKED "refit_top_linked" 12 [64, 1, 1]: 0 list Read 4, 1 lights Read 56, 2 instances Read 136, 3 nodes Read 288, 4 children Write 704;
    SAMPLE "sample" 40 [64, 1, 1]: 0 nodes Read 192, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 12;
    SAMPLE_ANY "sample_any" 40 [64, 1, 1]: 0 nodes Read 256, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 12;
    SAMPLE_CELL "sample_cell" 40 [64, 1, 1]: 0 nodes Read 192, 1 instances Read 136, 2 trails Read 4, 3 queries Read 44, 4 results Write 12;
    SAMPLE_EQ4 "sample_eq4" 40 [64, 1, 1]: 0 nodes Read 112, 1 instances Read 136, 2 trails Read 4, 3 queries Read 32, 4 results Write 12;
    SAMPLE_LINKED "sample_linked" 40 [64, 1, 1]: 0 nodes Read 288, 1 instances Read 136, 2 trails Read 4, 3 queries Read 36, 4 results Write 12;
    SCATTER "scatter" 12 [64, 1, 1]: 0 from Read 4, 1 to Write 4;
    SELF_TEST "self_test" 4 [64, 1, 1]: 0 operands Read 12, 1 answers Write 4;
}
