//! Problems of groups: their sockets, their insides, and groups that hold themselves.

use std::collections::HashSet;

use super::{Checker, Findings, Severity, counts, links, nodes, words};
use crate::context::{CONTEXTS, context};
use crate::document::{Document, GROUP_OUTPUT, Group, GroupInput, group_of, is_group_id, is_name};
use crate::group::{Extents, live_nodes, output_node};
use crate::library::Library;
use crate::node_def::Default;
use crate::value::{SocketType, Type};
use crate::wiring::Wiring;

/// All problems of a document's groups. `live` are the nodes of the top level that reach the surface: what stands in a group that
/// none of them uses, directly or not, is a warning. They are added to `findings`.
pub(super) fn check(
    document: &Document,
    library: &Library,
    extents: &Extents,
    live: &[String],
    mut findings: Findings,
) -> Findings {
    let used = used_groups(document, live);
    for (id, group) in &document.groups {
        let inside = library.inside(group);
        let wiring = Wiring::new(&group.graph);
        let mut checker = Checker::new(document, &group.graph, &inside, &wiring, findings);
        let label = if group.interface.label.is_empty() { id.as_str() } else { &group.interface.label };
        checker.group = Some((id, label));
        checker.is_used = used.contains(id.as_str());
        let live = live_nodes(&group.graph, &output_node(group).into_iter().collect::<Vec<_>>());
        if checker.is_used {
            let is_live = |node: &&str| live.binary_search_by(|live| live.as_str().cmp(node)).is_ok();
            checker.live = group.graph.nodes.keys().map(String::as_str).filter(is_live).collect();
        }
        one(&mut checker, id, group, extents);
        findings = checker.findings;
    }
    findings
}

/// The groups that some nodes of the top level use, directly or not.
fn used_groups<'d>(document: &'d Document, live: &[String]) -> HashSet<&'d str> {
    let top = live.iter().filter_map(|id| group_of(&document.graph.nodes.get(id)?.node));
    let mut open: Vec<&str> = top.collect();
    let mut used = HashSet::new();
    while let Some(id) = open.pop() {
        if let Some(group) = document.groups.get(id)
            && used.insert(id)
        {
            open.extend(group.graph.nodes.values().filter_map(|node| group_of(&node.node)));
        }
    }
    used
}

fn one(checker: &mut Checker, id: &str, group: &Group, extents: &Extents) {
    let severity = if checker.is_used { Severity::Error } else { Severity::Warning };
    if !is_group_id(id) {
        let message = "the group's id is no name; use letters, digits and _, first a letter, other than `input` and `output` (its label may be anything)";
        checker.of_document(Severity::Error, message);
    }
    for field in group.unknown.keys().chain(group.graph.unknown.keys()) {
        let message = format!(
            "the group's field `{field}` has parts that this program does not know; they are kept when it saves"
        );
        checker.of_document(Severity::Warning, message);
    }
    if let Some(ring) = extents.rings.iter().find(|ring| ring.groups.first().is_some_and(|first| first == id)) {
        let message = match ring.groups.as_slice() {
            [_] => "the group holds itself; remove the node that stands for it from its inside".to_string(),
            groups => {
                format!("the groups hold each other in a ring: {}; remove one from the next", words::ring(groups))
            }
        };
        checker.of_document(severity, message);
    }
    interface(checker, group, severity);
    checker.view();
    checker.cycles();
    nodes::check(checker);
    links::check(checker);
}

fn interface(checker: &mut Checker, group: &Group, severity: Severity) {
    let interface = &group.interface;
    let names = interface.inputs.iter().map(|input| input.name.as_str());
    let outputs = interface.outputs.iter().map(|output| output.name.as_str());
    for (what, names) in [("inputs", counts(names)), ("outputs", counts(outputs))] {
        for (name, count) in names {
            if count > 1 {
                checker.of_document(severity, format!("{count} {what} are named `{name}`; give each its own name"));
            }
            if !is_name(name) {
                let message =
                    format!("`{name}` among the {what} is no name; use letters, digits and _, first a letter");
                checker.of_document(severity, message);
            }
        }
    }
    for input in &interface.inputs {
        if let Some(message) = input_problem(input) {
            checker.of_document(severity, format!("the input `{}`: {message}", input.name));
        }
    }
    let ends: Vec<&str> =
        group.graph.nodes.iter().filter(|(_, n)| n.node == GROUP_OUTPUT).map(|(id, _)| id.as_str()).collect();
    match ends.as_slice() {
        [_] => {}
        [] => {
            checker.of_document(severity, format!("nothing comes out of the group; add a node `{GROUP_OUTPUT}` inside"))
        }
        [_, others @ ..] => {
            for other in others {
                checker.at(severity, other, None, "a group has one node for its outputs; remove this one");
            }
        }
    }
}

fn input_problem(input: &GroupInput) -> Option<String> {
    if input.range.is_some_and(|[lo, hi]| !(lo.is_finite() && hi.is_finite() && lo < hi)) {
        return Some("its range needs two finite numbers, the smaller one first".into());
    }
    match (&input.default, input.ty) {
        (_, SocketType::Generic | SocketType::Surface) | (Default::Surface, _) => {
            Some("a group takes numbers, vectors, switches and pictures".into())
        }
        (Default::Image(_), SocketType::Texture) => None,
        (_, SocketType::Texture) | (Default::Image(_), _) => {
            Some("a picture has no default, and only a picture has a colour space".into())
        }
        (Default::Value(value), SocketType::Value(ty)) => {
            let is_finite = value.components().is_none_or(|c| c.iter().all(|x| x.is_finite()));
            let fits = is_finite && (value.components_as(ty).is_some() || is_zero_switch(value, ty));
            (!fits).then(|| format!("its default does not fit the type {}", ty.wgsl()))
        }
        (Default::Context(name), SocketType::Value(ty)) => match context(name) {
            Some(context) if context.ty == ty => None,
            Some(context) => Some(format!("the context `{name}` is a {}, not a {}", context.ty.wgsl(), ty.wgsl())),
            None => {
                let known: Vec<&str> = CONTEXTS.iter().map(|c| c.name).collect();
                Some(format!("there is no context `{name}`; there are {}", known.join(", ")))
            }
        },
    }
}

/// The default of a switch that a file leaves out.
fn is_zero_switch(value: &crate::value::Value, ty: Type) -> bool {
    ty == Type::Bool && *value == crate::value::Value::Number(0.0)
}
