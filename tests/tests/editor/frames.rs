//! Frames and comments: chosen, moved, copied, named and arranged like nodes, and with those that lie in them.

use std::collections::BTreeMap;

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::{Comment, Frame, Graph, Rect};
use halfvector_graph::edit::Edit;

use super::hands::*;
use super::open;

const NONE: egui::Modifiers = egui::Modifiers::NONE;

/// A window whose graph has two frames, one in the other, and a comment in the inner one.
fn framed() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    window.state_mut().act(Action::Select(vec!["chips".into(), "grain".into()]));
    let at = empty_place(&window);
    go(&mut window, at);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::J);
    let outer = document(&window).graph.frames["frame"].rect;
    let inside = |by: f32, size: [f32; 2]| Rect {
        position: [outer.position[0] + by, outer.position[1] + outer.size[1] + by],
        size,
    };
    let larger = Rect { size: [outer.size[0], outer.size[1] + 260.0], ..outer };
    let title = |title: &str, rect| Frame { title: title.into(), rect, ..Frame::default() };
    let comment = Comment { text: "Why".into(), rect: inside(40.0, [100.0, 50.0]), ..Comment::default() };
    let edits = vec![
        Edit::SetFrame { id: "frame".into(), frame: title("Outer", larger) },
        Edit::AddFrame { id: "inner".into(), frame: title("Inner", inside(5.0, [200.0, 140.0])) },
        Edit::AddComment { id: "why".into(), comment },
    ];
    window.state_mut().act(Action::edit("Frames", Edit::Many(edits)));
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::Home);
    key(&mut window, NONE, egui::Key::Escape);
    window
}

fn graph(window: &Window) -> Graph {
    document(window).graph.clone()
}

/// Places of all that has one, by id.
fn places(graph: &Graph) -> BTreeMap<String, [f32; 2]> {
    let frames = graph.frames.iter().map(|(id, frame)| (id.clone(), frame.rect.position));
    let comments = graph.comments.iter().map(|(id, comment)| (id.clone(), comment.rect.position));
    graph.layout.clone().into_iter().chain(frames).chain(comments).collect()
}

fn ways(before: &Graph, after: &Graph) -> BTreeMap<String, [f32; 2]> {
    let (before, after) = (places(before), places(after));
    before.iter().map(|(id, old)| (id.clone(), [0, 1].map(|axis| after[id][axis] - old[axis]))).collect()
}

/// A place of a frame's title that is free.
fn grip(window: &Window, label: &str) -> egui::Pos2 {
    let title = window.get_by_label(label).rect();
    title.right_center() - egui::vec2(12.0, 0.0)
}

#[test]
fn a_frame_takes_along_the_frames_and_comments_in_it() {
    let mut window = framed();
    let before = graph(&window);
    let at = grip(&window, "Frame Outer");
    drag(&mut window, at, at + egui::vec2(-40.0, 30.0));
    let ways = ways(&before, &graph(&window));
    assert!(ways["frame"][0] < -20.0, "{ways:?}");
    for id in ["inner", "why", "chips", "grain"] {
        assert_eq!(ways[id], ways["frame"], "{id}");
    }
    assert_eq!(ways["surface"], [0.0, 0.0]);
    assert_eq!(window.state().session().steps()[0], Some("Move frame"));
    // Moved by a key it takes them along, too.
    let before = graph(&window);
    key(&mut window, NONE, egui::Key::ArrowUp);
    let ways = self::ways(&before, &graph(&window));
    assert_eq!((ways["frame"], ways["why"], ways["chips"]), ([0.0, -20.0], [0.0, -20.0], [0.0, -20.0]));
}

#[test]
fn arranging_moves_frames_with_their_nodes() {
    let mut window = framed();
    let held = |graph: &Graph, frame: &str, place: [f32; 2]| {
        let rect = graph.frames[frame].rect;
        (0..2).all(|axis| place[axis] >= rect.position[axis] && place[axis] <= rect.position[axis] + rect.size[axis])
    };
    // Far from their frame's place: all are arranged.
    let at = grip(&window, "Frame Outer");
    drag(&mut window, at, at + egui::vec2(30.0, -60.0));
    key(&mut window, NONE, egui::Key::Escape);
    key(&mut window, NONE, egui::Key::L);
    let after = graph(&window);
    let places = places(&after);
    for id in ["chips", "grain", "inner", "why"] {
        assert!(held(&after, "frame", places[id]), "{id}: {places:?} {:?}", after.frames["frame"].rect);
    }
    assert!(held(&after, "inner", places["why"]), "{places:?}");
    for id in ["enamel", "rust", "base_color", "roughness", "surface"] {
        assert!(!held(&after, "frame", places[id]), "{id}: {places:?}");
    }
    assert_eq!(window.state().session().steps()[0], Some("Arrange nodes"));
}

