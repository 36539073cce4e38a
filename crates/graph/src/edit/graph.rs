//! Edits of one graph: the top level's, or a group's inside.

use super::{Edit, EditError, add, remove_where};
use crate::document::{Graph, Link, Node};

/// Makes an edit of a graph and returns the one that undoes it.
pub(super) fn apply(graph: &mut Graph, edit: &Edit) -> Result<Edit, EditError> {
    match edit {
        Edit::AddNode { id, node } => {
            add(&mut graph.nodes, id, node)?;
            Ok(Edit::TakeNode { id: id.clone() })
        }
        Edit::RemoveNode { id } => remove_node(graph, id),
        Edit::TakeNode { id } => match graph.nodes.remove(id) {
            Some(node) => Ok(Edit::AddNode { id: id.clone(), node }),
            None => Err(EditError::NoNode(id.clone())),
        },
        Edit::RenameNode { id, to } => rename_node(graph, id, to),
        Edit::SetValue { socket, value } => {
            let node = node_mut(graph, &socket.node)?;
            let old = match value {
                Some(value) => node.values.insert(socket.socket.clone(), value.clone()),
                None => node.values.remove(&socket.socket),
            };
            Ok(Edit::SetValue { socket: socket.clone(), value: old })
        }
        Edit::SetLabel { id, label } => {
            let old = std::mem::replace(&mut node_mut(graph, id)?.label, label.clone());
            Ok(Edit::SetLabel { id: id.clone(), label: old })
        }
        Edit::AddLink { link } => add_link(graph, link),
        Edit::RemoveLink { link } => {
            let place = graph.links.iter().position(|l| l == link).ok_or_else(|| EditError::NoLink(link.clone()))?;
            Ok(Edit::InsertLinks { links: vec![(place, graph.links.remove(place))] })
        }
        Edit::InsertLinks { links } => {
            graph.links = inserted(&graph.links, links)?;
            Ok(Edit::RemoveLinksAt { places: links.iter().map(|(place, _)| *place).collect() })
        }
        Edit::RemoveLinksAt { places } => {
            ascending(places.iter().copied(), graph.links.len())?;
            let links = remove_where(&mut graph.links, |place, _| places.binary_search(&place).is_ok());
            Ok(Edit::InsertLinks { links })
        }
        Edit::MoveNode { id, position } => {
            node_mut(graph, id)?;
            let old = match position {
                Some(position) => graph.layout.insert(id.clone(), *position),
                None => graph.layout.remove(id),
            };
            Ok(Edit::MoveNode { id: id.clone(), position: old })
        }
        Edit::AddFrame { id, frame } => {
            add(&mut graph.frames, id, frame)?;
            Ok(Edit::RemoveFrame { id: id.clone() })
        }
        Edit::RemoveFrame { id } => match graph.frames.remove(id) {
            Some(frame) => Ok(Edit::AddFrame { id: id.clone(), frame }),
            None => Err(EditError::NoNote(id.clone())),
        },
        Edit::SetFrame { id, frame } => {
            let old = graph.frames.get_mut(id).ok_or_else(|| EditError::NoNote(id.clone()))?;
            Ok(Edit::SetFrame { id: id.clone(), frame: std::mem::replace(old, frame.clone()) })
        }
        Edit::AddComment { id, comment } => {
            add(&mut graph.comments, id, comment)?;
            Ok(Edit::RemoveComment { id: id.clone() })
        }
        Edit::RemoveComment { id } => match graph.comments.remove(id) {
            Some(comment) => Ok(Edit::AddComment { id: id.clone(), comment }),
            None => Err(EditError::NoNote(id.clone())),
        },
        Edit::SetComment { id, comment } => {
            let old = graph.comments.get_mut(id).ok_or_else(|| EditError::NoNote(id.clone()))?;
            Ok(Edit::SetComment { id: id.clone(), comment: std::mem::replace(old, comment.clone()) })
        }
        Edit::AddParameter { .. } | Edit::RemoveParameter { .. } | Edit::SetParameter { .. } => {
            Err(EditError::OfDocument("parameters"))
        }
        Edit::SetSurface { .. } => Err(EditError::OfDocument("settings of the surface")),
        Edit::SetName { .. } => Err(EditError::OfDocument("name of the material")),
        Edit::AddGroup { .. } | Edit::RemoveGroup { .. } | Edit::SetInterface { .. } | Edit::In { .. } => {
            Err(EditError::OfDocument("groups"))
        }
        Edit::SetFunction { .. } => Err(EditError::OfDocument("functions")),
        Edit::Many(_) => Err(EditError::OfDocument("lists of edits")),
    }
}

