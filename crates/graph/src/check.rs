//! What is wrong with a document: everything at once, in its user's words, each problem with node, socket, reason and remedy.
//!
//! An error keeps a shader from being made. A problem of a node that does not reach the surface is a warning, since no shader
//! needs that node; but a link to a node that is not there is an error, since what it was to feed may be what a shader needs. It opens no files: whether a picture exists is found when it is loaded.

mod findings;
mod groups;
mod limits;
pub(crate) mod links;
mod nodes;
mod parameters;
mod stages;
pub(crate) mod words;

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt;

use serde::Serialize;

use crate::FORMAT_VERSION;
use crate::document::{AlphaMode, Document, Graph, Link, NodeId, SURFACE_MIX, function_of};
use crate::flatten::{self, Flat, FlattenError, find, flatten};
use crate::group::{Extents, extents};
use crate::library::Library;
use crate::library::custom::{MAX_WORK, read_function};
use crate::node_def::NodeDef;
use crate::resolve::{Types, resolve_in};
use crate::value::SocketType;
use crate::wiring::Wiring;
use findings::Findings;

pub use limits::{MAX_FUNCTIONS, MAX_GROUP_SOCKETS, MAX_GROUPS, MAX_LINKS, MAX_NODES, MAX_PARAMETERS};

/// Most nodes that may reach the surface: more make no shader that a driver takes.
pub const MAX_LIVE_NODES: usize = 20_000;
/// Most nodes that mix surfaces; each is worth about twenty others.
pub const MAX_MIXTURES: usize = 1000;

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
    /// The group that it stands in; none for the top level.
    pub group: Option<String>,
    /// The node that it stands at; none for the document, or the group, as a whole.
    pub node: Option<NodeId>,
    /// The node's label, as the editor shows it; in a group after the group's: "Rust \u{203a} Noise".
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
        let place = match (&self.group, &self.node) {
            (None, None) => None,
            (None, Some(node)) => Some(node.clone()),
            (Some(group), None) => Some(format!("group {group}")),
            (Some(group), Some(node)) => Some(format!("{node} in group {group}")),
        };
        if let Some(place) = place {
            match self.node_label.as_deref().filter(|label| *label != place) {
                Some(label) => write!(f, "\u{201c}{}\u{201d} ({})", words::one_line(label), words::one_line(&place))?,
                None => f.write_str(&words::one_line(&place))?,
            }
            if let Some(socket) = &self.socket {
                write!(f, ", {}", words::one_line(socket))?;
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.message)
    }
}

/// All problems of a document: of the document, of its nodes in order of id, of its links and parameters in their order, of its groups
/// in order of id. `library` is the shipped one; what the document brings along is added here.
///
/// Of a document with more than it may hold only that is told. Of more than ten thousand errors, or warnings, the others are counted.
pub fn check(document: &Document, library: &Library) -> Vec<Problem> {
    let too_large = limits::check(document);
    if !too_large.is_empty() {
        return too_large;
    }
    let own = library.of(document);
    let wiring = Wiring::new(&document.graph);
    let surfaces = surface_nodes(document, library);
    let mut checker = Checker::new(document, &document.graph, &own, &wiring, Findings::default());
    checker.document();
    checker.cycles();
    checker.surface(&surfaces);
    nodes::check(&mut checker);
    links::check(&mut checker);
    parameters::check(&mut checker);
    let mut live: Vec<String> = checker.live.iter().map(|id| id.to_string()).collect();
    live.sort_unstable();
    let extents = extents(document);
    if surfaces.len() == 1 {
        checker.size(&live, &extents);
        match flatten(document, library) {
            Ok(Flat { document: Cow::Owned(flat), library }) => {
                checker.findings = in_stages(document, &flat, &library, checker.findings);
            }
            // What is wrong with groups is told with them; the top level is looked at by itself.
            _ => stages::check(&mut checker),
        }
    }
    groups::check(document, &own, &extents, &live, checker.findings).into_problems()
}

