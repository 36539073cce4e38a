//! Edits and their inverses.

use proptest::prelude::*;

use super::*;
use crate::edit::{Edit, EditError, apply};
use crate::file::to_json;

fn any_edit() -> impl Strategy<Value = Edit> {
    let single = prop_oneof![
        (any_id(), any_node()).prop_map(|(id, node)| Edit::AddNode { id, node }),
        any_id().prop_map(|id| Edit::RemoveNode { id }),
        any_id().prop_map(|id| Edit::TakeNode { id }),
        (any_id(), any_id()).prop_map(|(id, to)| Edit::RenameNode { id, to }),
        (any_socket(), prop::option::of(any_value())).prop_map(|(socket, value)| Edit::SetValue { socket, value }),
        (any_id(), prop::option::of(".{0,3}")).prop_map(|(id, label)| Edit::SetLabel { id, label }),
        any_link().prop_map(|link| Edit::AddLink { link }),
        any_link().prop_map(|link| Edit::RemoveLink { link }),
        (0..3usize, any_link(), any_link())
            .prop_map(|(place, a, b)| Edit::InsertLinks { links: vec![(place, a), (place + 1, b)] }),
        (0..3usize).prop_map(|place| Edit::RemoveLinksAt { places: vec![place, place + 2] }),
        (prop::option::of(0..4usize), any_parameter())
            .prop_map(|(place, parameter)| Edit::AddParameter { place, parameter }),
        (0..3usize).prop_map(|place| Edit::RemoveParameter { place }),
        (0..3usize, any_parameter()).prop_map(|(place, parameter)| Edit::SetParameter { place, parameter }),
        any_settings().prop_map(|surface| Edit::SetSurface { surface }),
        (any_id(), prop::option::of([any_number(), any_number()]))
            .prop_map(|(id, position)| Edit::MoveNode { id, position }),
        ".{0,3}".prop_map(|name| Edit::SetName { name }),
    ]
    .boxed();
    let of_view = prop_oneof![
        ("[ab]", any_frame()).prop_map(|(id, frame)| Edit::AddFrame { id, frame }),
        "[ab]".prop_map(|id| Edit::RemoveFrame { id }),
        ("[ab]", any_frame()).prop_map(|(id, frame)| Edit::SetFrame { id, frame }),
        ("[ab]", any_comment()).prop_map(|(id, comment)| Edit::AddComment { id, comment }),
        "[ab]".prop_map(|id| Edit::RemoveComment { id }),
        ("[ab]", any_comment()).prop_map(|(id, comment)| Edit::SetComment { id, comment }),
    ];
    let of_groups = prop_oneof![
        ("[gh]", any_group()).prop_map(|(id, group)| Edit::AddGroup { id, group: Box::new(group) }),
        "[gh]".prop_map(|id| Edit::RemoveGroup { id }),
        ("[st]", prop::option::of(".{0,3}|a\nb")).prop_map(|(id, text)| Edit::SetFunction { id, text }),
        ("[gh]", any_interface()).prop_map(|(group, interface)| Edit::SetInterface { group, interface }),
    ];
    let any = prop_oneof![4 => single, 1 => of_view, 1 => of_groups];
    any.prop_recursive(3, 8, 3, |edit| {
        prop_oneof![
            prop::collection::vec(edit.clone(), 0..3).prop_map(Edit::Many),
            ("[gh]", edit).prop_map(|(group, edit)| Edit::In { group, edit: Box::new(edit) }),
        ]
    })
}

proptest! {
    /// Any edits, then all inverses: the same file; and an edit that fails leaves the document as it was.
    #[test]
    fn inverses_give_the_same_file_back(first in any_document(), edits in prop::collection::vec(any_edit(), 0..12)) {
        let before = to_json(&first);
        let mut document = first;
        let mut undo = Vec::new();
        for edit in &edits {
            let state = to_json(&document);
            match apply(&mut document, edit) {
                Ok(inverse) => undo.push((inverse, state)),
                Err(_) => prop_assert_eq!(to_json(&document), state),
            }
        }
        while let Some((inverse, state)) = undo.pop() {
            let after = to_json(&document);
            let redo = apply(&mut document, &inverse).expect("an inverse can be made");
            prop_assert_eq!(to_json(&document), state);
            // An inverse has an exact inverse itself.
            let again = apply(&mut document, &redo).expect("a redo can be made");
            prop_assert_eq!(to_json(&document), after);
            apply(&mut document, &again).expect("and be undone");
        }
        prop_assert_eq!(to_json(&document), before);
    }
}

