//! What shows an output of a node: the part of the document that it depends on, as a surface that glows with it. A node inside
//! a group is shown as the first use of the group has it.

use std::collections::BTreeSet;
use std::sync::Arc;

use halfvector_graph::check::surface_node;
use halfvector_graph::document::{
    Document, GROUP_OUTPUT, GroupOutput, Link, Node, SocketRef, free_name, function_of, group_of,
};
use halfvector_graph::file::to_json;
use halfvector_graph::group::output_node;
use halfvector_graph::library::Library;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::{SocketType, Type, Value};
use halfvector_graph::wiring::Wiring;
use halfvector_scene::BuiltinMesh;

use super::Subject;
use crate::session::Session;

/// Nodes whose values lie on the shape and not on a picture.
const OF_SHAPE: [&str; 4] =
    ["coordinates/spherical", "coordinates/cylindrical", "coordinates/matcap", "coordinates/box"];
/// Nodes that give directions, beside those that have `normal` in their names.
const DIRECTIONS: [&str; 4] = ["geometry/tangent", "geometry/bitangent", "geometry/view_dir", "geometry/mirror_dir"];

/// What shows an output of a node of the level that is worked on, if anything can.
pub(super) fn preview(session: &Session, node: &str, output: &str) -> Option<Subject> {
    let document = session.sound_document();
    let ty = resolve_types(session.graph(), session.library()).get(node)?.output(output)?;
    let from = SocketRef::new(node, output);
    match (ty, session.path()) {
        (SocketType::Surface, []) => {
            let document = match surface_node(document, session.library()) {
                Some(end) if end != node => Arc::new(part(document, node)?),
                _ => document.clone(),
            };
            let directory = session.directory();
            let key = format!("material {} {}", session.pictures(), to_json(&document)).into();
            Some(Subject { key, document, directory, mesh: BuiltinMesh::Sphere, is_lit: true })
        }
        (SocketType::Value(ty), path) => {
            let is_direction = is_direction(&session.node(node)?.node);
            let (whole, from) = lifted(document, path, from, ty)?;
            let (cut, mesh) = glowing(&whole, from, ty, is_direction)?;
            // Positions do not matter, and the cut has none.
            let (directory, pictures) = (session.directory(), session.pictures());
            let key = format!("value {pictures} {} {}", directory.display(), to_json(&cut)).into();
            Some(Subject { key, document: cut.into(), directory, mesh, is_lit: false })
        }
        _ => None,
    }
}

fn is_direction(definition: &str) -> bool {
    definition.contains("normal") || DIRECTIONS.contains(&definition)
}

/// The document with an output of a group's inside handed out to the top level, through all groups that were entered, and what
/// gives it there. A group that nothing uses is used once, with its defaults.
fn lifted(document: &Arc<Document>, path: &[String], from: SocketRef, ty: Type) -> Option<(Arc<Document>, SocketRef)> {
    if path.is_empty() {
        return Some((document.clone(), from));
    }
    let mut whole = (**document).clone();
    let mut from = from;
    for (depth, id) in path.iter().enumerate().rev() {
        let group = whole.groups.get_mut(id)?;
        let name = free_name("preview", |name| group.interface.outputs.iter().any(|output| output.name == name));
        group.interface.outputs.push(GroupOutput::new(&name, ty));
        let taker = match output_node(group) {
            Some(taker) => taker.to_owned(),
            None => {
                let taker = group.graph.free_id("output");
                group.graph.nodes.insert(taker.clone(), Node::new(GROUP_OUTPUT));
                taker
            }
        };
        group.graph.links.push(Link::new(from, SocketRef::new(&taker, &name)));
        let outer = match depth.checked_sub(1).and_then(|outer| path.get(outer)) {
            Some(outer) => &mut whole.groups.get_mut(outer)?.graph,
            None => &mut whole.graph,
        };
        let definition = format!("group/{id}");
        let used = outer.nodes.iter().find(|(_, node)| node.node == definition).map(|(id, _)| id.clone());
        let user = used.unwrap_or_else(|| {
            let user = outer.free_id("preview");
            outer.nodes.insert(user.clone(), Node::new(&definition));
            user
        });
        from = SocketRef::new(&user, &name);
    }
    Some((Arc::new(whole), from))
}

