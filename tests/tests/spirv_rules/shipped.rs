//! The committed modules.

use lightbvh::TreeWords;
use lightbvh_kernels::query::QueryPush;
use lightbvh_kernels::refit::RefitPush;
use lightbvh_kernels::{ROW_GROUPS, WORKGROUP};
use lightbvh_kernels_builder::decorate::decorate;
use lightbvh_kernels_builder::manifest;
use lightbvh_kernels_builder::verify::verify;
use rspirv::dr::Operand;
use rspirv::spirv::MemoryAccess;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace above the tests")
}

#[test]
fn shipped_modules_are_those_of_the_sources() {
    let manifest = manifest::check(root()).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        manifest
            .modules
            .iter()
            .any(|record| record.file == "self_test.spv")
    );
}

#[test]
fn shipped_modules_obey_the_rules() {
    for record in manifest::read(root()).unwrap().modules {
        let words = manifest::read_module(root(), &record).unwrap();
        verify(&record.file, &words).unwrap_or_else(|error| panic!("{error}"));
        let interface = record.interface(&words).unwrap();
        assert_eq!(interface.workgroup, [WORKGROUP, 1, 1], "{}", record.file);
        assert!(interface.push_constants <= 128, "{}", record.file);
        let module = rspirv::dr::load_words(&words).unwrap();
        assert!(
            module.debug_string_source.is_empty() && module.debug_names.is_empty(),
            "{} names files of the machine that built it",
            record.file
        );
        // Accesses stay private, which is faster: no invocation reads what another of its dispatch writes.
        let marked = Operand::MemoryAccess(MemoryAccess::NON_PRIVATE_POINTER);
        let shared = module.all_inst_iter().any(|inst| inst.operands.contains(&marked));
        assert!(!shared, "{} shares memory", record.file);
    }
}

/// What an engine is told without the kernels' crate is what that crate says.
#[test]
fn push_constants_and_rows_are_those_of_the_kernels() {
    assert_eq!(lightbvh_gpu::ROW_GROUPS, ROW_GROUPS);
    let tree = TreeWords {
        root: 1,
        trail_words: 2,
        live: 3,
        lights: 4,
        depth: 5,
        top: 6,
        above: 7,
        places: 8,
        parts: 9,
    };
    let words = lightbvh_gpu::query_push(9, tree);
    assert_eq!(
        bytemuck::bytes_of(&words),
        bytemuck::bytes_of(&QueryPush { count: 9, tree })
    );
    // As `lightbvh_gpu::Step::Dispatch` has them.
    let push = RefitPush {
        first: 6,
        count: 7,
        top: 8,
    };
    assert_eq!(bytemuck::bytes_of(&[6_u32, 7, 8]), bytemuck::bytes_of(&push));
}

#[test]
fn words_that_are_no_module_are_refused() {
    let error = verify("x.spv", &[1, 2, 3]).unwrap_err().to_string();
    assert!(
        error.starts_with("x.spv: not a readable SPIR-V module"),
        "{error}"
    );
    assert!(decorate(&[]).is_err());
    let error = manifest::read(Path::new("/nowhere")).unwrap_err().to_string();
    assert!(error.starts_with("cannot read /nowhere/"), "{error}");
}
