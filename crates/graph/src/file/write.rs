//! Document to text.

use std::collections::{HashMap, HashSet};
use std::fmt::Write;
use std::io;

use serde::Serialize;
use serde_json::ser::Formatter;
use serde_json::{Map, Value as Plain};

use super::read::{link_of_plain, parameter_key_of_plain};
use crate::document::{Document, Link, Node, Parameter, SocketRef, SurfaceSettings};
use crate::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

/// The document as text, in the fixed order; ends with a line break.
pub fn to_json(document: &Document) -> String {
    let mut sections: Vec<String> = vec![
        format!("  \"halfvector\": {}", document.version),
        format!("  \"name\": {}", quoted(&document.name)),
        block("nodes", '{', '}', node_lines(document)),
        block("links", '[', ']', link_lines(document)),
    ];
    let parameters = parameter_lines(document);
    if !parameters.is_empty() {
        sections.push(block("parameters", '[', ']', parameters));
    }
    if let Some(surface) = surface_json(document) {
        sections.push(format!("  \"surface\": {surface}"));
    }
    let layout = layout_lines(document);
    if !layout.is_empty() {
        sections.push(block("layout", '{', '}', layout));
    }
    for (key, value) in &document.unknown {
        if !SECTIONS.contains(&key.as_str()) {
            sections.push(format!("  {}: {}", quoted(key), plain_json(value)));
        }
    }
    format!("{{\n{}\n}}\n", sections.join(",\n"))
}

/// The fields of a document; what stands under these names in `Document::unknown` is merged into them.
pub(super) const SECTIONS: &[&str] = &["halfvector", "name", "nodes", "links", "parameters", "surface", "layout"];

fn block(name: &str, open: char, close: char, lines: Vec<String>) -> String {
    if lines.is_empty() {
        return format!("  \"{name}\": {open}{close}");
    }
    format!("  \"{name}\": {open}\n    {}\n  {close}", lines.join(",\n    "))
}

fn node_lines(document: &Document) -> Vec<String> {
    let mut lines: Vec<(&str, String)> =
        document.nodes.iter().map(|(id, node)| (id.as_str(), node_json(node))).collect();
    if let Some(Plain::Object(kept)) = document.unknown.get("nodes") {
        lines.extend(
            kept.iter()
                .filter(|(id, _)| !document.nodes.contains_key(*id))
                .map(|(id, raw)| (id.as_str(), plain_json(raw))),
        );
        lines.sort_by(|a, b| a.0.cmp(b.0));
    }
    lines.into_iter().map(|(id, json)| format!("{}: {json}", quoted(id))).collect()
}

fn node_json(node: &Node) -> String {
    let mut fields = vec![format!("\"node\": {}", quoted(&node.node))];
    match (&node.label, node.unknown.get("label")) {
        (Some(label), _) => fields.push(format!("\"label\": {}", quoted(label))),
        (None, Some(raw)) => fields.push(format!("\"label\": {}", plain_json(raw))),
        (None, None) => {}
    }
    let mut values: Vec<(&str, String)> =
        node.values.iter().map(|(socket, value)| (socket.as_str(), value_json(value))).collect();
    match node.unknown.get("values") {
        Some(Plain::Object(kept)) => {
            let others = kept.iter().filter(|(socket, _)| !node.values.contains_key(*socket));
            values.extend(others.map(|(socket, raw)| (socket.as_str(), plain_json(raw))));
            values.sort_by(|a, b| a.0.cmp(b.0));
        }
        Some(raw) if values.is_empty() => fields.push(format!("\"values\": {}", plain_json(raw))),
        _ => {}
    }
    if !values.is_empty() {
        let values: Vec<String> =
            values.into_iter().map(|(socket, json)| format!("{}: {json}", quoted(socket))).collect();
        fields.push(format!("\"values\": {{{}}}", values.join(", ")));
    }
    push_unknown(&mut fields, &node.unknown, &["node", "label", "values"]);
    format!("{{{}}}", fields.join(", "))
}

fn push_unknown(fields: &mut Vec<String>, unknown: &Map<String, Plain>, known: &[&str]) {
    for (key, value) in unknown {
        if !known.contains(&key.as_str()) {
            fields.push(format!("{}: {}", quoted(key), plain_json(value)));
        }
    }
}

