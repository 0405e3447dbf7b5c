//! Makes a package for WESL of the functions in WGSL.

fn main() {
    let root = wesl::Module {
        name: "lightbvh".to_owned(),
        source: lightbvh_gpu::functions::WGSL.to_owned(),
        submodules: Vec::new(),
    };
    let package = wesl::Pkg {
        crate_name: "lightbvh_wesl".to_owned(),
        root,
        dependencies: Vec::new(),
    };
    package.build_artifact().expect("OUT_DIR can be written");
}
