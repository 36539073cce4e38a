//! HLSL, shader model 5.1: both stages in one file. Registers are the WGSL bindings, spaces the WGSL groups.
//!
//! naga reads samplers through a heap and an index buffer, which only wgpu has. The lines that declare them follow one
//! form, and are exchanged for plain registers. Arrays of zeros it writes as `(float[7])0`, which not every compiler takes: they
//! become lists.

use std::collections::BTreeMap;

use naga::back::hlsl;

use super::{ExportError, OutputFile, Source, Target, file, json, same};
use crate::reflection::Resource;

pub(super) const TARGET: Target = Target { name: "hlsl", help: "HLSL, shader model 5.1", needs: same, write };

fn write(source: &Source<'_>, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let fail = |message: String| ExportError::Backend { target: TARGET.name, message };
    let mut options = hlsl::Options {
        fake_missing_bindings: false,
        restrict_indexing: false,
        force_loop_bounding: false,
        ..hlsl::Options::default()
    };
    let mut samplers = BTreeMap::new();
    for binding in &source.shader.reflection.bindings {
        let place = naga::ResourceBinding { group: binding.group, binding: binding.binding };
        let target =
            hlsl::BindTarget { space: binding.group as u8, register: binding.binding, ..hlsl::BindTarget::default() };
        options.binding_map.insert(place, target);
        if matches!(binding.resource, Resource::Sampler(_)) {
            samplers.insert((binding.group, binding.binding), ());
            let key = hlsl::SamplerIndexBufferKey { group: binding.group };
            options.sampler_buffer_binding_map.insert(key, hlsl::BindTarget { space: 255, ..target });
        }
    }
    let mut text = String::new();
    let pipeline = hlsl::PipelineOptions::default();
    let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
    let fragment = hlsl::FragmentEntryPoint::new(&source.valid.module, "fs_main");
    let info =
        writer.write(&source.valid.module, &source.valid.info, fragment.as_ref()).map_err(|e| fail(e.to_string()))?;
    for entry_point in info.entry_point_names {
        entry_point.map_err(|e| fail(e.to_string()))?;
    }
    let text = listed_zeros(&plain_samplers(&text));
    if text.contains("nagaSamplerHeap") || text.matches(": register(s").count() != samplers.len() {
        return Err(fail("naga's form of samplers is not the one that is known here".into()));
    }
    let text = format!("{}{text}", source.shader.header());
    Ok(vec![file(format!("{name}.hlsl"), text), json::reflection(source, name, TARGET.name, None)])
}

/// Exchanges naga's sampler heap for registers.
fn plain_samplers(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for line in text.lines() {
        if declares_heap(line) {
            continue;
        }
        match sampler(line) {
            Some((name, group, index)) => {
                plain.push_str(&format!("SamplerState {name} : register(s{index}, space{group});"));
            }
            None => plain.push_str(line),
        }
        plain.push('\n');
    }
    plain
}

/// Exchanges zeros that are cast to an array for lists of zeros: initial values, and results of functions.
fn listed_zeros(text: &str) -> String {
    let mut listed = String::with_capacity(text.len());
    for line in text.lines() {
        match zeros(line) {
            Some((before, zeros)) if !before.ends_with("return ") => {
                listed.push_str(&format!("{before}{};", zeros.list()))
            }
            Some((before, zeros)) => {
                let Zeros { element, count } = zeros;
                let indent = &before[..before.len() - "return ".len()];
                listed.push_str(&format!(
                    "{indent}const {element} zeros[{count}] = {};\n{indent}return zeros;",
                    zeros.list()
                ));
            }
            None => listed.push_str(line),
        }
        listed.push('\n');
    }
    listed
}

/// An array of zeros.
struct Zeros<'t> {
    /// Type of an element.
    element: &'t str,
    count: usize,
}

impl Zeros<'_> {
    fn list(&self) -> String {
        let zero = format!("({})0", self.element);
        format!("{{ {} }}", vec![zero.as_str(); self.count].join(", "))
    }
}

/// What stands before `(T[N])0;` at the end of a line, and the array.
fn zeros(line: &str) -> Option<(&str, Zeros<'_>)> {
    let (before, ty) = line.strip_suffix("])0;")?.rsplit_once('(')?;
    let (element, count) = ty.split_once('[')?;
    Some((before, Zeros { element, count: count.parse().ok()? }))
}

fn declares_heap(line: &str) -> bool {
    line.starts_with("SamplerState nagaSamplerHeap[")
        || line.starts_with("SamplerComparisonState nagaComparisonSamplerHeap[")
        || (line.starts_with("StructuredBuffer<uint> nagaGroup") && line.contains("SamplerIndexArray"))
}

/// (name, group, binding) of `static const SamplerState NAME = nagaSamplerHeap[nagaGroupGSamplerIndexArray[N]];`
fn sampler(line: &str) -> Option<(&str, u32, u32)> {
    let rest = line.strip_prefix("static const SamplerState ")?;
    let (name, rest) = rest.split_once(" = nagaSamplerHeap[nagaGroup")?;
    let (group, rest) = rest.split_once("SamplerIndexArray[")?;
    let index = rest.strip_suffix("]];")?;
    Some((name, group.parse().ok()?, index.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heap_becomes_registers() {
        let naga = "SamplerState nagaSamplerHeap[2048]: register(s0, space0);\n\
                    SamplerComparisonState nagaComparisonSamplerHeap[2048]: register(s0, space1);\n\
                    StructuredBuffer<uint> nagaGroup1SamplerIndexArray : register(t2, space255);\n\
                    static const SamplerState linear_repeat = nagaSamplerHeap[nagaGroup1SamplerIndexArray[2]];\nfloat x;\n";
        assert_eq!(plain_samplers(naga), "SamplerState linear_repeat : register(s2, space1);\nfloat x;\n");
    }

    #[test]
    fn zeros_become_lists() {
        let naga = "    float3 p[2] = (float3[2])0;\n    return (int[3])0;\n    float4 c = (float4)0;\n    x = a[0];\n";
        let listed = "    float3 p[2] = { (float3)0, (float3)0 };\n    const int zeros[3] = { (int)0, (int)0, (int)0 };\n    \
                      return zeros;\n    float4 c = (float4)0;\n    x = a[0];\n";
        assert_eq!(listed_zeros(naga), listed);
    }
}
