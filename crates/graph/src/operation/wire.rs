//! Wires: whether one can be drawn, nodes taken out of one and put on one.

use std::collections::BTreeSet;

use super::{Refusal, graph_and_library, in_graph, refuse, selected};
use crate::check::links::fits;
use crate::check::{node_label, words};
use crate::document::{Document, Graph, Link, NodeId, SocketRef};
use crate::edit::Edit;
use crate::library::Library;
use crate::node_def::Input;
use crate::resolve::{Types, resolve_in, resolve_types};
use crate::value::SocketType;
use crate::wiring::Wiring;

/// Whether a wire can be drawn from an output to an input. A wire that is there already makes way.
///
/// # Errors
/// Why not: a socket that does not exist, types that do not fit, a ring.
pub fn can_connect(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    from: &SocketRef,
    to: &SocketRef,
) -> Result<(), Refusal> {
    let (graph, own) = graph_and_library(document, library, group)?;
    connects(graph, &own, from, to)
}

fn connects(graph: &Graph, library: &Library, from: &SocketRef, to: &SocketRef) -> Result<(), Refusal> {
    if from.node == to.node {
        return refuse("a node cannot feed itself");
    }
    // With the wire drawn, since it may decide what T is.
    let mut after = graph.clone();
    after.links.retain(|link| link.to != *to);
    after.links.push(Link::new(from.clone(), to.clone()));
    let wiring = Wiring::new(&after);
    let types = resolve_in(&after, library, &wiring);
    let label = |id: &str| node_label(graph, library, id);
    let given = types.get(&from.node).and_then(|types| types.output(&from.socket));
    let wanted = types.get(&to.node).and_then(|types| types.input(&to.socket));
    let (Some(given), Some(wanted)) = (given, wanted) else {
        let missing = if given.is_none() { (from, "output") } else { (to, "input") };
        return refuse(format!(
            "\u{201c}{}\u{201d} has no {} `{}`",
            label(&missing.0.node),
            missing.1,
            missing.0.socket
        ));
    };
    if wiring.order(&[&to.node]).is_err() {
        return refuse(format!(
            "\u{201c}{}\u{201d} feeds \u{201c}{}\u{201d} already, so that they would feed each other in a ring",
            label(&to.node),
            label(&from.node)
        ));
    }
    if !fits(given, wanted) {
        return refuse(format!(
            "a {} does not go into a {}: {}",
            words::socket_type(given),
            words::socket_type(wanted),
            words::refusal(given, wanted)
        ));
    }
    Ok(())
}

/// Removes nodes and joins the wires through them: where a removed node's output fed something, what fed its first input of the same
/// type feeds that from now on.
///
/// # Errors
/// No node is selected.
pub fn remove_and_heal(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    nodes: &[NodeId],
) -> Result<Edit, Refusal> {
    let (graph, own) = graph_and_library(document, library, group)?;
    let removed = selected(graph, nodes)?;
    let wiring = Wiring::new(graph);
    let types = resolve_in(graph, &own, &wiring);
    let mut healed = Vec::new();
    for link in &graph.links {
        let leaves = removed.contains(link.from.node.as_str()) && !removed.contains(link.to.node.as_str());
        if !leaves || wiring.incoming(&link.to.node, &link.to.socket) != Some(&link.from) {
            continue;
        }
        let wanted = types.get(&link.to.node).and_then(|types| types.input(&link.to.socket));
        if let Some(from) = behind(&removed, &wiring, &types, &link.from)
            && let Some(given) = types.get(&from.node).and_then(|types| types.output(&from.socket))
            && wanted.is_some_and(|wanted| fits(given, wanted))
        {
            healed.push(Edit::AddLink { link: Link::new(from.clone(), link.to.clone()) });
        }
    }
    // First the wires, which take the places of the old ones.
    healed.extend(removed.iter().map(|id| Edit::RemoveNode { id: id.to_string() }));
    Ok(in_graph(group, healed))
}

/// What feeds an output of a removed node, through all removed nodes.
fn behind<'g>(
    removed: &BTreeSet<&str>,
    wiring: &Wiring<'g>,
    types: &Types,
    output: &SocketRef,
) -> Option<&'g SocketRef> {
    let mut output = output;
    let mut seen = BTreeSet::new();
    loop {
        if !seen.insert(output) {
            return None;
        }
        let node = types.get(&output.node)?;
        let ty = node.output(&output.socket)?;
        let takes =
            |input: &&Input| node.resolved(input.ty) == ty && wiring.incoming(&output.node, &input.name).is_some();
        let input = node.def.inputs.iter().find(takes)?;
        let from = wiring.incoming(&output.node, &input.name)?;
        if !removed.contains(from.node.as_str()) {
            return Some(from);
        }
        output = from;
    }
}

/// Puts a node on a wire: its first input and output that fit, those of the wire's own type before others.
///
/// # Errors
/// There is no such wire or node, or the node has no sockets that fit.
pub fn insert_on_link(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    link: &Link,
    node: &str,
) -> Result<Edit, Refusal> {
    let (graph, own) = graph_and_library(document, library, group)?;
    if !graph.links.contains(link) {
        return refuse("the wire is not there any more");
    }
    let types = resolve_types(graph, &own);
    let Some(def) = types.get(node).map(|types| types.def) else {
        return refuse(format!("there is no node `{node}` that is known"));
    };
    let carried = types.get(&link.from.node).and_then(|types| types.output(&link.from.socket));
    let is_own = |ty: SocketType| ty == SocketType::Generic || Some(ty) == carried;
    let mut inputs: Vec<&str> = Vec::new();
    let free = def.inputs.iter().filter(|i| graph.incoming(&SocketRef::new(node, &i.name)).is_none());
    let (first, then): (Vec<&Input>, Vec<&Input>) = free.partition(|input| is_own(input.ty));
    inputs.extend(first.into_iter().chain(then).map(|input| input.name.as_str()));
    let mut without = graph.clone();
    without.links.retain(|other| other != link);
    for input in inputs {
        let into = Link::new(link.from.clone(), SocketRef::new(node, input));
        if connects(&without, &own, &into.from, &into.to).is_err() {
            continue;
        }
        let mut joined = without.clone();
        joined.links.push(into.clone());
        for output in &def.outputs {
            let out = Link::new(SocketRef::new(node, &output.name), link.to.clone());
            if connects(&joined, &own, &out.from, &out.to).is_ok() {
                return Ok(in_graph(group, vec![Edit::AddLink { link: out }, Edit::AddLink { link: into }]));
            }
        }
    }
    let label = node_label(graph, &own, node);
    refuse(format!("\u{201c}{label}\u{201d} has no free input and output that fit this wire"))
}
