//! Undo and redo: two lists of named steps, each holding the edit that takes it back. It changes no document by itself.

use halfvector_graph::document::Document;
use halfvector_graph::edit::{Edit, EditError, apply};
use halfvector_graph::value::Value;

/// What was done, and how to take it back.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// What could be done again before the last step.
    given_up: Vec<Step>,
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
        let undone = std::mem::take(&mut self.undone);
        match self.done.last_mut() {
            Some(step) if merge.is_some() && self.merge == merge => {
                let before = std::mem::replace(&mut step.inverse, Edit::Many(Vec::new()));
                step.inverse = joined(inverse, before);
            }
            _ => {
                self.done.push(Step { name, inverse });
                self.given_up = undone;
            }
        }
        self.merge = merge;
        Ok(())
    }

    /// Takes the last step back as if it had never been: what could be done again before it can be again. Of several in a row only the
    /// first finds that.
    pub(crate) fn take_back(&mut self, document: &mut Document) -> Result<(), EditError> {
        self.merge = None;
        if let Some(Step { inverse, .. }) = self.done.pop() {
            apply(document, &inverse)?;
            self.undone = std::mem::take(&mut self.given_up);
        }
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
        for step in self.done.iter_mut().chain(&mut self.undone).chain(&mut self.given_up) {
            values_of(&mut step.inverse, change);
        }
    }

    /// Of how many edits the last step is made; 0 when there is none.
    pub(crate) fn parts_of_undo(&self) -> usize {
        self.done.last().map_or(0, |step| listed(step.inverse.clone()).len())
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
/// long drag or a text that is written stays small.
fn joined(later: Edit, earlier: Edit) -> Edit {
    let mut parts = listed(earlier);
    let mut fresh: Vec<Edit> = listed(later);
    // What the earlier inverse sets anyway need not be set before. That holds while it does nothing but set: then no part of
    // it depends on another.
    if parts.iter().chain(&fresh).all(|edit| is_setting(None, edit)) {
        fresh.retain(|later| !parts.iter().any(|earlier| is_same(later, earlier)));
    }
    fresh.append(&mut parts);
    match <[Edit; 1]>::try_from(fresh) {
        Ok([only]) => only,
        Err(many) => Edit::Many(many),
    }
}

/// The edits of a list, those of lists in it too.
fn listed(edit: Edit) -> Vec<Edit> {
    let mut flat = Vec::new();
    let mut waiting = vec![edit];
    while let Some(edit) = waiting.pop() {
        match edit {
            Edit::Many(edits) => waiting.extend(edits.into_iter().rev()),
            Edit::In { group, edit } => match *edit {
                Edit::Many(edits) => {
                    let inside = |edit| Edit::In { group: group.clone(), edit: Box::new(edit) };
                    waiting.extend(edits.into_iter().rev().map(inside));
                }
                edit => flat.push(Edit::In { group, edit: Box::new(edit) }),
            },
            edit => flat.push(edit),
        }
    }
    flat
}

/// Whether an edit gives one thing another value, and changes nothing else. `group` is what it is in.
fn is_setting(group: Option<&str>, edit: &Edit) -> bool {
    match edit {
        Edit::In { group: inner, edit } => group.is_none() && is_setting(Some(inner), edit),
        Edit::SetValue { .. }
        | Edit::MoveNode { .. }
        | Edit::SetLabel { .. }
        | Edit::SetFrame { .. }
        | Edit::SetComment { .. }
        | Edit::SetParameter { .. }
        | Edit::SetName { .. }
        | Edit::SetSurface { .. }
        | Edit::SetInterface { .. }
        | Edit::SetFunction { .. } => true,
        _ => false,
    }
}

/// Whether two edits set the same thing.
fn is_same(a: &Edit, b: &Edit) -> bool {
    match (a, b) {
        (Edit::In { group: a, edit: of_a }, Edit::In { group: b, edit: of_b }) => a == b && is_same(of_a, of_b),
        (Edit::SetValue { socket: a, .. }, Edit::SetValue { socket: b, .. }) => a == b,
        (Edit::MoveNode { id: a, .. }, Edit::MoveNode { id: b, .. })
        | (Edit::SetLabel { id: a, .. }, Edit::SetLabel { id: b, .. })
        | (Edit::SetFrame { id: a, .. }, Edit::SetFrame { id: b, .. })
        | (Edit::SetComment { id: a, .. }, Edit::SetComment { id: b, .. })
        | (Edit::SetFunction { id: a, .. }, Edit::SetFunction { id: b, .. })
        | (Edit::SetInterface { group: a, .. }, Edit::SetInterface { group: b, .. }) => a == b,
        (Edit::SetParameter { place: a, .. }, Edit::SetParameter { place: b, .. }) => a == b,
        (Edit::SetName { .. }, Edit::SetName { .. }) | (Edit::SetSurface { .. }, Edit::SetSurface { .. }) => true,
        _ => false,
    }
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
