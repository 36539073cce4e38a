//! What an editor does in one step.

use proptest::prelude::*;

use super::{any_document, document, link, small, socket};
use crate::check::{Severity, check};
use crate::document::{Comment, Document, Frame, Group, GroupOutput, Node, Parameter, Rect};
use crate::edit::{Edit, apply};
use crate::file::{from_json, group_from_json, group_to_json, to_json};
use crate::operation::{
    GroupSide, Pasted, Pick, can_connect, collapse, copy, export_group, group_as_copied, insert_on_link, paste,
    remove_and_heal, rename_socket, ungroup,
};
use crate::value::{Type, Value};

/// Noise-like chain: c -> m -> n -> surface, m -> surface too.
fn chain() -> Document {
    let nodes = [("c", "vector/combine"), ("m", "math/mix"), ("n", "math/mix"), ("s", "vector/separate")];
    let mut d = document(
        &nodes,
        &[
            ("s.x", "c.x"),
            ("c.out", "m.a"),
            ("m.out", "n.a"),
            ("c.out", "n.b"),
            ("n.out", "surface.base_color"),
            ("m.out", "surface.normal"),
        ],
    );
    for (i, (id, _)) in nodes.iter().enumerate() {
        d.graph.layout.insert(id.to_string(), [100.0 * i as f32, 10.0]);
    }
    d.graph.nodes.get_mut("m").expect("m").values.insert("t".into(), Value::Number(0.25));
    d.parameters.push(Parameter { name: "weight".into(), label: None, socket: socket("m.t"), range: None });
    d
}

fn ids(ids: &[&str]) -> Vec<String> {
    ids.iter().map(|id| id.to_string()).collect()
}

/// Makes the edit, checks the document, and that undoing gives the same file.
#[track_caller]
fn made(d: &Document, edit: &Edit) -> Document {
    let mut after = d.clone();
    let undo = apply(&mut after, edit).expect("an edit that can be made");
    let mut back = after.clone();
    apply(&mut back, &undo).expect("an inverse");
    assert_eq!(to_json(&back), to_json(d));
    let errors =
        |d: &Document| check(d, small()).into_iter().filter(|p| p.severity == Severity::Error).collect::<Vec<_>>();
    assert!(errors(&after).len() <= errors(d).len(), "{:#?}\n{}", errors(&after), to_json(&after));
    after
}

#[test]
fn a_selection_becomes_a_group_with_its_wires() {
    let d = chain();
    let edit = collapse(&d, small(), None, &ids(&["m", "n"]), "Two mixes").expect("a group");
    let after = made(&d, &edit);
    let group = &after.groups["two_mixes"];
    let names =
        |names: &mut dyn Iterator<Item = (&str, String)>| names.map(|(n, t)| format!("{n}: {t}")).collect::<Vec<_>>();
    let inputs = names(&mut group.interface.inputs.iter().map(|i| (i.name.as_str(), format!("{:?}", i.ty))));
    assert_eq!(inputs, ["a: Value(Vec3)", "weight: Value(F32)"], "one wire twice is one input");
    let outputs = names(&mut group.interface.outputs.iter().map(|o| (o.name.as_str(), format!("{:?}", o.ty))));
    assert_eq!(outputs, ["out: Vec3", "out_2: Vec3"]);
    assert_eq!(after.parameters[0].socket, socket("two_mixes.weight"), "the parameter goes along");
    assert_eq!(after.graph.nodes["two_mixes"].values["weight"], Value::Number(0.25));
    assert_eq!(after.graph.links.len(), 4);
    assert_eq!(after.graph.incoming(&socket("surface.base_color")), Some(&socket("two_mixes.out")));
    assert_eq!(after.graph.layout["two_mixes"], [150.0, 10.0]);
    assert_eq!(group.graph.layout["inputs"], [100.0 - 240.0, 10.0]);
    // And back again.
    let back = made(&after, &ungroup(&after, small(), None, "two_mixes").expect("its nodes"));
    assert_eq!(back.graph.nodes, d.graph.nodes);
    assert_eq!(back.parameters, d.parameters);
    let sorted = |d: &Document| {
        let mut links = d.graph.links.clone();
        links.sort();
        links
    };
    assert_eq!(sorted(&back), sorted(&d));
}

