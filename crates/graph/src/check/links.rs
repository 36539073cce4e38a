//! Problems of links: ends that do not exist, types that do not fit, several links into one input.

use std::collections::HashMap;

use super::nodes::no_input;
use super::{Checker, Severity, Told, words};
use crate::document::{Link, SocketRef};
use crate::value::SocketType;

pub(super) fn check(checker: &mut Checker) {
    let graph = checker.graph;
    let mut first: HashMap<&SocketRef, &Link> = HashMap::new();
    for link in &graph.links {
        if let Some(earlier) = first.get(&link.to) {
            let message = Told(|| {
                format!(
                    "two links lead into this input, from {} and from {}; remove one of them (the first counts)",
                    earlier.from, link.from
                )
            });
            checker.wrong(&link.to.node, Some(&link.to.socket), message);
            continue;
        }
        first.insert(&link.to, link);
        ends(checker, link);
    }
}

fn ends(checker: &mut Checker, link: &Link) {
    if !checker.wiring.contains(&link.to.node) {
        // What it was to feed is not known, so that it may be the surface: an error wherever the material uses the graph.
        let severity = if checker.is_used { Severity::Error } else { Severity::Warning };
        let message = || {
            format!(
                "a link from {} leads to `{}`, but there is no such node; correct its name, or remove the link",
                link.from, link.to
            )
        };
        checker.at(severity, &link.to.node, Some(&link.to.socket), Told(message));
        return;
    }
    if !checker.wiring.contains(&link.from.node) {
        let message = Told(|| {
            format!("a link comes from `{}`, but there is no such node; remove the link or add the node", link.from)
        });
        checker.wrong(&link.to.node, Some(&link.to.socket), message);
        return;
    }
    let to = checker.types.get(&link.to.node).copied();
    let from = checker.types.get(&link.from.node).copied();
    let wanted = to.map(|types| types.input(&link.to.socket));
    let given = from.map(|types| types.output(&link.from.socket));
    if let (Some(types), Some(None)) = (to, wanted) {
        let message = format!("a link comes from {}, but {}", link.from, no_input(checker, types.def, &link.to.socket));
        checker.wrong(&link.to.node, Some(&link.to.socket), message);
    }
    if let (Some(types), Some(None)) = (from, given) {
        let names: Vec<&str> = types.def.outputs.iter().map(|output| output.name.as_str()).collect();
        let message = format!(
            "a link to {} starts here, but `{}` has no such output; it has {}",
            link.to,
            types.def.id,
            names.join(", ")
        );
        checker.wrong(&link.from.node, Some(&link.from.socket), message);
    }
    let (Some(from), Some(Some(given)), Some(Some(wanted))) = (from, given, wanted) else { return };
    if fits(given, wanted) {
        return;
    }
    let other = from.def.outputs.iter().find(|output| fits(from.resolved(output.ty), wanted));
    let remedy = match other {
        Some(other) => format!("link its output `{}` instead", other.name),
        None => words::refusal(given, wanted).into(),
    };
    let message = format!(
        "it takes a {}, but \u{201c}{}\u{201d} gives a {} at `{}`: {remedy}",
        words::socket_type(wanted),
        words::one_line(&checker.label(&link.from.node)),
        words::socket_type(given),
        link.from
    );
    checker.wrong(&link.to.node, Some(&link.to.socket), message);
}

/// Whether an output of one type can feed an input of another.
pub(crate) fn fits(given: SocketType, wanted: SocketType) -> bool {
    match (given, wanted) {
        (SocketType::Value(given), SocketType::Value(wanted)) => given.converts_to(wanted),
        (SocketType::Surface, SocketType::Surface) | (SocketType::Texture, SocketType::Texture) => true,
        _ => false,
    }
}
