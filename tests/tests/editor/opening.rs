//! What stands there when the editor opens.

use egui_kittest::kittest::{NodeT, Queryable};
use halfvector_editor::{Options, egui};

use egui::accesskit::Role;

use super::hands::Window;
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
    // At once: the message does not stay forever.
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("no/such.material.json").is_some());
    settle(&mut harness);
}

/// The headers of the cards that are seen, and the places of their sockets.
fn cards_and_sockets(window: &Window) -> (Vec<egui::Rect>, Vec<egui::Pos2>) {
    let headers =
        window.query_all_by_role(Role::ListItem).filter(|node| is_called(node.accesskit_node().label(), "Node "));
    let sockets = window
        .query_all_by_role(Role::Button)
        .filter(|node| ["Input ", "Output "].iter().any(|word| is_called(node.accesskit_node().label(), word)));
    // What the pane cuts off is told no larger than what is seen of it.
    let pane = window.get_by_label("Graph canvas").rect().shrink(1.0);
    let whole = |rect: &egui::Rect| pane.contains_rect(*rect);
    let sockets = sockets.map(|node| node.rect()).filter(whole).map(|rect| rect.center());
    (headers.map(|node| node.rect()).filter(whole).collect(), sockets.collect())
}

fn is_called(label: Option<String>, word: &str) -> bool {
    label.is_some_and(|label| label.starts_with(word))
}

#[test]
fn no_card_of_an_example_lies_over_another() {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/nodes"));
    let mut over = Vec::new();
    for file in std::fs::read_dir(folder).expect("the examples") {
        let path = file.expect("a file").path();
        let mut window = open(Options { document: Some(path.clone()), ..Options::default() });
        window.run_steps(3);
        let (headers, sockets) = cards_and_sockets(&window);
        assert!(headers.len() > 1 && !sockets.is_empty(), "{}", path.display());
        for (i, header) in headers.iter().enumerate() {
            // A card's own socket may stand beside its title.
            let is_beside = |at: &egui::Pos2| (at.y - header.center().y).abs() < 0.5;
            let covers = |at: &egui::Pos2| header.contains(*at) && !is_beside(at);
            if headers[i + 1..].iter().any(|other| other.intersects(*header)) || sockets.iter().any(covers) {
                over.push(format!("{}: a card at {:?}", path.display(), header.center()));
            }
        }
    }
    assert!(over.is_empty(), "{}", over.join("\n"));
}
