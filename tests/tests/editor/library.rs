//! The library: every material is sound and can be drawn; one is opened with a click.

use egui_kittest::kittest::Queryable;
use halfvector_editor::Options;
use halfvector_graph::check::check;
use halfvector_graph::library::Library;
use halfvector_ibl::{BakeOptions, bake};
use halfvector_raster::{RasterOptions, draw};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

use super::{open, settle};
use crate::support::root;

#[test]
fn every_material_is_sound_and_is_drawn() {
    let folder = root().join("editor/library");
    let light = bake(&halfvector_ibl::studio(), &BakeOptions { size: 16, irradiance_size: 4, ..Default::default() });
    let options = RasterOptions { width: 8, height: 8, samples_per_side: 1, ..RasterOptions::default() };
    let mut materials = 0;
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("the library").map(|file| file.expect("a file").path()).collect();
    files.sort();
    for file in files {
        let document = halfvector_graph::file::load(&file).expect("a material");
        let text = std::fs::read_to_string(&file).expect("text");
        assert_eq!(halfvector_graph::file::to_json(&document), text, "{} is not as it would be saved", file.display());
        let problems = check(&document, Library::standard());
        assert!(problems.is_empty(), "{}: {problems:?}", file.display());
        let name = file.file_name().expect("a name").to_string_lossy().into_owned();
        materials += usize::from(!name.starts_with("template"));
        // A material of the library needs no file beside it.
        let scene =
            Scene::from_material(document, "".as_ref(), &MeshSource::Builtin(BuiltinMesh::Cube)).expect("a scene");
        let picture = draw::<f32>(&scene, Some(&light), &options, |_| {}).expect("a picture");
        assert!(picture.pixels.as_flattened().iter().all(|x| x.is_finite()), "{name} is not finite");
        let light: f32 = picture.pixels.iter().flat_map(|pixel| &pixel[..3]).sum();
        assert!(light > 0.01, "{name} is black");
    }
    assert!(materials >= 24, "only {materials}");
}

#[test]
fn a_search_finds_and_a_click_opens() {
    let mut harness = open(Options::default());
    harness.get_by_label("Library").click();
    harness.step();
    harness.step();
    assert!(harness.query_by_label("Car paint, red").is_some());
    let field = harness.get_by_role_and_label(eframe::egui::accesskit::Role::TextInput, "Search materials");
    field.focus();
    harness.step();
    harness
        .get_by_role_and_label(eframe::egui::accesskit::Role::TextInput, "Search materials")
        .type_text("precious yellow");
    harness.step();
    harness.step();
    assert!(harness.query_by_label("Car paint, red").is_none());
    harness.state_mut().act(halfvector_editor::Action::Say("Saved /tmp/old.material.json".to_owned()));
    harness.step();
    assert!(harness.query_by_label_contains("Saved /tmp").is_some());
    harness.get_by_label("Gold").click();
    harness.step();
    settle(&mut harness);
    assert!(harness.query_by_label_contains("Saved /tmp").is_none(), "that was told of another material");
    let session = harness.state().session();
    assert_eq!((session.document().name.as_str(), session.file()), ("Gold", None));
    assert!(session.problems().is_empty());
}

#[test]
fn the_furnace_is_measured() {
    let mut harness = open(Options::default());
    harness.get_by_label("Accuracy").click();
    harness.step();
    harness.step();
    harness.get_by_label("Furnace test").click();
    // Errors are measured after it, which is not waited for.
    let start = std::time::Instant::now();
    while harness.query_by_label_contains("Most").is_none() {
        harness.step();
        assert!(start.elapsed().as_secs() < 120, "the furnace gives nothing");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let most = harness.get_by_label_contains("Most").value().expect("a figure");
    let most: f64 = most.trim_start_matches("Most").trim().parse().expect("a number");
    // Enamel and rust reflect a part, and nothing reflects more than it gets.
    assert!((0.2..1.01).contains(&most), "{most}");
}
