//! The kernels' SPIR-V modules, built into the program.

/// A kernel's module under the kernel's name.
pub(crate) struct Module {
    pub(crate) name: &'static str,
    pub(crate) bytes: &'static [u8],
}

/// One entry of the table: the module that the kernels' builder wrote for the entry point of that name.
macro_rules! module {
    ($name:literal) => {
        Module {
            name: $name,
            bytes: include_bytes!(concat!("../../../kernels/spirv/", $name, ".spv")),
        }
    };
}

/// All kernels; a new kernel is one line here.
pub(crate) const MODULES: &[Module] = &[
    module!("refit_bottom"),
    module!("refit_bottom_eq4"),
    module!("refit_roots"),
    module!("refit_roots_eq4"),
    module!("refit_top"),
    module!("refit_top_eq4"),
    module!("sample"),
    module!("sample_eq4"),
    module!("pmf"),
    module!("pmf_eq4"),
    module!("render_uniform"),
    module!("render_power"),
    module!("render_bvh"),
    module!("render_bvh_eq4"),
    module!("path_uniform"),
    module!("path_power"),
    module!("path_bvh"),
    module!("path_bvh_eq4"),
    module!("restir_initial_power"),
    module!("restir_initial_bvh"),
    module!("restir_initial_bvh_eq4"),
    module!("restir_temporal_unbiased"),
    module!("restir_temporal_biased"),
    module!("restir_spatial_unbiased"),
    module!("restir_spatial_biased"),
    module!("restir_shade"),
    module!("self_test"),
];

/// All kernels' bytes, one after the other: different for every change of a kernel that changes what it does.
pub fn module_bytes() -> Vec<u8> {
    MODULES.iter().flat_map(|module| module.bytes).copied().collect()
}

/// A module's bytes as words; a ragged end is dropped and will not parse.
pub(crate) fn words(bytes: &[u8]) -> Vec<u32> {
    bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::spirv_interface::Interface;
    use super::*;
    use lightbvh_kernels::WORKGROUP;

    #[test]
    fn every_module_is_the_kernel_it_is_named_after() {
        for module in MODULES {
            let interface = Interface::read(&words(module.bytes)).expect(module.name);
            assert_eq!(interface.entry_point, module.name);
            assert_eq!(interface.workgroup, [WORKGROUP, 1, 1], "{}", module.name);
            assert!(
                interface.strides.iter().all(Option::is_some),
                "{}: a binding is not used",
                module.name
            );
        }
    }
}
