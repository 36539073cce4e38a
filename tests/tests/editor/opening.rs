//! What stands there when the editor opens.

use egui_kittest::kittest::Queryable;
use halfvector_editor::Options;

use super::{open, settle};

#[test]
fn the_start_material_is_shown() {
    let mut harness = open(Options::default());
    settle(&mut harness);
    let session = harness.state().session();
    assert_eq!(session.document().name, "Worn enamel");
    assert!(!session.is_unsaved());
    harness.get_by_label("Problems").click();
    settle(&mut harness);
    harness.get_by_label("No problems");
}

#[test]
fn a_file_that_is_not_there_is_told() {
    let mut harness = open(Options { document: Some("no/such.material.json".into()), ..Options::default() });
    settle(&mut harness);
    assert!(harness.query_by_label_contains("no/such.material.json").is_some());
}
