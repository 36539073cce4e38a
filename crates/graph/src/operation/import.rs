//! Groups as files of their own: a group with all that it needs, out of one document and into another.

use std::collections::{BTreeMap, BTreeSet};

use super::{Refusal, refuse};
use crate::document::{Document, Group, free_name, group_of, is_group_id};
use crate::edit::Edit;
use crate::file::GroupFile;

/// A group of a document, with all that it holds.
///
/// # Errors
/// There is no such group, or one that it holds is missing.
pub fn export_group(document: &Document, id: &str) -> Result<GroupFile, Refusal> {
    let mut groups = BTreeMap::new();
    let mut open = vec![id];
    while let Some(id) = open.pop() {
        let Some(group) = document.groups.get(id) else {
            return refuse(format!("there is no group `{id}` in this document"));
        };
        if groups.insert(id.to_string(), group.clone()).is_none() {
            open.extend(held(group));
        }
    }
    Ok(GroupFile { group: id.into(), groups })
}

/// The edit that brings a file's groups into a document, and the id that its group has there. Groups that the document has already are
/// taken for the same when they are the same; where another one has the id, the new one gets a free id.
///
/// # Errors
/// The file lacks a group that it needs.
pub fn import_group(document: &Document, file: &GroupFile) -> Result<(Edit, String), Refusal> {
    let (edits, mut ids) = import(document, &file.groups)?;
    match ids.remove(&file.group) {
        Some(id) => Ok((Edit::Many(edits), id)),
        None => refuse(format!("the file is about the group `{}` and does not have it", file.group)),
    }
}

/// The edits that bring groups into a document, and the ids that they have there.
pub(super) fn import(
    document: &Document,
    groups: &BTreeMap<String, Group>,
) -> Result<(Vec<Edit>, BTreeMap<String, String>), Refusal> {
    let mut taken: BTreeSet<String> = document.groups.keys().cloned().collect();
    let mut new: BTreeSet<&str> = groups
        .iter()
        .filter(|(id, group)| document.groups.get(*id) != Some(*group))
        .map(|(id, _)| id.as_str())
        .collect();
    // A group whose parts get other ids is another group: what is the same is the same with all that it holds.
    loop {
        let holds_new = |group: &Group| held(group).any(|id| new.contains(id));
        let old = groups.iter().filter(|(id, _)| !new.contains(id.as_str()));
        let more: Vec<&str> = old.filter(|(_, group)| holds_new(group)).map(|(id, _)| id.as_str()).collect();
        if more.is_empty() {
            break;
        }
        new.extend(more);
    }
    let mut ids: BTreeMap<String, String> = BTreeMap::new();
    for id in groups.keys() {
        let is_kept = !new.contains(id.as_str()) || (!taken.contains(id) && is_group_id(id));
        let other = if is_kept { id.clone() } else { free_name(id, |id| taken.contains(id) || !is_group_id(id)) };
        taken.insert(other.clone());
        ids.insert(id.clone(), other);
    }
    let mut edits = Vec::new();
    for (id, group) in groups.iter().filter(|(id, _)| new.contains(id.as_str())) {
        let mut group = group.clone();
        for node in group.graph.nodes.values_mut() {
            if let Some(held) = group_of(&node.node) {
                match ids.get(held) {
                    Some(held) => node.node = format!("group/{held}"),
                    None => return refuse(format!("the group `{id}` holds the group `{held}`, which is missing")),
                }
            }
        }
        edits.push(Edit::AddGroup { id: ids[id].clone(), group: Box::new(group) });
    }
    Ok((edits, ids))
}

/// The groups that a group's inside uses.
pub(super) fn held(group: &Group) -> impl Iterator<Item = &str> {
    group.graph.nodes.values().filter_map(|node| group_of(&node.node))
}
