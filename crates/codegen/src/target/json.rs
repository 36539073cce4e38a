//! `NAME.json` beside an exported shader: what it wants bound and fed, for other engines to read.

use serde_json::{Map, Value, json};

use super::{OutputFile, Source, file};
use crate::emit::text::Origin;
use crate::line_map::{Lines, line_map};
use crate::reflection::{
    Binding, LightKind, Resource, SamplerSource, ShaderParameter, TextureSource, UniformMember, UniformSource,
};

/// The reflection as a file. `details` are the target's own names and numbers.
pub(super) fn reflection(source: &Source<'_>, name: &str, target: &str, details: Option<(&str, Value)>) -> OutputFile {
    let reflection = &source.shader.reflection;
    let mut root = Map::new();
    root.insert("halfvector".into(), json!(1));
    root.insert("target".into(), json!(target));
    root.insert("entry_points".into(), json!({ "vertex": "vs_main", "fragment": "fs_main" }));
    root.insert(
        "vertex_inputs".into(),
        reflection
            .vertex_inputs
            .iter()
            .map(|i| json!({ "name": i.name, "location": i.location, "type": i.ty.wgsl() }))
            .collect(),
    );
    root.insert("bindings".into(), reflection.bindings.iter().map(binding).collect());
    root.insert("parameters".into(), reflection.parameters.iter().map(parameter).collect());
    root.insert("alpha_mode".into(), json!(reflection.alpha_mode.name()));
    root.insert("double_sided".into(), json!(reflection.double_sided));
    let left_out = source.shader.dropped.iter().map(|d| {
        let mut entry = json!({ "what": d.what, "why": d.why });
        if let Some(count) = d.instructions {
            entry["instructions"] = json!(count);
        }
        entry
    });
    root.insert("left_out".into(), left_out.collect());
    if target == "wgsl" {
        // Other targets have other lines.
        root.insert("lines".into(), line_map(source.shader).iter().map(lines).collect());
    }
    if let Some((key, value)) = details {
        root.insert(key.into(), value);
    }
    let text = serde_json::to_string_pretty(&Value::Object(root)).unwrap_or_default();
    file(format!("{name}.json"), format!("{text}\n"))
}

fn lines(lines: &Lines) -> Value {
    let Lines { first, last, origin } = lines;
    match origin {
        Origin::Node(id) => json!({ "first": first, "last": last, "node": id }),
        Origin::Library(file) => json!({ "first": first, "last": last, "file": file }),
        Origin::Frame(part) => json!({ "first": first, "last": last, "node": null, "part": part.name() }),
    }
}

fn binding(binding: &Binding) -> Value {
    let mut entry = Map::new();
    entry.insert("group".into(), json!(binding.group));
    entry.insert("binding".into(), json!(binding.binding));
    entry.insert("name".into(), json!(binding.name));
    let stages = [("vertex", binding.vertex), ("fragment", binding.fragment)];
    entry.insert("stages".into(), stages.iter().filter(|(_, used)| *used).map(|(name, _)| json!(name)).collect());
    match &binding.resource {
        Resource::Uniform(block) => {
            entry.insert("kind".into(), json!("uniform"));
            entry.insert("struct".into(), json!(block.struct_name));
            entry.insert("size".into(), json!(block.size));
            entry.insert("members".into(), block.members.iter().map(member).collect());
        }
        Resource::Texture(texture) => {
            entry.insert("kind".into(), json!("texture"));
            let (dimension, source) = match texture {
                TextureSource::Image(image) => {
                    let file = serde_json::to_value(image).unwrap_or_default();
                    ("2d", json!({ "image": file }))
                }
                TextureSource::PrefilteredRadiance => ("cube", json!("prefiltered_radiance")),
                TextureSource::IrradianceOverPi => ("cube", json!("irradiance_over_pi")),
                TextureSource::Dfg => ("2d", json!("dfg")),
            };
            entry.insert("dimension".into(), json!(dimension));
            entry.insert("source".into(), source);
        }
        Resource::Sampler(sampler) => {
            entry.insert("kind".into(), json!("sampler"));
            let source = match sampler {
                SamplerSource::LinearClamp => json!("linear_clamp"),
                SamplerSource::Image { wrap_u, wrap_v, filter } => {
                    json!({ "wrap_u": wrap_u, "wrap_v": wrap_v, "filter": filter })
                }
            };
            entry.insert("source".into(), source);
        }
    }
    Value::Object(entry)
}

fn member(member: &UniformMember) -> Value {
    let source = match &member.source {
        UniformSource::ClipFromWorld => json!("clip_from_world"),
        UniformSource::CameraPosition => json!("camera_position"),
        UniformSource::Time => json!("time"),
        UniformSource::Exposure => json!("exposure"),
        UniformSource::EnvironmentRotation => json!("environment_rotation"),
        UniformSource::EnvironmentLevels => json!("environment_levels"),
        UniformSource::IrradianceSh => json!("irradiance_sh"),
        UniformSource::Lights(LightKind::Directional) => json!("directional_lights"),
        UniformSource::Lights(LightKind::Point) => json!("point_lights"),
        UniformSource::Lights(LightKind::Spot) => json!("spot_lights"),
        UniformSource::Input(socket) => json!({ "node": socket.node, "socket": socket.socket }),
        UniformSource::ViewFromWorld => json!("view_from_world"),
        UniformSource::WorldFromObject => json!("world_from_object"),
        UniformSource::ObjectFromWorld => json!("object_from_world"),
        UniformSource::NormalFromObject => json!("normal_from_object"),
    };
    json!({ "name": member.name, "type": member.ty.wgsl(), "offset": member.offset, "source": source })
}

fn parameter(parameter: &ShaderParameter) -> Value {
    json!({
        "name": parameter.name,
        "label": parameter.label,
        "type": parameter.ty.wgsl(),
        "default": parameter.default,
        "range": parameter.range,
    })
}