#[test]
fn removing_a_node_takes_what_hangs_on_it() {
    let mut d = document(
        &[("m", "math/mix"), ("n", "math/mix")],
        &[("m.out", "n.a"), ("n.out", "surface.height"), ("m.out", "n.b")],
    );
    d.parameters.push(Parameter { name: "t".into(), label: None, socket: socket("m.t"), range: None });
    d.graph.layout.insert("m".into(), [1.0, 2.0]);
    let before = d.clone();
    let inverse = apply(&mut d, &Edit::RemoveNode { id: "m".into() }).expect("an edit");
    assert_eq!(d.graph.links, [link("n.out", "surface.height")]);
    assert!(d.parameters.is_empty() && d.graph.layout.is_empty() && !d.graph.nodes.contains_key("m"));
    apply(&mut d, &inverse).expect("an inverse");
    assert_eq!(d, before);
}

#[test]
fn a_new_link_takes_the_place_of_the_old_one() {
    let mut d = document(&[("m", "math/mix"), ("n", "math/mix")], &[("m.out", "surface.height"), ("n.out", "m.a")]);
    let inverse = apply(&mut d, &Edit::AddLink { link: link("n.out", "surface.height") }).expect("an edit");
    assert_eq!(d.graph.links, [link("n.out", "surface.height"), link("n.out", "m.a")]);
    apply(&mut d, &inverse).expect("an inverse");
    assert_eq!(d.graph.links[0], link("m.out", "surface.height"));
    let refused = apply(&mut d, &Edit::AddLink { link: link("gone.out", "surface.height") });
    assert_eq!(refused, Err(EditError::NoNode("gone".into())));
}

#[test]
fn renaming_carries_links_parameters_and_position() {
    let mut d = document(&[("m", "math/mix")], &[("m.out", "surface.height")]);
    d.parameters.push(Parameter { name: "t".into(), label: None, socket: socket("m.t"), range: None });
    d.graph.layout.insert("m".into(), [1.0, 2.0]);
    let rename = |id: &str, to: &str| Edit::RenameNode { id: id.into(), to: to.into() };
    apply(&mut d, &rename("m", "blend")).expect("an edit");
    assert_eq!((d.graph.links[0].from.node.as_str(), d.parameters[0].socket.node.as_str()), ("blend", "blend"));
    assert!(d.graph.layout.contains_key("blend"));
    assert_eq!(apply(&mut d, &rename("blend", "surface")), Err(EditError::Taken("surface".into())));
}

#[test]
fn a_group_is_edited_like_the_top_level() {
    let mut d = document(&[("a", "group/band"), ("b", "group/band")], &[]);
    let inside = |edit| Edit::In { group: "band".into(), edit: Box::new(edit) };
    let add = Edit::AddGroup { id: "band".into(), group: Box::new(Group::new("Band")) };
    apply(&mut d, &add).expect("a group");
    let before = to_json(&d);
    let edits = Edit::Many(vec![
        Edit::AddNode { id: "m".into(), node: Node::new("math/mix") },
        Edit::MoveNode { id: "m".into(), position: Some([1.0, 2.0]) },
        Edit::AddLink { link: link("m.out", "output.out") },
        Edit::AddFrame { id: "f".into(), frame: Frame::default() },
    ]);
    let undo = apply(&mut d, &inside(edits)).expect("edits of its inside");
    assert_eq!((d.groups["band"].graph.nodes.len(), d.graph.nodes.len()), (2, 3));
    let settings = inside(Edit::SetName { name: "x".into() });
    assert_eq!(apply(&mut d, &settings), Err(EditError::OfDocument("name of the material")));
    let other = Edit::In { group: "gone".into(), edit: Box::new(Edit::RemoveNode { id: "m".into() }) };
    assert_eq!(apply(&mut d, &other), Err(EditError::NoGroup("gone".into())));
    apply(&mut d, &undo).expect("an inverse");
    assert_eq!(to_json(&d), before);
}
