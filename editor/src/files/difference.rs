//! What is different between two versions of a material, as a short list for people.

use std::collections::BTreeSet;

use halfvector_graph::check::node_label;
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;

/// Most lines of the list; the last one then says how many more there are.
const MAX_LINES: usize = 24;

/// What `theirs` has otherwise than `ours`: nothing when they are equal.
pub(crate) fn differences(ours: &Document, theirs: &Document) -> Vec<String> {
    let mut lines = Vec::new();
    if ours.name != theirs.name {
        lines.push(format!("name: “{}” instead of “{}”", theirs.name, ours.name));
    }
    nodes(ours, theirs, &mut lines);
    links(ours, theirs, &mut lines);
    parameters(ours, theirs, &mut lines);
    if ours.groups != theirs.groups {
        lines.push("groups changed inside".to_owned());
    }
    functions(ours, theirs, &mut lines);
    if ours.surface != theirs.surface {
        lines.push("alpha mode, cutoff or double sided changed".to_owned());
    }
    if lines.is_empty() && ours != theirs {
        lines.push("only positions on the canvas, or what this version does not know".to_owned());
    }
    if lines.len() > MAX_LINES {
        let more = lines.len() - (MAX_LINES - 1);
        lines.truncate(MAX_LINES - 1);
        lines.push(format!("and {more} more"));
    }
    lines
}

fn nodes(ours: &Document, theirs: &Document, lines: &mut Vec<String>) {
    let [of_ours, of_theirs] = [ours, theirs].map(|document| Library::standard().of(document));
    let ids: BTreeSet<&String> = ours.graph.nodes.keys().chain(theirs.graph.nodes.keys()).collect();
    for id in ids {
        match (ours.graph.nodes.get(id), theirs.graph.nodes.get(id)) {
            (Some(_), None) => lines.push(format!("removed: {}", node_label(&ours.graph, &of_ours, id))),
            (None, Some(_)) => lines.push(format!("added: {}", node_label(&theirs.graph, &of_theirs, id))),
            (Some(a), Some(b)) if a != b => {
                let sockets: BTreeSet<&String> = a.values.keys().chain(b.values.keys()).collect();
                let changed: Vec<&str> = sockets
                    .into_iter()
                    .filter(|socket| a.values.get(*socket) != b.values.get(*socket))
                    .map(String::as_str)
                    .collect();
                let what = if changed.is_empty() { "label or kind".to_owned() } else { changed.join(", ") };
                lines.push(format!("{}: {what} changed", node_label(&theirs.graph, &of_theirs, id)));
            }
            _ => {}
        }
    }
}

fn links(ours: &Document, theirs: &Document, lines: &mut Vec<String>) {
    let set = |document: &Document| document.graph.links.iter().cloned().collect::<BTreeSet<_>>();
    let (ours, theirs) = (set(ours), set(theirs));
    lines.extend(ours.difference(&theirs).map(|link| format!("unlinked: {} from {}", link.to, link.from)));
    lines.extend(theirs.difference(&ours).map(|link| format!("linked: {} to {}", link.from, link.to)));
}

fn functions(ours: &Document, theirs: &Document, lines: &mut Vec<String>) {
    let ids: BTreeSet<&String> = ours.functions.keys().chain(theirs.functions.keys()).collect();
    for id in ids {
        match (ours.functions.get(id), theirs.functions.get(id)) {
            (Some(_), None) => lines.push(format!("function {id} removed")),
            (None, Some(_)) => lines.push(format!("function {id} added")),
            (a, b) if a != b => lines.push(format!("function {id} rewritten")),
            _ => {}
        }
    }
}

fn parameters(ours: &Document, theirs: &Document, lines: &mut Vec<String>) {
    for parameter in &ours.parameters {
        match theirs.parameter(&parameter.name) {
            None => lines.push(format!("parameter {} removed", parameter.name)),
            Some(other) if other != parameter => lines.push(format!("parameter {} changed", parameter.name)),
            Some(_) => {}
        }
    }
    let new = theirs.parameters.iter().filter(|parameter| ours.parameter(&parameter.name).is_none());
    lines.extend(new.map(|parameter| format!("parameter {} added", parameter.name)));
}