#[test]
fn what_a_frame_holds_is_duplicated_and_copied_with_it() {
    let mut window = framed();
    let first = text(&window);
    window.get_by_label("Frame Outer").click();
    window.run_steps(2);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::D);
    let after = graph(&window);
    assert_eq!((after.nodes.len(), after.frames.len(), after.comments.len()), (9, 4, 2));
    assert_eq!(after.frames["frame_2"].title, "Outer");
    assert_eq!(window.state().session().steps()[0], Some("Duplicate 5 items"));
    // The copy is chosen: it is deleted whole.
    key(&mut window, NONE, egui::Key::Delete);
    assert_eq!((graph(&window).nodes.len(), graph(&window).frames.len(), graph(&window).comments.len()), (7, 2, 1));
    undo_all(&mut window);
    redo_all(&mut window);
    window.event(egui::Event::PointerGone);
    let menu = |window: &mut Window, entry: &str| {
        window.get_by_label("Edit").click();
        window.run_steps(2);
        window.get_by_label(entry).click();
        window.run_steps(3);
    };
    // The menu's entries are for a frame, too.
    window.get_by_label("Frame Inner").click();
    window.run_steps(2);
    menu(&mut window, "Delete Del");
    assert!(!graph(&window).frames.contains_key("inner"));
    assert!(graph(&window).comments.contains_key("why"), "what lies in it stays");
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(text(&window), first);
    window.get_by_label("Frame Inner").click();
    window.run_steps(2);
    window.event(egui::Event::Cut);
    window.step();
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    window.step();
    assert_eq!((graph(&window).frames.len(), graph(&window).comments.len()), (1, 0));
    window.event(egui::Event::Paste(copied.expect("something was copied")));
    window.run_steps(2);
    assert_eq!((graph(&window).frames["inner"].title.as_str(), graph(&window).comments.len()), ("Inner", 1));
}

#[test]
fn a_box_chooses_frames_and_comments() {
    let mut window = framed();
    let inner = window.get_by_label("Frame Inner").rect();
    let outer = window.get_by_label("Frame Outer").rect();
    // From beside the inner frame, within the outer one, which is not chosen then.
    let from = inner.left_top() + egui::vec2(-1.5, -1.5);
    let to = egui::pos2(inner.right() + 3.0, inner.bottom() + inner.width());
    assert!(outer.left() < from.x);
    let before = graph(&window);
    drag(&mut window, from, to);
    key(&mut window, NONE, egui::Key::ArrowRight);
    let ways = ways(&before, &graph(&window));
    assert_eq!((ways["inner"], ways["why"], ways["frame"]), ([20.0, 0.0], [20.0, 0.0], [0.0, 0.0]));
    // All are chosen by the key for all.
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::A);
    key(&mut window, NONE, egui::Key::ArrowRight);
    let ways = self::ways(&before, &graph(&window));
    assert_eq!((ways["inner"], ways["frame"], ways["surface"]), ([40.0, 0.0], [20.0, 0.0], [20.0, 0.0]));
}

#[test]
fn a_key_names_a_frame() {
    let mut window = framed();
    window.get_by_label("Frame Inner").click();
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::F2);
    window.step();
    write(&mut window, "Where it is worn");
    key(&mut window, NONE, egui::Key::Enter);
    window.step();
    assert_eq!(graph(&window).frames["inner"].title, "Where it is worn");
}

#[test]
fn a_frame_and_a_comment_come_where_the_pointer_is() {
    let mut window = open(Options::default());
    window.run_steps(3);
    let first = empty_place(&window) - egui::vec2(0.0, 40.0);
    let places = [("Comment Comment", first), ("Frame Frame", first + egui::vec2(200.0, 0.0))];
    for ((_, at), entry) in places.into_iter().zip(["Add comment", "Add frame Ctrl+J"]) {
        go(&mut window, at);
        for pressed in [true, false] {
            let button = egui::PointerButton::Secondary;
            window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers: NONE });
            window.step();
        }
        window.run_steps(2);
        window.get_by_label_contains(entry).click();
        window.run_steps(3);
        go(&mut window, at);
        key(&mut window, NONE, egui::Key::Escape);
    }
    for (label, at) in places {
        let rect = window.get_by_label(label).rect();
        assert!(rect.left_top().distance(at) < 20.0, "{label}: {rect:?}, {at:?}");
    }
}

#[test]
fn a_frame_keeps_a_card_that_is_larger_than_it() {
    let mut window = framed();
    let [left, top] = graph(&window).layout["surface"];
    // Around the header and a few rows: the card was folded when the frame was put there.
    let rect = Rect { position: [left - 20.0, top - 60.0], size: [400.0, 120.0] };
    let frame = Frame { title: "Short".into(), rect, ..Frame::default() };
    window.state_mut().act(Action::edit("Frame", Edit::AddFrame { id: "short".into(), frame }));
    window.run_steps(2);
    window.get_by_label("Frame Short").click();
    window.run_steps(2);
    let before = graph(&window);
    key(&mut window, NONE, egui::Key::ArrowUp);
    let ways = ways(&before, &graph(&window));
    assert_eq!((ways["short"], ways["surface"], ways["chips"]), ([0.0, -20.0], [0.0, -20.0], [0.0, 0.0]));
}

#[test]
fn all_is_shown_with_frames_and_comments() {
    let mut window = framed();
    let rect = Rect { position: [-3000.0, -2000.0], size: [300.0, 200.0] };
    let frame = Frame { title: "Far".into(), rect, ..Frame::default() };
    window.state_mut().act(Action::edit("Frame", Edit::AddFrame { id: "far".into(), frame }));
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::Home);
    window.run_steps(2);
    let canvas = window.get_by_label("Graph canvas").rect();
    assert!(canvas.contains_rect(window.get_by_label("Frame Far").rect()));
}

#[test]
fn escape_drops_what_was_written_on_a_comment() {
    let mut window = framed();
    window.get_by_label("Comment Why").click();
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::F2);
    window.step();
    write(&mut window, "Because");
    key(&mut window, NONE, egui::Key::Escape);
    window.run_steps(2);
    assert_eq!(graph(&window).comments["why"].text, "Why");
}

#[test]
fn the_menu_chooses_no_frame() {
    let mut window = framed();
    window.get_by_label("Frame Inner").click();
    window.run_steps(2);
    window.get_by_label("Edit").click();
    window.run_steps(2);
    window.get_by_label("Select nothing").click();
    window.run_steps(3);
    let before = text(&window);
    window.get_by_label("Graph canvas").focus();
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::Delete);
    assert_eq!(text(&window), before);
}
