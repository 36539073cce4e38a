//! What is wrong with a document: everything at once, in its user's words, each problem with node, socket, reason and remedy.
//!
//! An error keeps a shader from being made. A problem of a node that does not reach the surface is a warning, since no shader
//! needs that node. It opens no files: whether a picture exists is found when it is loaded.

mod links;
mod nodes;
mod parameters;
mod stages;
mod words;

use std::collections::{BTreeMap, HashSet};
use std::fmt;

use serde::Serialize;

use crate::FORMAT_VERSION;
use crate::document::{AlphaMode, Document, Graph, NodeId};
use crate::library::Library;
use crate::node_def::NodeDef;
use crate::resolve::{Types, resolve_in};
use crate::value::SocketType;
use crate::wiring::Wiring;

/// Most nodes that may reach the surface: more make no shader that a driver takes.
pub const MAX_LIVE_NODES: usize = 20_000;

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// No shader can be made.
    Error,
    /// A shader can be made, but perhaps not the one that was meant.
    Warning,
}

/// Something wrong with a document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// The node that it stands at; none for the document as a whole.
    pub node: Option<NodeId>,
    /// The node's label, as the editor shows it.
    pub node_label: Option<String>,
    /// The input or output.
    pub socket: Option<String>,
    /// What is wrong, why, and what to do.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.severity {
            Severity::Error => "error: ",
            Severity::Warning => "warning: ",
        })?;
        if let Some(node) = &self.node {
            match self.node_label.as_deref().filter(|label| label != node) {
                Some(label) => write!(f, "\u{201c}{}\u{201d} ({node})", words::one_line(label))?,
                None => write!(f, "{node}")?,
            }
            if let Some(socket) = &self.socket {
                write!(f, ", {socket}")?;
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.message)
    }
}

/// All problems of a document: of the document, of its nodes in order of id, of its links and parameters in their order.
pub fn check(document: &Document, library: &Library) -> Vec<Problem> {
    let wiring = Wiring::new(&document.graph);
    let types = resolve_in(&document.graph, library, &wiring);
    let surfaces = surfaces(document, library);
    let mut checker = Checker { document, library, live: HashSet::new(), wiring: &wiring, types, problems: Vec::new() };
    checker.document();
    checker.cycles();
    checker.surface(&surfaces);
    nodes::check(&mut checker);
    links::check(&mut checker);
    parameters::check(&mut checker);
    if let [surface] = surfaces.as_slice() {
        stages::check(&mut checker, surface);
    }
    checker.problems
}

/// The document's surface node, if it has exactly one.
pub fn surface_node<'d>(document: &'d Document, library: &Library) -> Option<&'d str> {
    match surfaces(document, library).as_slice() {
        [surface] => Some(surface),
        _ => None,
    }
}

/// The name that a node has for people: its own label, or its definition's, or its id.
pub fn node_label(graph: &Graph, library: &Library, id: &str) -> String {
    let node = graph.nodes.get(id);
    let own = node.and_then(|node| node.label.clone());
    own.or_else(|| node.and_then(|node| library.get(&node.node)).map(|def| def.label.clone()))
        .unwrap_or_else(|| id.into())
}

fn surfaces<'d>(document: &'d Document, library: &Library) -> Vec<&'d str> {
    let is_surface = |def: &NodeDef| def.outputs.iter().any(|output| output.ty == SocketType::Surface);
    let known = document.graph.nodes.iter().filter_map(|(id, node)| Some((id.as_str(), library.get(&node.node)?)));
    known.filter(|(_, def)| is_surface(def)).map(|(id, _)| id).collect()
}

struct Checker<'a> {
    document: &'a Document,
    library: &'a Library,
    wiring: &'a Wiring<'a>,
    types: Types<'a>,
    /// The nodes whose problems are errors: those that reach the surface, or all when that is not known.
    live: HashSet<&'a str>,
    problems: Vec<Problem>,
}

impl<'a> Checker<'a> {
    fn of_document(&mut self, severity: Severity, message: impl Into<String>) {
        self.problems.push(Problem { severity, node: None, node_label: None, socket: None, message: message.into() });
    }

    fn label(&self, id: &str) -> String {
        node_label(&self.document.graph, self.library, id)
    }