#[test]
fn what_cannot_become_a_group_says_why() {
    let d = chain();
    let why = |nodes: &[&str]| collapse(&d, small(), None, &ids(nodes), "x").expect_err("a refusal").to_string();
    assert!(why(&["c", "n"]).contains("\u{201c}Mix\u{201d} lies between selected nodes"), "{}", why(&["c", "n"]));
    assert!(why(&["m", "surface"]).contains("the surface is the end"));
    assert!(why(&["gone"]).contains("no node is selected"));
    assert!(ungroup(&d, small(), None, "m").is_err());
}

#[test]
fn groups_in_groups_and_inside_of_groups() {
    let d = chain();
    let d = made(&d, &collapse(&d, small(), None, &ids(&["c", "m", "n"]), "All").expect("a group"));
    let d = made(&d, &collapse(&d, small(), Some("all"), &ids(&["m", "n"]), "Some").expect("a group in it"));
    assert_eq!(d.groups["all"].graph.nodes["some"].node, "group/some");
    let sockets = collapse(&d, small(), Some("all"), &ids(&["inputs", "c"]), "x").expect_err("a refusal");
    assert!(sockets.to_string().contains("the sockets of a group stay"));
    let d = made(&d, &ungroup(&d, small(), Some("all"), "some").expect("taken apart"));
    assert!(d.groups["all"].graph.nodes.contains_key("n"));
}

/// A group that changes a type on the way cannot be taken apart without saying so.
#[test]
fn taking_apart_never_changes_a_type() {
    let mut d =
        document(&[("g", "group/g"), ("s", "vector/separate")], &[("s.x", "g.v"), ("g.out", "surface.base_color")]);
    let mut group = Group::new("g");
    group.interface.inputs = vec![crate::document::GroupInput::new("v", Type::Vec3, Value::Number(0.5))];
    group.interface.outputs = vec![GroupOutput::new("out", Type::Vec3)];
    group.graph.nodes.insert("in".into(), Node::new("group/input"));
    group.graph.nodes.insert("m".into(), Node::new("math/mix"));
    group.graph.links = vec![link("in.v", "m.a"), link("m.out", "output.out")];
    d.groups.insert("g".into(), group);
    let why = ungroup(&d, small(), None, "g").expect_err("a refusal").to_string();
    assert!(why.contains("the group's `v` turns what goes through it into another type"), "{why}");
    // A number set on it is spread as the group would.
    d.graph.links.remove(0);
    d.graph.nodes.get_mut("g").expect("g").values.insert("v".into(), Value::Number(0.25));
    let after = made(&d, &ungroup(&d, small(), None, "g").expect("its nodes"));
    assert_eq!(after.graph.nodes["m"].values["a"], Value::Vec3([0.25; 3]));
}

#[test]
fn groups_go_into_files_and_other_documents() {
    let d = chain();
    let d = made(&d, &collapse(&d, small(), None, &ids(&["c", "m", "n"]), "All").expect("a group"));
    let d = made(&d, &collapse(&d, small(), Some("all"), &ids(&["m"]), "Part").expect("a group in it"));
    let file = export_group(&d, "all").expect("a file");
    assert_eq!(file.groups.keys().collect::<Vec<_>>(), ["all", "part"]);
    let text = group_to_json(&file);
    assert_eq!(group_from_json(&text).expect("a file"), file);
    assert!(group_from_json(&text.replace("\"group\": \"all\"", "\"group\": \"gone\"")).is_err());
    // Into an empty document, into one that has it, and into one that has another `part`.
    let copied = group_as_copied(file.clone()).expect("whole");
    let with = |d: &Document| {
        let Pasted { edit, pick, .. } = paste(d, small(), None, &copied, [7.0, 8.0]).expect("an edit");
        let after = made(d, &edit);
        let [id] = &pick.nodes[..] else { panic!("one node: {pick:?}") };
        assert_eq!((after.graph.nodes[id].node.as_str(), after.graph.layout[id]), ("group/all", [7.0, 8.0]));
        after
    };
    assert_eq!(with(&document(&[], &[])).groups, file.groups);
    assert_eq!(with(&d).groups, d.groups);
    let mut clash = document(&[], &[]);
    clash.groups.insert("part".into(), Group::new("Another"));
    let after = with(&clash);
    assert_eq!(after.groups["part"], clash.groups["part"]);
    assert_eq!(after.groups["all"].graph.nodes.values().filter(|n| n.node == "group/part_2").count(), 1);
    // A file that lacks what it needs.
    let mut torn = file.clone();
    torn.groups.remove("part");
    assert!(group_as_copied(torn).expect_err("torn").0.contains("`group/part`, which is missing"));
}

