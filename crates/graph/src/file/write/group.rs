//! Groups as text.

use std::collections::BTreeMap;

use serde_json::Value as Plain;

use super::value::{numbers, plain_json, push_unknown, quoted, value_json};
use super::{block, graph};
use crate::document::{Group, GroupInput, GroupOutput};
use crate::node_def::Default as InputDefault;
use crate::value::{ColorSpace, SocketType};

/// Groups in order of id, each over several lines, with those that were kept.
pub(super) fn lines(groups: &BTreeMap<String, Group>, kept: Option<&Plain>) -> Vec<String> {
    let mut lines: Vec<(&str, String)> = groups.iter().map(|(id, group)| (id.as_str(), group_json(group, 4))).collect();
    if let Some(Plain::Object(kept)) = kept {
        let others = kept.iter().filter(|(id, _)| !groups.contains_key(*id));
        lines.extend(others.map(|(id, raw)| (id.as_str(), plain_json(raw))));
        lines.sort_by(|a, b| a.0.cmp(b.0));
    }
    lines.into_iter().map(|(id, json)| format!("{}: {json}", quoted(id))).collect()
}

/// A group whose closing brace is indented by `indent`.
pub(super) fn group_json(group: &Group, indent: usize) -> String {
    let inner = indent + 2;
    let margin = " ".repeat(inner);
    let mut sections = Vec::new();
    for (name, text) in [("label", &group.interface.label), ("help", &group.interface.help)] {
        if !text.is_empty() {
            sections.push(format!("{margin}\"{name}\": {}", quoted(text)));
        }
    }
    sections.push(block("inputs", '[', ']', group.interface.inputs.iter().map(input_json).collect(), inner));
    sections.push(block("outputs", '[', ']', group.interface.outputs.iter().map(output_json).collect(), inner));
    sections.extend(graph::meaning(&group.graph, inner));
    sections.extend(graph::view(&group.graph, inner));
    let mut unknown = Vec::new();
    push_unknown(&mut unknown, &group.unknown, &[]);
    sections.extend(unknown.into_iter().map(|field| format!("{margin}{field}")));
    format!("{{\n{}\n{}}}", sections.join(",\n"), " ".repeat(indent))
}

/// Name, type and label of a socket.
fn head(name: &str, ty: SocketType, label: Option<&String>) -> Vec<String> {
    let ty = match ty {
        SocketType::Value(ty) => ty.wgsl(),
        SocketType::Texture => "texture",
        // No group has them: `check` says so, and reading refuses them.
        SocketType::Generic => "T",
        SocketType::Surface => "surface",
    };
    let mut fields = vec![format!("\"name\": {}", quoted(name)), format!("\"type\": \"{ty}\"")];
    fields.extend(label.map(|label| format!("\"label\": {}", quoted(label))));
    fields
}

fn input_json(input: &GroupInput) -> String {
    let mut fields = head(&input.name, input.ty, input.label.as_ref());
    fields.push(match &input.default {
        InputDefault::Value(value) => format!("\"default\": {}", value_json(value)),
        InputDefault::Context(name) => format!("\"context\": {}", quoted(name)),
        InputDefault::Image(ColorSpace::Srgb) => "\"color_space\": \"srgb\"".into(),
        InputDefault::Image(ColorSpace::Linear) => "\"color_space\": \"linear\"".into(),
        // No group takes a surface.
        InputDefault::Surface => "\"default\": null".into(),
    });
    fields.extend(input.range.map(|range| format!("\"range\": {}", numbers(&range))));
    for (name, text) in [("unit", &input.unit), ("help", &input.help)] {
        if !text.is_empty() {
            fields.push(format!("\"{name}\": {}", quoted(text)));
        }
    }
    push_unknown(&mut fields, &input.unknown, &[]);
    format!("{{{}}}", fields.join(", "))
}

fn output_json(output: &GroupOutput) -> String {
    let mut fields = head(&output.name, SocketType::Value(output.ty), output.label.as_ref());
    if !output.help.is_empty() {
        fields.push(format!("\"help\": {}", quoted(&output.help)));
    }
    push_unknown(&mut fields, &output.unknown, &[]);
    format!("{{{}}}", fields.join(", "))
}
