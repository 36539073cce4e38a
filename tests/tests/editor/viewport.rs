//! The picture: turning it, its lights, what is dropped on it, two sides compared, and no graphics card.

use eframe::egui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Editor, Options};
use halfvector_graph::needs::ToneMap;
use halfvector_scene::{EnvironmentSource, MeshSource};

use super::hands::drop_file;
use super::settle;
use crate::support::renderer;

/// A window small enough that its pictures cost little.
fn open(options: Options) -> Harness<'static, Editor> {
    open_sized([1000.0, 620.0], options)
}

fn open_sized(size: [f32; 2], options: Options) -> Harness<'static, Editor> {
    let mut harness =
        Harness::builder().with_size(size).build_eframe(|context| Editor::new(&context.egui_ctx, options));
    settle(&mut harness);
    harness
}

/// Takes something with the pointer, moves it by `by` points and lets go.
fn drag(harness: &mut Harness<'_, Editor>, label: &str, by: [f32; 2]) {
    let from = harness.get_by_label(label).rect().center();
    let to = from + egui::vec2(by[0], by[1]);
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    harness.hover_at(from.lerp(to, 0.5));
    harness.step();
    harness.hover_at(to);
    harness.step();
    harness.drop_at(to);
    harness.step();
}

fn click(harness: &mut Harness<'_, Editor>, label: &str) {
    harness.get_by_label(label).click();
    harness.step();
    harness.step();
}

const PICTURE: &str = "Picture of the material";

#[test]
fn a_drag_turns_the_view_and_frame_brings_it_back() {
    let mut harness = open(Options::default());
    let before = harness.state().stage().orbit;
    drag(&mut harness, PICTURE, [60.0, 20.0]);
    let turned = harness.state().stage().orbit;
    assert!(turned.yaw < before.yaw - 0.1 && turned.pitch > before.pitch + 0.05, "{turned:?}");
    assert_eq!((turned.target, turned.distance), (before.target, before.distance));
    harness.event(egui::Event::ModifiersChanged(egui::Modifiers::SHIFT));
    drag(&mut harness, PICTURE, [60.0, 0.0]);
    harness.event(egui::Event::ModifiersChanged(egui::Modifiers::NONE));
    let panned = harness.state().stage().orbit;
    assert_eq!((panned.yaw, panned.pitch), (turned.yaw, turned.pitch));
    assert!(panned.target.distance(turned.target) > 0.1);
    click(&mut harness, "Frame");
    assert_eq!(harness.state().stage().orbit, before);
    // No view state is a change of the document.
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn a_light_is_added_and_dragged() {
    let mut harness = open(Options::default());
    click(&mut harness, "Lights");
    click(&mut harness, "Add point");
    let placed = harness.state().stage().lamps[0];
    harness.key_press(egui::Key::Escape);
    harness.step();
    drag(&mut harness, "Point light 1", [-50.0, 30.0]);
    let lamps = &harness.state().stage().lamps;
    assert_eq!(lamps.len(), 1);
    assert!(lamps[0].place.x < placed.place.x - 0.1 && lamps[0].place.y < placed.place.y - 0.1, "{lamps:?}");
    settle(&mut harness);
}

#[test]
fn environments_and_models_come_by_drop_and_bad_ones_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = open(Options::default());
    let sky = folder.path().join("sky.hdr");
    let pixels: Vec<u8> = (0..8u8).flat_map(|i| [90 + i, 100, 120, 128]).collect();
    std::fs::write(&sky, [b"#?RADIANCE\n\n-Y 2 +X 4\n".as_slice(), &pixels].concat()).expect("written");
    drop_file(&mut harness, &sky);
    settle(&mut harness);
    assert_eq!(harness.state().stage().environment, EnvironmentSource::File(sky.clone()));

    let broken = folder.path().join("broken.hdr");
    std::fs::write(&broken, "no picture").expect("written");
    drop_file(&mut harness, &broken);
    settle(&mut harness);
    assert_eq!(harness.state().stage().environment, EnvironmentSource::File(sky));
    assert!(harness.query_by_label_contains("The environment stays as it was").is_some());
    click(&mut harness, "Dismiss");
    assert!(harness.query_by_label_contains("stays as it was").is_none());

    let mesh = harness.state().stage().mesh.clone();
    let broken = folder.path().join("broken.glb");
    std::fs::write(&broken, "no model").expect("written");
    drop_file(&mut harness, &broken);
    settle(&mut harness);
    assert_eq!(harness.state().stage().mesh, mesh);
    assert!(harness.query_by_label_contains("The model stays as it was").is_some());

    let triangle = folder.path().join("triangle.gltf");
    std::fs::write(&triangle, TRIANGLE).expect("written");
    drop_file(&mut harness, &triangle);
    settle(&mut harness);
    assert_eq!(harness.state().stage().mesh, MeshSource::File(triangle));
    // It stands far off and is brought into view.
    assert!(harness.state().stage().orbit.target.x > 90.0, "{:?}", harness.state().stage().orbit);
}

