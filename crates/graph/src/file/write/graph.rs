//! The sections of a graph.

use std::collections::{BTreeMap, HashMap};

use serde_json::{Map, Value as Plain};

use super::block;
use super::value::{numbers, plain_json, push_unknown, quoted, rect, value_json};
use crate::document::{Comment, Frame, Graph, Link, Node};
use crate::file::read::link_of_plain;

/// Nodes and links.
pub(super) fn meaning(graph: &Graph, indent: usize) -> Vec<String> {
    let nodes = lines_by_id(graph, "nodes", &graph.nodes, node_json);
    vec![block("nodes", '{', '}', nodes, indent), block("links", '[', ']', link_lines(graph), indent)]
}

/// Layout, frames and comments, as far as there are any.
pub(super) fn view(graph: &Graph, indent: usize) -> Vec<String> {
    let sections = [
        ("layout", lines_by_id(graph, "layout", &graph.layout, |position| numbers(position))),
        ("frames", lines_by_id(graph, "frames", &graph.frames, frame_json)),
        ("comments", lines_by_id(graph, "comments", &graph.comments, comment_json)),
    ];
    let write = |(name, lines): (&str, Vec<String>)| match graph.unknown.get(name) {
        Some(raw) if lines.is_empty() && !raw.is_object() => {
            Some(format!("{}\"{name}\": {}", " ".repeat(indent), plain_json(raw)))
        }
        _ => (!lines.is_empty()).then(|| block(name, '{', '}', lines, indent)),
    };
    sections.into_iter().filter_map(write).collect()
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

fn link_lines(graph: &Graph) -> Vec<String> {
    let kept = kept_list(&graph.unknown, "links");
    let extras: HashMap<Link, &Map<String, Plain>> =
        kept.iter().filter_map(|raw| Some((link_of_plain(raw)?, raw.as_object()?))).collect();
    let links = graph.links.iter().map(|link| {
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

pub(super) fn kept_list<'d>(unknown: &'d Map<String, Plain>, section: &str) -> &'d [Plain] {
    unknown.get(section).and_then(Plain::as_array).map_or(&[], Vec::as_slice)
}

/// The lines of a section of things by id, with what is kept of it.
fn lines_by_id<'g, T>(
    graph: &'g Graph,
    section: &str,
    things: &'g BTreeMap<String, T>,
    json: impl Fn(&T) -> String,
) -> Vec<String> {
    let mut lines: Vec<(&str, String)> = things.iter().map(|(id, thing)| (id.as_str(), json(thing))).collect();
    if let Some(Plain::Object(kept)) = graph.unknown.get(section) {
        let others = kept.iter().filter(|(id, _)| !things.contains_key(*id));
        lines.extend(others.map(|(id, raw)| (id.as_str(), plain_json(raw))));
        lines.sort_by(|a, b| a.0.cmp(b.0));
    }
    lines.into_iter().map(|(id, json)| format!("{}: {json}", quoted(id))).collect()
}

fn frame_json(frame: &Frame) -> String {
    let mut fields = vec![format!("\"title\": {}", quoted(&frame.title))];
    if let Some([r, g, b]) = frame.color {
        fields.push(format!("\"color\": \"#{r:02x}{g:02x}{b:02x}\""));
    }
    fields.push(format!("\"rect\": {}", rect(&frame.rect)));
    push_unknown(&mut fields, &frame.unknown, &["title", "color", "rect"]);
    format!("{{{}}}", fields.join(", "))
}

fn comment_json(comment: &Comment) -> String {
    let mut fields = vec![format!("\"text\": {}", quoted(&comment.text)), format!("\"rect\": {}", rect(&comment.rect))];
    push_unknown(&mut fields, &comment.unknown, &["text", "rect"]);
    format!("{{{}}}", fields.join(", "))
}
