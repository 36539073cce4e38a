//! What becomes of nodes on the way to a shader: which are computed, which are known before, which nothing reads.
//!
//! It is told of the nodes that reach the surface; others are never looked at. Surfaces, and nodes that only hand on what they get,
//! compute nothing and are not told of.

use std::collections::BTreeSet;

use halfvector_graph::document::SURFACE_MIX;

use crate::ir::{Expr, Program};
use crate::link::Index;
use crate::passes::plan::Plan;
use crate::passes::types::{Source, Types};
use crate::{Dropped, DroppedNode};

/// By node: what it was after some of the passes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fates {
    /// A call, after lowering.
    pub(crate) lowered: Vec<bool>,
    /// Still a call, after folding.
    pub(crate) folded: Vec<bool>,
    /// A number, after folding.
    pub(crate) constant: Vec<bool>,
    /// A call that is read.
    pub(crate) live: Vec<bool>,
    /// A call that no other one stands for.
    pub(crate) kept: Vec<bool>,
}

/// Which nodes are calls in some stage.
pub(crate) fn calls(program: &Program<'_>) -> Vec<bool> {
    are(program, |expr| matches!(expr, Expr::Call { .. } | Expr::Builtin { .. }))
}

/// Which nodes are numbers in some stage.
pub(crate) fn constants(program: &Program<'_>) -> Vec<bool> {
    are(program, |expr| matches!(expr, Expr::Literal(_)))
}

fn are(program: &Program<'_>, is: impl Fn(&Expr<'_>) -> bool) -> Vec<bool> {
    let mut nodes = vec![false; program.nodes.len()];
    for entry in program.fragment.arena.exprs.iter().chain(&program.vertex.arena.exprs) {
        if let Some(node) = entry.node.filter(|_| is(&entry.expr)) {
            nodes[node] = true;
        }
    }
    nodes
}

/// Most places that are named in one reason.
const MAX_ENDS: usize = 3;

/// Where what a node gives comes to an end: sockets that are not read, and nodes that do not read it. In words.
#[derive(Clone, Default)]
struct Ends {
    /// The first of them.
    words: BTreeSet<String>,
    are_more: bool,
}

impl Ends {
    fn add(&mut self, words: String) {
        if self.words.len() < MAX_ENDS || self.words.contains(&words) {
            self.words.insert(words);
        } else {
            self.are_more = true;
        }
    }

    fn why(&self) -> String {
        let words: Vec<&str> = self.words.iter().map(String::as_str).collect();
        let more = if self.are_more { " and others that do not read it" } else { "" };
        format!("it feeds only {}{more}", words.join(", "))
    }
}

/// The nodes that reach the surface and are not in the shader, each with the reason and the instructions of its function alone.
pub(crate) fn dropped_nodes(types: &Types<'_>, fates: &Fates, plan: &Plan, index: &Index) -> Vec<DroppedNode> {
    let is = |of: &[bool], node: usize| of.get(node).copied().unwrap_or(false);
    let mut readers: Vec<Vec<(usize, usize)>> = vec![Vec::new(); types.nodes.len()];
    for (reader, sources) in types.sources.iter().enumerate() {
        for (input, source) in sources.iter().enumerate() {
            if let Some(Source::Output { node, .. }) = source {
                readers[*node].push((reader, input));
            }
        }
    }
    let mut ends: Vec<Ends> = vec![Ends::default(); types.nodes.len()];
    let mut dropped = Vec::new();
    // Readers come after what they read.
    for node in (0..types.nodes.len()).rev() {
        let info = &types.nodes[node];
        if info.def.forwards || types.gives_surface(node) || is(&fates.kept, node) {
            continue;
        }
        let is_folded = is(&fates.lowered, node) && !is(&fates.folded, node);
        let why = if !is(&fates.live, node) && is(&fates.constant, node) {
            "its value is known: a number stands in its place".to_owned()
        } else if is_folded {
            "it changes nothing: what it gets stands in its place".to_owned()
        } else if is(&fates.live, node) {
            "another node computes the same".to_owned()
        } else {
            let mut own = Ends::default();
            for (reader, input) in &readers[node] {
                let (to, socket) = (&types.nodes[*reader], &types.nodes[*reader].def.inputs[*input].name);
                let is_known = is(&fates.lowered, *reader) && !is(&fates.folded, *reader);
                if types.gives_surface(*reader) {
                    own.add(end_at_surface(to.def.id == SURFACE_MIX, socket, &plan.dropped));
                } else if is_known || is(&fates.constant, *reader) {
                    own.add(format!("`{}`, which needs no computing", to.label));
                } else if is(&fates.live, *reader) {
                    own.add(format!("`{}`, which does not read it here", to.label));
                } else {
                    let passed = &ends[*reader];
                    passed.words.iter().for_each(|words| own.add(words.clone()));
                    own.are_more |= passed.are_more;
                }
            }
            let why = own.why();
            ends[node] = own;
            why
        };
        let function = index.instance(&info.def.function.name, info.generic);
        let instructions = function.and_then(|function| index.compiled(function)).map(|known| known.cost.total());
        dropped.push(DroppedNode { node: info.id.clone(), label: info.label.to_owned(), why, instructions });
    }
    dropped.sort_by(|a, b| a.node.cmp(&b.node));
    dropped
}

/// A socket of a surface that is not read, and why.
fn end_at_surface(is_mixture: bool, socket: &str, dropped: &[Dropped]) -> String {
    let switch = match socket {
        "coat_color" | "coat_roughness" | "coat_ior" | "coat_normal" => "coat_weight",
        "sheen_roughness" => "sheen_color",
        "anisotropy_rotation" => "anisotropy",
        "thin_film_thickness" | "thin_film_ior" => "thin_film_weight",
        other => other,
    };
    match dropped.iter().find(|one| one.kept_by.socket() == Some(switch)) {
        Some(one) => format!("`{socket}` ({})", one.why),
        None if is_mixture => format!("the mixture's `{socket}`, which has no effect here"),
        None => format!("`{socket}`, which this shader does not read"),
    }
}
