//! Changes of a document, each with its exact inverse: an editor's undo is the list of inverses.
//!
//! An edit looks at the document only: whether it makes sense is told by `check`, so that a half-made material can be worked
//! on. An edit that cannot be made changes nothing. Every edit keeps the order of everything that it does not touch, so that undoing
//! gives back the same file.

use crate::document::{Document, Link, Node, NodeId, Parameter, SocketRef, SurfaceSettings};
use crate::value::Value;

/// A change of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Adds a node. Links that name its id already become its own.
    AddNode {
        /// Free.
        id: NodeId,
        /// The node.
        node: Node,
    },
    /// Removes a node with its links, parameters and position.
    RemoveNode {
        /// Which.
        id: NodeId,
    },
    /// Removes a node alone: the inverse of `AddNode`.
    TakeNode {
        /// Which.
        id: NodeId,
    },
    /// Gives a node another id, and its links, parameters and position with it.
    RenameNode {
        /// Which.
        id: NodeId,
        /// Named by nothing in the document.
        to: NodeId,
    },
    /// Sets the value of an input, or removes it so that the default holds.
    SetValue {
        /// The input; its node must exist.
        socket: SocketRef,
        /// None for the default.
        value: Option<Value>,
    },
    /// Sets the user's name of a node, or removes it.
    SetLabel {
        /// Which node.
        id: NodeId,
        /// In any script.
        label: Option<String>,
    },
    /// Adds a link; links into the same input make way.
    AddLink {
        /// Both nodes must exist.
        link: Link,
    },
    /// Removes a link.
    RemoveLink {
        /// Which; of equal ones the first.
        link: Link,
    },
    /// Puts links at places of the list, whatever is there: the inverse of removing.
    InsertLinks {
        /// Places in the list as it will be, ascending.
        links: Vec<(usize, Link)>,
    },
    /// Takes links out of the list by place.
    RemoveLinksAt {
        /// Places, ascending.
        places: Vec<usize>,
    },
    /// Offers an input as a parameter.
    AddParameter {
        /// Place in the list; none for its end.
        place: Option<usize>,
        /// The parameter.
        parameter: Parameter,
    },
    /// Takes a parameter back.
    RemoveParameter {
        /// Its place in the list.
        place: usize,
    },
    /// Changes name, label, range or input of a parameter.
    SetParameter {
        /// Its place in the list.
        place: usize,
        /// What stands there from now on.
        parameter: Parameter,
    },
    /// Sets what the rasteriser must know.
    SetSurface {
        /// From now on.
        surface: SurfaceSettings,
    },
    /// Moves a node on the editor's canvas, or forgets where it is.
    MoveNode {
        /// Which.
        id: NodeId,
        /// None to forget.
        position: Option<[f32; 2]>,
    },
    /// Renames the material.
    SetName {
        /// For people.
        name: String,
    },
    /// Several edits as one: all or none.
    Many(Vec<Edit>),
}

/// Why an edit cannot be made. The document is unchanged.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The node does not exist.
    #[error("there is no node `{0}`; was it removed or renamed?")]
    NoNode(NodeId),
    /// The id is taken.
    #[error("the id `{0}` is in use; choose another one")]
    Taken(NodeId),
    /// The link does not exist.
    #[error("there is no link from {} to {}", .0.from, .0.to)]
    NoLink(Link),
    /// A place is beyond the list's end, or places do not ascend.
    #[error("place {place} does not exist in a list of {length}")]
    NoPlace {
        /// As given.
        place: usize,
        /// Of the list.
        length: usize,
    },
}