fn node_mut<'g>(graph: &'g mut Graph, id: &str) -> Result<&'g mut Node, EditError> {
    graph.nodes.get_mut(id).ok_or_else(|| EditError::NoNode(id.into()))
}

fn remove_node(graph: &mut Graph, id: &str) -> Result<Edit, EditError> {
    let node = graph.nodes.remove(id).ok_or_else(|| EditError::NoNode(id.into()))?;
    let mut inverse = vec![Edit::AddNode { id: id.into(), node }];
    if let Some(position) = graph.layout.remove(id) {
        inverse.push(Edit::MoveNode { id: id.into(), position: Some(position) });
    }
    let links = remove_where(&mut graph.links, |_, link| link.from.node == id || link.to.node == id);
    if !links.is_empty() {
        inverse.push(Edit::InsertLinks { links });
    }
    Ok(Edit::Many(inverse))
}

fn rename_node(graph: &mut Graph, id: &str, to: &str) -> Result<Edit, EditError> {
    if !graph.nodes.contains_key(id) {
        return Err(EditError::NoNode(id.into()));
    }
    // Links of a missing node would come into the renamed one's hands, and undoing would not give them back.
    let is_named = graph.nodes.contains_key(to)
        || graph.layout.contains_key(to)
        || graph.links.iter().any(|link| link.from.node == to || link.to.node == to);
    if is_named {
        return Err(EditError::Taken(to.into()));
    }
    if let Some(node) = graph.nodes.remove(id) {
        graph.nodes.insert(to.into(), node);
    }
    if let Some(position) = graph.layout.remove(id) {
        graph.layout.insert(to.into(), position);
    }
    let ends = graph.links.iter_mut().flat_map(|link| [&mut link.from, &mut link.to]);
    ends.filter(|socket| socket.node == id).for_each(|socket| socket.node = to.into());
    Ok(Edit::RenameNode { id: to.into(), to: id.into() })
}

fn add_link(graph: &mut Graph, link: &Link) -> Result<Edit, EditError> {
    for id in [&link.from.node, &link.to.node] {
        node_mut(graph, id)?;
    }
    let old = remove_where(&mut graph.links, |_, other| other.to == link.to);
    let place = old.first().map_or(graph.links.len(), |(place, _)| *place);
    graph.links.insert(place, link.clone());
    let mut inverse = vec![Edit::RemoveLinksAt { places: vec![place] }];
    if !old.is_empty() {
        inverse.push(Edit::InsertLinks { links: old });
    }
    Ok(Edit::Many(inverse))
}

/// Refuses places that do not ascend or are not below `length`.
fn ascending(places: impl Iterator<Item = usize>, length: usize) -> Result<(), EditError> {
    let mut next = 0;
    for place in places {
        if place < next || place >= length {
            return Err(EditError::NoPlace { place, length });
        }
        next = place + 1;
    }
    Ok(())
}

/// The list with items at places of the result.
fn inserted(list: &[Link], new: &[(usize, Link)]) -> Result<Vec<Link>, EditError> {
    ascending(new.iter().map(|(place, _)| *place), list.len() + new.len())?;
    let mut out = Vec::with_capacity(list.len() + new.len());
    let mut old = list.iter();
    for (place, link) in new {
        out.extend(old.by_ref().take(place - out.len()).cloned());
        out.push(link.clone());
    }
    out.extend(old.cloned());
    Ok(out)
}
