//! A shader that imports the functions.

use wesl::Wesl;

#[test]
fn functions_are_imported_with_what_they_use() {
    let mut wesl = Wesl::new("tests/shaders");
    wesl.add_package(&lightbvh_wesl::lightbvh::PACKAGE);
    let compiled = wesl
        .compile(&"package::main".parse().unwrap())
        .unwrap()
        .to_string();
    naga::front::wgsl::parse_str(&compiled).unwrap();
    assert!(!compiled.contains("lightbvh_pmf"), "nothing that is not used");
}
