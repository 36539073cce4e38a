//! Pages that are made from the code: what is committed is what the code says. `HALFVECTOR_BLESS=1` writes them anew.

use halfvector_graph::docs::nodes_markdown;
use halfvector_graph::library::Library;

use crate::support::{bless, root};

#[test]
fn the_page_of_nodes_is_what_the_library_says() {
    let path = root().join("docs/nodes.md");
    let page = nodes_markdown(Library::standard());
    if bless() {
        std::fs::write(&path, &page).expect("the page can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == page, "docs/nodes.md differs from the library; HALFVECTOR_BLESS=1 writes it anew");
}

#[test]
fn there_are_enough_nodes_to_live_in() {
    assert!(Library::standard().iter().count() >= 190);
}