/// Makes an edit and returns the one that undoes it, exactly.
pub fn apply(document: &mut Document, edit: &Edit) -> Result<Edit, EditError> {
    // Nested edits are worked off from a list, so that no nesting is too deep.
    let mut inverses = Vec::new();
    let mut waiting = vec![edit];
    while let Some(edit) = waiting.pop() {
        if let Edit::Many(edits) = edit {
            waiting.extend(edits.iter().rev());
            continue;
        }
        match apply_one(document, edit) {
            Ok(inverse) => inverses.push(inverse),
            Err(e) => {
                for inverse in inverses.iter().rev() {
                    apply(document, inverse)?;
                }
                return Err(e);
            }
        }
    }
    inverses.reverse();
    let flat: Vec<Edit> = inverses.into_iter().flat_map(parts).collect();
    Ok(match <[Edit; 1]>::try_from(flat) {
        Ok([only]) => only,
        Err(many) => Edit::Many(many),
    })
}

fn parts(edit: Edit) -> Vec<Edit> {
    match edit {
        Edit::Many(edits) => edits,
        edit => vec![edit],
    }
}

fn apply_one(document: &mut Document, edit: &Edit) -> Result<Edit, EditError> {
    match edit {
        Edit::AddNode { id, node } => add_node(document, id, node),
        Edit::RemoveNode { id } => remove_node(document, id),
        Edit::TakeNode { id } => match document.nodes.remove(id) {
            Some(node) => Ok(Edit::AddNode { id: id.clone(), node }),
            None => Err(EditError::NoNode(id.clone())),
        },
        Edit::RenameNode { id, to } => rename_node(document, id, to),
        Edit::SetValue { socket, value } => {
            let node = node_mut(document, &socket.node)?;
            let old = match value {
                Some(value) => node.values.insert(socket.socket.clone(), value.clone()),
                None => node.values.remove(&socket.socket),
            };
            Ok(Edit::SetValue { socket: socket.clone(), value: old })
        }
        Edit::SetLabel { id, label } => {
            let old = std::mem::replace(&mut node_mut(document, id)?.label, label.clone());
            Ok(Edit::SetLabel { id: id.clone(), label: old })
        }
        Edit::AddLink { link } => add_link(document, link),
        Edit::RemoveLink { link } => {
            let place = document.links.iter().position(|l| l == link).ok_or_else(|| EditError::NoLink(link.clone()))?;
            Ok(Edit::InsertLinks { links: vec![(place, document.links.remove(place))] })
        }
        Edit::InsertLinks { links } => {
            document.links = inserted(&document.links, links)?;
            Ok(Edit::RemoveLinksAt { places: links.iter().map(|(place, _)| *place).collect() })
        }
        Edit::RemoveLinksAt { places } => {
            ascending(places.iter().copied(), document.links.len())?;
            Ok(Edit::InsertLinks {
                links: remove_where(&mut document.links, |place, _| places.binary_search(&place).is_ok()),
            })
        }
        Edit::AddParameter { place, parameter } => {
            let length = document.parameters.len();
            let place = place.unwrap_or(length);
            if place > length {
                return Err(EditError::NoPlace { place, length });
            }
            document.parameters.insert(place, parameter.clone());
            Ok(Edit::RemoveParameter { place })
        }
        Edit::RemoveParameter { place } => {
            parameter_mut(document, *place)?;
            let parameter = document.parameters.remove(*place);
            Ok(Edit::AddParameter { place: Some(*place), parameter })
        }
        Edit::SetParameter { place, parameter } => {
            let old = std::mem::replace(parameter_mut(document, *place)?, parameter.clone());
            Ok(Edit::SetParameter { place: *place, parameter: old })
        }
        Edit::SetSurface { surface } => {
            Ok(Edit::SetSurface { surface: std::mem::replace(&mut document.surface, *surface) })
        }
        Edit::MoveNode { id, position } => move_node(document, id, *position),
        Edit::SetName { name } => Ok(Edit::SetName { name: std::mem::replace(&mut document.name, name.clone()) }),
        Edit::Many(_) => apply(document, edit),
    }
}

fn node_mut<'d>(document: &'d mut Document, id: &str) -> Result<&'d mut Node, EditError> {
    document.nodes.get_mut(id).ok_or_else(|| EditError::NoNode(id.into()))
}

