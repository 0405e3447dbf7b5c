//! x
use spirv_builder::*;
fn main() {
    let mut b = SpirvBuilder::new(std::env::args().nth(1).unwrap(), "spirv-unknown-vulkan1.2");
    b.rustc_codegen_spirv_location = Some(std::env::var_os("RUSTC_CODEGEN_SPIRV").unwrap().into());
    b.toolchain_overwrite = Some(std::env::var("RUST_GPU_TOOLCHAIN").unwrap());
    b.multimodule = true;
    if std::env::var_os("BRAKE").is_some() { b.capabilities.push(Capability::SignedZeroInfNanPreserve); }
    if std::env::var_os("NOOPT").is_some() { b.extra_args.push("--no-spirv-opt".into()); }
    let r = b.build();
    match r { Ok(r) => println!("{r:#?}"), Err(e) => println!("{e}") }
}
