//! The sheet of keys and the page about the program.

use eframe::egui;

use crate::app::keys::{EVERYWHERE, Hint, SHORTCUTS};

/// Groups of keys that panes take themselves.
const PANES: &[(&str, &[Hint])] = &[("Graph", GRAPH), ("Viewport", VIEWPORT)];

const GRAPH: &[Hint] = &[
    Hint { keys: "Space, Tab", what: "Add a node" },
    Hint { keys: "Enter", what: "Add a node that the selected one feeds" },
    Hint { keys: "Drag on the ground", what: "Select with a box" },
    Hint { keys: "Middle drag, wheel", what: "Move and zoom the view" },
    Hint { keys: "Home, F, 1", what: "Show all, the selection, life size" },
    Hint { keys: "Tab, Shift+Tab", what: "Next or previous node, without the pointer on the graph" },
    Hint { keys: "Arrow keys", what: "Move the selection by the grid" },
    Hint { keys: "Ctrl+A, Ctrl+D", what: "Select all, duplicate" },
    Hint { keys: "Delete, Ctrl+Delete", what: "Remove; remove and join what it was between" },
    Hint { keys: "Ctrl+G, Ctrl+Shift+G", what: "Make a group, take it apart" },
    Hint { keys: "Double click, Esc", what: "Open a group, leave it" },
    Hint { keys: "Ctrl+J", what: "Frame the selection" },
    Hint { keys: "L", what: "Arrange the nodes" },
    Hint { keys: "F2", what: "Rename the node" },
];

const VIEWPORT: &[Hint] = &[
    Hint { keys: "Drag", what: "Turn" },
    Hint { keys: "Right or middle drag", what: "Move" },
    Hint { keys: "Wheel or pinch", what: "Nearer or farther" },
    Hint { keys: "Double click", what: "As at first" },
];

/// Draws the sheet; whether it is to be closed.
pub(crate) fn keys(ui: &mut egui::Ui) -> bool {
    ui.heading("Keys");
    egui::ScrollArea::vertical().max_height(ui.ctx().content_rect().height() * 0.7).show(ui, |ui| {
        ui.add_space(4.0);
        ui.strong("Window");
        egui::Grid::new("keys of the window").num_columns(2).striped(true).min_col_width(180.0).show(ui, |ui| {
            for shortcut in SHORTCUTS {
                let text = |keys| ui.ctx().format_shortcut(keys).replace("Questionmark", "?");
                let keys: Vec<String> = shortcut.keys.iter().map(text).collect();
                row(ui, &keys.join(" or "), shortcut.what);
            }
        });
        for (title, hints) in PANES.iter().chain(&[("Everywhere", EVERYWHERE)]) {
            ui.add_space(8.0);
            ui.strong(*title);
            egui::Grid::new(*title).num_columns(2).striped(true).min_col_width(180.0).show(ui, |ui| {
                hints.iter().for_each(|hint| row(ui, hint.keys, hint.what));
            });
        }
    });
    ui.add_space(8.0);
    ui.button("Close").clicked()
}

fn row(ui: &mut egui::Ui, keys: &str, what: &str) {
    ui.monospace(keys);
    ui.label(what);
    ui.end_row();
}

/// Draws the page; whether it is to be closed.
pub(crate) fn about(ui: &mut egui::Ui) -> bool {
    ui.heading("Halfvector");
    ui.label(format!("Version {}", env!("CARGO_PKG_VERSION")));
    ui.add_space(8.0);
    ui.label(
        "Physically based materials as node graphs, seen live, taken home as small, readable and measured shaders.",
    );
    ui.add_space(8.0);
    ui.weak(concat!("Licence: ", env!("CARGO_PKG_LICENSE")));
    ui.add_space(12.0);
    ui.button("Close").clicked()
}
