//! Bevy: a material plug-in, as a Rust file and a WGSL file to put side by side into an app's sources.
//!
//! Bevy gives the viewer, all of its own lights with their shadows, the mesh and the tone map; whatever else the shader reads
//! (parameters, images, an environment) is a field of the material. Bevy's own vertex stage is used: heights displace nothing.

mod plugin;

use halfvector_graph::needs::{Needs, ShaderOutput};
use halfvector_shaders::{SliceError, TokenKind, slice, tokens};

use super::{ExportError, OutputFile, Source, Target, file};
use crate::emit::expression::lights_member;
use crate::emit::vertex::VARYINGS;
use crate::reflection::{Binding, LightKind, Resource, TextureSource, UniformSource};

/// The version that the files are written for.
pub(super) const BEVY: &str = "0.19";

pub(super) const TARGET: Target =
    Target { name: "bevy", help: "Bevy 0.19: a material plug-in, Rust and WGSL", needs: engine_needs, write };

/// Imports, and what every shader hands back.
const ENGINE: &str = include_str!("bevy/engine.wgsl");
/// The lights of the app.
const LIGHTS: &str = include_str!("bevy/lights.wgsl");

/// Lights come from the app: loops over each kind. The table of albedos is none of Bevy's, a fit serves without it.
fn engine_needs(mut needs: Needs) -> Needs {
    (needs.directional_lights, needs.point_lights, needs.spot_lights) = (LOOPED, LOOPED, LOOPED);
    needs.output = ShaderOutput::Radiance;
    if needs.methods.is("dfg", "table") {
        // Both are names of the list.
        let _ = needs.methods.set("dfg", "fit");
    }
    needs
}

/// Any number of lights that is written as a loop, whose bounds are then the engine's.
const LOOPED: u32 = 2;

fn write(source: &Source<'_>, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let stem = plugin::snake(name);
    let fields = material_bindings(&source.shader.reflection.bindings);
    let wgsl = shader(source, &fields)?;
    let rust = plugin::plugin(&source.shader.reflection, &fields, name, &stem, &wgsl);
    Ok(vec![file(format!("{stem}.rs"), rust), file(format!("{stem}.wgsl"), wgsl)])
}

/// A binding of the material in Bevy, by its new number; of a uniform block what Bevy does not fill.
pub(super) struct Field<'s> {
    number: u32,
    binding: &'s Binding,
}

/// Whether Bevy fills a member.
fn is_of_engine(source: &UniformSource) -> bool {
    matches!(
        source,
        UniformSource::ClipFromWorld
            | UniformSource::CameraPosition
            | UniformSource::Time
            | UniformSource::Lights(_)
            | UniformSource::ViewFromWorld
            | UniformSource::WorldFromObject
            | UniformSource::ObjectFromWorld
            | UniformSource::NormalFromObject
    )
}

/// What the fragment stage reads that Bevy has not.
fn material_bindings(bindings: &[Binding]) -> Vec<Field<'_>> {
    let wanted = bindings.iter().filter(|binding| match &binding.resource {
        _ if !binding.fragment => false,
        Resource::Uniform(block) => block.members.iter().any(|member| !is_of_engine(&member.source)),
        Resource::Texture(_) | Resource::Sampler(_) => true,
    });
    wanted.enumerate().map(|(number, binding)| Field { number: number as u32, binding }).collect()
}