/// A bake that is given up leaves what is there.
#[test]
fn a_bake_is_cancelled() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = open(Options::default());
    let before = harness.state().stage().environment.clone();
    let sky = folder.path().join("large.hdr");
    let head = b"#?RADIANCE\n\n-Y 1024 +X 2048\n".as_slice();
    let pixels: Vec<u8> = (0..2048 * 1024_u32).flat_map(|i| [(i % 251) as u8, 100, 120, 128]).collect();
    std::fs::write(&sky, [head, &pixels].concat()).expect("written");
    drop_file(&mut harness, &sky);
    harness.run_steps(2);
    assert_eq!(harness.state().stage().environment, EnvironmentSource::File(sky));
    harness.get_by_label_contains("Preparing the environment");
    click(&mut harness, "Cancel");
    assert_eq!(harness.state().stage().environment, before);
    settle(&mut harness);
    assert_eq!(harness.state().stage().environment, before);
    assert!(harness.query_by_label_contains("Preparing the environment").is_none());
}

/// Tools that have no room are in the menu at the end of the row, and work there.
#[test]
fn a_narrow_window_keeps_its_tools_in_a_menu() {
    let mut harness = open_sized([700.0, 620.0], Options::default());
    assert!(harness.query_by_label("Turntable").is_none(), "there is room for all");
    click(&mut harness, "More tools");
    harness.get_by_label("Turntable");
    // The name of a menu in a menu ends in an arrow.
    harness.get_all_by_label_contains("Display").last().expect("it has no room in the row").click();
    harness.run_steps(3);
    click(&mut harness, "Reinhard");
    assert_eq!(harness.state().stage().tone_map, ToneMap::Reinhard);
}

/// A triangle at x = 100: three positions of 32-bit floats as a data URI.
const TRIANGLE: &str = r#"{
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0, "translation": [100, 0, 0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
}"#;

#[test]
fn two_sides_are_compared_and_their_difference_is_told() {
    let mut harness = open_sized([1440.0, 620.0], Options::default());
    click(&mut harness, "Compare");
    click(&mut harness, "Difference");
    settle(&mut harness);
    // The same picture twice.
    assert!(harness.query_by_label_contains("FLIP mean 0.0000").is_some(), "no difference is told");
    click(&mut harness, "Split");
    let boxes = harness.get_all_by_label("Own methods").collect::<Vec<_>>();
    boxes[1].click();
    harness.step();
    harness.key_press(egui::Key::Escape);
    settle(&mut harness);
    let before = harness.get_by_label("Divider of A and B").rect().center().x;
    drag(&mut harness, "Divider of A and B", [40.0, 0.0]);
    let after = harness.get_by_label("Divider of A and B").rect().center().x;
    assert!((after - before - 40.0).abs() < 2.0, "{before} {after}");
}

#[test]
fn the_selected_nodes_outputs_are_shown() {
    let mut harness = open(Options::default());
    assert!(harness.query_by_label("out of chips").is_none());
    harness.state_mut().act(halfvector_editor::Action::Select(vec!["chips".into()]));
    settle(&mut harness);
    harness.get_by_label("out of chips");
    // Of two selected nodes none.
    harness.state_mut().act(halfvector_editor::Action::Select(vec!["chips".into(), "grain".into()]));
    settle(&mut harness);
    assert!(harness.query_by_label("out of chips").is_none());
}

