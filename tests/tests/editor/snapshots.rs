//! Pictures of the window in its main states, committed: a difference that a person would see fails.
//! `HALFVECTOR_BLESS=1` draws them anew, to be looked at. A failure leaves what it drew in `target/editor`.
//!
//! They are compared as people see them (FLIP), as no two drivers draw the same edges of text.

use std::path::Path;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_maps::color::linear_from_srgb;
use halfvector_reference::metrics::{FlipOptions, flip_ldr};

use super::settle;
use crate::support::{bless, renderer, root};

/// The largest mean of FLIP at which two pictures are the same: a word that moves, or a card without its picture, is more.
const SAME: f64 = 0.01;

fn open(size: [f32; 2], theme: egui::Theme, document: &str) -> Harness<'static, Editor> {
    let options = Options { document: Some(root().join(document)), ..Options::default() };
    let mut window =
        Harness::builder().with_size(size).wgpu().build_eframe(|context| Editor::new(&context.egui_ctx, options));
    window.ctx.set_theme(theme);
    settle(&mut window);
    window
}

/// Draws the window as it is and compares it with the picture of that name.
fn compare(window: &mut Harness<'_, Editor>, name: &str) {
    // What fades in has come by then.
    window.run_steps(20);
    settle(window);
    let drawn = window.render().unwrap_or_else(|e| panic!("{name}: {e}"));
    let golden = root().join("tests/golden/editor").join(name).with_extension("png");
    if bless() {
        std::fs::create_dir_all(golden.parent().expect("a folder")).expect("made");
        drawn.save(&golden).expect("saved");
        return;
    }
    let wanted = image::open(&golden).unwrap_or_else(|e| panic!("{}: {e}", golden.display())).to_rgba8();
    assert_eq!(wanted.dimensions(), drawn.dimensions(), "{name}");
    let pixels = |picture: &image::RgbaImage| -> Vec<[f64; 3]> {
        picture.pixels().map(|p| linear_from_srgb([p[0], p[1], p[2]].map(|c| f64::from(c) / 255.0))).collect()
    };
    let map = flip_ldr(&pixels(&wanted), &pixels(&drawn), drawn.width() as usize, FlipOptions::default());
    let mean = map.iter().sum::<f64>() / map.len() as f64;
    println!("{name}: FLIP {mean:.5}");
    if mean > SAME {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("editor");
        std::fs::create_dir_all(&folder).expect("made");
        let path = folder.join(name).with_extension("png");
        drawn.save(&path).expect("saved");
        panic!("{name} looks different: FLIP {mean:.4} on the mean, more than {SAME}; it is in {}", path.display());
    }
}

#[test]
fn a_rich_material_in_the_dark_and_in_the_light() {
    if renderer().is_none() {
        return;
    }
    for (theme, name) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
        let mut window = open([1440.0, 900.0], theme, "examples/rusted-iron.material.json");
        compare(&mut window, name);
    }
}

#[test]
fn the_palette_over_the_graph() {
    if renderer().is_none() {
        return;
    }
    let mut window = open([1440.0, 900.0], egui::Theme::Dark, "examples/car-paint.material.json");
    let canvas = window.get_by_label("Graph canvas").rect();
    window.hover_at(canvas.left_top() + egui::vec2(60.0, 60.0));
    window.step();
    window.key_press(egui::Key::Space);
    window.run_steps(3);
    window.event(egui::Event::Text("noise".into()));
    compare(&mut window, "palette");
}

#[test]
fn a_small_window_with_a_node_selected() {
    if renderer().is_none() {
        return;
    }
    let mut window = open([960.0, 600.0], egui::Theme::Dark, "examples/rusted-iron.material.json");
    let first = window.state().session().document().graph.nodes.keys().next().expect("a node").clone();
    window.state_mut().act(Action::Select(vec![first]));
    compare(&mut window, "small");
}