/// A surface that is mixed into the document's, by itself.
fn part(document: &Document, surface: &str) -> Option<Document> {
    let mut cut = needed(document, surface)?;
    cut.surface = document.surface;
    bring(document, &mut cut);
    Some(cut)
}

/// The nodes of a document's top level that one of them depends on, and the links between them.
fn needed(document: &Document, node: &str) -> Option<Document> {
    let mut cut = Document::new("preview");
    for id in Wiring::new(&document.graph).order(&[node]).ok()? {
        cut.graph.nodes.insert(id.to_owned(), document.graph.nodes.get(id)?.clone());
    }
    let nodes = &cut.graph.nodes;
    let inside = |link: &&Link| nodes.contains_key(&link.from.node) && nodes.contains_key(&link.to.node);
    cut.graph.links = document.graph.links.iter().filter(inside).cloned().collect();
    Some(cut)
}

/// The part of a document that an output of its top level depends on, as a surface that glows with it, and what that is seen on.
fn glowing(document: &Document, from: SocketRef, ty: Type, is_direction: bool) -> Option<(Document, BuiltinMesh)> {
    let mut cut = needed(document, &from.node)?;
    let kinds = bring(document, &mut cut);
    let depends_on_shape = kinds.iter().any(|kind| kind.starts_with("geometry/") || OF_SHAPE.contains(&kind.as_str()));
    let mut from = from;
    let add = |cut: &mut Document, from: SocketRef, node: Node, input: &str, output: &str| {
        let id = cut.graph.free_id("preview");
        cut.graph.nodes.insert(id.clone(), node);
        cut.graph.links.push(Link::new(from, SocketRef::new(&id, input)));
        SocketRef::new(&id, output)
    };
    match ty {
        Type::F32 | Type::I32 => {}
        Type::Vec3 if is_direction => {
            // -1..1 becomes 0..1, as normal maps have it.
            let half = || Value::Vec3([0.5; 3]);
            let node = Node::new("math/multiply_add").with("b", half()).with("c", half());
            from = add(&mut cut, from, node, "a", "out");
        }
        Type::Vec3 => {}
        Type::Vec4 => {
            from = add(&mut cut, from, Node::new("vector/separate_color_alpha"), "v", "color");
        }
        Type::Vec2 => {
            let parts = add(&mut cut, from, Node::new("vector/separate2"), "v", "x");
            let y = SocketRef::new(&parts.node, "y");
            let color = add(&mut cut, parts, Node::new("vector/combine3"), "x", "out");
            cut.graph.links.push(Link::new(y, SocketRef::new(&color.node, "y")));
            from = color;
        }
        Type::Bool => {
            let node = Node::new("math/switch").with("when_true", Value::Number(1.0));
            from = add(&mut cut, from, node, "condition", "out");
        }
    }
    let surface =
        Node::new("surface/surface").with("base_color", Value::Vec3([0.0; 3])).with("specular", Value::Number(0.0));
    add(&mut cut, from, surface, "emission", "");
    surface_node(&cut, Library::standard())?;
    Some((cut, if depends_on_shape { BuiltinMesh::Sphere } else { BuiltinMesh::Plane }))
}

/// Brings the groups and functions that a cut needs, without what only the canvas shows; returns the kinds of all nodes in it.
fn bring(document: &Document, cut: &mut Document) -> BTreeSet<String> {
    let mut kinds: BTreeSet<String> = cut.graph.nodes.values().map(|node| node.node.clone()).collect();
    let mut waiting: Vec<String> = kinds.iter().cloned().collect();
    while let Some(kind) = waiting.pop() {
        if let Some((id, text)) = function_of(&kind).and_then(|id| document.functions.get_key_value(id)) {
            cut.functions.insert(id.clone(), text.clone());
        }
        let Some((id, group)) = group_of(&kind).and_then(|id| document.groups.get_key_value(id)) else { continue };
        let mut group = group.clone();
        (group.graph.layout, group.graph.frames, group.graph.comments) = Default::default();
        waiting
            .extend(group.graph.nodes.values().map(|node| node.node.clone()).filter(|kind| kinds.insert(kind.clone())));
        cut.groups.insert(id.clone(), group);
    }
    kinds
}
