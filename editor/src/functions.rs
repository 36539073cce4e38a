//! The WGSL functions of a document as a person handles them: made, renamed and removed, as edits, and where they are used. It
//! shows nothing, and what a function may be is decided by `halfvector_graph::library::custom`.

use halfvector_graph::check::Problem;
use halfvector_graph::document::{Document, Graph, Node, free_name, function_of, is_name};
use halfvector_graph::edit::Edit;

/// What a new function begins as, and the id that it has in its text.
const TEMPLATE: &str = include_str!("new_function.wgsl");
const TEMPLATE_ID: &str = "new_function";

/// A new function: its id, and the edit that adds it.
pub(crate) fn new(document: &Document) -> (String, Edit) {
    let id = free_name(TEMPLATE_ID, |id| document.functions.contains_key(id));
    let text = with_id(TEMPLATE, TEMPLATE_ID, &id);
    (id.clone(), Edit::SetFunction { id, text: Some(text) })
}

/// The edit that gives a function another id, in its text and in all nodes that it is.
///
/// # Errors
/// Why it cannot be called that.
pub(crate) fn renamed(document: &Document, from: &str, to: &str) -> Result<Edit, String> {
    let text = document.functions.get(from).ok_or_else(|| format!("there is no function “{from}”"))?;
    if !is_name(to) || to.bytes().any(|b| b.is_ascii_uppercase()) {
        return Err(format!("“{to}” is no name of a function: small letters, digits and _, first a letter"));
    }
    if document.functions.contains_key(to) {
        return Err(format!("there is a function “{to}” already; choose another name"));
    }
    let mut edits = vec![
        Edit::SetFunction { id: from.to_owned(), text: None },
        Edit::SetFunction { id: to.to_owned(), text: Some(with_id(text, from, to)) },
    ];
    for (group, graph) in graphs(document) {
        let theirs = graph.nodes.iter().filter(|(_, node)| function_of(&node.node) == Some(from));
        let changed: Vec<Edit> = theirs
            .flat_map(|(id, node)| {
                let node = Node { node: format!("custom/{to}"), ..node.clone() };
                [Edit::TakeNode { id: id.clone() }, Edit::AddNode { id: id.clone(), node }]
            })
            .collect();
        match group {
            _ if changed.is_empty() => {}
            Some(group) => {
                edits.push(Edit::In { group: group.to_owned(), edit: Box::new(Edit::Many(changed)) });
            }
            None => edits.extend(changed),
        }
    }
    Ok(Edit::Many(edits))
}

/// The edit that removes a function.
///
/// # Errors
/// It is in use.
pub(crate) fn removed(document: &Document, id: &str) -> Result<Edit, String> {
    match uses(document, id) {
        0 => Ok(Edit::SetFunction { id: id.to_owned(), text: None }),
        1 => Err("A node uses it: delete that first".to_owned()),
        count => Err(format!("{count} nodes use it: delete them first")),
    }
}

/// How many nodes are this function, those in groups too.
pub(crate) fn uses(document: &Document, id: &str) -> usize {
    let nodes = graphs(document).flat_map(|(_, graph)| graph.nodes.values());
    nodes.filter(|node| function_of(&node.node) == Some(id)).count()
}

/// The function that a problem of the document is about.
pub(crate) fn of_problem<'d>(document: &'d Document, problem: &Problem) -> Option<&'d str> {
    let is_of = |id: &&String| problem.message.starts_with(&format!("the function `{id}`,"));
    document.functions.keys().find(is_of).filter(|_| problem.node.is_none()).map(String::as_str)
}

/// The top level and the groups' insides.
fn graphs(document: &Document) -> impl Iterator<Item = (Option<&str>, &Graph)> {
    let groups = document.groups.iter().map(|(id, group)| (Some(id.as_str()), &group.graph));
    std::iter::once((None, &document.graph)).chain(groups)
}

/// A text whose comment names the node by another id. A text that does not name it stays as it is.
fn with_id(text: &str, from: &str, to: &str) -> String {
    let old = format!("custom/{from}");
    let renamed = text.split_inclusive('\n').map(|line| {
        let words = line.trim_start().strip_prefix("///").map(str::trim_start);
        let id = words.and_then(|words| words.strip_prefix("@node")).map(str::trim_start);
        let is_it = id.and_then(|id| id.split_whitespace().next()) == Some(old.as_str());
        if is_it { line.replacen(&old, &format!("custom/{to}"), 1) } else { line.to_owned() }
    });
    renamed.collect()
}
