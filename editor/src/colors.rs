//! Which generic nodes work on colours: a vector of three numbers on them is shown as a swatch. A node that works on any type does
//! not say so; what it is wired to does.

use std::collections::{BTreeSet, HashMap};

use halfvector_graph::document::Graph;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::resolve::Types;
use halfvector_graph::value::SocketType;

/// The generic nodes of a graph that work on colours. What a node feeds counts, through other generic nodes: an input that wants a
/// colour. Where it feeds nothing but such nodes, what feeds it counts.
pub(crate) fn nodes_of_colors<'g>(graph: &'g Graph, types: &Types<'_>) -> BTreeSet<&'g str> {
    let (mut wanted, mut given, mut others) = (Vec::new(), Vec::new(), Vec::new());
    let mut wired: HashMap<&str, Vec<&str>> = HashMap::new();
    for link in &graph.links {
        let (Some(from), Some(to)) = (types.get(&link.from.node), types.get(&link.to.node)) else { continue };
        let output = from.def.outputs.iter().find(|output| output.name == link.from.socket);
        let input = to.def.inputs.iter().find(|input| input.name == link.to.socket);
        let (Some(output), Some(input)) = (output, input) else { continue };
        match (output.ty == SocketType::Generic, input.ty == SocketType::Generic) {
            (true, true) => {
                wired.entry(&link.from.node).or_default().push(&link.to.node);
                wired.entry(&link.to.node).or_default().push(&link.from.node);
            }
            (true, false) if input.unit == "color" => wanted.push(link.from.node.as_str()),
            (true, false) => others.push(link.from.node.as_str()),
            (false, true) if gives_color(from.def, &output.name) => given.push(link.to.node.as_str()),
            _ => {}
        }
    }
    let mut colors = reached(wanted, &wired);
    let others = reached(others, &wired);
    colors.extend(reached(given, &wired).difference(&others));
    colors
}

/// All that is wired to some nodes.
fn reached<'g>(mut from: Vec<&'g str>, wired: &HashMap<&str, Vec<&'g str>>) -> BTreeSet<&'g str> {
    let mut all = BTreeSet::new();
    while let Some(node) = from.pop() {
        if all.insert(node) {
            from.extend(wired.get(node).into_iter().flatten());
        }
    }
    all
}

/// Outputs have no unit: the name or the category says it.
fn gives_color(def: &NodeDef, output: &str) -> bool {
    def.id.starts_with("color/") || output.contains("color") || output == "albedo"
}
