//! Groups with all that they need, out of one document and into another.

use std::collections::{BTreeMap, BTreeSet};

use super::{Refusal, refuse};
use crate::document::{Document, Group, Node, free_name, function_of, group_of, is_group_id};
use crate::edit::Edit;
use crate::file::GroupFile;

/// What nodes of a document need of it.
#[derive(Debug, Default)]
pub(super) struct Needed {
    pub(super) groups: BTreeMap<String, Group>,
    pub(super) functions: BTreeMap<String, String>,
}

/// The groups and functions of a document that nodes need, directly or not, as far as it has them.
pub(super) fn needed<'n>(document: &Document, nodes: impl Iterator<Item = &'n Node>) -> Needed {
    let mut needed = Needed::default();
    let mut open: Vec<&str> = nodes.map(|node| node.node.as_str()).collect();
    while let Some(kind) = open.pop() {
        if let Some((id, text)) = function_of(kind).and_then(|id| document.functions.get_key_value(id)) {
            needed.functions.insert(id.clone(), text.clone());
        }
        if let Some((id, group)) = group_of(kind).and_then(|id| document.groups.get_key_value(id))
            && !needed.groups.contains_key(id)
        {
            needed.groups.insert(id.clone(), group.clone());
            open.extend(group.graph.nodes.values().map(|node| node.node.as_str()));
        }
    }
    needed
}

/// A group of a document, with all that it holds.
///
/// # Errors
/// There is no such group, or something that it holds is missing.
pub fn export_group(document: &Document, id: &str) -> Result<GroupFile, Refusal> {
    let Needed { groups, functions } = needed(document, [Node::new(&format!("group/{id}"))].iter());
    if !groups.contains_key(id) {
        return refuse(format!("there is no group `{id}` in this document"));
    }
    let file = GroupFile { group: id.into(), groups, functions };
    complete(&file.groups, &file.functions)?;
    Ok(file)
}

/// Refuses groups that hold what is not among them.
fn complete(groups: &BTreeMap<String, Group>, functions: &BTreeMap<String, String>) -> Result<(), Refusal> {
    for (id, group) in groups {
        for node in group.graph.nodes.values() {
            let lacks_group = group_of(&node.node).is_some_and(|held| !groups.contains_key(held));
            let lacks_function = function_of(&node.node).is_some_and(|held| !functions.contains_key(held));
            if lacks_group || lacks_function {
                return refuse(format!("the group `{id}` holds `{}`, which is missing", node.node));
            }
        }
    }
    Ok(())
}

/// A document with one node, which is a file's group: what [`super::paste`] puts into another document, with all that the group needs.
///
/// # Errors
/// The file lacks a group or a function that it needs.
pub fn group_as_copied(file: GroupFile) -> Result<Document, Refusal> {
    let GroupFile { group, groups, functions } = file;
    complete(&groups, &functions)?;
    if !groups.contains_key(&group) {
        return refuse(format!("the file is about the group `{group}` and does not have it"));
    }
    let mut copied = Document::new("");
    copied.graph.nodes.insert(group.clone(), Node::new(&format!("group/{group}")));
    copied.graph.layout.insert(group, [0.0; 2]);
    (copied.groups, copied.functions) = (groups, functions);
    Ok(copied)
}

/// Ids in a document of what was brought into it, by the old ones.
#[derive(Debug, Default)]
pub(super) struct Names {
    groups: BTreeMap<String, String>,
    functions: BTreeMap<String, String>,
}

impl Names {
    /// A definition's id with the new name in it.
    pub(super) fn definition(&self, old: &str) -> String {
        let group = group_of(old).and_then(|id| self.groups.get(id)).map(|id| format!("group/{id}"));
        let function = || function_of(old).and_then(|id| self.functions.get(id)).map(|id| format!("custom/{id}"));
        group.or_else(function).unwrap_or_else(|| old.to_string())
    }
}

/// The edits that bring groups and functions into a document, and the ids that they have there.
pub(super) fn import(
    document: &Document,
    groups: &BTreeMap<String, Group>,
    functions: &BTreeMap<String, String>,
) -> (Vec<Edit>, Names) {
    let mut names = Names::default();
    let mut edits = Vec::new();
    let mut taken: BTreeSet<String> = document.functions.keys().cloned().collect();
    for (id, text) in functions {
        if document.functions.get(id) == Some(text) {
            names.functions.insert(id.clone(), id.clone());
            continue;
        }
        let new = free_name(id, |id| taken.contains(id));
        taken.insert(new.clone());
        let text = text.replace(&format!("@node custom/{id}"), &format!("@node custom/{new}"));
        edits.push(Edit::SetFunction { id: new.clone(), text: Some(text) });
        names.functions.insert(id.clone(), new);
    }
    let is_renamed = |id: &str| names.functions.get(id).is_some_and(|new| new != id);
    // A group whose parts get other ids is another group: what is the same is the same with all that it holds.
    let mut new: BTreeSet<&str> = groups
        .iter()
        .filter(|(id, group)| {
            let mut kinds = group.graph.nodes.values().filter_map(|node| function_of(&node.node));
            document.groups.get(*id) != Some(*group) || kinds.any(is_renamed)
        })
        .map(|(id, _)| id.as_str())
        .collect();
    loop {
        let holds_new = |group: &Group| held(group).any(|id| new.contains(id));
        let old = groups.iter().filter(|(id, _)| !new.contains(id.as_str()));
        let more: Vec<&str> = old.filter(|(_, group)| holds_new(group)).map(|(id, _)| id.as_str()).collect();
        if more.is_empty() {
            break;
        }
        new.extend(more);
    }
    let mut taken: BTreeSet<String> = document.groups.keys().cloned().collect();
    for id in groups.keys() {
        let is_kept = !new.contains(id.as_str()) || (!taken.contains(id) && is_group_id(id));
        let other = if is_kept { id.clone() } else { free_name(id, |id| taken.contains(id) || !is_group_id(id)) };
        taken.insert(other.clone());
        names.groups.insert(id.clone(), other);
    }
    for (id, group) in groups.iter().filter(|(id, _)| new.contains(id.as_str())) {
        let mut group = group.clone();
        for node in group.graph.nodes.values_mut() {
            node.node = names.definition(&node.node);
        }
        edits.push(Edit::AddGroup { id: names.groups[id].clone(), group: Box::new(group) });
    }
    (edits, names)
}

/// The groups that a group's inside uses.
pub(super) fn held(group: &Group) -> impl Iterator<Item = &str> {
    group.graph.nodes.values().filter_map(|node| group_of(&node.node))
}
