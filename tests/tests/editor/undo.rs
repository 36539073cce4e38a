//! Undo gives back the first document to the byte, whatever was done: any edits, good or refused, joined or not, with undo and
//! redo in between.

use std::cell::RefCell;

use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_graph::document::{Comment, Document, Frame, Link, Node, Parameter, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::{from_json, to_json};
use halfvector_graph::value::Value;
use proptest::prelude::*;

/// What a test does in one step.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a list of some dozens")]
enum Step {
    Act(Action),
    Undo,
    Redo,
}

/// Ids that are there, that may come, and one that never is.
fn node() -> impl Strategy<Value = String> {
    prop::sample::select(vec!["chips", "grain", "rust", "surface", "mix", "mix_2", "nobody"]).prop_map(str::to_owned)
}

fn socket() -> impl Strategy<Value = SocketRef> {
    let name = prop::sample::select(vec!["out", "t", "a", "base_color", "scale"]);
    (node(), name).prop_map(|(node, name)| SocketRef::new(&node, name))
}

fn link() -> impl Strategy<Value = Link> {
    (socket(), socket()).prop_map(|(from, to)| Link::new(from, to))
}

fn value() -> impl Strategy<Value = Value> {
    prop_oneof![
        (-10.0f32..10.0).prop_map(Value::Number),
        any::<bool>().prop_map(Value::Bool),
        prop::array::uniform3(0.0f32..1.0).prop_map(Value::Vec3),
    ]
}

fn edit() -> impl Strategy<Value = Edit> {
    let plain = prop_oneof![
        node().prop_map(|id| Edit::AddNode { id, node: Node::new("math/mix") }),
        node().prop_map(|id| Edit::RemoveNode { id }),
        (node(), node()).prop_map(|(id, to)| Edit::RenameNode { id, to }),
        (socket(), prop::option::of(value())).prop_map(|(socket, value)| Edit::SetValue { socket, value }),
        (node(), prop::option::of("[a-z ]{0,6}")).prop_map(|(id, label)| Edit::SetLabel { id, label }),
        link().prop_map(|link| Edit::AddLink { link }),
        link().prop_map(|link| Edit::RemoveLink { link }),
        (socket(), "[a-z]{1,4}").prop_map(|(socket, name)| Edit::AddParameter {
            place: None,
            parameter: Parameter { name, label: None, socket, range: None },
        }),
        (0usize..4).prop_map(|place| Edit::RemoveParameter { place }),
        (node(), prop::option::of(prop::array::uniform2(-500.0f32..500.0)))
            .prop_map(|(id, position)| Edit::MoveNode { id, position }),
        "[a-z]{0,5}".prop_map(|name| Edit::SetName { name }),
        "[ab]".prop_map(|id| Edit::AddFrame { id, frame: Frame::default() }),
        "[ab]".prop_map(|id| Edit::RemoveFrame { id }),
        "[ab]".prop_map(|id| Edit::AddComment { id, comment: Comment::default() }),
        ("[ab]", "[a-z]{0,5}")
            .prop_map(|(id, text)| Edit::SetComment { id, comment: Comment { text, ..Comment::default() } }),
    ];
    plain.prop_recursive(2, 12, 4, |inner| prop::collection::vec(inner, 0..4).prop_map(Edit::Many))
}

fn step() -> impl Strategy<Value = Step> {
    let key = prop::option::of(prop::sample::select(vec!["one", "two"]));
    let made = (edit(), key).prop_map(|(edit, key)| Action::Edit {
        name: "A step".into(),
        edit,
        merge: key.map(str::to_owned),
    });
    prop_oneof![
        8 => made.prop_map(Step::Act),
        1 => Just(Step::Act(Action::EndMerge)),
        1 => prop::collection::vec(node(), 0..3).prop_map(|nodes| Step::Act(Action::Select(nodes))),
        2 => Just(Step::Undo),
        1 => Just(Step::Redo),
    ]
}

fn document(editor: &Editor) -> &Document {
    editor.session().document()
}

#[test]
fn any_edits_and_all_undos_give_the_first_document() {
    let context = egui::Context::default();
    let editor = RefCell::new(Editor::new(&context, Options::default()));
    let mut runner = proptest::test_runner::TestRunner::default();
    let outcome = runner.run(&prop::collection::vec(step(), 1..40), |steps| {
        let mut editor = editor.borrow_mut();
        // What is left to be done again of the case before is fine: it stands above the first document, too.
        let first = to_json(document(&editor));
        for step in steps {
            match step {
                Step::Act(action) => editor.act(action),
                Step::Undo => editor.act(Action::Undo),
                Step::Redo => editor.act(Action::Redo),
            }
        }
        let last = to_json(document(&editor));
        let mut count = 0;
        while editor.session().steps()[0].is_some() {
            editor.act(Action::Undo);
            count += 1;
            prop_assert!(count < 100, "undo does not end");
        }
        prop_assert_eq!(to_json(document(&editor)), first.clone());
        prop_assert!(editor.session().selection().iter().all(|id| document(&editor).graph.nodes.contains_key(id)));
        // Not those that were taken back before.
        for _ in 0..count {
            editor.act(Action::Redo);
        }
        prop_assert_eq!(to_json(document(&editor)), last.clone());
        // What is written is what is read.
        prop_assert_eq!(from_json(&last).map(|document| to_json(&document)).ok(), Some(last));
        while editor.session().steps()[0].is_some() {
            editor.act(Action::Undo);
        }
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}
