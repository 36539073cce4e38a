//! The code pane: lines and nodes find each other, and what is exported is what is shown.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};

use egui::accesskit::Role;

use super::{open, settle};

fn window() -> Harness<'static, Editor> {
    let mut harness = open(Options::default());
    settle(&mut harness);
    harness
}

#[test]
fn a_line_of_a_node_shows_the_node_and_is_found_by_it() {
    let mut harness = window();
    harness.state_mut().act(Action::Select(vec!["grain".into()]));
    settle(&mut harness);
    // Its lines are in view now.
    harness.state_mut().act(Action::Select(Vec::new()));
    settle(&mut harness);
    let rects: Vec<egui::Pos2> = harness.get_all_by_label_contains("Line ").map(|line| line.rect().center()).collect();
    let found = rects.into_iter().any(|at| {
        for pressed in [true, false] {
            let button = egui::PointerButton::Primary;
            harness.event(egui::Event::PointerMoved(at));
            harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers: egui::Modifiers::NONE });
            harness.step();
        }
        harness.step();
        harness.state().session().selection().contains("grain")
    });
    assert!(found, "no line that is seen is the node's");
}

#[test]
fn every_target_is_shown() {
    let mut harness = window();
    for target in ["glsl", "glsl-es", "hlsl", "msl", "spirv", "wgsl"] {
        harness.get_by_role_and_label(Role::ComboBox, "Target").click();
        harness.run_steps(3);
        harness.get_all_by_label(target).last().unwrap().click();
        settle(&mut harness);
        let note = harness.query_by_label_contains("This target is not text").is_some();
        assert_eq!(note, target == "spirv", "{target}");
    }
    assert!(harness.query_by_label_contains("Left out (").is_some());
}