    fn at(&mut self, severity: Severity, node: &str, socket: Option<&str>, message: impl Into<String>) {
        let node_label = self.document.graph.nodes.contains_key(node).then(|| self.label(node));
        self.problems.push(Problem {
            severity,
            node: Some(node.into()),
            node_label,
            socket: socket.map(str::to_string),
            message: message.into(),
        });
    }

    /// An error, or a warning at a node that no shader needs.
    fn wrong(&mut self, node: &str, socket: Option<&str>, message: impl Into<String>) {
        let severity = if self.live.contains(node) { Severity::Error } else { Severity::Warning };
        self.at(severity, node, socket, message);
    }

    fn warn(&mut self, node: &str, socket: Option<&str>, message: impl Into<String>) {
        self.at(Severity::Warning, node, socket, message);
    }

    fn document(&mut self) {
        let document = self.document;
        if document.version > FORMAT_VERSION {
            self.of_document(
                Severity::Warning,
                format!(
                    "the file is of format {}, this program knows up to {FORMAT_VERSION}; what it does not know is kept when it saves, but not drawn",
                    document.version
                ),
            );
        }
        for field in document.unknown.keys().chain(document.graph.unknown.keys()) {
            self.of_document(
                Severity::Warning,
                format!("the document's field `{field}` has parts that this program does not know; they are kept when it saves"),
            );
        }
        let settings = document.surface;
        if !(0.0..=1.0).contains(&settings.alpha_cutoff) {
            self.of_document(
                Severity::Error,
                format!(
                    "alpha_cutoff is {}; it is the opacity below which nothing is drawn, from 0 to 1",
                    settings.alpha_cutoff
                ),
            );
        }
        for (id, _) in document.graph.layout.iter().filter(|(_, position)| position.iter().any(|x| !x.is_finite())) {
            self.warn(id, None, "its position in the editor is no number; move the node");
        }
    }

    fn cycles(&mut self) {
        for cycle in self.wiring.cycles() {
            let first = &cycle.nodes[0];
            let message = match cycle.nodes.as_slice() {
                [_] => "the node feeds itself; remove the link from its output to its own input".to_string(),
                nodes => {
                    let labels: Vec<String> = nodes.iter().map(|id| self.label(id)).collect();
                    format!("the nodes feed each other in a ring: {}; remove one of the links", words::ring(&labels))
                }
            };
            self.at(Severity::Error, first, None, message);
        }
    }

    /// Finds the live nodes, and reports what keeps the document from having a surface.
    fn surface(&mut self, surfaces: &[&'a str]) {
        let all = || self.document.graph.nodes.keys().map(String::as_str).collect();
        match surfaces {
            [surface] => match self.wiring.order(&[surface]) {
                Ok(order) => self.live = order.into_iter().collect(),
                Err(_) => self.live = all(),
            },
            [] => {
                self.live = all();
                self.of_document(
                    Severity::Error,
                    "the material has no surface node, so nothing is drawn; add one (surface/surface)",
                );
            }
            [first, others @ ..] => {
                self.live = all();
                for other in others {
                    let message = format!(
                        "a material has one surface node; this one is beside \u{201c}{}\u{201d}: remove one",
                        self.label(first)
                    );
                    self.at(Severity::Error, other, None, message);
                }
            }
        }
        if surfaces.len() == 1 && self.live.len() > MAX_LIVE_NODES {
            let message = format!(
                "{} nodes reach the surface; no driver takes a shader of more than {MAX_LIVE_NODES}: bake parts into pictures",
                self.live.len()
            );
            self.of_document(Severity::Error, message);
        }
        if let [surface] = surfaces {
            self.opacity(surface);
        }
    }

    fn opacity(&mut self, surface: &str) {
        let set = self.document.graph.nodes.get(surface).and_then(|node| node.values.get("opacity"));
        let is_used = self.wiring.incoming(surface, "opacity").is_some()
            || set.and_then(|value| value.components()).is_some_and(|c| c.iter().any(|x| *x != 1.0));
        if is_used && self.document.surface.alpha_mode == AlphaMode::Opaque {
            self.warn(
                surface,
                Some("opacity"),
                "opacity has no effect while the alpha mode is opaque; choose mask or blend",
            );
        }
    }
}

/// How often each text comes.
fn counts<'t>(texts: impl Iterator<Item = &'t str>) -> BTreeMap<&'t str, usize> {
    let mut counts = BTreeMap::new();
    texts.for_each(|text| *counts.entry(text).or_default() += 1);
    counts
}