fn link_lines(document: &Document) -> Vec<String> {
    let kept = kept_list(document, "links");
    let extras: HashMap<Link, &Map<String, Plain>> =
        kept.iter().filter_map(|raw| Some((link_of_plain(raw)?, raw.as_object()?))).collect();
    let links = document.links.iter().map(|link| {
        let mut fields = vec![
            format!("\"from\": {}", quoted(&link.from.to_string())),
            format!("\"to\": {}", quoted(&link.to.to_string())),
        ];
        if let Some(extra) = extras.get(link) {
            push_unknown(&mut fields, extra, &["from", "to"]);
        }
        format!("{{{}}}", fields.join(", "))
    });
    let others = kept.iter().filter(|raw| link_of_plain(raw).is_none()).map(plain_json);
    links.chain(others).collect()
}

fn kept_list<'d>(document: &'d Document, section: &str) -> &'d [Plain] {
    document.unknown.get(section).and_then(Plain::as_array).map_or(&[], Vec::as_slice)
}

fn parameter_lines(document: &Document) -> Vec<String> {
    let kept = kept_list(document, "parameters");
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
    ];
    let mut fields: Vec<String> = known
        .iter()
        .map(|(name, json, is_default)| match kept.get(*name) {
            Some(raw) if *is_default => format!("\"{name}\": {}", plain_json(raw)),
            _ => format!("\"{name}\": {json}"),
        })
        .collect();
    push_unknown(&mut fields, kept, &["alpha_mode", "alpha_cutoff", "double_sided"]);
    Some(format!("{{{}}}", fields.join(", ")))
}

fn layout_lines(document: &Document) -> Vec<String> {
    let mut lines: Vec<(&str, String)> =
        document.layout.iter().map(|(id, position)| (id.as_str(), numbers(position))).collect();
    if let Some(Plain::Object(kept)) = document.unknown.get("layout") {
        let known: HashSet<&str> = document.layout.keys().map(String::as_str).collect();
        let others = kept.iter().filter(|(id, _)| !known.contains(id.as_str()));
        lines.extend(others.map(|(id, raw)| (id.as_str(), plain_json(raw))));
        lines.sort_by(|a, b| a.0.cmp(b.0));
    }
    lines.into_iter().map(|(id, json)| format!("{}: {json}", quoted(id))).collect()
}

fn value_json(value: &Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Number(x) => number(*x),
        Value::Vec2(v) => numbers(v),
        Value::Vec3(v) => numbers(v),
        Value::Vec4(v) => numbers(v),
        Value::Image(image) => image_json(image),
    }
}

fn image_json(image: &ImageRef) -> String {
    let color_space = match image.color_space {
        ColorSpace::Srgb => "srgb",
        ColorSpace::Linear => "linear",
    };
    let mut out = format!("{{\"file\": {}, \"color_space\": \"{color_space}\"", quoted(&image.file));
    for (name, wrap) in [("wrap_u", image.wrap_u), ("wrap_v", image.wrap_v)] {
        let wrap = match wrap {
            Wrap::Repeat => continue,
            Wrap::Clamp => "clamp",
            Wrap::Mirror => "mirror",
        };
        let _ = write!(out, ", \"{name}\": \"{wrap}\"");
    }
    if image.filter == Filter::Nearest {
        out.push_str(", \"filter\": \"nearest\"");
    }
    out.push('}');
    out
}

/// A value that this version does not know, with the writer's own spacing.
fn plain_json(value: &Plain) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Spaced);
    // Writing to memory does not fail; without spaces it is the same value.
    match value.serialize(&mut serializer) {
        Ok(()) => String::from_utf8(bytes).unwrap_or_else(|_| value.to_string()),
        Err(_) => value.to_string(),
    }
}

/// Everything in one line, with a space after each `,` and `:`.
struct Spaced;

impl Formatter for Spaced {
    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { writer.write_all(b", ") }
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { writer.write_all(b", ") }
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

fn quoted(text: &str) -> String {
    Plain::from(text).to_string()
}

fn numbers(numbers: &[f32]) -> String {
    let items: Vec<String> = numbers.iter().map(|x| number(*x)).collect();
    format!("[{}]", items.join(", "))
}

/// The shortest digits that read back as the same number. JSON has no infinities: they, and NaN, are written as texts, so that an
/// unsound document survives saving and `check` still sees it.
fn number(x: f32) -> String {
    if x.is_nan() {
        return "\"nan\"".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "\"inf\"".into() } else { "\"-inf\"".into() };
    }
    let magnitude = x.abs();
    if magnitude == 0.0 || (1e-6..1e9).contains(&magnitude) { format!("{x}") } else { format!("{x:e}") }
}
