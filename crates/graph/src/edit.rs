//! Changes of a document, each with its exact inverse: an editor's undo is the list of inverses.
//!
//! An edit looks at the document only: whether it makes sense is told by `check`, so that a half-made material can be worked
//! on. An edit that cannot be made changes nothing. Every edit keeps the order of everything that it does not touch, so that undoing
//! gives back the same file.

mod graph;

use std::collections::BTreeMap;

use crate::document::{
    Comment, Document, Frame, Group, Interface, Link, Node, NodeId, Parameter, SocketRef, SurfaceSettings,
};
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
    /// Adds a frame.
    AddFrame {
        /// Free.
        id: String,
        /// The frame.
        frame: Frame,
    },
    /// Removes a frame; the nodes in it stay.
    RemoveFrame {
        /// Which.
        id: String,
    },
    /// Changes title, colour or rectangle of a frame.
    SetFrame {
        /// Which.
        id: String,
        /// What it is from now on.
        frame: Frame,
    },
    /// Adds a comment.
    AddComment {
        /// Free.
        id: String,
        /// The comment.
        comment: Comment,
    },
    /// Removes a comment.
    RemoveComment {
        /// Which.
        id: String,
    },
    /// Changes text or rectangle of a comment.
    SetComment {
        /// Which.
        id: String,
        /// What it is from now on.
        comment: Comment,
    },
    /// Renames the material.
    SetName {
        /// For people.
        name: String,
    },
    /// Adds a group. Nodes that name it already become its own.
    AddGroup {
        /// Free.
        id: String,
        /// The group.
        group: Box<Group>,
    },
    /// Removes a group; nodes that name it stay, and are reported by `check`.
    RemoveGroup {
        /// Which.
        id: String,
    },
    /// Changes label, help, inputs or outputs of a group. Links are left as they are.
    SetInterface {
        /// Which group.
        group: String,
        /// From now on.
        interface: Interface,
    },
    /// Adds, changes or removes a WGSL function.
    SetFunction {
        /// Which.
        id: String,
        /// Its text; none to remove it.
        text: Option<String>,
    },
    /// An edit of a group's inside: of its nodes, links and view.
    In {
        /// Which group.
        group: String,
        /// Any edit of a graph, or several.
        edit: Box<Edit>,
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
    /// The group does not exist.
    #[error("there is no group `{0}`; was it removed?")]
    NoGroup(String),
    /// The frame or comment does not exist.
    #[error("there is no frame or comment `{0}`; was it removed?")]
    NoNote(String),
    /// The edit is none of a group's inside.
    #[error("a group has no {0} of its own; they belong to the whole material")]
    OfDocument(&'static str),
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
    // Nested edits are worked off from a list, so that no nesting is too deep. With each goes the group that it is in.
    let mut inverses = Vec::new();
    let mut waiting: Vec<(Option<&str>, &Edit)> = vec![(None, edit)];
    while let Some((group, edit)) = waiting.pop() {
        let done = match (group, edit) {
            (group, Edit::Many(edits)) => {
                waiting.extend(edits.iter().rev().map(|edit| (group, edit)));
                continue;
            }
            (None, Edit::In { group, edit }) => {
                waiting.push((Some(group), edit));
                continue;
            }
            (None, edit) => of_document(document, edit),
            (Some(id), edit) => in_group(document, id, edit),
        };
        match done {
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

fn of_document(document: &mut Document, edit: &Edit) -> Result<Edit, EditError> {
    match edit {
        Edit::RemoveNode { id } => remove_node(document, id),
        Edit::RenameNode { id, to } => rename_node(document, id, to),
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
        Edit::SetName { name } => Ok(Edit::SetName { name: std::mem::replace(&mut document.name, name.clone()) }),
        Edit::AddGroup { id, group } => {
            add(&mut document.groups, id, group.as_ref())?;
            Ok(Edit::RemoveGroup { id: id.clone() })
        }
        Edit::RemoveGroup { id } => match document.groups.remove(id) {
            Some(group) => Ok(Edit::AddGroup { id: id.clone(), group: Box::new(group) }),
            None => Err(EditError::NoGroup(id.clone())),
        },
        Edit::SetInterface { group: id, interface } => {
            let group = document.groups.get_mut(id).ok_or_else(|| EditError::NoGroup(id.clone()))?;
            let old = std::mem::replace(&mut group.interface, interface.clone());
            Ok(Edit::SetInterface { group: id.clone(), interface: old })
        }
        Edit::SetFunction { id, text } => {
            let old = match text {
                Some(text) => document.functions.insert(id.clone(), text.clone()),
                None => document.functions.remove(id),
            };
            Ok(Edit::SetFunction { id: id.clone(), text: old })
        }
        Edit::In { .. } | Edit::Many(_) => apply(document, edit),
        edit => graph::apply(&mut document.graph, edit),
    }
}

fn in_group(document: &mut Document, id: &str, edit: &Edit) -> Result<Edit, EditError> {
    let group = document.groups.get_mut(id).ok_or_else(|| EditError::NoGroup(id.into()))?;
    let inverse = graph::apply(&mut group.graph, edit)?;
    Ok(Edit::In { group: id.into(), edit: Box::new(inverse) })
}

fn parameter_mut(document: &mut Document, place: usize) -> Result<&mut Parameter, EditError> {
    let length = document.parameters.len();
    document.parameters.get_mut(place).ok_or(EditError::NoPlace { place, length })
}

/// Puts something under a free id.
fn add<T: Clone>(map: &mut BTreeMap<String, T>, id: &str, item: &T) -> Result<(), EditError> {
    if map.contains_key(id) {
        return Err(EditError::Taken(id.into()));
    }
    map.insert(id.into(), item.clone());
    Ok(())
}

/// Removes a node of the top level, and the parameters that it gave.
fn remove_node(document: &mut Document, id: &str) -> Result<Edit, EditError> {
    let mut inverse = parts(graph::apply(&mut document.graph, &Edit::RemoveNode { id: id.into() })?);
    let parameters = remove_where(&mut document.parameters, |_, parameter| parameter.socket.node == id);
    inverse
        .extend(parameters.into_iter().map(|(place, parameter)| Edit::AddParameter { place: Some(place), parameter }));
    Ok(Edit::Many(inverse))
}

/// Renames a node of the top level, in the parameters too.
fn rename_node(document: &mut Document, id: &str, to: &str) -> Result<Edit, EditError> {
    if document.graph.nodes.contains_key(id) && document.parameters.iter().any(|p| p.socket.node == to) {
        return Err(EditError::Taken(to.into()));
    }
    let inverse = graph::apply(&mut document.graph, &Edit::RenameNode { id: id.into(), to: to.into() })?;
    let sockets = document.parameters.iter_mut().map(|parameter| &mut parameter.socket);
    sockets.filter(|socket| socket.node == id).for_each(|socket| socket.node = to.into());
    Ok(inverse)
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
