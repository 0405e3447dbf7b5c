//! The languages of a library.

use naga::back::{glsl, hlsl, msl, wgsl};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Expression, Function, Module, ShaderStage, Span, Statement};

use crate::Error;

/// A language that libraries are printed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// WGSL, and WESL, which imports it.
    Wgsl,
    /// GLSL 4.50 for Vulkan.
    Glsl,
    /// HLSL, shader model 6.0; Slang takes it.
    Hlsl,
    /// The Metal shading language 2.4.
    Msl,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Wgsl, Self::Glsl, Self::Hlsl, Self::Msl];

    /// What names of files end in.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "metal",
        }
    }

    pub(super) fn print(self, module: &Module) -> Result<String, Error> {
        let info = validated(module)?;
        let text = match self {
            Self::Wgsl => wgsl::write_string(module, &info, wgsl::WriterFlags::empty()).map_err(said)?,
            Self::Glsl => in_glsl(module)?,
            Self::Hlsl => in_hlsl(module, &info)?,
            Self::Msl => {
                let options = msl::Options {
                    lang_version: (2, 4),
                    force_loop_bounding: false,
                    ..Default::default()
                };
                msl::write_string(module, &info, &options, &msl::PipelineOptions::default())
                    .map_err(said)?
                    .0
            }
        };
        let lines = text.lines().map(|line| format!("{}\n", line.trim_end()));
        Ok(format!("{HEAD}\n{}", lines.collect::<String>().trim_start()))
    }
}

const HEAD: &str = "\
// Functions of lightbvh (docs/shaders.md). Written by `print-functions` from compiled kernels; edits are lost.
";

fn said(error: impl std::fmt::Display) -> Error {
    Error(error.to_string())
}

fn validated(module: &Module) -> Result<ModuleInfo, Error> {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator
        .validate(module)
        .map_err(|error| Error(error.emit_to_string("")))
}

/// The writer wants an entry point: one that calls each function, and is cut off again.
fn in_glsl(module: &Module) -> Result<String, Error> {
    let mut module = module.clone();
    let mut function = Function::default();
    for (called, own) in module.functions.iter() {
        let zeros = own.arguments.iter().map(|argument| {
            function
                .expressions
                .append(Expression::ZeroValue(argument.ty), Span::UNDEFINED)
        });
        let arguments = zeros.collect();
        let result = function
            .expressions
            .append(Expression::CallResult(called), Span::UNDEFINED);
        let call = Statement::Call {
            function: called,
            arguments,
            result: Some(result),
        };
        function.body.push(call, Span::UNDEFINED);
    }
    module.entry_points.push(naga::EntryPoint {
        name: "main".to_owned(),
        stage: ShaderStage::Compute,
        early_depth_test: None,
        workgroup_size: [1, 1, 1],
        workgroup_size_overrides: None,
        function,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    });
    let info = validated(&module)?;
    let mut text = String::new();
    let mut options = glsl::Options {
        version: glsl::Version::Desktop(450),
        writer_flags: glsl::WriterFlags::empty(),
        ..Default::default()
    };
    for own in module.global_variables.iter().filter_map(|(_, own)| own.binding) {
        options.binding_map.insert(own, own.binding as u8);
    }
    let pipeline = glsl::PipelineOptions {
        shader_stage: ShaderStage::Compute,
        entry_point: "main".to_owned(),
        multiview: None,
    };
    let policies = naga::proc::BoundsCheckPolicies::default();
    glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
        .map_err(said)?
        .write()
        .map_err(said)?;
    for (_, own) in module.global_variables.iter() {
        if let (Some(at), Some(name)) = (own.binding, &own.name) {
            text = text.replace(&format!("_group_{}_binding_{}_cs", at.group, at.binding), name);
            let binding = format!("binding = {})", at.binding);
            text = text.replace(
                &format!(", {binding}"),
                &format!(", set = {}, {binding}", at.group),
            );
        }
    }
    let (start, end) = (text.find("struct"), text.find("void main()"));
    Ok(text[start.unwrap_or(0)..end.unwrap_or(text.len())]
        .trim_end()
        .to_owned())
}

fn in_hlsl(module: &Module, info: &ModuleInfo) -> Result<String, Error> {
    let mut text = String::new();
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V6_0,
        force_loop_bounding: false,
        ..Default::default()
    };
    let pipeline = hlsl::PipelineOptions::default();
    hlsl::Writer::new(&mut text, &options, &pipeline)
        .write(module, info, None)
        .map_err(said)?;
    Ok(text)
}
