//! Pass: the nodes that the surface is made of, in an order in which each comes after what feeds it, with every generic
//! type decided and every link looked up.

use std::collections::HashMap;

use halfvector_graph::check::surface_node;
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::resolve::resolve_some;
use halfvector_graph::value::SocketType;
use halfvector_graph::wiring::Wiring;

use crate::CodegenError;
use crate::ir::NodeInfo;

/// What feeds an input. Nodes that only hand on what they get are looked through.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// The output `output` of node number `node`.
    Output { node: usize, output: usize },
    /// What the unconnected input `input` of node number `node` reads.
    Input { node: usize, input: usize },
}

impl Source {
    /// The node that must be computed first, if any.
    pub(crate) fn computed(self) -> Option<usize> {
        match self {
            Source::Output { node, .. } => Some(node),
            Source::Input { .. } => None,
        }
    }
}

/// The nodes that the surface is made of.
pub(crate) struct Types<'a> {
    pub(crate) nodes: Vec<NodeInfo<'a>>,
    /// By node and input.
    pub(crate) sources: Vec<Vec<Option<Source>>>,
    /// The surface node.
    pub(crate) surface: usize,
    /// The document's parameters, by node and input.
    pub(crate) parameters: HashMap<(&'a str, &'a str), usize>,
}

impl Types<'_> {
    /// Whether a node's result is a surface.
    pub(crate) fn gives_surface(&self, node: usize) -> bool {
        self.nodes[node].def.outputs.iter().any(|output| output.ty == SocketType::Surface)
    }

    /// The node that feeds an input.
    pub(crate) fn source(&self, node: usize, input: &str) -> Option<usize> {
        let index = self.nodes[node].def.inputs.iter().position(|i| i.name == input)?;
        self.sources[node][index].and_then(Source::computed)
    }
}

/// Looks everything up that the surface reaches.
pub(crate) fn resolve<'a>(document: &'a Document, library: &'a Library) -> Result<Types<'a>, CodegenError> {
    let root = surface_node(document, library).ok_or(CodegenError::NoSurface)?;
    let wiring = Wiring::new(&document.graph);
    let order = wiring.order(&[root]).map_err(|cycle| CodegenError::Library(cycle.to_string()))?;
    let resolved = resolve_some(&document.graph, library, &wiring, &order);
    let mut types = Types { nodes: Vec::new(), sources: Vec::new(), surface: 0, parameters: HashMap::new() };
    for (number, parameter) in document.parameters.iter().enumerate() {
        types.parameters.entry((&parameter.socket.node, &parameter.socket.socket)).or_insert(number);
    }
    let mut index: HashMap<&str, usize> = HashMap::new();
    for id in order {
        let (Some((id, node)), Some(known)) = (document.graph.nodes.get_key_value(id), resolved.get(id)) else {
            continue;
        };
        let sources = known
            .def
            .inputs
            .iter()
            .map(|input| {
                let from = wiring.incoming(id, &input.name)?;
                let node = *index.get(from.node.as_str())?;
                let info: &NodeInfo<'_> = &types.nodes[node];
                let output = info.def.outputs.iter().position(|o| o.name == from.socket)?;
                if info.def.forwards {
                    return Some(types.sources[node][output].unwrap_or(Source::Input { node, input: output }));
                }
                Some(Source::Output { node, output })
            })
            .collect::<Vec<Option<Source>>>();
        index.insert(id, types.nodes.len());
        types.surface = types.nodes.len();
        let label = node.label.as_deref().unwrap_or(&known.def.label);
        types.nodes.push(NodeInfo { id, label, def: known.def, generic: known.generic, values: &node.values });
        types.sources.push(sources);
    }
    Ok(types)
}
