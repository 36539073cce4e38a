//! Undo and redo: two lists of named steps, each holding the edit that takes it back. It changes no document by itself.

use halfvector_graph::document::Document;
use halfvector_graph::edit::{Edit, EditError, apply};
use halfvector_graph::value::Value;

/// What was done, and how to take it back.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// The key of the last step, while more may join it.
    merge: Option<String>,
}

#[derive(Clone, Debug)]
struct Step {
    name: String,
    /// Of a step that was done the edit that takes it back; of one that was taken back the edit that does it again.
    inverse: Edit,
}

impl History {
    /// Makes an edit and remembers how to take it back. With the key of the step before it becomes part of that step.
    pub(crate) fn make(
        &mut self,
        document: &mut Document,
        name: String,
        edit: &Edit,
        merge: Option<String>,
    ) -> Result<(), EditError> {
        let inverse = apply(document, edit)?;
        self.undone.clear();
        match self.done.last_mut() {
            Some(step) if merge.is_some() && self.merge == merge => {
                let before = std::mem::replace(&mut step.inverse, Edit::Many(Vec::new()));
                step.inverse = joined(inverse, before);
            }
            _ => self.done.push(Step { name, inverse }),
        }
        self.merge = merge;
        Ok(())
    }

    /// What comes next is a new step.
    pub(crate) fn end_merge(&mut self) {
        self.merge = None;
    }

    /// Takes the last step back and returns its name; `None` when there is none.
    pub(crate) fn undo(&mut self, document: &mut Document) -> Result<Option<String>, EditError> {
        self.merge = None;
        step(&mut self.done, &mut self.undone, document)
    }

    /// Does again what was taken back last and returns its name; `None` when there is nothing.
    pub(crate) fn redo(&mut self, document: &mut Document) -> Result<Option<String>, EditError> {
        self.merge = None;
        step(&mut self.undone, &mut self.done, document)
    }

    /// Changes values in all that may come back by undo or redo.
    pub(crate) fn for_each_value(&mut self, change: &mut dyn FnMut(&mut Value)) {
        for step in self.done.iter_mut().chain(&mut self.undone) {
            values_of(&mut step.inverse, change);
        }
    }

    /// The name of the step that undo would take back.
    pub(crate) fn undo_name(&self) -> Option<&str> {
        self.done.last().map(|step| step.name.as_str())
    }

    /// The name of the step that redo would do.
    pub(crate) fn redo_name(&self) -> Option<&str> {
        self.undone.last().map(|step| step.name.as_str())
    }
}

fn step(from: &mut Vec<Step>, to: &mut Vec<Step>, document: &mut Document) -> Result<Option<String>, EditError> {
    let Some(Step { name, inverse }) = from.pop() else { return Ok(None) };
    let inverse = apply(document, &inverse)?;
    to.push(Step { name: name.clone(), inverse });
    Ok(Some(name))
}

/// The inverse of two edits, the later one's first. Of what is set again and again only the first inverse is kept, so that a
/// long drag stays small.
fn joined(later: Edit, earlier: Edit) -> Edit {
    let same = match (&later, &earlier) {
        (Edit::SetValue { socket: a, .. }, Edit::SetValue { socket: b, .. }) => a == b,
        (Edit::MoveNode { id: a, .. }, Edit::MoveNode { id: b, .. })
        | (Edit::SetLabel { id: a, .. }, Edit::SetLabel { id: b, .. }) => a == b,
        (Edit::SetParameter { place: a, .. }, Edit::SetParameter { place: b, .. }) => a == b,
        (Edit::SetName { .. }, Edit::SetName { .. }) | (Edit::SetSurface { .. }, Edit::SetSurface { .. }) => true,
        _ => false,
    };
    if same { earlier } else { Edit::Many(vec![later, earlier]) }
}

fn values_of(edit: &mut Edit, change: &mut dyn FnMut(&mut Value)) {
    match edit {
        Edit::SetValue { value: Some(value), .. } => change(value),
        Edit::AddNode { node, .. } => node.values.values_mut().for_each(change),
        Edit::AddGroup { group, .. } => {
            group.graph.nodes.values_mut().flat_map(|node| node.values.values_mut()).for_each(change);
        }
        Edit::In { edit, .. } => values_of(edit, change),
        Edit::Many(edits) => edits.iter_mut().for_each(|edit| values_of(edit, change)),
        _ => {}
    }
}
