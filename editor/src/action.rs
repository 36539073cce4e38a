//! What a person can do to the session: panes return these, and only [`crate::Session`] and the window carry them out.

use std::path::PathBuf;
use std::sync::Arc;

use halfvector_graph::document::{Document, NodeId, SocketRef};
use halfvector_graph::edit::Edit;

/// One thing that a person does.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Changes the document.
    Edit {
        /// What undo calls it, such as "Add Noise".
        name: String,
        /// The change.
        edit: Edit,
        /// Edits in a row with the same key are one step of undo: a number that is dragged. None for a step of its own.
        merge: Option<String>,
    },
    /// Ends a row of merged edits: the mouse button is up.
    EndMerge,
    /// Takes the last step back, and what was undone before it can be done again: a drag that was given up.
    TakeBack,
    /// Takes the last step back.
    Undo,
    /// Does the last step that was taken back again.
    Redo,
    /// Replaces the selection.
    Select(Vec<NodeId>),
    /// Selects a node and brings it into view.
    Show(NodeId),
    /// Goes to the graph that a node stands in, the top level's or a group's, selects it and brings it into view.
    Find {
        /// None for the top level.
        group: Option<String>,
        /// In that graph.
        node: NodeId,
    },
    /// Goes into groups, the outermost first, or out of them.
    Enter(Vec<String>),
    /// Brings the text of a function of the document to the front.
    EditFunction(String),
    /// Replaces the document by a new one, after asking when it is not saved.
    New,
    /// Replaces the document by a new one that begins as this, after asking when it is not saved.
    NewFrom(Arc<Document>),
    /// Replaces the document by that of a file, after asking when it is not saved.
    Open(PathBuf),
    /// Writes the document to its file; asks where when it has none.
    Save,
    /// Writes the document to this file, which becomes its own.
    SaveAs(PathBuf),
    /// Writes a group of the document, with all that it needs, to a file.
    SaveGroup(String, PathBuf),
    /// Opens a file dialog.
    Choose(Choose),
    /// Tells something in the status line.
    Say(String),
}

/// What a file dialog is opened for.
#[derive(Clone, Debug, PartialEq)]
pub enum Choose {
    /// A material to open.
    Open,
    /// A file to write the document to.
    SaveAs,
    /// A picture for an input.
    Image(SocketRef),
    /// A group to add a node of.
    Group,
    /// A file to write a group to, by its id.
    SaveGroup(String),
    /// A folder to write the exported shader to.
    ExportFolder,
}

/// Shows the node that a shader calls by a path through groups.
pub(crate) fn found(document: &Document, path: &str) -> Option<Action> {
    let (group, node, _) = halfvector_graph::flatten::find(document, path)?;
    Some(Action::Find { group: group.map(str::to_owned), node: node.to_owned() })
}

impl Action {
    /// An edit that is a step of undo of its own.
    pub fn edit(name: impl Into<String>, edit: Edit) -> Action {
        Action::Edit { name: name.into(), edit, merge: None }
    }

    /// An edit that joins those before it with the same key.
    pub fn drag(name: impl Into<String>, edit: Edit, key: impl Into<String>) -> Action {
        Action::Edit { name: name.into(), edit, merge: Some(key.into()) }
    }
}