#[test]
fn without_a_graphics_card_the_cpu_draws_and_says_so() {
    let mut harness = open(Options { without_gpu: true, ..Options::default() });
    assert!(harness.query_by_label_contains("Drawn on the CPU").is_some());
    // Asked again, it is opened where there is one; either way there is a picture and no end.
    click(&mut harness, "Try the GPU again");
    settle(&mut harness);
}

/// The share of the picture that is magenta, as no material of these tests is.
fn magenta(harness: &mut Harness<'_, Editor>) -> f64 {
    settle(harness);
    let place = harness.get_by_label(PICTURE).rect();
    let drawn = harness.render().expect("a picture");
    let scale = harness.ctx.pixels_per_point();
    let pixels = drawn.enumerate_pixels().filter(|(x, y, _)| {
        let at = egui::pos2(*x as f32, *y as f32) / scale;
        place.contains(at)
    });
    let (mut all, mut found) = (0, 0);
    for (_, _, pixel) in pixels {
        let [red, green, blue, _] = pixel.0;
        all += 1;
        found += u32::from(red > 150 && blue > 150 && green < 60);
    }
    f64::from(found) / f64::from(all.max(1))
}

/// A checker stands in for a picture that is not there, in each engine, and goes when the picture comes.
#[test]
fn a_picture_that_is_missing_leaves_the_rest_to_be_seen() {
    if renderer().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("missing.material.json");
    let text = r#"{"halfvector": 1, "name": "Missing", "nodes": {
        "gone": {"node": "textures/image", "values": {"image": {"file": "gone.png", "color_space": "srgb"}}},
        "surface": {"node": "surface/surface", "values": {"base_color": [0, 0, 0], "specular": 0}}},
        "links": [{"from": "gone.color", "to": "surface.emission"}]}"#;
    std::fs::write(&file, text).expect("written");
    let picture = folder.path().join("gone.png");
    for without_gpu in [false, true] {
        let options = Options { document: Some(file.clone()), without_gpu, ..Options::default() };
        let mut harness = Harness::builder()
            .with_size([1000.0, 620.0])
            .wgpu()
            .build_eframe(|context| Editor::new(&context.egui_ctx, options));
        let share = magenta(&mut harness);
        assert!(share > 0.05, "{share}, without a GPU: {without_gpu}");
        harness.get_by_label("Problems (1)");
        // Half written first, then whole.
        for (bytes, is_whole) in [(b"half".to_vec(), false), (green(), true)] {
            std::fs::write(&picture, bytes).expect("written");
            let start = std::time::Instant::now();
            while (magenta(&mut harness) < 0.01) != is_whole
                || harness.query_by_label("Problems (1)").is_some() == is_whole
            {
                assert!(start.elapsed().as_secs() < 60, "the file is not seen");
                std::thread::sleep(std::time::Duration::from_millis(100));
            }
        }
        std::fs::remove_file(&picture).expect("removed");
    }
}

/// A green picture as the bytes of a file.
fn green() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_pixel(4, 4, image::Rgb([20, 200, 20]))
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("coded");
    bytes.into_inner()
}

/// What a square picture shows whole is whole in one that is higher than wide, and a wide one is as it was.
#[test]
fn a_narrow_picture_cuts_nothing_off() {
    let window = open(Options::default());
    let orbit = window.state().stage().orbit;
    assert!((orbit.within(2.0).vertical_fov - orbit.vertical_fov).abs() < 1e-4);
    let narrow = orbit.within(0.5);
    let edge = |orbit: halfvector_editor::Orbit| orbit.project(glam::Vec3::X).expect("before the camera")[0];
    // In shares of the height: a square one is 0.5 wide on each side, this one 0.25.
    assert!((edge(narrow) - 0.5 * edge(orbit)).abs() < 1e-4);
    assert!(orbit.within(f32::NAN).vertical_fov.is_finite() && orbit.within(0.0).vertical_fov.is_finite());
}
