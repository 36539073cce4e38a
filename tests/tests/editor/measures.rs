//! The panes that measure: errors against the reference, the furnace, what nodes cost, what is wrong. And a GPU that goes while it
//! draws.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_graph::document::SocketRef;
use halfvector_graph::edit::Edit;
use halfvector_graph::value::Value;

use egui::accesskit::Role;

use super::settle;

type Window = Harness<'static, Editor>;

fn open() -> Window {
    open_with(Options::default())
}

fn open_with(options: Options) -> Window {
    let mut window =
        Harness::builder().with_size([1000.0, 620.0]).build_eframe(|context| Editor::new(&context.egui_ctx, options));
    settle(&mut window);
    window
}

fn show(window: &mut Window, pane: &str) {
    window.get_by_role_and_label(Role::Button, pane).click();
    // The pane asks for what it shows when it is seen.
    window.run_steps(4);
    settle(window);
}

fn set(window: &mut Window, socket: &str, value: f32) {
    let edit = Edit::SetValue { socket: SocketRef::new("surface", socket), value: Some(Value::Number(value)) };
    window.state_mut().act(Action::edit("Set", edit));
    settle(window);
}

const ODD: &str = r#"{"halfvector": 1, "name": "Odd",
  "nodes": {"surface": {"node": "surface/surface"}, "odd": {"node": "custom/odd"}},
  "links": [{"from": "odd.out", "to": "surface.emission"}],
  "functions": {"odd": ["/// Odd", "///", "/// Test.", "/// @node custom/odd", "/// - uv: where [context uv0]", "/// - return: light",
    "fn odd(uv: vec2f) -> vec3f {", "return vec3f(sqrt(uv.x - 0.5));", "}"]}}"#;

