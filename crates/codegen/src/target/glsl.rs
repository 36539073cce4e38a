//! GLSL, one file for each stage: 4.50 for desktop GL, 3.00 ES for WebGL 2 and GL ES 3.
//!
//! GLSL joins texture and sampler. Each texture of a shader here has one sampler (a picture read in two ways is two
//! bindings), so joining loses nothing; the JSON names each joined sampler and what it is made of.

use naga::back::glsl;
use naga::{Expression, MathFunction};
use serde_json::{Map, Value, json as value};

use super::{ExportError, OutputFile, Source, Target, file, json, same};
use crate::reflection::Resource;

pub(super) const TARGET: Target = Target {
    name: "glsl",
    help: "GLSL 4.50, one file a stage",
    needs: same,
    write: |source, name| write(source, name, "glsl", desktop()),
};

pub(super) const TARGET_ES: Target = Target {
    name: "glsl-es",
    help: "GLSL ES 3.00 (WebGL 2), one file a stage",
    needs: same,
    write: |source, name| write(source, name, "glsl-es", es()),
};

fn desktop() -> glsl::Version {
    glsl::Version::Desktop(450)
}

fn es() -> glsl::Version {
    glsl::Version::Embedded { version: 300, is_webgl: false }
}

fn write(
    source: &Source<'_>,
    name: &str,
    target: &'static str,
    version: glsl::Version,
) -> Result<Vec<OutputFile>, ExportError> {
    let fail = |e: glsl::Error| ExportError::Backend { target, message: e.to_string() };
    // Explicit bindings are GLSL 4.20's and ES 3.10's; below, names are looked up.
    let mut binding_map = glsl::BindingMap::default();
    if matches!(version, glsl::Version::Desktop(_)) {
        let (mut blocks, mut textures) = (0_u8, 0_u8);
        for binding in &source.shader.reflection.bindings {
            let next = match binding.resource {
                Resource::Uniform(_) => &mut blocks,
                Resource::Texture(_) => &mut textures,
                Resource::Sampler(_) => continue,
            };
            binding_map.insert(naga::ResourceBinding { group: binding.group, binding: binding.binding }, *next);
            *next += 1;
        }
    }
    let options =
        glsl::Options { version, writer_flags: glsl::WriterFlags::empty(), binding_map, ..glsl::Options::default() };
    let (mut files, mut details) = (Vec::new(), Map::new());
    for (stage, entry_point, ending) in Source::STAGES {
        let alone = source.stage(stage, target)?;
        if matches!(version, glsl::Version::Embedded { .. })
            && let Some((function, what)) = missing_in_es(&alone.module)
        {
            let message =
                format!("GLSL ES 3.00 has no `{what}`, which `{function}` calls: leave it out, or take another target");
            return Err(ExportError::Backend { target, message });
        }
        let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: entry_point.into(), multiview: None };
        let mut text = String::new();
        let policies = naga::proc::BoundsCheckPolicies::default();
        let mut writer =
            glsl::Writer::new(&mut text, &alone.module, &alone.info, &options, &pipeline, policies).map_err(fail)?;
        let info = writer.write().map_err(fail)?;
        details.insert(ending.into(), names(&alone.module, &info));
        files.push(file(format!("{name}.{ending}"), headed(&text, source.shader.header())));
    }
    files.push(json::reflection(source, name, target, Some(("glsl", Value::Object(details)))));
    Ok(files)
}

/// The first function that calls a built-in which GLSL has in later versions only, and that built-in as WGSL names it. naga
/// writes some of these all the same.
fn missing_in_es(module: &naga::Module) -> Option<(&str, &'static str)> {
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let functions = module.functions.iter().map(|(_, function)| function).chain(entries);
    functions.into_iter().find_map(|function| {
        let missing = function.expressions.iter().find_map(|(_, expression)| match expression {
            Expression::Math { fun, .. } => later_than_es(*fun),
            _ => None,
        });
        missing.map(|what| (function.name.as_deref().unwrap_or("the shader"), what))
    })
}

fn later_than_es(function: MathFunction) -> Option<&'static str> {
    Some(match function {
        MathFunction::Ldexp => "ldexp",
        MathFunction::Frexp => "frexp",
        MathFunction::CountOneBits => "countOneBits",
        MathFunction::ReverseBits => "reverseBits",
        MathFunction::ExtractBits => "extractBits",
        MathFunction::InsertBits => "insertBits",
        MathFunction::FirstLeadingBit => "firstLeadingBit",
        MathFunction::FirstTrailingBit => "firstTrailingBit",
        MathFunction::CountLeadingZeros => "countLeadingZeros",
        MathFunction::CountTrailingZeros => "countTrailingZeros",
        MathFunction::Pack4x8snorm => "pack4x8snorm",
        MathFunction::Pack4x8unorm => "pack4x8unorm",
        MathFunction::Dot4U8Packed => "dot4U8Packed",
        MathFunction::Dot4I8Packed => "dot4I8Packed",
        MathFunction::Unpack4xU8 => "unpack4xU8",
        MathFunction::Unpack4xI8 => "unpack4xI8",
        _ => return None,
    })
}

/// The text with the comment: after the version, which GLSL ES wants in the first line.
fn headed(text: &str, header: &str) -> String {
    let version = text.find('\n').map_or(0, |end| end + 1);
    format!("{}{header}{}", &text[..version], &text[version..])
}

/// What the blocks and joined samplers of a stage are called, in order of names.
fn names(module: &naga::Module, info: &glsl::ReflectionInfo) -> Value {
    let global =
        |handle: naga::Handle<naga::GlobalVariable>| module.global_variables[handle].name.clone().unwrap_or_default();
    let mut blocks: Vec<(String, String)> =
        info.uniforms.iter().map(|(handle, name)| (global(*handle), name.clone())).collect();
    let mut textures: Vec<(String, String, Option<String>)> = info
        .texture_mapping
        .iter()
        .map(|(name, mapping)| (global(mapping.texture), name.clone(), mapping.sampler.map(global)))
        .collect();
    blocks.sort();
    textures.sort();
    value!({
        "blocks": blocks.iter().map(|(name, glsl)| (name.clone(), Value::from(glsl.as_str()))).collect::<Map<_, _>>(),
        "samplers": textures
            .iter()
            .map(|(texture, glsl, sampler)| value!({ "name": glsl, "texture": texture, "sampler": sampler }))
            .collect::<Vec<_>>(),
    })
}