fn parameter_mut(document: &mut Document, place: usize) -> Result<&mut Parameter, EditError> {
    let length = document.parameters.len();
    document.parameters.get_mut(place).ok_or(EditError::NoPlace { place, length })
}

fn add_node(document: &mut Document, id: &str, node: &Node) -> Result<Edit, EditError> {
    if document.nodes.contains_key(id) {
        return Err(EditError::Taken(id.into()));
    }
    document.nodes.insert(id.into(), node.clone());
    Ok(Edit::TakeNode { id: id.into() })
}

fn remove_node(document: &mut Document, id: &str) -> Result<Edit, EditError> {
    let node = document.nodes.remove(id).ok_or_else(|| EditError::NoNode(id.into()))?;
    let mut inverse = vec![Edit::AddNode { id: id.into(), node }];
    if let Some(position) = document.layout.remove(id) {
        inverse.push(Edit::MoveNode { id: id.into(), position: Some(position) });
    }
    let parameters = remove_where(&mut document.parameters, |_, parameter| parameter.socket.node == id);
    inverse
        .extend(parameters.into_iter().map(|(place, parameter)| Edit::AddParameter { place: Some(place), parameter }));
    let links = remove_where(&mut document.links, |_, link| link.from.node == id || link.to.node == id);
    if !links.is_empty() {
        inverse.push(Edit::InsertLinks { links });
    }
    Ok(Edit::Many(inverse))
}

fn rename_node(document: &mut Document, id: &str, to: &str) -> Result<Edit, EditError> {
    if !document.nodes.contains_key(id) {
        return Err(EditError::NoNode(id.into()));
    }
    // Links of a missing node would come into the renamed one's hands, and undoing would not give them back.
    let is_named = document.nodes.contains_key(to)
        || document.layout.contains_key(to)
        || document.links.iter().any(|link| link.from.node == to || link.to.node == to)
        || document.parameters.iter().any(|parameter| parameter.socket.node == to);
    if is_named {
        return Err(EditError::Taken(to.into()));
    }
    if let Some(node) = document.nodes.remove(id) {
        document.nodes.insert(to.into(), node);
    }
    if let Some(position) = document.layout.remove(id) {
        document.layout.insert(to.into(), position);
    }
    let ends = document.links.iter_mut().flat_map(|link| [&mut link.from, &mut link.to]);
    let sockets = ends.chain(document.parameters.iter_mut().map(|parameter| &mut parameter.socket));
    sockets.filter(|socket| socket.node == id).for_each(|socket| socket.node = to.into());
    Ok(Edit::RenameNode { id: to.into(), to: id.into() })
}

fn add_link(document: &mut Document, link: &Link) -> Result<Edit, EditError> {
    for id in [&link.from.node, &link.to.node] {
        node_mut(document, id)?;
    }
    let old = remove_where(&mut document.links, |_, other| other.to == link.to);
    let place = old.first().map_or(document.links.len(), |(place, _)| *place);
    document.links.insert(place, link.clone());
    let mut inverse = vec![Edit::RemoveLinksAt { places: vec![place] }];
    if !old.is_empty() {
        inverse.push(Edit::InsertLinks { links: old });
    }
    Ok(Edit::Many(inverse))
}

fn move_node(document: &mut Document, id: &str, position: Option<[f32; 2]>) -> Result<Edit, EditError> {
    node_mut(document, id)?;
    let old = match position {
        Some(position) => document.layout.insert(id.into(), position),
        None => document.layout.remove(id),
    };
    Ok(Edit::MoveNode { id: id.into(), position: old })
}

/// Takes out the items that match, with their places.
fn remove_where<T>(list: &mut Vec<T>, matches: impl Fn(usize, &T) -> bool) -> Vec<(usize, T)> {
    let mut removed = Vec::new();
    let mut kept = Vec::with_capacity(list.len());
    for (place, item) in std::mem::take(list).into_iter().enumerate() {
        if matches(place, &item) { removed.push((place, item)) } else { kept.push(item) }
    }
    *list = kept;
    removed
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
