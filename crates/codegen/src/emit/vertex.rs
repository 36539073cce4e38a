//! The vertex stage: object space to clip space, the displacement, and the varyings that the fragment stage reads.

use std::collections::BTreeSet;

use crate::CodegenError;
use crate::emit::expression::{Entrance, Uses, ViewMember, Writer};
use crate::emit::text::{Part, Text};
use crate::ir::Program;
use crate::link::Index;
use crate::names::Namer;
use crate::passes::plan::Plan;

/// Varyings in order of their locations, with their types.
pub(crate) const VARYINGS: [(&str, &str); 8] = [
    ("world_position", "vec3f"),
    ("surface_position", "vec3f"),
    ("object_position", "vec3f"),
    ("world_normal", "vec3f"),
    ("world_tangent", "vec4f"),
    ("uv0", "vec2f"),
    ("uv1", "vec2f"),
    ("vertex_color", "vec4f"),
];

/// Writes `vs_main`. `varyings` are the members that the fragment stage reads.
pub(crate) fn vertex<'a>(
    program: &Program<'a>,
    plan: &Plan,
    index: &Index,
    names: &crate::emit::expression::Names,
    varyings: &BTreeSet<&'static str>,
) -> Result<(Text, Uses), CodegenError> {
    let mut writer = Writer::new(program, index, names, Entrance::Vertex, plan.height);
    let mut namer = Namer::new(index);
    writer.expressions(&program.vertex, &mut namer)?;
    let height = program.vertex.root("height").filter(|_| plan.height).map(|id| writer.atom(id).to_owned());

    let object = "object.world_from_object";
    let mut lines = Text::of(Part::Vertex);
    let position = writer.member("position");
    let transform = writer.library("position_in_world")?;
    lines.line(&format!("    let world_position = {transform}({object}, {position});"));
    let wants_normal =
        height.is_some() || varyings.contains("world_normal") || writer.uses.contexts.contains("world_normal");
    if wants_normal {
        let (transform, normal) = (writer.library("normal_in_world")?, writer.member("normal"));
        writer.uses.normal_matrix = true;
        lines.line(&format!("    let world_normal = {transform}(object.normal_from_object, {normal});"));
    }
    if varyings.contains("world_tangent") || writer.uses.contexts.contains("world_tangent") {
        let (transform, tangent) = (writer.library("tangent_in_world")?, writer.member("tangent"));
        lines.line(&format!("    let world_tangent = {transform}({object}, {tangent});"));
    }
    if writer.uses.contexts.contains("view_dir") {
        let camera = writer.view(ViewMember::CameraPosition);
        lines.line(&format!("    let view_dir = normalize({camera} - world_position);"));
    }
    lines.append(&writer.body);

    let mut shown = "world_position";
    if let Some(height) = height {
        let displaced = writer.library("displaced")?;
        lines.line(&format!("    let displaced_position = {displaced}(world_position, world_normal, {height});"));
        shown = "displaced_position";
    }
    let clip = writer.view(ViewMember::ClipFromWorld);
    lines.line("    var out: Varyings;");
    lines.line(&format!("    out.clip_position = {clip} * vec4f({shown}, 1.0);"));
    for (name, _) in VARYINGS.iter().filter(|(name, _)| varyings.contains(name)) {
        let value = match *name {
            "world_position" => shown.to_owned(),
            "surface_position" => "world_position".to_owned(),
            "object_position" => position.clone(),
            name @ ("uv0" | "uv1") => writer.member(name),
            "vertex_color" => writer.member("color"),
            name => name.to_owned(),
        };
        lines.line(&format!("    out.{name} = {value};"));
    }
    lines.line("    return out;");

    let mut text = Text::of(Part::Vertex);
    text.line("@vertex");
    text.line("fn vs_main(in: VertexInput) -> Varyings {");
    text.append(&lines);
    text.line("}");
    Ok((text, writer.uses))
}
