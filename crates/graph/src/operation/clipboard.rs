//! Copy and paste: a selection as a document of its own, with the groups and functions that it needs and the parameters that set it.

use std::collections::{BTreeMap, BTreeSet};

use super::import::{Needed, held, import, needed};
use super::{Refusal, in_graph, refuse};
use crate::check::{node_label, surface_nodes};
use crate::document::{
    Comment, Document, Frame, GROUP_INPUT, GROUP_OUTPUT, Link, Node, NodeId, Parameter, Rect, SURFACE_MIX,
    SURFACE_NODE, SocketRef, free_name, group_of, is_name,
};
use crate::edit::Edit;
use crate::library::Library;
use crate::node_def::{Default as InputDefault, Input};
use crate::value::SocketType;

/// What is picked out of a graph, by ids.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pick {
    /// Nodes.
    pub nodes: Vec<NodeId>,
    /// Frames; what lies in them is not meant with them.
    pub frames: Vec<String>,
    /// Comments.
    pub comments: Vec<String>,
}

impl Pick {
    /// Nodes alone.
    pub fn nodes(nodes: impl IntoIterator<Item = NodeId>) -> Pick {
        Pick { nodes: nodes.into_iter().collect(), ..Pick::default() }
    }

    /// Whether nothing is picked.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.frames.is_empty() && self.comments.is_empty()
    }
}

/// What is picked of a graph as a document of its own: nodes with the links among them, their places and the groups and functions that
/// they need; frames and comments; of the top level the parameters that set these nodes. The nodes of a group's sockets stay with the group.
pub fn copy(document: &Document, group: Option<&str>, pick: &Pick) -> Document {
    let mut copied = Document::new("");
    let Some(graph) = document.graph_of(group) else { return copied };
    let is_copied = |node: &Node| node.node != GROUP_INPUT && node.node != GROUP_OUTPUT;
    for id in &pick.nodes {
        if let Some(node) = graph.nodes.get(id).filter(|node| is_copied(node)) {
            copied.graph.nodes.insert(id.clone(), node.clone());
            copied.graph.layout.extend(graph.layout.get(id).map(|place| (id.clone(), *place)));
        }
    }
    let frames = pick.frames.iter().filter_map(|id| Some((id.clone(), graph.frames.get(id)?.clone())));
    copied.graph.frames = frames.collect();
    let comments = pick.comments.iter().filter_map(|id| Some((id.clone(), graph.comments.get(id)?.clone())));
    copied.graph.comments = comments.collect();
    let has = |id: &str| copied.graph.nodes.contains_key(id);
    copied.graph.links = graph.links.iter().filter(|l| has(&l.from.node) && has(&l.to.node)).cloned().collect();
    if group.is_none() {
        let theirs = document.parameters.iter().filter(|parameter| has(&parameter.socket.node));
        copied.parameters = theirs.cloned().collect();
    }
    let Needed { groups, functions } = needed(document, copied.graph.nodes.values());
    (copied.groups, copied.functions) = (groups, functions);
    copied
}

/// What pasting does.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The edit of the document.
    pub edit: Edit,
    /// What comes, by the ids that it gets there.
    pub pick: Pick,
    /// What else came along, and what was left out and why: each a part of a sentence, such as "the parameter `scale` came along".
    pub notes: Vec<String>,
}

