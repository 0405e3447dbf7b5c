//! Modules of one function, and what the verifier says of them.

use lightbvh_kernels_builder::decorate::decorate;
use lightbvh_kernels_builder::verify::verify;
use rspirv::binary::Assemble;
use rspirv::dr::Builder;
use rspirv::spirv::{
    AddressingModel, Capability, ExecutionMode, ExecutionModel, FunctionControl, MemoryModel,
};

/// A compute module whose body is what `body` writes between the entry label and the return.
pub fn module(body: impl FnOnce(&mut Builder, Types)) -> Vec<u32> {
    let mut b = Builder::new();
    b.set_version(1, 5);
    b.capability(Capability::Shader);
    b.capability(Capability::VulkanMemoryModel);
    b.memory_model(AddressingModel::Logical, MemoryModel::Vulkan);
    let void = b.type_void();
    let kernel = b.type_function(void, []);
    let float = b.type_float(32, None);
    let uint = b.type_int(32, 0);
    let two = b.constant_bit32(float, 2f32.to_bits());
    let three = b.constant_bit32(float, 3f32.to_bits());
    let glsl = b.ext_inst_import("GLSL.std.450");
    let main = b
        .begin_function(void, None, FunctionControl::NONE, kernel)
        .unwrap();
    b.begin_block(None).unwrap();
    body(
        &mut b,
        Types {
            float,
            uint,
            two,
            three,
            glsl,
        },
    );
    b.ret().unwrap();
    b.end_function().unwrap();
    b.entry_point(ExecutionModel::GLCompute, main, "kernel", []);
    b.execution_mode(main, ExecutionMode::LocalSize, [64, 1, 1]);
    b.module().assemble()
}

/// Ids that the bodies use.
pub struct Types {
    pub float: u32,
    pub uint: u32,
    pub two: u32,
    pub three: u32,
    pub glsl: u32,
}

/// The rules that the module breaks, as one text; empty when it is accepted.
pub fn complaint(words: &[u32]) -> String {
    match verify("kernel.spv", words) {
        Ok(()) => String::new(),
        Err(error) => error.to_string(),
    }
}

/// Decorates first, so that only the operation itself can be what is refused.
pub fn complaint_about(body: impl FnOnce(&mut Builder, Types)) -> String {
    complaint(&decorate(&module(body)).unwrap())
}