/// Problems of stages where groups are taken apart, told of the places where the user sees them.
fn in_stages(document: &Document, flat: &Document, library: &Library, findings: Findings) -> Findings {
    let wiring = Wiring::new(&flat.graph);
    let before = findings.problems.len();
    let mut checker = Checker::new(flat, &flat.graph, library, &wiring, findings);
    checker.live = flat.graph.nodes.keys().map(String::as_str).collect();
    stages::check(&mut checker);
    let mut findings = checker.findings;
    for problem in &mut findings.problems[before..] {
        if let Some((group, node, _)) = problem.node.as_deref().and_then(|path| find(document, path)) {
            (problem.group, problem.node) = (group.map(str::to_string), Some(node.to_string()));
        }
    }
    findings
}

/// The document's surface node, if it has exactly one.
pub fn surface_node<'d>(document: &'d Document, library: &Library) -> Option<&'d str> {
    match surface_nodes(document, library).as_slice() {
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

/// The ids of the document's surface nodes: those that give a surface to no other one that mixes it.
pub(crate) fn surface_nodes<'d>(document: &'d Document, library: &Library) -> Vec<&'d str> {
    // A document has many nodes of few definitions.
    let mut kinds: HashMap<&str, Option<&NodeDef>> = HashMap::new();
    let mut surfaces: BTreeMap<&str, &NodeDef> = BTreeMap::new();
    for (id, node) in &document.graph.nodes {
        let def = kinds.entry(&node.node).or_insert_with(|| library.get(&node.node).filter(|def| is_of_surfaces(def)));
        surfaces.extend(def.map(|def| (id.as_str(), def)));
    }
    let takes = |link: &&Link| {
        let inputs = surfaces.get(link.to.node.as_str()).map_or(&[][..], |def| &def.inputs);
        inputs.iter().any(|input| input.ty == SocketType::Surface && input.name == link.to.socket)
    };
    let mixed: HashSet<&str> = document.graph.links.iter().filter(takes).map(|link| link.from.node.as_str()).collect();
    let last = surfaces.into_iter().filter(|(id, def)| !mixed.contains(id) && gives_surface(def));
    last.map(|(id, _)| id).collect()
}

/// Whether a node takes or gives surfaces.
fn is_of_surfaces(def: &NodeDef) -> bool {
    gives_surface(def) || def.inputs.iter().any(|input| input.ty == SocketType::Surface)
}

/// The ids of the surfaces that the document's surface is mixed of: the surface node itself where nothing is mixed. Sorted;
/// empty when the document has not exactly one surface.
pub fn mixed_surfaces<'d>(document: &'d Document, library: &Library) -> Vec<&'d str> {
    let Some(root) = surface_node(document, library) else { return Vec::new() };
    let mut ids = Wiring::new(&document.graph).order(&[root]).unwrap_or_default();
    ids.retain(|id| is_unmixed(&document.graph, library, id));
    ids.sort_unstable();
    ids
}

fn gives_surface(def: &NodeDef) -> bool {
    def.outputs.iter().any(|output| output.ty == SocketType::Surface)
}

/// Whether a node is a surface that is not mixed of others.
fn is_unmixed(graph: &Graph, library: &Library, id: &str) -> bool {
    let def = graph.nodes.get(id).and_then(|node| library.get(&node.node));
    def.is_some_and(|def| gives_surface(def) && def.inputs.iter().all(|input| input.ty != SocketType::Surface))
}

/// A message that is made only when it is told: a hostile document has many problems of which it is not.
struct Told<F>(F);

impl<F: FnOnce() -> String> From<Told<F>> for String {
    fn from(told: Told<F>) -> String {
        (told.0)()
    }
}