#[test]
fn nodes_are_copied_with_their_wires() {
    let d = chain();
    let copied = copy(&d, None, &Pick::nodes(ids(&["c", "m", "surface"])));
    assert_eq!(from_json(&to_json(&copied)).expect("a document"), copied);
    assert_eq!((copied.graph.nodes.len(), copied.graph.links.len(), copied.parameters.len()), (3, 2, 1));
    let Pasted { edit, pick: new, notes } = paste(&d, small(), None, &copied, [500.0, 600.0]).expect("an edit");
    assert_eq!(new.nodes, ["c_2", "m_2"], "a material has one surface");
    assert_eq!(
        notes,
        ["“Surface” was left out, as the material has a surface", "the parameter `weight` came along as `weight_2`"]
    );
    let after = made(&d, &edit);
    let names = |d: &Document| d.parameters.iter().map(|p| format!("{} {}", p.name, p.socket)).collect::<Vec<_>>();
    assert_eq!(names(&after), ["weight m.t", "weight_2 m_2.t"]);
    assert_eq!(after.graph.incoming(&socket("m_2.a")), Some(&socket("c_2.out")));
    assert_eq!((after.graph.layout["c_2"], after.graph.layout["m_2"]), ([500.0, 600.0], [600.0, 600.0]));
    assert!(paste(&d, small(), None, &Document::new(""), [0.0; 2]).is_err());
    // A group goes along, but not into itself.
    let d = made(&d, &collapse(&d, small(), None, &ids(&["m", "n"]), "Two").expect("a group"));
    let copied = copy(&d, None, &Pick::nodes(ids(&["two"])));
    let Pasted { edit, .. } = paste(&document(&[], &[]), small(), None, &copied, [0.0; 2]).expect("an edit");
    let other = made(&document(&[], &[]), &edit);
    assert!(other.groups.contains_key("two"));
    assert_eq!(names(&other), ["weight two.weight"], "a group's input is offered there, too");
    let why = paste(&d, small(), Some("two"), &copied, [0.0; 2]).expect_err("a refusal");
    assert!(why.to_string().contains("a group cannot hold itself"));
}

#[test]
fn what_was_cut_comes_back_with_its_parameters_as_they_were() {
    let mut d = chain();
    let of_m = Parameter { label: Some("Weight".into()), range: Some([0.2, 0.8]), ..d.parameters[0].clone() };
    d.parameters = vec![of_m.clone(), Parameter { name: "Other".into(), socket: socket("n.t"), ..of_m.clone() }];
    let copied = copy(&d, None, &Pick::nodes(ids(&["m", "n"])));
    let removed: Vec<Edit> = ids(&["m", "n"]).into_iter().map(|id| Edit::RemoveNode { id }).collect();
    let without = made(&d, &Edit::Many(removed));
    assert!(without.parameters.is_empty());
    let Pasted { edit, notes, .. } = paste(&without, small(), None, &copied, [0.0; 2]).expect("an edit");
    assert_eq!(made(&without, &edit).parameters, d.parameters);
    assert_eq!(notes, ["the parameter `weight` came along", "the parameter `Other` came along"]);
    // Twice: each has a name of its own.
    let twice = made(&made(&without, &edit), &paste(&d, small(), None, &copied, [0.0; 2]).expect("an edit").edit);
    let names: Vec<&str> = twice.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["weight", "Other", "weight_2", "other"]);
}

