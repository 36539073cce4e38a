//! Document to text.

mod graph;
mod group;
mod value;

use std::collections::{BTreeMap, HashMap};

use serde_json::{Map, Value as Plain};

use super::read::parameter_key_of_plain;
use super::{GroupFile, Instance};
use crate::FORMAT_VERSION;
use crate::document::{Document, Parameter, SocketRef, SurfaceSettings};
use graph::kept_list;
use value::{number, numbers, plain_json, push_unknown, quoted, value_json};

/// The document as text, in the fixed order; ends with a line break.
pub fn to_json(document: &Document) -> String {
    let mut sections: Vec<String> =
        vec![format!("  \"halfvector\": {}", document.version), format!("  \"name\": {}", quoted(&document.name))];
    sections.extend(graph::meaning(&document.graph, 2));
    let parameters = parameter_lines(document);
    if !parameters.is_empty() {
        sections.push(block("parameters", '[', ']', parameters, 2));
    }
    if let Some(surface) = surface_json(document) {
        sections.push(format!("  \"surface\": {surface}"));
    }
    let groups = group::lines(&document.groups, document.unknown.get("groups"));
    if !groups.is_empty() {
        sections.push(block("groups", '{', '}', groups, 2));
    }
    let functions = function_lines(&document.functions, document.unknown.get("functions"));
    if !functions.is_empty() {
        sections.push(block("functions", '{', '}', functions, 2));
    }
    sections.extend(graph::view(&document.graph, 2));
    for (key, value) in &document.unknown {
        if !SECTIONS.contains(&key.as_str()) || (matches!(key.as_str(), "groups" | "functions") && !value.is_object()) {
            sections.push(format!("  {}: {}", quoted(key), plain_json(value)));
        }
    }
    format!("{{\n{}\n}}\n", sections.join(",\n"))
}

/// A group's file as text.
pub fn group_to_json(file: &GroupFile) -> String {
    let mut sections = vec![
        format!("  \"halfvector\": {FORMAT_VERSION}"),
        format!("  \"group\": {}", quoted(&file.group)),
        block("groups", '{', '}', group::lines(&file.groups, None), 2),
    ];
    if !file.functions.is_empty() {
        sections.push(block("functions", '{', '}', function_lines(&file.functions, None), 2));
    }
    format!("{{\n{}\n}}\n", sections.join(",\n"))
}

/// An instance's file as text.
pub fn instance_to_json(instance: &Instance) -> String {
    let mut sections = vec![format!("  \"halfvector\": {}", instance.version)];
    sections.extend(instance.name.as_ref().map(|name| format!("  \"name\": {}", quoted(name))));
    sections.push(format!("  \"base\": {}", quoted(&instance.base)));
    let set = instance.set.iter().map(|(name, value)| format!("{}: {}", quoted(name), value_json(value)));
    sections.push(block("set", '{', '}', set.collect(), 2));
    sections.extend(instance.unknown.iter().map(|(key, value)| format!("  {}: {}", quoted(key), plain_json(value))));
    format!("{{\n{}\n}}\n", sections.join(",\n"))
}

/// Sections of which parts may be kept: what stands under these names in `Document::unknown` is merged into them.
const SECTIONS: &[&str] = &["parameters", "surface", "groups", "functions"];

/// A section of lines, indented by `indent`.
fn block(name: &str, open: char, close: char, lines: Vec<String>, indent: usize) -> String {
    let margin = " ".repeat(indent);
    if lines.is_empty() {
        return format!("{margin}\"{name}\": {open}{close}");
    }
    format!("{margin}\"{name}\": {open}\n{margin}  {}\n{margin}{close}", lines.join(&format!(",\n{margin}  ")))
}

fn parameter_lines(document: &Document) -> Vec<String> {
    let kept = kept_list(&document.unknown, "parameters");
    let extras: HashMap<(String, SocketRef), &Map<String, Plain>> =
        kept.iter().filter_map(|raw| Some((parameter_key_of_plain(raw)?, raw.as_object()?))).collect();
    let parameters = document.parameters.iter().map(|parameter| {
        let extra = extras.get(&(parameter.name.clone(), parameter.socket.clone())).copied();
        parameter_json(parameter, extra)
    });
    let others = kept.iter().filter(|raw| parameter_key_of_plain(raw).is_none()).map(plain_json);
    parameters.chain(others).collect()
}

fn parameter_json(parameter: &Parameter, extra: Option<&Map<String, Plain>>) -> String {
    let mut fields = vec![
        format!("\"name\": {}", quoted(&parameter.name)),
        format!("\"socket\": {}", quoted(&parameter.socket.to_string())),
    ];
    if let Some(label) = &parameter.label {
        fields.push(format!("\"label\": {}", quoted(label)));
    }
    if let Some(range) = &parameter.range {
        fields.push(format!("\"range\": {}", numbers(range)));
    }
    if let Some(extra) = extra {
        let mut written = vec!["name", "socket"];
        written.extend(parameter.label.is_some().then_some("label"));
        written.extend(parameter.range.is_some().then_some("range"));
        push_unknown(&mut fields, extra, &written);
    }
    format!("{{{}}}", fields.join(", "))
}

/// The functions in order of id, each line of a text in a line of the file.
fn function_lines(functions: &BTreeMap<String, String>, kept: Option<&Plain>) -> Vec<String> {
    let mut lines: Vec<(&str, String)> = Vec::new();
    for (id, text) in functions {
        let quoted: Vec<String> = text.split('\n').map(quoted).collect();
        lines.push((id, format!("[\n      {}\n    ]", quoted.join(",\n      "))));
    }
    if let Some(Plain::Object(kept)) = kept {
        let others = kept.iter().filter(|(id, _)| !functions.contains_key(*id));
        lines.extend(others.map(|(id, raw)| (id.as_str(), plain_json(raw))));
        lines.sort_by(|a, b| a.0.cmp(b.0));
    }
    lines.into_iter().map(|(id, json)| format!("{}: {json}", quoted(id))).collect()
}

fn surface_json(document: &Document) -> Option<String> {
    let surface = document.surface;
    let default = SurfaceSettings::default();
    let empty = Map::new();
    let kept = match document.unknown.get("surface") {
        Some(Plain::Object(kept)) => kept,
        Some(raw) if surface == default => return Some(plain_json(raw)),
        _ => &empty,
    };
    if surface == default && kept.is_empty() {
        return None;
    }
    let known = [
        ("alpha_mode", quoted(surface.alpha_mode.name()), surface.alpha_mode == default.alpha_mode),
        ("alpha_cutoff", number(surface.alpha_cutoff), surface.alpha_cutoff == default.alpha_cutoff),
        ("double_sided", surface.double_sided.to_string(), !surface.double_sided),
        ("thin_walled", surface.thin_walled.to_string(), !surface.thin_walled),
    ];
    let written = |name: &str, is_default: bool| !is_default || name != "thin_walled" || kept.contains_key(name);
    let mut fields: Vec<String> = known
        .iter()
        .filter(|(name, _, is_default)| written(name, *is_default))
        .map(|(name, json, is_default)| match kept.get(*name) {
            Some(raw) if *is_default => format!("\"{name}\": {}", plain_json(raw)),
            _ => format!("\"{name}\": {json}"),
        })
        .collect();
    push_unknown(&mut fields, kept, &["alpha_mode", "alpha_cutoff", "double_sided", "thin_walled"]);
    Some(format!("{{{}}}", fields.join(", ")))
}
