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

/// Every character of the editor and of the nodes is in its fonts, as another one would be an empty box.
#[test]
fn every_character_is_in_the_fonts() {
    fn characters(path: &Path, found: &mut std::collections::BTreeMap<char, std::path::PathBuf>) {
        if path.is_dir() {
            for entry in std::fs::read_dir(path).expect("a folder") {
                characters(&entry.expect("an entry").path(), found);
            }
        } else if let Ok(text) = std::fs::read_to_string(path) {
            for character in text.chars().filter(|character| !character.is_ascii()) {
                found.entry(character).or_insert_with(|| path.to_owned());
            }
        }
    }
    let mut found = std::collections::BTreeMap::new();
    for place in ["editor", "shaders/nodes", "examples"] {
        characters(&root().join(place), &mut found);
    }
    // Labels and problems come from the graph, which writes them as escapes.
    for file in
        ["check.rs", "flatten.rs", "check/words.rs", "file/instance.rs", "operation/wire.rs", "operation/collapse.rs"]
    {
        let path = root().join("crates/graph/src").join(file);
        let text = std::fs::read_to_string(&path).expect("text");
        for rest in text.split("\\u{").skip(1) {
            let code = rest.split('}').next().and_then(|digits| u32::from_str_radix(digits, 16).ok());
            found.entry(code.and_then(char::from_u32).expect("a character")).or_insert(path.clone());
        }
    }
    assert!(found.len() > 8, "{found:?}");
    let mut window = Harness::new_ui(|_| {});
    window.step();
    let font = egui::FontId::proportional(14.0);
    let place = |character: char| {
        let shown = window
            .ctx
            .fonts_mut(|fonts| fonts.layout_no_wrap(character.to_string(), font.clone(), egui::Color32::WHITE));
        shown.rows[0].glyphs[0].uv_rect
    };
    // The box is what a character of nobody is shown as.
    let nobodys = place('\u{10fffd}');
    found.retain(|&character, _| place(character) == nobodys);
    // It stands in the window's title alone, which the system draws.
    found.remove(&'●');
    assert!(found.is_empty(), "they are shown as empty boxes: {found:?}");
}

/// Coloured words can be read in both themes: a contrast of 4 to 1 with their ground at least.
#[test]
fn coloured_words_can_be_read() {
    if renderer().is_none() {
        return;
    }
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        let mut window = open([1000.0, 620.0], theme, "examples/car-paint.material.json");
        window.get_by_label("Problems").click();
        window.run_steps(4);
        let place = window.get_by_label("No problems").rect();
        let drawn = window.render().expect("a picture");
        let light = |pixel: &image::Rgba<u8>| {
            let [r, g, b, _] = pixel.0.map(|code| f64::from(code) / 255.0);
            let [r, g, b] = linear_from_srgb([r, g, b]);
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let pixels = drawn.enumerate_pixels().filter(|(x, y, _)| place.contains(egui::pos2(*x as f32, *y as f32)));
        let (least, most) = pixels.fold((f64::INFINITY, 0.0_f64), |(least, most), (_, _, pixel)| {
            (least.min(light(pixel)), most.max(light(pixel)))
        });
        assert!(most / least > 4.0, "{theme:?}: {:.2}", most / least);
    }
}