#[test]
fn parameters_that_cannot_come_along_are_told() {
    let mut d = chain();
    let copied = copy(&d, None, &Pick::nodes(ids(&["m"])));
    d.groups.insert("g".into(), Group::new("g"));
    let Pasted { edit, notes, .. } = paste(&d, small(), Some("g"), &copied, [0.0; 2]).expect("an edit");
    assert_eq!(made(&d, &edit).parameters, d.parameters);
    assert_eq!(notes, ["the parameter `weight` was left out, as only the top level's nodes have parameters"]);
    // Wrong ones of a text from elsewhere.
    let wrong = |change: &dyn Fn(&mut Document)| {
        let mut copied = copied.clone();
        change(&mut copied);
        let Pasted { edit, notes, .. } = paste(&d, small(), None, &copied, [0.0; 2]).expect("an edit");
        assert_eq!(made(&d, &edit).parameters.len(), 1, "{notes:?}");
        assert_eq!(notes.len(), 1, "{notes:?}");
        notes[0].clone()
    };
    let name = wrong(&|copied| copied.parameters[0].name = "no name".into());
    assert!(name.contains("letters, digits and _"), "{name}");
    let range = wrong(&|copied| copied.parameters[0].range = Some([1.0, 0.0]));
    assert!(range.contains("its range"), "{range}");
    let gone = wrong(&|copied| copied.parameters[0].socket = socket("m.gone"));
    assert!(gone.contains("its input is not there"), "{gone}");
}

#[test]
fn frames_and_comments_are_copied_too() {
    let mut d = chain();
    let rect = |x: f32| Rect { position: [x, 10.0], size: [100.0, 60.0] };
    d.graph.frames.insert("f".into(), Frame { title: "Rust".into(), rect: rect(0.0), ..Frame::default() });
    d.graph.comments.insert("n".into(), Comment { text: "why".into(), rect: rect(40.0), ..Comment::default() });
    let pick = Pick { frames: vec!["f".into()], comments: vec!["n".into()], ..Pick::default() };
    let copied = copy(&d, None, &pick);
    let Pasted { edit, pick: new, .. } = paste(&d, small(), None, &copied, [500.0, 600.0]).expect("an edit");
    assert_eq!((new.frames.as_slice(), new.comments.as_slice()), (&["f_2".to_owned()][..], &["n_2".to_owned()][..]));
    let after = made(&d, &edit);
    assert_eq!(
        (after.graph.frames["f_2"].title.as_str(), after.graph.frames["f_2"].rect.position),
        ("Rust", [500.0, 600.0])
    );
    assert_eq!(after.graph.comments["n_2"].rect.position, [540.0, 600.0]);
    assert_eq!(after.graph.nodes, d.graph.nodes);
}

#[test]
fn a_removed_node_hands_its_wire_on() {
    let d = chain();
    let after = made(&d, &remove_and_heal(&d, small(), None, &ids(&["m", "n"])).expect("an edit"));
    assert_eq!(after.graph.incoming(&socket("surface.base_color")), Some(&socket("c.out")));
    assert_eq!(after.graph.incoming(&socket("surface.normal")), Some(&socket("c.out")));
    // Three numbers become none of a vector: the wire is gone.
    let after = made(&d, &remove_and_heal(&d, small(), None, &ids(&["c"])).expect("an edit"));
    assert_eq!(after.graph.incoming(&socket("m.a")), None);
}

#[test]
fn wires_that_cannot_be_say_why() {
    let d = chain();
    let can =
        |from: &str, to: &str| can_connect(&d, small(), None, &socket(from), &socket(to)).map_err(|e| e.to_string());
    assert_eq!(can("s.x", "m.t"), Ok(()));
    assert_eq!(can("c.out", "m.b"), Ok(()), "T follows");
    let why = |from: &str, to: &str| can(from, to).expect_err("a refusal");
    assert!(
        why("c.out", "m.t").contains("a vec3f does not go into a f32: components would be lost"),
        "{}",
        why("c.out", "m.t")
    );
    assert!(why("n.out", "m.b").contains("feed each other in a ring"));
    assert!(why("m.out", "m.b").contains("feed itself"));
    assert!(why("m.gone", "n.b").contains("has no output `gone`"));
    assert!(why("m.out", "n.gone").contains("has no input `gone`"));
    assert!(why("surface.out", "m.a").contains("ring") || why("surface.out", "m.a").contains("surface"));
}