/// The WGSL: the exported fragment stage, fed by Bevy.
fn shader(source: &Source<'_>, fields: &[Field<'_>]) -> Result<String, ExportError> {
    let fail = |what: &str| ExportError::Backend { target: TARGET.name, message: format!("there is no {what}") };
    let text = &source.shader.wgsl;
    let start = text.find("\n@fragment\n").ok_or_else(|| fail("fragment stage"))? + 1;
    let end = start + text[start..].find("\n}\n").ok_or_else(|| fail("end of the fragment stage"))? + 3;
    let mut lines = text[start..end].lines().skip(1);
    let signature = lines.next().ok_or_else(|| fail("entry point"))?;
    let (reads, two_sided) = (signature.contains("in: Varyings"), signature.contains("front_facing"));

    let mut written = String::new();
    let mut of_lights = false;
    for line in text.lines().take_while(|line| line.starts_with("//")) {
        of_lights = line.starts_with("// serves: ") || (of_lights && line.starts_with("//     "));
        if !of_lights {
            written += &format!("{line}\n");
        }
    }
    written += &format!("// for Bevy {BEVY}: lights, shadows, exposure and tone map are the app's\n\n");
    written += ENGINE;
    written.push('\n');
    for field in fields {
        declare(field, &mut written);
    }
    let varyings = varyings(text);
    if reads {
        written += "\nstruct Varyings {\n";
        for (name, ty) in &varyings {
            written += &format!("    {name}: {ty},\n");
        }
        written += "}\n";
    }

    let body = engine_words(&lines.collect::<Vec<_>>());
    if body.contains("lights.directional") || body.contains("lights.point") || body.contains("lights.spot") {
        return Err(fail("loop over lights: the shader was made for other needs than `Target::needs` gives"));
    }
    let lit = body.contains("engine_");
    let mut arguments = vec!["mesh: VertexOutput"];
    arguments.extend(reads.then_some("in: Varyings"));
    arguments.extend(two_sided.then_some("front_facing: bool"));
    written += &format!("\nfn shaded({}) -> vec4f {{\n", arguments.join(", "));
    if body.contains("clusters.") {
        written += "    var clusters = engine_clusters(mesh);\n";
    }
    written += &body;

    let face = if two_sided { ", @builtin(front_facing) front_facing: bool" } else { "" };
    written += &format!("\n@fragment\nfn fragment(mesh: VertexOutput{face}) -> @location(0) vec4f {{\n");
    if reads {
        written += "    var in: Varyings;\n";
        for (name, _) in &varyings {
            written += from_mesh(name);
        }
    }
    let mut handed = vec!["mesh"];
    handed.extend(reads.then_some("in"));
    handed.extend(two_sided.then_some("front_facing"));
    written += &format!("    return engine_color(shaded({}));\n}}\n", handed.join(", "));
    if lit {
        written.push('\n');
        written += LIGHTS;
    }
    let library =
        reached(&written, &text[end..]).map_err(|error| fail(&format!("library that can be read: {error}")))?;
    written += &library;
    Ok(written)
}

/// The varyings of the shader, with their types.
fn varyings(text: &str) -> Vec<(&'static str, &'static str)> {
    let Some((_, rest)) = text.split_once("struct Varyings {\n") else { return Vec::new() };
    let members = rest.split_once("\n}\n").map_or(rest, |(members, _)| members);
    VARYINGS.into_iter().filter(|(name, _)| members.contains(&format!(" {name}:"))).collect()
}

/// Where Bevy has a varying. What a mesh has not stays zero; a mesh without colours is white.
fn from_mesh(name: &str) -> &'static str {
    match name {
        "world_normal" => "    in.world_normal = mesh.world_normal;\n",
        "world_tangent" => "#ifdef VERTEX_TANGENTS\n    in.world_tangent = mesh.world_tangent;\n#endif\n",
        "uv0" => "#ifdef VERTEX_UVS_A\n    in.uv0 = mesh.uv;\n#endif\n",
        "uv1" => "#ifdef VERTEX_UVS_B\n    in.uv1 = mesh.uv_b;\n#endif\n",
        "vertex_color" => {
            "    in.vertex_color = vec4f(1.0);\n#ifdef VERTEX_COLORS\n    in.vertex_color = mesh.color;\n#endif\n"
        }
        "object_position" => {
            "#ifdef VERTEX_OUTPUT_INSTANCE_INDEX\n    in.object_position = \
             (mesh_functions::get_local_from_world(mesh.instance_index) * mesh.world_position).xyz;\n#endif\n"
        }
        "surface_position" => "    in.surface_position = mesh.world_position.xyz;\n",
        _ => "    in.world_position = mesh.world_position.xyz;\n",
    }
}