/// Waits until errors are being measured, which begins by itself; whether they were said to be old until then.
fn wait_for_measuring(window: &mut Window) -> bool {
    let start = std::time::Instant::now();
    let mut was_old = false;
    while window.query_by_label("Stop").is_none() {
        was_old |= window.query_by_label_contains("has changed since").is_some();
        assert!(start.elapsed().as_secs() < 60, "nothing is measured");
        window.step();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    was_old
}

/// Errors are measured once the material rests, and again after a change.
#[test]
fn errors_are_measured_against_the_reference() {
    // A light that is no number on half of the surface is told.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("odd.material.json");
    std::fs::write(&path, ODD).expect("written");
    let mut window = open_with(Options { document: Some(path), ..Options::default() });
    window.get_by_role_and_label(Role::Button, "Accuracy").click();
    assert!(!wait_for_measuring(&mut window));
    let rows = ["as it is", "karis", "hdre"];
    settle(&mut window);
    assert!(rows.iter().all(|row| window.query_by_label(row).is_some()));
    assert!(window.query_by_label_contains("paths for each pixel").is_some());
    assert!(window.query_by_label_contains("`Odd` is NaN or infinite at").is_some());
    assert!(window.query_by_label_contains("has changed since").is_none());
    let edit = Edit::SetValue { socket: SocketRef::new("surface", "height"), value: Some(Value::Number(0.1)) };
    window.state_mut().act(Action::edit("Set", edit));
    assert!(wait_for_measuring(&mut window), "rows of an older state are not told");
    assert!(window.query_by_label_contains("has changed since").is_none());
}

#[test]
fn the_furnace_is_lit_on_demand_and_a_measurement_is_stopped() {
    let mut window = open();
    window.get_by_role_and_label(Role::Button, "Accuracy").click();
    wait_for_measuring(&mut window);
    window.get_by_label("Stop").click();
    settle(&mut window);
    window.get_by_label("Furnace test").click();
    settle(&mut window);
    // In view, and not behind the words that nothing was measured.
    let picture = window.get_by_label("The material in the white furnace").rect();
    assert!(picture.right() < window.get_by_label("Picture of the material").rect().left(), "{picture:?}");
    window.get_by_label("Measure errors").click();
    window.run_steps(2);
    window.get_by_label("Stop").click();
    settle(&mut window);
    assert!(window.query_by_label("karis").is_none());
}

#[test]
fn costs_are_counted_and_colour_the_graph() {
    let mut window = open();
    show(&mut window, "Cost");
    // What the header counts is what the rows add up to.
    let figures = |label: &str| label.split_whitespace().next().and_then(|word| word.parse::<u32>().ok());
    let labels: Vec<String> = window.query_all_by_role(Role::Label).filter_map(|label| label.value()).collect();
    let header = labels.iter().find(|label| label.contains("instructions: ")).expect("a header");
    let rows = labels.iter().filter(|label| label.ends_with(|c: char| c.is_ascii_digit()) || label.ends_with(" tex"));
    let rows: u32 = rows.filter(|label| label.starts_with(' ')).filter_map(|label| figures(label)).sum();
    assert_eq!(figures(header), Some(rows), "{labels:?}");
    assert!(window.state().session().heat().is_empty());
    window.get_by_label("Colour the graph").click();
    settle(&mut window);
    let heat = window.state().session().heat();
    assert!(heat["chips"] > heat["roughness"], "{heat:?}");
    window.get_all_by_label("Rust grain").last().unwrap().click();
    window.run_steps(3);
    assert!(window.state().session().selection().contains("grain"));
}

#[test]
fn problems_lead_to_their_nodes_and_are_filtered() {
    let mut window = open();
    set(&mut window, "perceptual_roughness", 0.5);
    window.state_mut().act(Action::edit("Unlink", Edit::RemoveNode { id: "grain".to_owned() }));
    window.state_mut().act(Action::edit("Unlink", Edit::RemoveNode { id: "rust".to_owned() }));
    window.state_mut().act(Action::edit("Unlink", Edit::RemoveNode { id: "base_color".to_owned() }));
    window.state_mut().act(Action::edit("Unlink", Edit::RemoveNode { id: "roughness".to_owned() }));
    settle(&mut window);
    let count = window.state().session().problems().len();
    assert!(count > 0);
    window.get_by_label(&format!("Problems ({count})")).click();
    settle(&mut window);
    let links = |window: &Window| window.query_all_by_label("Enamel is left").count();
    assert_eq!(links(&window), 1, "the warning names its node");
    window.get_by_label("Enamel is left").click();
    window.run_steps(3);
    assert!(window.state().session().selection().contains("enamel"));
    window.get_by_label("Warnings").click();
    window.run_steps(3);
    assert_eq!(links(&window), 0);
}

#[test]
fn a_gpu_that_goes_while_it_draws_leaves_the_picture_to_the_cpu() {
    let mut window = open();
    if window.query_by_label_contains("Drawn on the CPU").is_some() {
        println!("skipped: there is no GPU to lose");
        return;
    }
    // Pictures of everything are being drawn when it goes.
    set(&mut window, "metallic", 0.1);
    window.get_by_role_and_label(Role::Button, "Library").click();
    window.get_by_role_and_label(Role::Button, "View").click();
    let edit = Edit::SetValue { socket: SocketRef::new("surface", "metallic"), value: Some(Value::Number(0.6)) };
    window.state_mut().act(Action::edit("Set", edit));
    window.run_steps(2);
    assert!(!window.state().is_idle());
    window.get_by_label("Draw on the CPU").click();
    window.run_steps(2);
    assert!(window.query_by_label_contains("Drawn on the CPU").is_some());
    settle(&mut window);
    assert!(window.query_by_label_contains("stopped while").is_none());
    assert_eq!(window.state().drawn_by(), Some("CPU"));
    window.get_by_label("Try the GPU again").click();
    settle(&mut window);
    assert!(window.query_by_label_contains("Drawn on the CPU:").is_none());
    assert_ne!(window.state().drawn_by(), Some("CPU"));
}

/// f32 is compared with exact arithmetic on demand; a finding leads to its node, and small numbers are to be told apart from 0.
#[test]
fn stability_is_checked_and_leads_to_the_node() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("jumps.material.json");
    let text = r#"{"halfvector": 1, "name": "Jumps", "nodes": {
        "place": {"node": "coordinates/object_position"},
        "parts": {"node": "vector/separate3"},
        "log": {"node": "math/log", "label": "Logarithm of x"},
        "surface": {"node": "surface/surface"}},
        "links": [{"from": "place.out", "to": "parts.v"}, {"from": "parts.x", "to": "log.x"},
            {"from": "log.out", "to": "surface.metallic"}]}"#;
    std::fs::write(&file, text).expect("written");
    let options = Options { document: Some(file), ..Options::default() };
    let mut window =
        Harness::builder().with_size([1000.0, 620.0]).build_eframe(|context| Editor::new(&context.egui_ctx, options));
    settle(&mut window);
    show(&mut window, "Problems");
    window.get_by_label("Check stability").click();
    window.run_steps(2);
    settle(&mut window);
    assert!(window.query_by_label_contains("jumps from").is_some());
    assert!(window.query_by_label_contains("object_position.x = -0.000000").is_none());
    window.get_all_by_label("Logarithm of x").last().expect("a link").click();
    window.run_steps(3);
    assert!(window.state().session().selection().contains("log"));
    set(&mut window, "ior", 1.4);
    assert!(window.query_by_label_contains("of an older state").is_some());
}