#[test]
fn a_node_is_put_on_a_wire() {
    let mut d = chain();
    d.graph.nodes.insert("x".into(), Node::new("math/mix"));
    let on = link("m.out", "surface.normal");
    let after = made(&d, &insert_on_link(&d, small(), None, &on, "x").expect("an edit"));
    assert_eq!(after.graph.incoming(&socket("surface.normal")), Some(&socket("x.out")));
    assert_eq!(after.graph.incoming(&socket("x.a")), Some(&socket("m.out")));
    d.graph.nodes.insert("y".into(), Node::new("vector/greater"));
    let why = insert_on_link(&d, small(), None, &on, "y").expect_err("a refusal");
    assert!(why.to_string().contains("has no free input and output that fit"), "{why}");
    assert!(insert_on_link(&d, small(), None, &link("a.b", "c.d"), "x").is_err());
}

proptest! {
    /// On whatever document: an edit that can be made and undone, or a refusal.
    #[test]
    fn operations_never_break_a_document(d in any_document(), pick in prop::collection::vec("[a-e]", 1..4), in_group in any::<bool>()) {
        let group = in_group.then_some("g");
        let mut edits = vec![
            collapse(&d, small(), group, &pick, "made"),
            remove_and_heal(&d, small(), group, &pick),
            ungroup(&d, small(), group, &pick[0]),
        ];
        let copied = copy(&d, group, &Pick { nodes: pick.clone(), frames: pick.clone(), comments: pick });
        edits.push(paste(&d, small(), group, &copied, [1.0, 2.0]).map(|pasted| pasted.edit));
        for edit in edits.into_iter().flatten() {
            let mut after = d.clone();
            let undo = apply(&mut after, &edit).map_err(|e| TestCaseError::fail(format!("{e}: {edit:?}\n{}", to_json(&d))))?;
            apply(&mut after, &undo).map_err(|e| TestCaseError::fail(e.to_string()))?;
            prop_assert_eq!(to_json(&after), to_json(&d));
        }
    }
}

#[test]
fn a_groups_socket_is_renamed_with_all_that_names_it() {
    let d = chain();
    let d = made(&d, &collapse(&d, small(), None, &ids(&["m", "n"]), "Two mixes").expect("a group"));
    // A second user, within a group of its own.
    let d = made(&d, &collapse(&d, small(), None, &ids(&["two_mixes"]), "Around").expect("a group"));
    let input = |d: &Document| d.groups["two_mixes"].interface.inputs[1].name.clone();
    assert_eq!(input(&d), "weight");
    let after = made(&d, &rename_socket(&d, "two_mixes", GroupSide::Input, "weight", "share").expect("free"));
    assert_eq!(input(&after), "share");
    let file = to_json(&after);
    assert!(!file.contains("two_mixes.weight") && file.contains("two_mixes.share"), "{file}");
    let after = made(&after, &rename_socket(&after, "two_mixes", GroupSide::Output, "out", "bent").expect("free"));
    assert!(to_json(&after).contains("two_mixes.bent"), "{}", to_json(&after));
    let outer = made(&after, &rename_socket(&after, "around", GroupSide::Input, "weight", "how_much").expect("free"));
    assert_eq!(outer.parameters[0].socket, socket("around.how_much"), "the parameter goes along");
    for (group, from, to, why) in [
        ("none", "a", "b", "no group"),
        ("two_mixes", "none", "b", "no input"),
        ("two_mixes", "a", "share", "already"),
        ("two_mixes", "a", "a b", "no name"),
    ] {
        let refusal = rename_socket(&after, group, GroupSide::Input, from, to).expect_err(why);
        assert!(refusal.0.contains(why), "{refusal}");
    }
    made(&after, &rename_socket(&after, "two_mixes", GroupSide::Input, "a", "a").expect("the same name is no harm"));
}