/// Puts what was copied into a graph, its upper left corner at `at`. Parameters come along under free names; what cannot stand there is left out,
/// and the notes say so.
///
/// # Errors
/// The document has nothing that can stand here; a group would come to hold itself.
pub fn paste(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    copied: &Document,
    at: [f32; 2],
) -> Result<Pasted, Refusal> {
    let Some(graph) = document.graph_of(group) else {
        return refuse("the group is not there any more");
    };
    let has_surface = group.is_some() || !surface_nodes(document, library).is_empty();
    let mut notes = Vec::new();
    let mut nodes: Vec<(&NodeId, &Node)> = Vec::new();
    for (id, node) in &copied.graph.nodes {
        let why = match node.node.as_str() {
            GROUP_INPUT | GROUP_OUTPUT => "sockets of a group stay in it",
            SURFACE_MIX if group.is_some() => "surfaces are mixed at the top level",
            SURFACE_NODE if group.is_some() => "the surface stands at the top level",
            SURFACE_NODE if has_surface => "the material has a surface",
            _ => {
                nodes.push((id, node));
                continue;
            }
        };
        notes.push(format!("\u{201c}{}\u{201d} was left out, as {why}", node_label(&copied.graph, library, id)));
    }
    let (frames, comments) = (&copied.graph.frames, &copied.graph.comments);
    if nodes.is_empty() && frames.is_empty() && comments.is_empty() {
        return refuse(match notes.as_slice() {
            [only] => format!("nothing can be pasted here: {only}"),
            _ => "what was copied has no nodes that can stand here".to_owned(),
        });
    }
    let (mut edits, names) = import(document, &copied.groups, &copied.functions);
    let mut ids: BTreeMap<&str, NodeId> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for (id, _) in &nodes {
        let free = free_name(id, |id| graph.nodes.contains_key(id) || taken.contains(id));
        taken.insert(free.clone());
        ids.insert(id, free);
    }
    let mut places: Vec<[f32; 2]> = nodes.iter().filter_map(|(id, _)| copied.graph.layout.get(*id).copied()).collect();
    places.extend(frames.values().map(|frame| frame.rect.position));
    places.extend(comments.values().map(|comment| comment.rect.position));
    let corner = [0, 1].map(|axis| places.iter().map(|place| place[axis]).fold(f32::INFINITY, f32::min));
    let moved = |place: [f32; 2]| [0, 1].map(|axis| at[axis] + (place[axis] - corner[axis]));
    let mut inside = Vec::new();
    for (id, node) in nodes {
        let mut node = node.clone();
        node.node = names.definition(&node.node);
        if let (Some(held), Some(group)) = (group_of(&node.node), group)
            && reaches(document, held, group)
        {
            return refuse("a group cannot hold itself; paste this node elsewhere");
        }
        let new = &ids[id.as_str()];
        inside.push(Edit::AddNode { id: new.clone(), node });
        if let Some(place) = copied.graph.layout.get(id) {
            inside.push(Edit::MoveNode { id: new.clone(), position: Some(moved(*place)) });
        }
    }
    let named = |socket: &SocketRef| Some(SocketRef::new(ids.get(socket.node.as_str())?, &socket.socket));
    let links = copied.graph.links.iter().filter_map(|link| Some(Link::new(named(&link.from)?, named(&link.to)?)));
    inside.extend(links.map(|link| Edit::AddLink { link }));
    let parameters = parameters(document, library, group, copied, named, &mut notes);
    let mut pasted = Pick::nodes(ids.into_values());
    for (id, frame) in frames {
        let id = free_name(id, |id| graph.frames.contains_key(id) || pasted.frames.iter().any(|one| one == id));
        pasted.frames.push(id.clone());
        let rect = Rect { position: moved(frame.rect.position), ..frame.rect };
        inside.push(Edit::AddFrame { id, frame: Frame { rect, ..frame.clone() } });
    }
    for (id, comment) in comments {
        let id = free_name(id, |id| graph.comments.contains_key(id) || pasted.comments.iter().any(|one| one == id));
        pasted.comments.push(id.clone());
        let rect = Rect { position: moved(comment.rect.position), ..comment.rect };
        inside.push(Edit::AddComment { id, comment: Comment { rect, ..comment.clone() } });
    }
    edits.push(in_graph(group, inside));
    edits.extend(parameters);
    Ok(Pasted { edit: Edit::Many(edits), pick: pasted, notes })
}

/// The edits that offer what was offered of the pasted nodes, each parameter under a free name.
fn parameters(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    copied: &Document,
    named: impl Fn(&SocketRef) -> Option<SocketRef>,
    notes: &mut Vec<String>,
) -> Vec<Edit> {
    let own = library.of(copied);
    let mut taken: BTreeSet<String> = document.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let mut edits = Vec::new();
    for parameter in &copied.parameters {
        let Some(socket) = named(&parameter.socket) else { continue };
        let name = &parameter.name;
        if group.is_some() {
            notes.push(format!("the parameter `{name}` was left out, as only the top level's nodes have parameters"));
            continue;
        }
        // What was wrong there is not brought here.
        if let Some(why) = unsound(&own, copied, parameter) {
            notes.push(format!("the parameter `{name}` was left out, as {why}"));
            continue;
        }
        let free = match taken.contains(name) {
            false => name.clone(),
            // The copy of `scale_2` is `scale_3`.
            true => free_name(unnumbered(name), |name| taken.contains(name)),
        };
        notes.push(match free == *name {
            true => format!("the parameter `{name}` came along"),
            false => format!("the parameter `{name}` came along as `{free}`"),
        });
        taken.insert(free.clone());
        let parameter = Parameter { name: free, socket, ..parameter.clone() };
        edits.push(Edit::AddParameter { place: None, parameter });
    }
    edits
}

/// A name without the number at its end.
fn unnumbered(name: &str) -> &str {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    bare.strip_suffix('_').filter(|bare| !bare.is_empty() && *bare != name).unwrap_or(name)
}

/// Why a parameter would be wrong wherever it stands.
fn unsound(library: &Library, copied: &Document, parameter: &Parameter) -> Option<&'static str> {
    let socket = &parameter.socket;
    if !is_name(&parameter.name) {
        return Some("its name is none of letters, digits and _");
    }
    if parameter.range.is_some_and(|[low, high]| !(low.is_finite() && high.is_finite() && low < high)) {
        return Some("its range is none");
    }
    if copied.graph.incoming(socket).is_some() {
        return Some("a wire feeds its input");
    }
    let node = copied.graph.nodes.get(&socket.node)?;
    let input = library.get(&node.node)?.inputs.iter().find(|input| input.name == socket.socket);
    match input {
        None => Some("its input is not there"),
        Some(input) if !matches!(input.ty, SocketType::Value(_) | SocketType::Generic) => {
            Some("its input takes no number")
        }
        Some(Input { default: InputDefault::Context(_), .. }) if !node.values.contains_key(&socket.socket) => {
            Some("its input has no value")
        }
        Some(_) => None,
    }
}

/// Whether a group is another one or holds it, directly or not.
fn reaches(document: &Document, from: &str, to: &str) -> bool {
    let mut open = vec![from];
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if id == to {
            return true;
        }
        if let Some(group) = document.groups.get(id)
            && seen.insert(id)
        {
            open.extend(held(group));
        }
    }
    false
}