struct Checker<'a> {
    document: &'a Document,
    /// The graph that is looked at: the document's, or a group's inside.
    graph: &'a Graph,
    /// The group that it is the inside of, and its label.
    group: Option<(&'a str, &'a str)>,
    /// The definitions of the graph's nodes.
    library: &'a Library,
    wiring: &'a Wiring<'a>,
    types: Types<'a>,
    /// The nodes whose problems are errors: those that reach the surface or the group's outputs, or all when that is not known.
    live: HashSet<&'a str>,
    /// Whether the material uses the graph: what is no part of it can lack nothing.
    is_used: bool,
    findings: Findings,
}

impl<'a> Checker<'a> {
    fn new(
        document: &'a Document,
        graph: &'a Graph,
        library: &'a Library,
        wiring: &'a Wiring<'a>,
        findings: Findings,
    ) -> Checker<'a> {
        let types = resolve_in(graph, library, wiring);
        Checker { document, graph, group: None, library, wiring, types, live: HashSet::new(), is_used: true, findings }
    }

    /// A problem of the document, or of the group, as a whole.
    fn of_document(&mut self, severity: Severity, message: impl Into<String>) {
        self.with_code(severity, in_one_line(message.into()));
    }

    /// The same with lines of the user's own code below the message.
    fn with_code(&mut self, severity: Severity, message: String) {
        if !self.findings.has_room(severity) {
            return;
        }
        let (group, label) = self.group.unzip();
        self.findings.problems.push(Problem {
            severity,
            group: group.map(str::to_string),
            node: None,
            node_label: label.map(str::to_string),
            socket: None,
            message,
        });
    }

    fn label(&self, id: &str) -> String {
        node_label(self.graph, self.library, id)
    }

    fn at(&mut self, severity: Severity, node: &str, socket: Option<&str>, message: impl Into<String>) {
        if !self.findings.has_room(severity) {
            return;
        }
        let node_label = self.graph.nodes.contains_key(node).then(|| match self.group {
            Some((_, label)) => format!("{label} \u{203a} {}", self.label(node)),
            None => self.label(node),
        });
        self.findings.problems.push(Problem {
            severity,
            group: self.group.map(|(id, _)| id.to_string()),
            node: Some(node.into()),
            node_label,
            socket: socket.map(str::to_string),
            message: in_one_line(message.into()),
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
        self.functions();
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
        self.view();
    }

    /// What is wrong with the document's own WGSL, each function once.
    fn functions(&mut self) {
        let graphs = self.document.groups.values().map(|group| &group.graph).chain([&self.document.graph]);
        let used: HashSet<&str> =
            graphs.flat_map(|graph| graph.nodes.values()).filter_map(|node| function_of(&node.node)).collect();
        for (id, text) in &self.document.functions {
            if let Err(e) = read_function(id, text) {
                let severity = if used.contains(id.as_str()) { Severity::Error } else { Severity::Warning };
                self.with_code(severity, format!("the function `{}`, {e}", words::one_line(id)));
            }
        }
    }

    /// Places that are no numbers.
    fn view(&mut self) {
        let graph = self.graph;
        for (id, _) in graph.layout.iter().filter(|(_, position)| position.iter().any(|x| !x.is_finite())) {
            self.warn(id, None, "its position in the editor is no number; move the node");
        }
        let frames = graph.frames.iter().map(|(id, frame)| ("frame", id, &frame.rect));
        let comments = graph.comments.iter().map(|(id, comment)| ("comment", id, &comment.rect));
        for (what, id, rect) in frames.chain(comments) {
            if rect.position.iter().chain(&rect.size).any(|x| !x.is_finite()) {
                let message = format!("the place of the {what} `{id}` is no number; move it or remove it");
                self.of_document(Severity::Warning, message);
            }
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

    /// Too many nodes, or groups too deep in each other.
    fn size(&mut self, live: &[String], extents: &Extents) {
        let is_mix = |id: &&String| self.document.graph.nodes.get(*id).is_some_and(|node| node.node == SURFACE_MIX);
        let mixtures = live.iter().filter(is_mix).count();
        if mixtures > MAX_MIXTURES {
            let message = format!(
                "{mixtures} mixtures reach the surface, each of all that a surface has; no shader has more than {MAX_MIXTURES}: mix colours \
                 and numbers instead, or bake parts into pictures"
            );
            self.of_document(Severity::Error, message);
        }
        let each = live.iter().map(|id| extents.work(self.graph, id));
        let work = each.fold(0u64, u64::saturating_add);
        if work > MAX_WORK {
            let message = format!(
                "the document's own functions take {work} turns of loops and calls for each pixel, in all nodes that reach the surface \
                 together; {MAX_WORK} are the most: use fewer of those nodes, or let their loops end sooner"
            );
            self.of_document(Severity::Error, message);
        }
        let message = match flatten::count(self.document, live, extents) {
            Ok(nodes) if nodes <= MAX_LIVE_NODES => return,
            Ok(nodes) if nodes == live.len() => format!(
                "{nodes} nodes reach the surface; no driver takes a shader of more than {MAX_LIVE_NODES}: bake parts into pictures"
            ),
            Ok(nodes) => FlattenError::TooMany(nodes).to_string(),
            Err(e @ FlattenError::TooDeep) => e.to_string(),
            // Told with the groups and with the node.
            Err(_) => return,
        };
        self.of_document(Severity::Error, message);
    }

    /// Finds the live nodes, and reports what keeps the document from having a surface.
    fn surface(&mut self, surfaces: &[&'a str]) {
        let all = || self.graph.nodes.keys().map(String::as_str).collect();
        match surfaces {
            [surface] => match self.wiring.order(&[surface]) {
                Ok(order) => self.live = order.into_iter().collect(),
                Err(_) => self.live = all(),
            },
            [] => {
                self.live = all();
                let message = match self.ring_of_surfaces() {
                    Some(ring) => format!(
                        "no surface is the material's last one, so nothing is drawn: these mix each other in a ring, {ring}; remove one of \
                         the links"
                    ),
                    None => "the material has no surface node, so nothing is drawn; add one (surface/surface)".into(),
                };
                self.of_document(Severity::Error, message);
            }
            [first, others @ ..] => {
                self.live = all();
                for other in others {
                    let message = format!(
                        "a material has one surface node; this one is beside \u{201c}{}\u{201d}: remove one, or mix them",
                        self.label(first)
                    );
                    self.at(Severity::Error, other, None, message);
                }
            }
        }
        if surfaces.len() == 1 {
            for surface in self.parts() {
                self.opacity(surface);
            }
        }
    }

    /// The first ring of surfaces that mix each other, in words.
    fn ring_of_surfaces(&self) -> Option<String> {
        let def = |id: &str| self.library.get(&self.graph.nodes.get(id)?.node);
        let cycles = self.wiring.cycles();
        let ring = cycles.iter().find(|cycle| cycle.nodes.iter().all(|id| def(id).is_some_and(gives_surface)))?;
        let names: Vec<String> = ring.nodes.iter().map(|id| format!("{} ({id})", self.label(id))).collect();
        Some(words::ring(&names))
    }

    /// The live surfaces that are not mixed of others, sorted.
    fn parts(&self) -> Vec<&'a str> {
        let mut parts: Vec<&str> =
            self.live.iter().copied().filter(|id| is_unmixed(self.graph, self.library, id)).collect();
        parts.sort_unstable();
        parts
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

/// A message without line breaks and other control characters, which names in it may have: a name does not forge a line.
fn in_one_line(message: String) -> String {
    if message.contains(char::is_control) { words::one_line(&message) } else { message }
}

/// How often each text comes.
fn counts<'t>(texts: impl Iterator<Item = &'t str>) -> BTreeMap<&'t str, usize> {
    let mut counts = BTreeMap::new();
    texts.for_each(|text| *counts.entry(text).or_default() += 1);
    counts
}
