//! A shader that imports the functions.

use wesl::{VirtualResolver, Wesl};

#[test]
fn functions_are_imported_with_what_they_use() {
    let own = "import lightbvh::{lightbvh_sample, lightbvh_light_point};
        @group(1) @binding(0) var<storage, read_write> out: array<f32>;
        @compute @workgroup_size(1) fn main() {
            let own = lightbvh_sample(vec3(0.0), vec3(0.0, 1.0, 0.0), vec2(1u, 2u));
            out[0] = own.pmf + lightbvh_light_point(own.light, own.instance, vec2(0.5)).density;
        }";
    let mut resolver = VirtualResolver::new();
    resolver.add_module("package::main".parse().unwrap(), own.into());
    let mut wesl = Wesl::new("").set_custom_resolver(resolver);
    wesl.add_package(&lightbvh_wesl::lightbvh::PACKAGE);
    let text = wesl.compile(&"package::main".parse().unwrap()).unwrap().to_string();
    assert!(text.contains("lights") && !text.contains("lightbvh_pmf("), "only what is used");
}