/// The entry point's lines, with what Bevy gives in the place of our uniforms and loops over its lights in the place of
/// ours.
fn engine_words(lines: &[&str]) -> String {
    let mut written = String::new();
    let mut lines = lines.iter().copied().peekable();
    let head = format!("for (var i = 0u; i < {LOOPED}u; i++) {{");
    while let Some(line) = lines.next() {
        let next = lines.peek().map_or("", |line| line.trim_start());
        let kind = LightKind::ALL.into_iter().find(|kind| next.starts_with(&sampled(*kind)));
        match kind.filter(|_| line.trim_start() == head) {
            Some(kind) => {
                let member = lights_member(kind);
                written += &format!("    for ({}; i++) {{\n", bounds(kind));
                written += &format!("        let light = engine_{member}_light(mesh, i);\n");
                lines.next();
            }
            None => {
                let line = replace_word(line, "view.camera_position", "engine::view.world_position");
                written += &of_engine(&replace_word(&line, "view.time", "engine::globals.time"));
                written.push('\n');
            }
        }
    }
    written
}

/// A line with Bevy's transforms between spaces in the place of ours.
fn of_engine(line: &str) -> String {
    let object = |of: &str| format!("mesh_functions::get_{of}(mesh.instance_index)");
    let line = replace_word(line, "view.view_from_world", "engine::view.view_from_world");
    let line = replace_word(&line, "object.world_from_object", &object("world_from_local"));
    replace_word(&line, "object.object_from_world", &object("local_from_world"))
}

/// The first line in a loop over lights of a kind.
fn sampled(kind: LightKind) -> String {
    let member = lights_member(kind);
    format!("let light = {member}_light_sample(lights.{member}[i], ")
}

/// Where Bevy has the lights of a kind.
fn bounds(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Directional => "var i = 0u; i < engine::lights.n_directional_lights",
        LightKind::Point => {
            "var i = clusters.first_point_light_index_offset; i < clusters.first_spot_light_index_offset"
        }
        LightKind::Spot => {
            "var i = clusters.first_spot_light_index_offset; i < clusters.first_reflection_probe_index_offset"
        }
    }
}

/// The items of the library that a text reaches, in the library's order: what only our own lights call stays behind.
fn reached(text: &str, library: &str) -> Result<String, SliceError> {
    let items = slice(library)?;
    let mut open: Vec<&str> =
        tokens(text).iter().filter(|token| token.kind == TokenKind::Identifier).map(|token| token.text(text)).collect();
    let mut wanted = vec![false; items.len()];
    while let Some(name) = open.pop() {
        if let Some(at) = items.iter().position(|item| item.name == name).filter(|at| !wanted[*at]) {
            wanted[at] = true;
            open.extend(items[at].dependencies.iter().map(String::as_str));
        }
    }
    let kept = items.iter().zip(wanted).filter(|(_, wanted)| *wanted);
    Ok(kept.map(|(item, _)| format!("\n{}\n", &library[item.start..item.end])).collect())
}

/// Replaces a path where it stands by itself.
fn replace_word(line: &str, from: &str, to: &str) -> String {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '.');
    let mut replaced = String::new();
    let mut rest = line;
    while let Some(at) = rest.find(from) {
        let (before, after) = (&rest[..at], &rest[at + from.len()..]);
        replaced += before;
        let alone = !is_part(replaced.chars().next_back()) && !is_part(after.chars().next().filter(|c| *c != '.'));
        replaced += if alone { to } else { from };
        rest = after;
    }
    replaced + rest
}

/// The declaration of a binding in the material's group.
fn declare(field: &Field<'_>, written: &mut String) {
    let place = format!("@group(#{{MATERIAL_BIND_GROUP}}) @binding({})", field.number);
    let name = &field.binding.name;
    match &field.binding.resource {
        Resource::Uniform(block) => {
            *written += &format!("struct {} {{\n", block.struct_name);
            for member in block.members.iter().filter(|member| !is_of_engine(&member.source)) {
                *written += &format!("    {}: {},\n", member.name, member.ty.wgsl());
            }
            *written += &format!("}}\n{place} var<uniform> {name}: {};\n", block.struct_name);
        }
        Resource::Texture(texture) => {
            let ty = match texture {
                TextureSource::PrefilteredRadiance | TextureSource::IrradianceOverPi => "texture_cube<f32>",
                TextureSource::Image(_) | TextureSource::Dfg => "texture_2d<f32>",
            };
            *written += &format!("{place} var {name}: {ty};\n");
        }
        Resource::Sampler(_) => *written += &format!("{place} var {name}: sampler;\n"),
    }
}
