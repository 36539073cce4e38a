//! Where the parts of the window stand: as it opens first, as it was left, with parts on and off.

use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};

use crate::app::Pane;

/// The graph large, the picture and the inspector beside it, the rest below.
pub(crate) fn start() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let canvas = tiles.insert_pane(Pane::Canvas);
    let viewport = tiles.insert_pane(Pane::Viewport);
    let inspector = tiles.insert_pane(Pane::Inspector);
    let code = tiles.insert_pane(Pane::Code);
    let functions = tiles.insert_pane(Pane::Functions);
    let problems = tiles.insert_pane(Pane::Problems);
    let cost = tiles.insert_pane(Pane::Cost);
    let library = tiles.insert_pane(Pane::Library);
    let accuracy = tiles.insert_pane(Pane::Accuracy);
    let canvas = tiles.insert_tab_tile(vec![canvas]);
    let viewport = tiles.insert_tab_tile(vec![viewport]);
    let inspector = tiles.insert_tab_tile(vec![inspector]);
    let below = tiles.insert_tab_tile(vec![code, functions, problems, library, cost, accuracy]);
    let left = split(&mut tiles, LinearDir::Vertical, [canvas, below], 0.66);
    let right = split(&mut tiles, LinearDir::Vertical, [viewport, inspector], 0.5);
    let root = split(&mut tiles, LinearDir::Horizontal, [left, right], 0.64);
    Tree::new("panes", root, tiles)
}

fn split(tiles: &mut Tiles<Pane>, direction: LinearDir, children: [TileId; 2], first: f32) -> TileId {
    let linear = Linear::new_binary(direction, children, first);
    tiles.insert_container(Container::Linear(linear))
}

/// A layout as it was left, when it holds each part once; else the first one.
pub(crate) fn restored(layout: Option<Tree<Pane>>) -> Tree<Pane> {
    let is_whole = |tree: &Tree<Pane>| {
        let panes =
            || tree.tiles.tiles().filter_map(|tile| if let Tile::Pane(pane) = tile { Some(*pane) } else { None });
        tree.root().is_some()
            && panes().count() == Pane::ALL.len()
            && Pane::ALL.iter().all(|pane| panes().any(|other| other == *pane))
    };
    layout.filter(is_whole).unwrap_or_else(start)
}

/// Whether a part is on.
pub(crate) fn is_on(tree: &Tree<Pane>, pane: Pane) -> bool {
    tree.tiles.find_pane(&pane).is_some_and(|tile| tree.tiles.is_visible(tile))
}

/// Puts a part on or off.
pub(crate) fn set_on(tree: &mut Tree<Pane>, pane: Pane, on: bool) {
    if let Some(tile) = tree.tiles.find_pane(&pane) {
        tree.tiles.set_visible(tile, on);
    }
    if on {
        show(tree, pane);
    }
}

/// Brings a part to the front.
pub(crate) fn show(tree: &mut Tree<Pane>, pane: Pane) {
    if let Some(tile) = tree.tiles.find_pane(&pane) {
        tree.tiles.set_visible(tile, true);
        tree.make_active(|other, _| other == tile);
    }
}
